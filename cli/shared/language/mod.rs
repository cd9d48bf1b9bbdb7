//! Reports in the language that the user asked for.
//!
//! Commands write English. At the door to the terminal every line is looked up in a table of
//! phrases; what the table does not know stays as it is. Data, such as JSON, never come here.
//! Pages and pictures are looked up text by text when they are written; commands that write them
//! ask what they print to, a [`Reporter`], for the language. The help of commands has a table of its
//! own; what is wrong with words is looked up line by line, as reports are.

mod choice;
pub(crate) mod help;
mod line;
mod phrases;
mod translated;

pub(crate) use self::choice::Language;
pub(crate) use self::translated::{Reporter, Translated};
