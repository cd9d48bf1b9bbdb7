//! A formula where no name fits: the grammar of physical terms before the court that judges
//! effects, and what it proposes.

mod errors;
mod held;
mod orders;
mod proposal;
mod search;

pub use proposal::{FormulaParameter, Proposal, RunnerUp};
pub use search::{Discovery, Found, discover};
