//! Recognises rust-hdl's D flip-flop, which is written as Verilog text.

use rust_hdl::core::ast::Verilog;

use crate::scope::parse_literal;
use crate::source::Source;

impl Source {
    /// True for a plain D flip-flop on the rising edge.
    pub(crate) fn is_flip_flop(&self) -> bool {
        self.initial_state().is_some()
    }

    /// Its state at power-up, when it is a flip-flop.
    pub(crate) fn initial_state(&self) -> Option<u64> {
        let Verilog::Custom(code) = &self.code else { return None };
        let words: Vec<&str> = code.split_whitespace().collect();
        let words = words.join(" ");
        let rest = words.strip_prefix("initial begin q = ")?;
        let (initial, rest) = rest.split_once("; ")?;
        (rest == "end always @(posedge clock) begin q <= d; end")
            .then(|| parse_literal(initial).map(|(_, value)| value))?
    }
}
