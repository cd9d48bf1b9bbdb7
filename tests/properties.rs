//! How random cases are drawn: few, the same in every run, failures kept beside the test.

use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

/// 64 cases from one seed; a case that fails is kept in `<test file>.regressions`.
pub(crate) fn kept_beside_source() -> Config {
    Config {
        cases: 64,
        rng_seed: RngSeed::Fixed(7430),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..Config::default()
    }
}
