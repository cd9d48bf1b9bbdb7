//! Why no files can be made.

use thiserror::Error;

/// A design or board that cannot be written down.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GenError {
    /// A name that Verilog or SystemVerilog does not allow.
    #[error("module `{module}`: `{name}` is {found}; expected a plain identifier")]
    Name {
        /// Module.
        module: String,
        /// The name.
        name: String,
        /// What is wrong with it.
        found: &'static str,
    },
    /// Bits of a computed value, which Verilog cannot take.
    #[error(
        "module `{module}`: `{signal}` takes bits of a computed value; expected bits of a signal"
    )]
    CutValue {
        /// Module.
        module: String,
        /// Signal assigned.
        signal: String,
    },
}
