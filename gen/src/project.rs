//! Everything a builder gets, as file names and texts.

use helixlock_netlist::Design;

use crate::makefile::makefile;
use crate::template::template;
use crate::test_bench::{test_bench, vectors_text};
use crate::{Bench, Board, GenError, verilog};

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

/// The project of a design on a board: Verilog, constraints, test benches, templates, Makefile.
///
/// # Errors
///
/// Ports without a pin, a bench of a module that is not there, and what [`verilog`] finds.
pub fn project(design: &Design, board: &Board, benches: &[Bench]) -> Result<Project, GenError> {
    let top = design.top();
    board.check(top)?;
    let modules = verilog(design)?;
    let sources: Vec<String> = modules.iter().map(|(name, _)| format!("rtl/{name}.v")).collect();
    let texts = modules.into_iter().map(|(_, text)| text);
    let mut files: Vec<(String, String)> = sources.iter().cloned().zip(texts).collect();
    files.push((board.file.clone(), board.constraints.clone()));
    let tested: Vec<&str> = benches.iter().map(|bench| bench.module.as_str()).collect();
    files.push(("Makefile".to_owned(), makefile(&top.name, &sources, &tested, board)));
    for bench in benches {
        let found = design.modules.iter().find(|module| module.name == bench.module);
        let module = found.ok_or_else(|| GenError::NoModule { module: bench.module.clone() })?;
        files.extend([
            (format!("test/{}_tb.sv", module.name), test_bench(module, bench, board.clock_mhz)),
            (format!("test/{}_vectors.txt", module.name), vectors_text(module, &bench.vectors)),
            (format!("templates/{}.v", module.name), template(module)),
        ]);
    }
    Ok(Project { top: top.name.clone(), sources, files })
}
