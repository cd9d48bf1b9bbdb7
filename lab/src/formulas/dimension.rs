//! Units of a formula's parts, multiplied and divided like numbers.

use std::collections::BTreeMap;
use std::fmt;

/// A product of powers of units, in halves; a pure number has none. An angle in turns is a pure
/// number.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Dimension(BTreeMap<String, i32>);

/// Endings of column names, and the units they stand for.
const SUFFIXES: &[(&str, &str)] = &[
    ("_mm", "mm"),
    ("_s", "s"),
    ("_rpm", "rpm"),
    ("_c", "°C"),
    ("_hpa", "hPa"),
    ("_pct", "%"),
    ("_n", "N"),
    ("_um", "µm"),
    ("_arcsec", "arcsec"),
    ("_deg", "°"),
    ("_a", "A"),
    ("_v", "V"),
    ("_w", "W"),
];

impl Dimension {
    /// A pure number.
    pub(crate) fn number() -> Self {
        Self::default()
    }

    /// One unit.
    pub(crate) fn unit(symbol: &str) -> Self {
        Self([(symbol.to_owned(), 2)].into())
    }

    /// That of a column by the end of its name; one that ends in no known unit has its own.
    pub(crate) fn of_column(name: &str) -> Self {
        let known = SUFFIXES.iter().find(|(suffix, _)| name.ends_with(suffix));
        Self::unit(known.map_or(name, |(_, symbol)| symbol))
    }

    /// True for a pure number.
    pub(crate) fn is_number(&self) -> bool {
        self.0.is_empty()
    }

    /// The unit of a quotient.
    pub(crate) fn over(&self, other: &Self) -> Self {
        self.times(&other.to_the(-1))
    }

    /// The unit of a product.
    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut product = self.0.clone();
        for (unit, power) in &other.0 {
            *product.entry(unit.clone()).or_default() += power;
        }
        product.retain(|_, power| *power != 0);
        Self(product)
    }

    /// The unit of a power.
    pub(crate) fn to_the(&self, power: i32) -> Self {
        Self(self.0.iter().map(|(unit, own)| (unit.clone(), own * power)).collect())
    }

    /// The unit of a square root; `None` when there are no such units.
    pub(crate) fn root(&self) -> Option<Self> {
        let even = self.0.values().all(|power| power % 2 == 0);
        even.then(|| Self(self.0.iter().map(|(unit, own)| (unit.clone(), own / 2)).collect()))
    }
}

impl fmt::Display for Dimension {
    /// `µm/mm/°C`, `1/s`; nothing for a pure number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let power = |f: &mut fmt::Formatter<'_>, (unit, power): (&String, i32)| match power {
            2 => write!(f, "{unit}"),
            halves => write!(f, "{unit}^{}", 0.5 * f64::from(halves)),
        };
        let mut above = self.0.iter().filter(|(_, power)| 0 < **power).peekable();
        if above.peek().is_none() && !self.0.is_empty() {
            f.write_str("1")?;
        }
        for (place, (unit, times)) in above.enumerate() {
            f.write_str(if place == 0 { "" } else { "·" })?;
            power(f, (unit, *times))?;
        }
        for (unit, times) in self.0.iter().filter(|(_, power)| **power < 0) {
            f.write_str("/")?;
            power(f, (unit, -times))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_multiplied_and_divided() {
        let slope = Dimension::unit("µm")
            .over(&Dimension::unit("mm").times(&Dimension::of_column("oil_temperature_c")));
        assert_eq!(slope.to_string(), "µm/mm/°C");
        assert_eq!(slope.over(&slope), Dimension::number());
        assert_eq!(Dimension::unit("s").to_the(-2).to_string(), "1/s^2");
        let root = Dimension::unit("mm").root().expect("a half power");
        assert_eq!(Dimension::unit("µm").over(&root).to_string(), "µm/mm^0.5");
        assert_eq!(root.root(), None);
        assert_eq!(Dimension::of_column("coolant_l_min").to_string(), "coolant_l_min");
    }
}
