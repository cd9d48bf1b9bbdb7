//! What a formula may remember of the samples before: `lag(column, s)`, `relay(column, middle, width)`.

/// Values as something of first order follows them, from rest; `constant_s` is its time constant.
#[must_use]
pub fn lag(values: &[f64], time_s: &[f64], constant_s: f64) -> Vec<f64> {
    let mut state = values.first().copied().unwrap_or_default();
    let mut before_s = time_s.first().copied().unwrap_or_default();
    let with_time = values.iter().zip(time_s);
    let follow = |(&led, &now_s): (&f64, &f64)| {
        state += (led - state) * -libm::expm1(-(now_s - before_s).max(0.0) / constant_s);
        before_s = now_s;
        state
    };
    with_time.map(follow).collect()
}

/// 1 from where values rise above `middle` by half of `width` to where they fall below it by as
/// much, else 0.
#[must_use]
pub fn relay(values: &[f64], middle: f64, width: f64) -> Vec<f64> {
    let mut on = values.first().is_some_and(|first| middle < *first);
    let switch = |value: &f64| {
        on = middle + 0.5 * width < *value || (on && middle - 0.5 * width <= *value);
        f64::from(u8::from(on))
    };
    values.iter().map(switch).collect()
}

/// Which memory, by its name in a formula and the number of its arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Lag,
    Relay,
}

/// A call of one in a formula, with the words between its brackets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Call {
    pub(super) kind: Kind,
    /// What it is of.
    pub(super) of: String,
    /// Parameters or numbers.
    pub(super) arguments: Vec<String>,
}

impl Kind {
    const ALL: [(&'static str, Self); 2] = [("lag", Self::Lag), ("relay", Self::Relay)];

    /// How it is written.
    pub(super) fn usage(self) -> &'static str {
        match self {
            Self::Lag => "lag(column, time constant in s)",
            Self::Relay => "relay(column, middle, width)",
        }
    }

    fn arguments(self) -> usize {
        match self {
            Self::Lag => 1,
            Self::Relay => 2,
        }
    }

    /// The values that it makes of others.
    pub(super) fn values(self, of: &[f64], time_s: &[f64], arguments: &[f64]) -> Vec<f64> {
        match self {
            Self::Lag => lag(of, time_s, arguments[0]),
            Self::Relay => relay(of, arguments[0], arguments[1]),
        }
    }

    /// The same of a single instant, at which all has been as it is.
    pub(super) fn at_rest(self, value: f64, arguments: &[f64]) -> f64 {
        match self {
            Self::Lag => value,
            Self::Relay => f64::from(u8::from(arguments[0] < value)),
        }
    }
}

/// Name of a call's value in the formula that is left.
pub(super) fn placeholder(index: usize) -> String {
    format!("remembered_{index}_")
}

/// A formula with every call of a memory replaced by a name, and those calls; the call's usage when
/// one is written otherwise.
pub(super) fn taken_out(formula: &str) -> Result<(String, Vec<Call>), &'static str> {
    let mut text = String::with_capacity(formula.len());
    let mut calls = Vec::new();
    let mut rest = formula;
    while let Some((at, kind, open)) = next_call(rest, text.chars().next_back()) {
        let inside = &rest[open + 1..];
        let close = inside.find(')').ok_or(kind.usage())?;
        let mut words = inside[..close].split(',').map(|word| word.trim().to_owned());
        let of = words.next().unwrap_or_default();
        let arguments: Vec<String> = words.collect();
        let plain = |word: &String| {
            !word.is_empty()
                && word.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '-'))
        };
        if arguments.len() != kind.arguments() || !plain(&of) || !arguments.iter().all(plain) {
            return Err(kind.usage());
        }
        text.push_str(&rest[..at]);
        text.push_str(&placeholder(calls.len()));
        calls.push(Call { kind, of, arguments });
        rest = &inside[close + 1..];
    }
    text.push_str(rest);
    Ok((text, calls))
}

/// Where the first call of a memory begins, which, and where its bracket opens.
fn next_call(text: &str, before: Option<char>) -> Option<(usize, Kind, usize)> {
    let of_word = |c: char| c.is_alphanumeric() || c == '_';
    let calls = Kind::ALL.iter().flat_map(|(name, kind)| {
        text.match_indices(name).filter_map(move |(at, _)| {
            let last = text[..at].chars().next_back().or(before);
            let after = &text[at + name.len()..];
            let open = after.len() - after.trim_start().len();
            let called = after[open..].starts_with('(') && !last.is_some_and(of_word);
            called.then_some((at, *kind, at + name.len() + open))
        })
    });
    calls.min_by_key(|(at, ..)| *at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_taken_out_of_a_formula() {
        let (text, calls) =
            taken_out("k*x*lag(oil_c, tau_s) + flag(3) + relay( a , 2.5, w )").expect("a formula");
        assert_eq!(text, "k*x*remembered_0_ + flag(3) + remembered_1_");
        assert_eq!(calls[0].arguments, ["tau_s"]);
        assert_eq!((calls[1].of.as_str(), calls[1].kind), ("a", Kind::Relay));
        assert_eq!(taken_out("lag(oil_c)"), Err(Kind::Lag.usage()));
        assert_eq!(taken_out("relay(oil_c, 1, 2"), Err(Kind::Relay.usage()));
    }

    #[test]
    fn a_lag_follows_a_jump_by_its_time_constant() {
        let followed = lag(&[0.0, 1.0, 1.0], &[0.0, 10.0, 20.0], 10.0);
        assert!((followed[1] - 0.632_120_558_8).abs() < 1e-9, "{followed:?}");
        assert!((followed[2] - 0.864_664_716_8).abs() < 1e-9, "{followed:?}");
    }

    #[test]
    fn a_relay_keeps_its_state_between_its_thresholds() {
        assert_eq!(
            relay(&[1.0, 2.4, 2.6, 2.0, 1.6, 1.4], 2.0, 1.0),
            [0.0, 0.0, 1.0, 1.0, 1.0, 0.0]
        );
    }
}
