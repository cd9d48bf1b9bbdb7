//! The search for what a model lacks: effects are added while they are accepted, pruned when they
//! are superfluous, held against their rivals, and polished on all rows.

mod acceptance;
mod aliases;
mod analysis;
mod beside_the_rest;
mod chosen_again;
mod come_again;
mod court;
mod flanks;
mod judging;
mod known_together;
mod likeness;
mod one_cause;
mod one_comb;
mod orders;
mod other_spectrum;
mod own_errors;
mod polish;
mod pruning;
mod refusal;
mod rivals;
mod running_off;
mod seats;
mod span;
mod starts;
mod suspected;
mod together;
mod uneven;
mod unlisted_order;

pub(crate) use analysis::{Step, search, take_for_a_shape, tried_beside};
pub(crate) use beside_the_rest::{not_told, untold};
pub(crate) use come_again::come_again;
pub(crate) use court::{Claim, claims, hear, nobodys};
pub(crate) use flanks::at_flanks;
pub(crate) use one_cause::one_cause;
pub(crate) use one_comb::one_comb;
pub(crate) use own_errors::{in_place_of, left_at_targets, own_errors, paid, paid_by_formula};
pub(crate) use polish::polished;
pub(crate) use pruning::{Dropped, errors_of_counts, pruned, pruned_in_doubt};
pub(crate) use refusal::Refusal;
pub(crate) use rivals::{Rivals, rivals};
pub(crate) use running_off::running_off;
pub(crate) use suspected::suspected;
pub(crate) use unlisted_order::unlisted_order;
