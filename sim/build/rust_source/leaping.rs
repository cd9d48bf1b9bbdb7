//! What a kernel may leap over: edges that change nothing but what is known, and counters that coast.

use helixlock_netlist::Netlist;

use super::layout::BITS;
use super::outside::{self, Outside};
use super::packing::Packing;
use super::plan::{Coasting, Plan};
use super::words::number;

/// Bits found one of which is set when an edge changes more; `None` when the tables do not tell.
pub(super) fn busy(plan: &Plan, packing: &Packing) -> Option<u64> {
    let outer = plan.blocks.blocks.iter().filter(|block| block.parent.is_none());
    let active: Option<Vec<u64>> = outer.map(|block| packing.active(block)).collect();
    let left = packing.left_outside(plan);
    let coasts = |register: &usize| {
        let coasting = plan.coasting.iter().find(|coasting| coasting.register == *register)?;
        number(coasting.strays).map_or(Some(0), |word| Some(1 << packing.places.get(&word)?))
    };
    let stray: Option<Vec<u64>> = left.iter().map(coasts).collect();
    let tells = packing.gives_all_to_blocks(plan) && outside::looks_at_known_alone(plan, packing);
    let bits = active?.into_iter().chain(stray?);
    tells.then(|| bits.fold(0, |busy, bit| busy | bit))
}

/// The counters left outside that coast, as Rust.
pub(super) fn coasting(netlist: &Netlist, plan: &Plan, packing: &Packing) -> Vec<String> {
    let left = packing.left_outside(plan);
    let coasting = plan.coasting.iter().filter(|coasting| left.contains(&coasting.register));
    let text = |Coasting { register, width, step, thresholds, .. }: &Coasting| {
        let output = netlist.registers[*register].output.0;
        format!(
            "Coast {{ register: {register}, output: SignalId({output}), width: {width}, step: {step:#x}, thresholds: &{thresholds:?} }}"
        )
    };
    coasting.map(text).collect()
}

/// Which place each output has among those of one bit that follow from what is known, and the
/// statements that give them.
pub(super) fn shown(plan: &Plan, packing: &Packing) -> (Vec<Option<usize>>, Vec<String>) {
    let mut outside = Outside::new(plan, packing);
    let (mut places, mut parts) = (vec![], vec!["0".to_owned()]);
    for output in &plan.outputs {
        let word = number(*output).filter(|word| follows(plan, packing, *word));
        let word = word.filter(|_| parts.len() <= BITS);
        places.push(word.map(|_| parts.len() - 1));
        if word.is_some() {
            outside.compute(word);
            parts.push(format!("{output} << {}", parts.len() - 1));
        }
    }
    let mut lines = outside.lines;
    lines.push(parts.join(" | "));
    (places, lines)
}

/// True for one bit that is computed from what is known.
fn follows(plan: &Plan, packing: &Packing, word: usize) -> bool {
    let mut outside = Outside::new(plan, packing);
    outside.compute(Some(word));
    plan.words.all()[word].width == 1 && outside.looks_at_known_alone()
}
