//! From bytes to characters.

use std::collections::BTreeSet;

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{Encoding, GB18030, GBK, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::place::Place;

/// The text of a file, line ends as they are.
pub(crate) fn decode(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<String, ImportError> {
    let name = decisions.text("text", "encoding", || {
        let (encoding, reason) = detect(bytes);
        (encoding.name().to_owned(), reason)
    });
    let file = decisions.file();
    let Some(encoding) = Encoding::for_label(name.as_bytes()) else {
        let expected = "an encoding such as `UTF-8`, `GBK`, `windows-1252`, `UTF-16LE`";
        return Err(ImportError::found(
            Place::file(file),
            format!("`encoding = \"{name}\"`"),
            expected,
        ));
    };
    let (text, _, malformed) = encoding.decode(bytes);
    if malformed {
        let before = text.split('\u{fffd}').next().unwrap_or_default();
        let place = crate::text::place(file, &text, before.len());
        let found = format!("bytes that are no {}", encoding.name());
        return Err(ImportError::found(place, found, "text")
            .hinted("`[text] encoding` in a recipe, such as `GBK` or `windows-1252`"));
    }
    if text.chars().take(4096).any(|c| c == '\0') {
        let place = Place::file(file);
        return Err(ImportError::found(
            place,
            "binary data",
            "text, or a format with its own mark",
        ));
    }
    Ok(text.into_owned())
}

fn detect(bytes: &[u8]) -> (&'static Encoding, String) {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return (encoding, "a byte-order mark".into());
    }
    if let Some(encoding) = wide(bytes) {
        return (encoding, "every other byte is nought, without a byte-order mark".into());
    }
    if bytes.is_ascii() {
        return (UTF_8, "nothing but ASCII".into());
    }
    if std::str::from_utf8(bytes).is_ok() {
        return (UTF_8, "every byte fits UTF-8".into());
    }
    if stands_alone(bytes) {
        return (WINDOWS_1252, "no UTF-8; single letters beyond ASCII, as `µ` and `ü`".into());
    }
    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    let guess = detector.guess(None, Utf8Detection::Deny);
    // GB 18030 holds GBK and the rest of Chinese.
    let encoding = if guess == GBK { GB18030 } else { guess };
    (encoding, "no UTF-8; the frequencies of its bytes (chardetng)".into())
}

/// True where few different letters beyond ASCII stand mostly alone: the frequencies of so few tell nothing,
/// and `µm` would be Chinese. A script of its own has many of them, one beside the other.
fn stands_alone(bytes: &[u8]) -> bool {
    const FEW: usize = 8;
    let different: BTreeSet<u8> = bytes.iter().copied().filter(|byte| !byte.is_ascii()).collect();
    let runs = || bytes.chunk_by(|one, next| !one.is_ascii() && !next.is_ascii());
    let beyond = || runs().filter(|run| !run[0].is_ascii());
    let alone = beyond().filter(|run| run.len() == 1).count();
    different.len() < FEW && beyond().count() < 2 * alone
}

/// UTF-16 without a mark: ASCII shows as noughts on one side.
fn wide(bytes: &[u8]) -> Option<&'static Encoding> {
    let sample = &bytes[..bytes.len().min(2000) & !1];
    let noughts =
        |side: usize| sample.iter().skip(side).step_by(2).filter(|byte| **byte == 0).count();
    let (even, odd) = (noughts(0), noughts(1));
    match sample.len() / 2 {
        0..8 => None,
        half if half / 2 < odd && even < half / 20 => Some(UTF_16LE),
        half if half / 2 < even && odd < half / 20 => Some(UTF_16BE),
        _ => None,
    }
}
