//! Why no files can be made.

use std::path::PathBuf;
use std::{fmt, io};

use thiserror::Error;

/// Where a tool comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A package of Debian.
    Debian(&'static str),
    /// A package of the Python Package Index.
    Pypi(&'static str),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Debian(package) => write!(f, "on Debian it is in the package `{package}`"),
            Self::Pypi(package) => write!(f, "`pip install {package}` brings it"),
        }
    }
}

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
    /// A board nobody has described.
    #[error("board `{found}` is not known; expected one of {}", known.join(", "))]
    UnknownBoard {
        /// As given.
        found: String,
        /// The boards there are.
        known: Vec<String>,
    },
    /// A constraint file without something every board has.
    #[error("{file}: `{what}` is missing")]
    Constraints {
        /// File name.
        file: String,
        /// What is missing.
        what: &'static str,
    },
    /// Ports and pins that do not match.
    #[error(
        "{file}: found no pin for [{}] and no port for [{}], expected one for each",
        without_pin.join(", "),
        without_port.join(", ")
    )]
    Pins {
        /// File name.
        file: String,
        /// Ports, or bits of them, that have no pin.
        without_pin: Vec<String>,
        /// Pins whose port the design does not have.
        without_port: Vec<String>,
    },
    /// A pin the design does not have.
    #[error("pin `{pin}` is not one of the design")]
    NoPort {
        /// As asked for.
        pin: String,
    },
    /// A block the design does not have.
    #[error("block `{block}` is not one of the design")]
    NoBlock {
        /// As asked for.
        block: String,
    },
    /// A signal the top of a design does not have.
    #[error("signal `{signal}` is not one of the design")]
    NoSignal {
        /// As asked for.
        signal: String,
    },
    /// A block that cannot be taken out.
    #[error("block `{block}`: `{output}` is read, and nothing stands in its place")]
    NoWay {
        /// The block.
        block: String,
        /// Its output.
        output: String,
    },
    /// A module the design does not have.
    #[error("module `{module}` is not one of the design")]
    NoModule {
        /// As asked for.
        module: String,
    },
    /// A tool that is not installed.
    #[error("`{tool}` is not installed\nhint: {origin}")]
    MissingTool {
        /// Command.
        tool: &'static str,
        /// What has it.
        origin: Origin,
    },
    /// icetime without the chip's timing, which Debian packs apart.
    #[error(
        "`icetime` finds no chip database\nhint: on Debian it is in the package \
         `fpga-icestorm-chipdb`"
    )]
    MissingChipDatabase,
    /// A tool that failed.
    #[error("`{tool}` failed ({status}):\n{output}")]
    ToolFailed {
        /// Command.
        tool: &'static str,
        /// Exit status.
        status: String,
        /// The last lines it wrote.
        output: String,
    },
    /// A report without the figure looked for.
    #[error("`{tool}` reported no {figure}; its version may be unknown to us")]
    Report {
        /// Command.
        tool: &'static str,
        /// What is missing.
        figure: &'static str,
    },
    /// A folder or file of the build that cannot be used.
    #[error("{}: {source}", path.display())]
    Folder {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}
