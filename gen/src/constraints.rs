//! What a constraint file says, in the language of its family's placer.

use crate::Family;

/// Pins behind this line are of ports that a design may lack.
const ASKED_FOR: &str = "Pins of a design that asks for them.";

/// Where a bit of a port goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Port, or bit of one: `calibrate[0]`.
    pub port: String,
    /// Pin of the package.
    pub pin: String,
    /// Connector and purpose.
    pub note: String,
    /// The design may lack the port.
    pub optional: bool,
    /// The pin is pulled up.
    pub pull_up: bool,
}

/// What stands in a line of comment.
pub(crate) fn comment(family: Family, line: &str) -> Option<&str> {
    line.strip_prefix(mark(family))?.strip_prefix(' ')
}

/// All pins, in order of the file.
pub(crate) fn pins(family: Family, text: &str) -> Vec<Pin> {
    let mut optional = false;
    let mut pins = vec![];
    for line in text.lines() {
        optional |= line.ends_with(ASKED_FOR);
        let Some((port, pin)) = place(family, line) else { continue };
        let (_, note) = line.split_once(mark(family)).unwrap_or_default();
        let [port, pin, note] = [port, pin, note.trim()].map(str::to_owned);
        let pull_up = is_pulled_up(family, text, &port);
        pins.push(Pin { port, pin, note, optional, pull_up });
    }
    pins
}

/// Frequency of the clock, MHz.
pub(crate) fn clock_mhz(family: Family, text: &str) -> Option<u32> {
    let rest = text.lines().find_map(|line| line.strip_prefix(clock(family)))?;
    rest.split_ascii_whitespace().next()?.parse().ok()
}

/// How the line with that frequency begins.
pub(crate) fn clock(family: Family) -> &'static str {
    match family {
        Family::Ice40 => "set_frequency clock ",
        Family::Ecp5 => "FREQUENCY PORT \"clock\" ",
        // This language knows pins only.
        Family::Gowin => "// clock: ",
    }
}

/// How a comment begins.
fn mark(family: Family) -> &'static str {
    match family {
        Family::Ice40 | Family::Ecp5 => "#",
        Family::Gowin => "//",
    }
}

/// Port and pin of a line that brings them together.
fn place(family: Family, line: &str) -> Option<(&str, &str)> {
    let (set, _) = line.split_once(mark(family)).unwrap_or((line, ""));
    match family {
        Family::Ice40 => {
            let mut words = set.strip_prefix("set_io ")?.split_ascii_whitespace().rev();
            let pin = words.next()?;
            Some((words.next()?, pin))
        }
        Family::Ecp5 => {
            let mut quoted = set.strip_prefix("LOCATE COMP ")?.split('"').skip(1).step_by(2);
            Some((quoted.next()?, quoted.next()?))
        }
        Family::Gowin => {
            let mut parts = set.strip_prefix("IO_LOC ")?.split('"').skip(1);
            Some((parts.next()?, parts.next()?.trim().trim_end_matches(';')))
        }
    }
}

fn is_pulled_up(family: Family, text: &str, port: &str) -> bool {
    let buffer = format!("PORT \"{port}\" ");
    text.lines().any(|line| match family {
        Family::Ice40 => {
            let of_port = place(family, line).is_some_and(|(found, _)| found == port);
            of_port && line.contains("-pullup yes")
        }
        Family::Ecp5 => line.contains(&buffer) && line.contains("PULLMODE=UP"),
        Family::Gowin => line.contains(&buffer) && line.contains("PULL_MODE=UP"),
    })
}
