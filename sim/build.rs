//! Writes the device as Rust source, `device.rs` in Cargo's output folder.

use std::error::Error;
use std::path::Path;

use helixlock_netlist::{Library, Netlist, elaborate, rust_source};

fn main() -> Result<(), Box<dyn Error>> {
    let card = helixlock_rtl::BLOCKS
        .iter()
        .find(|card| card.name == "device")
        .ok_or("no block is called `device`")?;
    let design = elaborate(card.name, (card.build)().as_ref(), &Library::new())?;
    let source = rust_source::generate(&Netlist::new(&design)?, "DeviceKernel");
    let path = Path::new(&std::env::var("OUT_DIR")?).join("device.rs");
    write(&path, &source)?;
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}

#[expect(clippy::disallowed_methods, reason = "a build script writes where Cargo tells it to")]
fn write(path: &Path, source: &str) -> std::io::Result<()> {
    std::fs::write(path, source)
}
