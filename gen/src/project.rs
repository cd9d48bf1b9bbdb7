//! Everything a builder gets, as file names and texts.

use helixlock_netlist::Design;

use crate::makefile::makefile;
use crate::test_bench::{test_bench, vectors_text};
use crate::{Board, GenError, Vector, verilog};

/// Files of a project for one board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Project {
    /// Name of the top module.
    pub top: String,
    /// Names of the Verilog files, leaves first.
    pub sources: Vec<String>,
    /// Name, relative to the project's folder, and text of every file.
    pub files: Vec<(String, String)>,
}

/// The project of a design on a board: Verilog, constraints, test bench, Makefile.
///
/// # Errors
///
/// Ports without a pin, and what [`verilog`] finds.
pub fn project(design: &Design, board: &Board, vectors: &[Vector]) -> Result<Project, GenError> {
    let top = design.top();
    board.check(top)?;
    let modules = verilog(design)?;
    let sources: Vec<String> = modules.iter().map(|(name, _)| format!("rtl/{name}.v")).collect();
    let texts = modules.into_iter().map(|(_, text)| text);
    let mut files: Vec<(String, String)> = sources.iter().cloned().zip(texts).collect();
    files.extend([
        (board.file.clone(), board.constraints.clone()),
        ("Makefile".to_owned(), makefile(&top.name, &sources, board)),
        (format!("test/{}_tb.sv", top.name), test_bench(top, board.clock_mhz)),
        ("test/vectors.txt".to_owned(), vectors_text(top, vectors)),
    ]);
    Ok(Project { top: top.name.clone(), sources, files })
}
