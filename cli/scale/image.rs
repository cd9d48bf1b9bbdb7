//! EEPROM images as files.

use std::path::{Path, PathBuf};

use anyhow::bail;
use helixlock_metrology::scale::{CorrectionTable, from_hex, from_image, to_hex, to_image};
use helixlock_traces::read_bytes;

use crate::shared::output::write_content;
use crate::shared::refused::in_file;

/// Longest file that may be an image, bytes; as Intel HEX one has some three times its size.
const LONGEST_BYTES: u64 = 1 << 20;

/// Writes an image: Intel HEX by the name, binary otherwise.
///
/// `inputs` is what the table was made of.
pub(crate) fn write_image(
    path: &Path,
    inputs: [PathBuf; 1],
    table: &CorrectionTable,
) -> anyhow::Result<()> {
    let image = to_image(table)?;
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hex")) {
        return write_content(path, inputs, to_hex(&image)?);
    }
    write_content(path, inputs, image)
}

/// Reads an image, Intel HEX or binary by its first byte.
pub(crate) fn read_image(path: &Path) -> anyhow::Result<CorrectionTable> {
    let place = path.display();
    let bytes = read_bytes(path, LONGEST_BYTES)?;
    let refused = in_file(path);
    if bytes.first() != Some(&b':') {
        return from_image(&bytes).map_err(refused);
    }
    let Ok(text) = std::str::from_utf8(&bytes) else {
        bail!("{place}: found other than text after a colon, expected Intel HEX")
    };
    from_image(&from_hex(text).map_err(refused)?).map_err(refused)
}
