//! What the names in a kernel stand for.

use std::collections::BTreeMap;

use rust_hdl::core::ast::VerilogExpression;

use crate::kernel_text::text;
use crate::{Expression, NetlistError, SignalId};

/// What a kernel can name.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Name {
    /// A value: its signal and width.
    Data(SignalId, u32),
    /// The input of a flip-flop or block inside, which rust-hdl's simulator shows one update late.
    WriteOnly(SignalId, u32),
    /// The block's own clock.
    Clock,
    /// The clock of a flip-flop or block inside.
    InnerClock,
    /// An enum's code.
    State(u64),
}

/// The names of one block.
#[derive(Debug)]
pub(crate) struct Scope {
    /// Path of the instance, for messages.
    pub(crate) block: String,
    /// By the name the kernel's syntax tree has, such as `digit$q`.
    pub(crate) names: BTreeMap<String, Name>,
}

impl Scope {
    pub(crate) fn find(&self, name: &str) -> Result<Name, NetlistError> {
        let plain = name.strip_suffix("$next").unwrap_or(name);
        self.names.get(plain).copied().ok_or_else(|| NetlistError::UnknownSignal {
            block: self.block.clone(),
            name: plain.replace('$', "."),
        })
    }

    /// A signal that may be read.
    pub(crate) fn read(&self, name: &str) -> Result<Expression, NetlistError> {
        match self.find(name)? {
            Name::Data(id, width) => Ok(Expression::signal(width, id)),
            Name::State(_) => Err(self.refuse(name, "an enum outside a comparison")),
            Name::WriteOnly(..) => Err(self.refuse(name, "reading an input of an inner block")),
            Name::Clock | Name::InnerClock => Err(self.refuse(name, "a clock used as data")),
        }
    }

    pub(crate) fn unsupported(&self, e: &VerilogExpression, feature: &'static str) -> NetlistError {
        self.refuse(&text(e), feature)
    }

    pub(crate) fn refuse(&self, text: &str, feature: &'static str) -> NetlistError {
        NetlistError::Unsupported {
            block: self.block.clone(),
            text: text.replace('$', "."),
            feature,
        }
    }

    /// A width of 1 to 64 bits.
    pub(crate) fn width(&self, bits: usize, text: &str) -> Result<u32, NetlistError> {
        match u32::try_from(bits) {
            Ok(width @ 1..=64) => Ok(width),
            _ => Err(NetlistError::Width {
                block: self.block.clone(),
                text: text.replace('$', "."),
                found: bits,
                expected: 64,
            }),
        }
    }
}

/// A literal of the kernel: the bits Verilog gives it, its value.
pub(crate) fn literal(scope: &Scope, e: &VerilogExpression) -> Result<(u32, u64), NetlistError> {
    let VerilogExpression::Literal(literal) = e else {
        return Err(scope.unsupported(e, "a computed value here"));
    };
    parse_literal(&format!("{literal:x}")).ok_or_else(|| NetlistError::Literal {
        block: scope.block.clone(),
        literal: text(e),
        expected: 64,
    })
}

/// Reads `12'h3f`.
pub(crate) fn parse_literal(text: &str) -> Option<(u32, u64)> {
    let (width, digits) = text.split_once("'h")?;
    Some((width.parse().ok()?, u64::from_str_radix(digits, 16).ok()?))
}
