use std::path::Path;

use super::{Machine, MachineFile};
use crate::prediction::implied_um_per_m;
use crate::{Lead, Term};

pub(crate) const SG7430: &str = r#"# The first example.
title = "SG7430 grinding a 6 mm screw"

[workpiece]
lead = "6 mm"               # kept as an exact ratio
length = "1000 mm"
expansion = "11.5 ppm/K"

[spindle]
speed = "6 rpm"

[lead_screw]                # the machine's own
lead = "12 mm"

[[gear]]
name = "change gear 1"
order = 2.5                 # turns per spindle turn
teeth = 48

[grating]
lines = 13906
diameter = "200 mm"

[laser]
wavelength = "0.63281983 um"
reference_temperature = "20 degC"
reference_pressure = "1013.25 hPa"
reference_humidity = "50 %"

[dividers]
a = 110
b = 150
range = 2
initial_phase = 150
compensation = "0 um/m"

[drive]
step = "0.0125 um"
frequency = "160 Hz"

[filter]
cutoff = "1 Hz"

[loop]
closed = true

[fpga]
clock = "12 MHz"
board = "icestick"

[[effect]]
kind = "screw-periodic"
amplitude = "1.5 um"        # half of 3 µm
phase = "30 deg"
"#;

fn parse(text: &str) -> Machine {
    Machine::parse(text, Path::new("machine.toml")).expect("a machine")
}

fn refusal(text: &str) -> String {
    Machine::parse(text, Path::new("machine.toml")).expect_err("bad input").to_string()
}

#[test]
fn the_example_reads() {
    let machine = parse(SG7430);
    assert_eq!(machine.workpiece.lead.to_string(), "6 mm");
    assert_eq!(machine.lead_screw.as_ref().map(Lead::to_string), Some("12 mm".into()));
    assert_eq!(machine.gear_orders()[1], ("change gear 1 mesh".into(), 120.0));
    assert_eq!(machine.effects[0].values, [1.5, 30.0, 1.0]);
    // Document 1: 13906·6/(60·2·110).
    assert!((machine.comparison_hz() - 6.320_909_090_909_091).abs() < 1e-12);
    // 2·150·λ/2.
    assert!((machine.full_scale_um() - 94.922_974_5).abs() < 1e-9);
}

#[test]
fn the_dividers_leave_what_document_1_makes_them_leave() {
    // facts: the rational N is 0.846 ppm low.
    let slope = implied_um_per_m(&parse(SG7430));
    assert!((slope - -0.846).abs() < 5e-4, "{slope}");
    // Blocking one pulse in 156 000 adds 6.41 µm/m.
    let text = SG7430.replace("0 um/m", "6.4 um/m");
    assert!((implied_um_per_m(&parse(&text)) - (slope + 1e6 / 156e3)).abs() < 1e-9);
}

#[test]
fn places_are_those_of_the_file() {
    assert_eq!(
        refusal(&SG7430.replace("a = 110", "a = 0")),
        "machine.toml:31:5: `dividers.a` is `0`, expected a whole number from 1 to 999"
    );
    assert_eq!(
        refusal(&SG7430.replace("closed = true", "close = true")),
        "machine.toml:45:1: unknown key `close` in `loop`, expected one of closed"
    );
}

#[test]
fn writing_back_keeps_comments_and_order() {
    let file = MachineFile::parse(SG7430, Path::new("machine.toml")).expect("a machine");
    assert_eq!(file.text(), SG7430);
    let card = Term::card("gear-error").expect("in the catalogue");
    let gear = Term::new(card, &[0.25, -90.0, 120.0]).expect("three values");
    let more = file.with_effect(&gear).expect("added");
    let expected = format!(
        "{SG7430}\n[[effect]]\nkind = \"gear-error\"\namplitude = \"0.25 um\"\n\
         phase = \"-90 deg\"\ngear = \"change gear 1\"\nmesh = true\n"
    );
    assert_eq!(more.text(), expected);
    let mut wider = more.machine.effects[0].clone();
    wider.values[0] = 1.75;
    let changed = more.with_values(0, &wider).expect("changed");
    assert_eq!(changed.text(), expected.replace("\"1.5 um\"", "\"1.75 um\""));
    assert_eq!(changed.without_effect(1).expect("removed").machine.effects.len(), 1);
    let slower = file.with_setting("spindle.speed", "\"3 rpm\"").expect("set");
    assert_eq!(slower.text(), SG7430.replace("\"6 rpm\"", "\"3 rpm\""));
    let phase = file.with_setting("effect.0.phase", "\"45 deg\"").expect("set");
    assert_eq!(phase.text(), SG7430.replace("\"30 deg\"", "\"45 deg\""));
}
