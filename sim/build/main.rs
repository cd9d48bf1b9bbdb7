//! Writes designs as Rust source into Cargo's output folder: the device, `device.rs`, and what the
//! generator is tested on, `samples.rs`.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_rtl::{APART, BLOCKS, BlockCard};
use random_design::{Dice, random_bits, random_design, random_waiting};

#[path = "../src/engine/random_design.rs"]
mod random_design;
mod rust_source;

/// The block that is compiled into the library, and the name of its kernel.
const DEVICE: &str = "device";
const KERNEL: &str = "DeviceKernel";

/// Random designs compiled into the tests: they take most of a minute to compile.
const RANDOM_DESIGNS: u64 = 16;

/// Designs of flip-flops alone, besides.
const RANDOM_BITS: u64 = 2;

/// Designs that wait for pulses, besides.
const RANDOM_WAITING: u64 = 8;

/// How many of the first, and of the first that wait, run in lanes too, which take longest to compile.
const RANDOM_LANES: u64 = 4;

#[expect(clippy::print_stdout, reason = "a build script speaks to Cargo so")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::var("OUT_DIR")?;
    let device = BLOCKS.iter().find(|card| card.name == DEVICE);
    let device = flat(device.ok_or_else(|| format!("no block is called `{DEVICE}`"))?)?;
    let source =
        rust_source::generate(&device, KERNEL) + &rust_source::generate_lanes(&device, KERNEL);
    write(&Path::new(&folder).join("device.rs"), &source)?;
    write(&Path::new(&folder).join("samples.rs"), &samples()?)?;
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed=src/engine/random_design.rs");
    Ok(())
}

fn flat(card: &BlockCard) -> Result<Netlist, Box<dyn Error>> {
    let design = elaborate(card.name, (card.build)().as_ref(), &Library::new())?;
    Ok(Netlist::new(&design)?)
}

/// Kernels of random designs and of every other block, and a list of each.
fn samples() -> Result<String, Box<dyn Error>> {
    let mut source = String::new();
    let [mut random, mut bits, mut waiting, mut blocks] = [const { String::new() }; 4];
    let [mut lanes, mut waiting_lanes] = [const { String::new() }; 2];
    for seed in 0..RANDOM_DESIGNS {
        let (name, design) = (format!("Random{seed}"), random_design(&mut Dice(seed)));
        source += &rust_source::generate(&design, &name);
        write!(random, "check::<{name}>, ")?;
        if seed < RANDOM_LANES {
            source += &rust_source::generate_lanes(&design, &name);
            write!(lanes, "check_lanes::<{name}>, ")?;
        }
    }
    for seed in 0..RANDOM_BITS {
        let (name, design) = (format!("Bits{seed}"), random_bits(&mut Dice(seed)));
        source += &rust_source::generate(&design, &name);
        write!(bits, "check::<{name}>, ")?;
    }
    for seed in 0..RANDOM_WAITING {
        let (name, design) = (format!("Waiting{seed}"), random_waiting(&mut Dice(seed)));
        source += &rust_source::generate(&design, &name);
        write!(waiting, "check::<{name}>, ")?;
        if seed < RANDOM_LANES {
            source += &rust_source::generate_lanes(&design, &name);
            write!(waiting_lanes, "check_lanes::<{name}>, ")?;
        }
    }
    for (index, card) in BLOCKS.iter().chain(APART).enumerate() {
        if card.name == DEVICE {
            write!(blocks, "check::<{KERNEL}>, ")?;
            continue;
        }
        let name = format!("Block{index}");
        source += &rust_source::generate(&flat(card)?, &name);
        write!(blocks, "check::<{name}>, ")?;
    }
    let engines = [("RANDOM", random), ("BITS", bits), ("WAITING", waiting), ("BLOCKS", blocks)];
    for (list, checks) in engines {
        writeln!(source, "pub(super) const {list}: &[Check] = &[{checks}];")?;
    }
    for (list, checks) in [("LANES", lanes), ("WAITING_LANES", waiting_lanes)] {
        writeln!(source, "pub(super) const {list}: &[LaneCheck] = &[{checks}];")?;
    }
    Ok(source)
}

#[expect(clippy::disallowed_methods, reason = "a build script writes where Cargo tells it to")]
fn write(path: &Path, source: &str) -> std::io::Result<()> {
    std::fs::write(path, source)
}
