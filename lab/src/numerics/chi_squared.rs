//! The χ² law that gains of likelihood follow.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Chance that χ² with `freedom` degrees of freedom exceeds a value.
#[must_use]
pub(crate) fn chi_squared_tail(value: f64, freedom: f64) -> f64 {
    if value <= 0.0 {
        return 1.0;
    }
    ChiSquared::new(freedom).map_or(1.0, |law| law.sf(value))
}
