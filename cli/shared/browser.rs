//! The browser of the user.

use std::ffi::OsStr;
use std::io::{self, Write};

/// Opens an address or a file there, or says that it cannot be: where it is was printed before.
pub(crate) fn open_page(out: &mut impl Write, page: impl AsRef<OsStr>) -> io::Result<()> {
    match open::that_detached(page) {
        Ok(()) => Ok(()),
        Err(_) => writeln!(out, "no browser could be opened"),
    }
}
