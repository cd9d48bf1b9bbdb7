//! A grammar of physical terms: what machines show beyond the catalogue, as formulas that are
//! evaluated, written as text and checked for their units from one description.

mod dimension;
mod expression;
mod grammar;
mod logged;
mod moving;
mod quantities;
mod shape;
mod turning;

pub(crate) use grammar::{formulas, nameless, several_a_turn, sine_between, switching};
pub(crate) use moving::STRAIGHT_LINE;
pub(crate) use shape::{Delta, ORDER, Placed, Shape};
