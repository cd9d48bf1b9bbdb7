//! Edges from the dump that Icarus writes, a hundred megabytes at times.

use std::path::Path;

use anyhow::{Context, bail, ensure};
use helixlock_original::{Circuit, Edge, Net};

use crate::tools::read;

/// Ticks of the dump in a picosecond.
const TICKS: u64 = 10;

/// Edges since `begins_ps`, in the order of time, then of wires.
pub(super) fn read_edges(
    path: &Path,
    circuit: &Circuit,
    begins_ps: u64,
) -> anyhow::Result<Vec<Edge>> {
    let text = read(path)?;
    let (head, changes) = text.split_once("$enddefinitions $end").context("a head")?;
    let nets = nets(head, circuit);
    let mut edges = Vec::new();
    let mut time_ps = 0;
    for line in changes.lines() {
        match line.as_bytes() {
            [b'#', ..] => {
                let ticks: u64 = line[1..].parse()?;
                ensure!(ticks.is_multiple_of(TICKS), "a change at {ticks} tenths of a picosecond");
                time_ps = ticks / TICKS - begins_ps;
            }
            [level @ (b'0' | b'1'), code @ ..] if 0 < time_ps => {
                if let Some(net) = nets.get(place(code)).copied().flatten() {
                    edges.push(Edge { time_ps, net, level: *level == b'1' });
                }
            }
            [b'x' | b'z', code @ ..] => {
                if let Some(net) = nets.get(place(code)).copied().flatten() {
                    bail!("`{}` is undefined at {time_ps} ps", circuit.nets[net.0]);
                }
            }
            _ => {}
        }
    }
    edges.sort_unstable();
    Ok(edges)
}

/// Nets by the number of their code; `None` for what is no net but a name of a pin.
fn nets(head: &str, circuit: &Circuit) -> Vec<Option<Net>> {
    let mut nets = Vec::new();
    for line in head.lines().filter(|line| line.starts_with("$var")) {
        let mut words = line.split_whitespace().skip(3);
        let (Some(code), Some(name)) = (words.next(), words.next()) else { continue };
        let place = place(code.as_bytes());
        if nets.len() <= place {
            nets.resize(place + 1, None);
        }
        if let Some(net) = circuit.nets.iter().position(|net| net == name) {
            nets[place] = Some(Net(net));
        }
    }
    nets
}

/// The number of a code: its characters are the digits, `!` to `~`.
fn place(code: &[u8]) -> usize {
    code.iter().rev().fold(0, |place, digit| 94 * place + usize::from(digit - b'!'))
}
