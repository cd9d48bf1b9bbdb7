//! What the commands share: reading measurements, writing files, words, pieces of pages.

pub(crate) mod angular;
pub(crate) mod answer;
pub(crate) mod board_design;
pub(crate) mod captured;
pub(crate) mod cases;
pub(crate) mod diagnosis_json;
pub(crate) mod diagnosis_page;
pub(crate) mod diagnosis_text;
pub(crate) mod effect_file;
pub(crate) mod input;
pub(crate) mod keys;
pub(crate) mod language;
pub(crate) mod measured;
pub(crate) mod output;
pub(crate) mod page_pieces;
pub(crate) mod progress;
pub(crate) mod quantity;
pub(crate) mod refused;
pub(crate) mod residual_picture;
pub(crate) mod residual_table;
pub(crate) mod series;
pub(crate) mod sheet;
pub(crate) mod spectrum;
pub(crate) mod terminal;
pub(crate) mod wheels;
pub(crate) mod words;
