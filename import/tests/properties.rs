//! Whatever bytes come, an answer comes back.

use helixlock_import::{Recipe, Source, propose};
use proptest::collection::vec;
use proptest::prelude::*;

const SAMPLES: [&[u8]; 22] = [
    include_bytes!("samples/german.csv"),
    include_bytes!("samples/chinese-gbk.csv"),
    include_bytes!("samples/chinese-utf16.txt"),
    include_bytes!("samples/runs-as-columns.csv"),
    include_bytes!("samples/blocks.txt"),
    include_bytes!("samples/date-and-clock.csv"),
    include_bytes!("samples/laser.rtl"),
    include_bytes!("samples/iso230.md"),
    include_bytes!("samples/camonitor.log"),
    include_bytes!("samples/scope.csv"),
    include_bytes!("samples/scope-stamps.csv"),
    include_bytes!("samples/scope-rates.csv"),
    include_bytes!("samples/guide-log.txt"),
    include_bytes!("samples/record.npy"),
    include_bytes!("samples/workbook.xlsx"),
    include_bytes!("samples/sheet.ods"),
    include_bytes!("samples/debug-log.txt"),
    include_bytes!("samples/session.mat"),
    include_bytes!("samples/plain.mat"),
    include_bytes!("samples/session73.mat"),
    include_bytes!("samples/logger.h5"),
    include_bytes!("samples/session.feather"),
];

fn read(bytes: &[u8]) {
    for name in ["data.csv", "screw.comp"] {
        if let Ok(proposal) = propose(&[Source { name, bytes }], &Recipe::default()) {
            let text = proposal.recipe.to_string();
            prop_assert_recipe(&text);
        }
    }
}

fn prop_assert_recipe(text: &str) {
    let again = Recipe::parse(text, "recipe").unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(again.to_string(), text);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn any_bytes_get_an_answer(bytes in vec(any::<u8>(), 0..2000)) {
        read(&bytes);
    }

    #[test]
    fn any_table_like_text_gets_an_answer(text in "[-0-9a-fA-F.,;:\t \n\"#%+/°µ\\[\\]()|=]{0,600}") {
        read(text.as_bytes());
    }

    #[test]
    fn a_damaged_sample_gets_an_answer(
        sample in 0..SAMPLES.len(),
        places in vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in any::<prop::sample::Index>(),
        cuts in any::<bool>(),
    ) {
        let mut bytes = SAMPLES[sample].to_vec();
        for (place, byte) in places {
            let at = place.index(bytes.len());
            bytes[at] = byte;
        }
        if cuts {
            bytes.truncate(cut.index(bytes.len()));
        }
        read(&bytes);
    }

    #[test]
    fn any_recipe_gets_an_answer(text in "[a-z\\[\\]_= \"\n0-9.,#-]{0,200}") {
        let _ = Recipe::parse(&text, "recipe");
    }
}
