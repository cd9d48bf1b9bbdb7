//! Waves of a turn that are the harmonics of one shape.
//!
//! What comes again several times a turn in no smooth shape, the poles of a motor or the pawl of an index, has
//! waves at all multiples of its number. Each by itself is one of a circle that is divided unevenly; such a
//! circle has no reason to show all multiples of one number, and no wave between.

use super::beside_the_rest::gain;
use crate::hypotheses::Structure;
use crate::model::{Problem, State};
use crate::numerics::{chi_squared_tail, count};
use crate::policy::evidence::{FEWEST_TEETH, MISSING_TEETH};

/// A wave of a model, by its place there, and which multiple of the comb's number it is.
type Tooth = (usize, u32);

/// Places of the waves of a model that are the harmonics of one shape, and that shape.
#[must_use]
pub(crate) fn one_comb(problem: &Problem, state: &State) -> Option<(Vec<usize>, Structure)> {
    let names = state.components.iter().map(|component| component.term.name.as_str());
    let comb = names.filter_map(|name| comb_of(state, name)).max_by_key(Vec::len)?;
    let (first, multiple) = comb[0];
    let order = state.components[first].waves_a_turn(problem) / f64::from(multiple);
    let places: Vec<usize> = comb.into_iter().map(|(place, _)| place).collect();
    let sum = |of: &dyn Fn(usize) -> f64| places.iter().map(|place| of(*place)).sum::<f64>();
    let gains = sum(&|place| gain(problem, state, place).unwrap_or(0.0));
    let freedom = sum(&|place| state.components[place].freedom());
    let size = |place: usize| state.components[place].size_um(problem, state.coefficients(place).0);
    let rms_um = sum(&|place| size(place) * size(place)).sqrt();
    let (shape, p_value) =
        ("comes again evenly, in no smooth shape", chi_squared_tail(gains, freedom));
    let told = Structure::without_place("spindle order", shape, rms_um, p_value);
    Some((places, Structure { at: Some(order), ..told }))
}

/// The longest comb of more than one a turn among the waves of a name.
fn comb_of(state: &State, name: &str) -> Option<Vec<Tooth>> {
    let waves = || {
        let all = state.components.iter().enumerate().filter(|(_, one)| one.term.name == name);
        all.filter_map(|(place, one)| Some((place, one.term.harmonic()?)))
    };
    let most = waves().map(|(_, waves)| waves).max()?;
    let teeth = |number: u32| -> Vec<Tooth> {
        waves()
            .filter(|(_, waves)| waves % number == 0)
            .map(|(place, waves)| (place, waves / number))
            .collect()
    };
    (2..=most).map(teeth).filter(|teeth| is_a_comb(teeth)).max_by_key(Vec::len)
}

fn is_a_comb(teeth: &[Tooth]) -> bool {
    let last = teeth.iter().map(|(_, multiple)| *multiple).max().unwrap_or(0);
    FEWEST_TEETH <= teeth.len() && f64::from(last) <= count(teeth.len() + MISSING_TEETH)
}
