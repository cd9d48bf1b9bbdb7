//! How random cases are drawn: few, the same in every run, failures kept beside the test.

use proptest::test_runner::{Config, FileFailurePersistence, RngSeed};

use crate::support::seeds::all_are_asked;

/// 64 cases from one seed; a case that fails is kept in `<test file>.regressions`.
pub(crate) fn kept_beside_source() -> Config {
    Config {
        cases: 64,
        rng_seed: RngSeed::Fixed(7430),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..Config::default()
    }
}

/// A few cases of something slow, with `HELIXLOCK_SEEDS=all` so many; `PROPTEST_CASES` and
/// `PROPTEST_RNG_SEED` make a campaign of them.
pub(crate) fn few(cases: u32, all: u32) -> Config {
    let kept = kept_beside_source();
    let campaign = Config::default();
    match std::env::var_os("PROPTEST_CASES") {
        Some(_) => Config { cases: campaign.cases, rng_seed: campaign.rng_seed, ..kept },
        None => Config { cases: if all_are_asked() { all } else { cases }, ..kept },
    }
}
