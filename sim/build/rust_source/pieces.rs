//! The kernel that leaps: the pieces of a [`Partition`], each on its own.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::dense::indented;
use super::words::{Operand, Words};
use helixlock_netlist::Netlist;
use helixlock_netlist::partition::{CounterPiece, Group, Net, Partition, Readers, Source, Task};

/// `impl Kernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let pieces = Pieces { netlist, partition: &Partition::new(netlist) };
    let partition = pieces.partition;
    let slots = netlist.inputs.len() + netlist.registers.len() + partition.nets.len();
    let nets = word_count(partition.nets.len() + partition.counters.len());
    let groups = word_count(partition.groups.len() + partition.counters.len());
    let counters = partition.counters.len();
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl Kernel for {name} {{
    type Slots = [u64; {slots}];
    type Nets = [u64; {nets}];
    type Groups = [u64; {groups}];
    type Counters = [Coasting; {counters}];

    fn blank(&self) -> Moment<Self> {{
        Moment::new([0; {slots}], [0; {nets}], [0; {groups}], [{coasting}])
    }}

    #[inline(always)]
    fn net(&self, index: usize, now: &mut Moment<Self>) {{
{net}    }}

    #[inline(always)]
    fn group(&self, index: usize, now: &mut Moment<Self>) {{
{group}    }}

    #[inline(always)]
    fn input_changed(&self, index: usize, now: &mut Moment<Self>) {{
{inputs}    }}

    #[inline(always)]
    fn counter_moved(&self, index: usize, now: &mut Moment<Self>) {{
{woken}    }}
}}
",
        coasting = pieces.coasting(),
        net = pieces.nets_and_modes(),
        group = pieces.groups_and_loads(),
        inputs = pieces.input_readers(),
        woken = pieces.counter_readers(),
    );
    source
}

struct Pieces<'a> {
    netlist: &'a Netlist,
    partition: &'a Partition,
}

impl Pieces<'_> {
    fn nets_and_modes(&self) -> String {
        let nets = self.partition.nets.iter().enumerate();
        let counters = self.partition.counters.iter().enumerate();
        choice(
            nets.map(|(index, net)| self.net(index, net))
                .chain(counters.map(|(index, piece)| self.mode(index, piece))),
        )
    }

    fn groups_and_loads(&self) -> String {
        let groups = self.partition.groups.iter();
        let counters = self.partition.counters.iter().enumerate();
        choice(
            groups
                .map(|group| self.group(group))
                .chain(counters.map(|(index, piece)| self.load(index, piece))),
        )
    }

    fn input_readers(&self) -> String {
        choice((0..self.netlist.inputs.len()).map(|index| self.marks(Source::Input(index))))
    }

    fn counter_readers(&self) -> String {
        choice((0..self.partition.counters.len()).map(|index| self.marks(Source::Counter(index))))
    }

    fn net(&self, index: usize, net: &Net) -> Vec<String> {
        let mut words = self.words(&net.task);
        let value = words.signal(net.signal);
        let slot = self.net_slot(index);
        let mut marks = self.marks(Source::Net(index));
        marks.push(format!("now.changed[{}] |= {:#x};", index / 64, 1_u64 << (index % 64)));
        let mut lines = words.lines();
        lines.push(update(slot, value, &marks));
        lines
    }

    fn group(&self, group: &Group) -> Vec<String> {
        let mut words = self.words(&group.task);
        let next: Vec<(usize, Operand)> = group
            .registers
            .iter()
            .map(|index| (*index, words.signal(self.netlist.registers[*index].input)))
            .collect();
        let mut lines = words.lines();
        lines.extend(next.into_iter().map(|(register, value)| {
            let marks = self.marks(Source::Register(register));
            update(self.register_slot(register), value, &marks)
        }));
        lines
    }

    /// Tells how a counter moves from now on, and until when.
    fn mode(&self, index: usize, piece: &CounterPiece) -> Vec<String> {
        let mut words = self.words(&piece.mode);
        let counting = words.value(&piece.counter.counting);
        let step = words.value(&piece.counter.step);
        let thresholds = piece.counter.thresholds.iter();
        let thresholds: Vec<String> =
            thresholds.map(|threshold| words.value(threshold).to_string()).collect();
        let mut lines = words.lines();
        lines.push(format!(
            "now.count({index}, choose({counting}, {step}, 0), &[{}]);",
            thresholds.join(", "),
        ));
        let load = self.partition.groups.len() + index;
        let mark = format!("now.groups[{}] |= {:#x};", load / 64, 1_u64 << (load % 64));
        lines.push(format!("if {counting} == 0 {{ {mark} }}"));
        lines
    }

    fn load(&self, index: usize, piece: &CounterPiece) -> Vec<String> {
        let register = piece.counter.register;
        let mut words = self.words(&piece.load);
        let value = words.signal(self.netlist.registers[register].input);
        let mut lines = words.lines();
        lines.push(format!("now.load({index}, {value});"));
        lines
    }

    /// Code in which everything a piece reads has its place.
    fn words(&self, task: &Task) -> Words<'_> {
        let mut words = Words::new(self.netlist);
        for (signal, source) in &task.reads {
            words.place(*signal, &self.place(*source));
        }
        words.body(&task.body);
        words
    }

    fn place(&self, source: Source) -> String {
        match source {
            Source::Input(index) => format!("now.slots[{index}]"),
            Source::Register(index) => format!("now.slots[{}]", self.register_slot(index)),
            Source::Net(index) => format!("now.slots[{}]", self.net_slot(index)),
            Source::Counter(index) => format!("now.counter({index})"),
            Source::Nothing => "0_u64".to_owned(),
        }
    }

    /// Statements that call upon the readers of a source.
    fn marks(&self, source: Source) -> Vec<String> {
        let none = Readers::default();
        let readers = self.partition.readers.get(&source).unwrap_or(&none);
        let mut marks = bits("now.nets", &readers.nets);
        marks.extend(bits("now.groups", &readers.groups));
        marks
    }

    /// The counters at rest.
    fn coasting(&self) -> String {
        let counters = self.partition.counters.iter().map(|piece| {
            let register = piece.counter.register;
            let (slot, width) = (self.register_slot(register), self.register_width(register));
            format!("Coasting::rest({slot}, {width})")
        });
        counters.collect::<Vec<_>>().join(", ")
    }

    fn register_slot(&self, register: usize) -> usize {
        self.netlist.inputs.len() + register
    }

    fn net_slot(&self, net: usize) -> usize {
        self.netlist.inputs.len() + self.netlist.registers.len() + net
    }

    fn register_width(&self, register: usize) -> u32 {
        self.netlist.signal(self.netlist.registers[register].output).width
    }
}

/// Stores a value and calls upon its readers if it is a new one.
fn update(slot: usize, value: Operand, marks: &[String]) -> String {
    let marks = marks.join(" ");
    format!("if now.slots[{slot}] != {value} {{ now.slots[{slot}] = {value}; {marks} }}")
}

/// Statements that set bits in an array of words.
fn bits(words: &str, set: &BTreeSet<usize>) -> Vec<String> {
    let last = set.last().map_or(0, |last| last / 64 + 1);
    (0..last)
        .filter_map(|word| {
            let here = set.iter().filter(|index| *index / 64 == word);
            let bits = here.fold(0_u64, |bits, index| bits | 1 << (index % 64));
            (bits != 0).then(|| format!("{words}[{word}] |= {bits:#x};"))
        })
        .collect()
}

/// `match index { 0 => …, 1 => … }`
fn choice(arms: impl Iterator<Item = Vec<String>>) -> String {
    let mut source = String::from("        match index {\n");
    for (index, lines) in arms.enumerate() {
        // Writing into a string does not fail.
        let _ = write!(source, "        {index} => {{\n{}        }}\n", indented(&lines));
    }
    source + "        _ => {}\n        }\n"
}

fn word_count(bits: usize) -> usize {
    bits.div_ceil(64).max(1)
}
