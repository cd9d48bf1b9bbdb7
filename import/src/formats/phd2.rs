//! Guide logs of the PHD2 autoguider: what a telescope's worm drive does.
//!
//! The guider measures where a star stands against its mark and pushes the drive back. Without its
//! pushes the drive would be off by the reading and by all pushes before it. A session counts its
//! seconds from `Guiding Begins at`; the clock in that line says how far sessions lie apart.
//! Format: PHD2 user guide, "Analyzing PHD2 Guiding Results" and "Guide log contents".

use helixlock_traces::Column;

use crate::build::Built;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::instant::{Order, parse};
use crate::number::number;
use crate::place::Place;
use crate::question::Answer;
use crate::recipe::Value;

const DAY_S: f64 = 86_400.0;
/// Error codes from here on say that no star was measured; 1 is one that was too bright.
const NO_STAR: f64 = 2.0;
/// Below this declination sky and axis agree to a third of a per cent.
const NEAR_THE_EQUATOR_DEG: f64 = 5.0;

/// Which columns hold an axis.
struct Axis {
    raw: &'static str,
    push: &'static str,
}

/// What is known while reading.
struct Reader<'a> {
    file: &'a str,
    axis: Axis,
    unguided: bool,
    /// Names of the columns, from the line that begins with `Frame`.
    names: Vec<String>,
    scale: Option<f64>,
    given_scale: Option<f64>,
    /// Seconds since 1970 at which the session and the first one began.
    session_s: Option<f64>,
    first_s: Option<f64>,
    pushed: f64,
    fresh: bool,
    pass: f64,
    time_s: Vec<f64>,
    error: Vec<f64>,
    passes: Vec<f64>,
    /// Rows that push without a star, by what the drive is expected to do.
    guessed: usize,
    /// True when a row needed a scale and had none.
    unscaled: bool,
    /// Declinations of the sessions, least and most of their size in degrees.
    declination_deg: Option<[f64; 2]>,
}

/// Reads a guide log.
pub(crate) fn read(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let Wanted { is_dec, unguided, scale } = wanted(decisions);
    let axis = if is_dec {
        Axis { raw: "DECRawDistance", push: "DECGuideDistance" }
    } else {
        Axis { raw: "RARawDistance", push: "RAGuideDistance" }
    };
    let mut reader = Reader::new(decisions.file(), axis, unguided, scale);
    let last = lines.iter().rposition(|line| !line.trim().is_empty());
    for (index, line) in lines.iter().enumerate() {
        if Some(index) == last && reader.is_cut_off(line) {
            decisions.note("the last row ends in the middle and is left out");
        } else {
            reader.line(index + 1, line.trim())?;
        }
    }
    if let Some(note) = reader.declination_deg.filter(|_| !is_dec).and_then(on_the_sky) {
        decisions.note(note);
    }
    reader.finish(decisions)
}

/// What follows the declination's name where a session says where it points: at the start of its line, and in
/// newer logs behind the right ascension.
fn pointing(line: &str) -> Option<&str> {
    let behind = || line.strip_prefix("RA = ")?.split_once(", Dec = ").map(|(_, rest)| rest);
    line.strip_prefix("Dec = ").or_else(behind)
}

/// What to say of right ascension, which a star shows smaller the nearer it is to the pole.
fn on_the_sky([least_deg, most_deg]: [f64; 2]) -> Option<String> {
    let range = if least_deg < most_deg {
        format!("{least_deg} to {most_deg}")
    } else {
        most_deg.to_string()
    };
    (NEAR_THE_EQUATOR_DEG < most_deg).then(|| {
        format!("right ascension is as seen on the sky, at a declination of {range}°: the axis turns by that over its cosine")
    })
}

/// What is wanted of a log.
pub(super) struct Wanted {
    pub(super) is_dec: bool,
    /// What the drive would do without the guider's pushes.
    pub(super) unguided: bool,
    /// Arc seconds a pixel, where the recipe says it.
    pub(super) scale: Option<f64>,
}

/// What the recipe wants of a log, and what is wanted without one.
pub(super) fn wanted(decisions: &mut Decisions<'_>) -> Wanted {
    let axis = decisions
        .text("phd2", "axis", || ("ra".into(), "right ascension turns with the worm".into()));
    let error = decisions.text("phd2", "error", || {
        (
            "unguided".into(),
            "the reading and all pushes before it: what the drive does alone".into(),
        )
    });
    let scale = match decisions.given("phd2", "scale_arcsec") {
        Some(Value::Number(scale)) => Some(*scale),
        _ => None,
    };
    Wanted { is_dec: axis == "dec", unguided: error == "unguided", scale }
}

/// Asks how many arc seconds a pixel is.
pub(super) fn ask_for_scale(decisions: &mut Decisions<'_>) {
    let answer = Answer {
        label: "pixels are written as arc seconds: periods are right, amplitudes are not".into(),
        recipe: "[phd2]\nscale_arcsec = 1.0".into(),
    };
    let text = "the log does not say how many arc seconds a pixel is (`Pixel scale`)";
    decisions.question(text, vec![answer]);
}

impl<'a> Reader<'a> {
    fn new(file: &'a str, axis: Axis, unguided: bool, given_scale: Option<f64>) -> Self {
        Self {
            file,
            axis,
            unguided,
            names: Vec::new(),
            scale: given_scale,
            given_scale,
            session_s: None,
            first_s: None,
            pushed: 0.0,
            fresh: false,
            pass: 1.0,
            time_s: Vec::new(),
            error: Vec::new(),
            passes: Vec::new(),
            guessed: 0,
            unscaled: false,
            declination_deg: None,
        }
    }

    fn line(&mut self, number: usize, line: &str) -> Result<(), ImportError> {
        let begun = !self.time_s.is_empty();
        if let Some(rest) = line.strip_prefix("Guiding Begins at") {
            self.begin(number, line, rest)?;
            self.fresh = begun;
        } else if line.starts_with("Calibration Begins") {
            self.names.clear();
        } else if let Some(rest) = line.split("Pixel scale =").nth(1) {
            self.pixel_scale(number, line, rest)?;
        } else if let Some(rest) = pointing(line) {
            self.declination(rest);
        } else if line.starts_with("INFO: SET LOCK POSITION")
            || line.starts_with("INFO: Server received PAUSE")
            || line.starts_with("INFO: DITHER")
        {
            self.fresh = begun;
        } else if line.starts_with("Frame,") {
            self.names =
                line.split(',').map(|name| name.trim().trim_matches('"').to_owned()).collect();
        } else if line.starts_with(|c: char| c.is_ascii_digit()) && !self.names.is_empty() {
            self.row(number, line)?;
        }
        Ok(())
    }

    fn begin(&mut self, number: usize, line: &str, rest: &str) -> Result<(), ImportError> {
        let place = || Place::word(self.file, number, line, rest.trim());
        let instant = parse(rest, Order::Year).filter(|instant| instant.day.is_some());
        let Some(instant) = instant else {
            return Err(ImportError::found(
                place(),
                quoted(rest.trim()),
                "when guiding began, as `2017-02-18 20:31:15`",
            ));
        };
        let session_s = instant.since(0, 0);
        self.session_s = Some(session_s);
        let first_s = *self.first_s.get_or_insert(session_s);
        if session_s < first_s - DAY_S {
            return Err(ImportError::found(
                place(),
                "a session before the first one",
                "sessions in order of time",
            ));
        }
        self.scale = self.given_scale;
        Ok(())
    }

    fn pixel_scale(&mut self, at: usize, line: &str, rest: &str) -> Result<(), ImportError> {
        let word = rest.split_whitespace().next().unwrap_or_default();
        if self.given_scale.is_some() || word.starts_with("unspecified") || word.is_empty() {
            return Ok(());
        }
        if let Some(scale) = number(word, '.').filter(|scale| 0.0 < *scale && *scale < 1000.0) {
            self.scale = Some(scale);
            Ok(())
        } else {
            let place = Place::word(self.file, at, line, word);
            Err(ImportError::found(place, quoted(word), "a pixel scale in arc seconds"))
        }
    }

    /// `37.7 deg, Hour angle = …`; a mount that does not know has no number there.
    fn declination(&mut self, rest: &str) {
        let word = rest.split([' ', ',']).next().unwrap_or_default();
        let Some(size) = number(word, '.').map(f64::abs).filter(|size| *size < 90.0) else {
            return;
        };
        let [least, most] = self.declination_deg.unwrap_or([size, size]);
        self.declination_deg = Some([least.min(size), most.max(size)]);
    }

    /// True for a row of fewer cells than the header has.
    fn is_cut_off(&self, line: &str) -> bool {
        let is_row = line.trim().starts_with(|c: char| c.is_ascii_digit());
        is_row && 1 < self.time_s.len() && line.split(',').count() < self.names.len()
    }

    fn row(&mut self, line: usize, text: &str) -> Result<(), ImportError> {
        let cells: Vec<&str> = text.split(',').map(|cell| cell.trim().trim_matches('"')).collect();
        let time = self.cell(line, text, &cells, "Time")?;
        let (raw, push) = (self.axis.raw, self.axis.push);
        let is_guess = self.is_without_star(line, text, &cells)?;
        let raw = self.cell(line, text, &cells, raw)?.filter(|_| !is_guess);
        let push = self.cell(line, text, &cells, push)?;
        let Some(time) = time else {
            let place = Place::line(self.file, line);
            return Err(ImportError::found(place, "no time", "the seconds since guiding began"));
        };
        if self.fresh {
            self.pass += 1.0;
            self.pushed = 0.0;
            self.fresh = false;
        }
        self.guessed += usize::from(is_guess && push.is_some());
        self.unscaled |= self.scale.is_none();
        let scale = self.scale.unwrap_or(1.0);
        let pushed = if self.unguided { self.pushed } else { 0.0 };
        let offset_s =
            self.session_s.zip(self.first_s).map_or(0.0, |(session, first)| session - first);
        self.time_s.push(((offset_s + time) * 1e6).round() / 1e6);
        self.error.push(raw.map_or(f64::NAN, |raw| (scale * (raw + pushed) * 1e4).round() / 1e4));
        self.passes.push(self.pass);
        self.pushed += push.unwrap_or(0.0);
        Ok(())
    }

    /// True for a row that says why it has measured no star, where a log says that.
    fn is_without_star(
        &self,
        line: usize,
        text: &str,
        cells: &[&str],
    ) -> Result<bool, ImportError> {
        const WHY: &str = "ErrorCode";
        let says = self.names.iter().any(|name| name == WHY);
        let why = if says { self.cell(line, text, cells, WHY)? } else { None };
        Ok(why.is_some_and(|code| NO_STAR <= code))
    }

    /// A number of a row; `None` when its cell is empty, as when the star was lost.
    fn cell(
        &self,
        line: usize,
        text: &str,
        cells: &[&str],
        name: &str,
    ) -> Result<Option<f64>, ImportError> {
        let place = |index: usize| {
            let before: usize =
                text.split(',').take(index).map(|cell| cell.chars().count() + 1).sum();
            let mut place = Place::line(self.file, line);
            place.at.column = Some(before + 1);
            place
        };
        let Some(index) = self.names.iter().position(|known| known == name) else {
            return Err(ImportError::found(
                Place::line(self.file, line),
                format!("no column `{name}`"),
                "the columns of a guide log",
            ));
        };
        let Some(cell) = cells.get(index) else {
            let found = format!("{} cells", cells.len());
            return Err(ImportError::found(
                place(cells.len()),
                found,
                format!("{} as in the header", self.names.len()),
            ));
        };
        if cell.is_empty() {
            return Ok(None);
        }
        match number(cell, '.') {
            Some(value) => Ok(Some(value)),
            None => Err(ImportError::found(
                place(index),
                format!("{} in column `{name}`", quoted(cell)),
                "a number",
            )),
        }
    }

    fn finish(self, decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
        if self.time_s.is_empty() {
            let place = Place::file(self.file);
            return Err(ImportError::found(
                place,
                "no row of a guided frame",
                "rows below `Frame,Time,mount,…`",
            ));
        }
        if self.unscaled {
            ask_for_scale(decisions);
        }
        if 0 < self.guessed {
            decisions.note(format!(
                "rows without a star (`ErrorCode` 2 and more) hold a guess, which is left out: {}",
                self.guessed
            ));
        }
        match self.first_s {
            Some(_) => decisions.note(
                "time counts from the beginning of the first session, by the clock of the log",
            ),
            None => decisions.note("the log has no clock: time is that of the frames"),
        }
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        let columns = vec![
            column("time_s", self.time_s),
            column("error_arcsec", self.error),
            column("pass", self.passes),
        ];
        Ok(Built { columns, origin_s: self.first_s })
    }
}
