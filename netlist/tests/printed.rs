//! Expressions as Verilog text mean what they evaluate to: random trees of every operator, printed,
//! read by Icarus and by yosys, and simulated at random values.

mod trees;

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use helixlock_netlist::{Expression, Node, SignalId};
use trees::{Dice, WIDTHS, constant, tree};

const TREES: usize = 400;
const VECTORS: usize = 24;

/// A tree with a wire for every value that is sliced, for Verilog slices nothing but names.
#[derive(Default)]
struct Wires(Vec<Expression>);

impl Wires {
    /// The same expression, its sliced values in wires.
    fn named(&mut self, expression: &Expression) -> Expression {
        let mut named = expression.clone();
        if let Node::Slice { of, .. } = &mut named.node {
            let inner = self.named(of);
            if !matches!(inner.node, Node::Signal(_)) {
                let place = u32::try_from(WIDTHS.len() + self.0.len()).expect("few");
                **of = Expression::signal(inner.width, SignalId(place));
                self.0.push(inner);
            }
            return named;
        }
        for operand in operands(&mut named) {
            *operand = self.named(operand);
        }
        named
    }
}

fn operands(expression: &mut Expression) -> Vec<&mut Expression> {
    match &mut expression.node {
        Node::Constant(_) | Node::Signal(_) => vec![],
        Node::Not(a) | Node::All(a) | Node::Any(a) | Node::Parity(a) | Node::Extend(a) => vec![a],
        Node::Slice { of, .. } => vec![of],
        Node::And(a, b)
        | Node::Or(a, b)
        | Node::Xor(a, b)
        | Node::Add(a, b)
        | Node::Subtract(a, b)
        | Node::ShiftUp(a, b)
        | Node::ShiftDown(a, b)
        | Node::Equal(a, b)
        | Node::Less(a, b)
        | Node::LessOrEqual(a, b) => vec![a, b],
        Node::Select { condition, then, otherwise } => vec![condition, then, otherwise],
    }
}

fn name(id: SignalId) -> String {
    format!("s{}", id.0)
}

fn range(width: u32) -> String {
    format!("[{}:0]", width - 1)
}

/// A module with an output a tree.
fn module(trees: &[Expression]) -> String {
    let (mut ports, mut body) = (Vec::new(), String::new());
    let mut wires = Wires::default();
    for (index, width) in WIDTHS.iter().enumerate() {
        ports.push(format!("input wire {} s{index}", range(*width)));
    }
    for (index, tree) in trees.iter().enumerate() {
        ports.push(format!("output wire {} y{index}", range(tree.width)));
        let text = wires.named(tree).verilog(&name);
        writeln!(body, "    assign y{index} = {text};").expect("a string");
    }
    let mut declared = String::new();
    for (index, wire) in wires.0.iter().enumerate() {
        let (place, text) = (WIDTHS.len() + index, wire.verilog(&name));
        writeln!(declared, "    wire {} s{place};", range(wire.width)).expect("a string");
        writeln!(body, "    assign s{place} = {text};").expect("a string");
    }
    format!("module trees(\n    {}\n);\n{declared}{body}endmodule\n", ports.join(",\n    "))
}

/// A bench that prints every output at every vector, a line each.
fn bench(trees: &[Expression], vectors: &[[u64; 6]]) -> String {
    let (mut declared, mut ports) = (String::new(), Vec::new());
    for (index, width) in WIDTHS.iter().enumerate() {
        writeln!(declared, "    reg {} s{index};", range(*width)).expect("a string");
        ports.push(format!(".s{index}(s{index})"));
    }
    for (index, tree) in trees.iter().enumerate() {
        writeln!(declared, "    wire {} y{index};", range(tree.width)).expect("a string");
        ports.push(format!(".y{index}(y{index})"));
    }
    let mut body = String::new();
    for vector in vectors {
        for (index, value) in vector.iter().enumerate() {
            writeln!(body, "        s{index} = 64'h{value:x};").expect("a string");
        }
        body.push_str("        #1;\n");
        for index in 0..trees.len() {
            writeln!(body, "        $display(\"%0h\", y{index});").expect("a string");
        }
    }
    let ports = ports.join(", ");
    format!(
        "module bench;\n{declared}    trees dut({ports});\n    initial begin\n{body}    end\nendmodule\n"
    )
}

/// What a program prints; it must succeed.
fn printed_by(program: &str, words: &[&str], folder: &Path) -> String {
    let output =
        Command::new(program).args(words).current_dir(folder).output().unwrap_or_else(|error| {
            panic!("`{program}` of the Debian package cannot start: {error}")
        });
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {words:?}: {said}");
    String::from_utf8(output.stdout).expect("text")
}

#[expect(clippy::disallowed_methods, reason = "a test makes its own input, in its own folder")]
fn put(path: &Path, text: &str) {
    std::fs::write(path, text).expect("a scratch folder is writable");
}

fn simulated(file: &str, folder: &Path) -> Vec<u64> {
    printed_by("iverilog", &["-g2005", "-o", "bench.vvp", file, "bench.v"], folder);
    let lines = printed_by("vvp", &["-n", "bench.vvp"], folder);
    lines.lines().map(|line| u64::from_str_radix(line, 16).expect(line)).collect()
}

/// Every output at every vector, the first that differs told as Verilog.
fn same(trees: &[Expression], found: &[u64], expected: &[u64]) {
    assert_eq!(found.len(), expected.len(), "a line for every output");
    for (place, (found, expected)) in found.iter().zip(expected).enumerate() {
        let tree = &trees[place % trees.len()];
        assert_eq!(found, expected, "{}", tree.verilog(&name));
    }
}

#[test]
fn text_means_what_the_expression_evaluates_to() {
    let mut dice = Dice(0x1977);
    let mut trees = complements_reduced();
    while trees.len() < TREES {
        let (width, depth) = (dice.between(1, 64), dice.between(1, 4));
        let tree = tree(&mut dice, width, depth);
        trees.extend((!shifts_far(&tree)).then_some(tree));
    }
    let vectors: Vec<[u64; 6]> =
        (0..VECTORS).map(|_| WIDTHS.map(|width| constant(&mut dice, width))).collect();
    let expected: Vec<u64> =
        vectors.iter().flat_map(|vector| trees.iter().map(|tree| tree.evaluate(vector))).collect();

    let folder = tempfile::tempdir().expect("a scratch folder");
    put(&folder.path().join("trees.v"), &module(&trees));
    put(&folder.path().join("bench.v"), &bench(&trees, &vectors));
    same(&trees, &simulated("trees.v", folder.path()), &expected);
    let script = "read_verilog trees.v; proc; write_verilog -noattr by_yosys.v";
    printed_by("yosys", &["-q", "-p", script], folder.path());
    same(&trees, &simulated("by_yosys.v", folder.path()), &expected);
}

/// True for a shift by more than 31 bits can count: Icarus 11 takes such a number for negative.
fn shifts_far(expression: &Expression) -> bool {
    let shift = matches!(expression.node, Node::ShiftUp(..) | Node::ShiftDown(..));
    shift && 31 < expression.width || expression.operands().into_iter().any(shifts_far)
}

/// Reductions of complements: without parentheses `^~` is another operator, and `|~` none.
fn complements_reduced() -> Vec<Expression> {
    let complement = || {
        let signal = Expression::signal(12, SignalId(4));
        Box::new(Expression { width: 12, node: Node::Not(Box::new(signal)) })
    };
    let reduced = [Node::All(complement()), Node::Any(complement()), Node::Parity(complement())];
    reduced.map(|node| Expression { width: 1, node }).into()
}
