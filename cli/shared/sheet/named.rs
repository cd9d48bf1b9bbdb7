//! What a figure of a sheet is called.

/// A figure as a command names it.
pub(crate) struct Named {
    /// Its symbol.
    pub(crate) symbol: String,
    /// Its name in the file of the sheet.
    pub(crate) key: String,
    /// What it is.
    pub(crate) meaning: String,
    /// Its value, µm.
    pub(crate) value_um: f64,
}
