use std::path::Path;

use super::{MachineFile, Model};
use crate::rationalisation::implied_um_per_m;
use crate::{Lead, Part, Term};

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

fn parse(text: &str) -> Model {
    Model::parse(text, Path::new("machine.toml")).expect("a machine")
}

fn refusal(text: &str) -> String {
    Model::parse(text, Path::new("machine.toml")).expect_err("bad input").to_string()
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
    // Document 1: the rational N is 0.846 ppm low.
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
    let mut wider = more.model.effects[0].clone();
    wider.values[0] = 1.75;
    let changed = more.with_values(0, &wider).expect("changed");
    assert_eq!(changed.text(), expected.replace("\"1.5 um\"", "\"1.75 um\""));
    assert_eq!(changed.without_effect(1).expect("removed").model.effects.len(), 1);
    let slower = file.with_setting("spindle.speed", "\"3 rpm\"").expect("set");
    assert_eq!(slower.text(), SG7430.replace("\"6 rpm\"", "\"3 rpm\""));
    let phase = file.with_setting("effect.0.phase", "\"45 deg\"").expect("set");
    assert_eq!(phase.text(), SG7430.replace("\"30 deg\"", "\"45 deg\""));
}

/// `effect = [{ … }]` is as good as tables, and an own file may follow either.
#[test]
fn effects_in_a_line_become_tables() {
    let (head, table) = SG7430.split_once("[[effect]]").expect("it has an effect");
    let inline = table.split('#').next().unwrap_or_default().trim().replace('\n', ", ");
    let text = format!("effect = [{{ {inline} }}]\n{head}");
    let file = MachineFile::parse(&text, Path::new("machine.toml")).expect("a machine");
    let own = "# mine\n[[effect]]\nkind = \"phase-drift\"\nrate = \"1 um/h\"\n";
    let more = file.with_text(own, Path::new("own.toml")).expect("added");
    assert_eq!(more.model.effects.len(), 2);
    assert!(more.text().contains("\n[[effect]]\nkind = \"screw-periodic\"\n"), "{}", more.text());
    assert!(more.text().ends_with(own));
    let same = file.with_effect(&more.model.effects[1]).expect("added");
    assert_eq!(same.model.effects[1].values, more.model.effects[1].values);
    let wrong = file.with_text(&own.replace("1 um/h", "1 um"), Path::new("own.toml"));
    let message = wrong.expect_err("no drift").to_string();
    assert!(message.starts_with("own.toml:4:8: "), "{message}");
    let open = file.with_text("[[effect]\n", Path::new("own.toml")).expect_err("open").to_string();
    assert!(open.starts_with("own.toml:1:"), "{open}");
}

#[test]
fn settings_that_have_no_place_are_refused() {
    let file = MachineFile::parse(SG7430, Path::new("machine.toml")).expect("a machine");
    let refused =
        |key: &str, value: &str| file.with_setting(key, value).expect_err("refused").to_string();
    let hint = "expected for example `spindle.speed` or `effect.0.amplitude`";
    assert_eq!(
        refused("effect.1.phase", "\"1 deg\""),
        format!("machine.toml: key `effect.1.phase`: there is no place `1`, {hint}")
    );
    assert_eq!(
        refused("title.speed", "1"),
        format!("machine.toml: key `title.speed`: there is no place `speed`, {hint}")
    );
    assert!(refused("spindle.sped", "\"3 rpm\"").contains("unknown key `sped` in `spindle`"));
    assert!(refused("spindle", "\"3 rpm\"").contains("expected a table"));
    assert!(refused("spindle.speed", "3 rpm").contains("expected a TOML value"));
    assert!(refused("", "1").contains("unknown key"));
}

#[test]
fn a_section_that_is_not_there_is_made() {
    let file = MachineFile::parse(SG7430, Path::new("machine.toml")).expect("a machine");
    let warm = file.with_setting("environment.air_temperature", "\"22 degC\"").expect("set");
    assert_eq!(warm.model.environment.get("air_temperature_c"), Some(22.0));
    let gear = file.with_setting("gear.0.order", "3.5").expect("set");
    assert_eq!(gear.text(), SG7430.replace("order = 2.5", "order = 3.5"));
}

/// One run tells everything that is wrong, in the order of the file.
#[test]
fn all_that_is_wrong_is_told_at_once() {
    let text = "[workpiece]\nlead = \"6\"\nlenght = \"1 m\"\n[spindle]\nspeed = 6\n\
                [[effect]]\nkind = \"screw_periodic\"\n[[effect]]\nkind = \"backlash\"\n";
    let said = refusal(text);
    let lines: Vec<_> = said.lines().collect();
    assert_eq!(lines.len(), 5, "{said}");
    assert!(lines[0].starts_with("machine.toml:2:8: `workpiece.lead` is `\"6\"`"), "{said}");
    assert!(lines[1].contains("unknown key `lenght` in `workpiece`, expected `length`"), "{said}");
    assert!(lines[2].starts_with("machine.toml:5:9: `spindle.speed` is `6`"), "{said}");
    assert!(lines[3].contains("expected `screw-periodic`, or another one of"), "{said}");
    assert!(lines[4].starts_with("machine.toml:8:1: `effect.width` is missing"), "{said}");
}

/// A linear axis needs its screw and nothing of the grinder; what it lacks has no effect.
#[test]
fn an_axis_without_a_device_reads() {
    let text = "lead_screw.lead = \"5 mm\"\nspindle.speed = \"600 rpm\"\n";
    let axis = parse(text);
    assert_eq!(axis.workpiece.lead.to_string(), "5 mm");
    assert_eq!(implied_um_per_m(&axis).to_bits(), 0.0_f64.to_bits());
    assert_eq!(axis.lacks(&[Part::Table, Part::LeadScrew]), None);
    for (kind, part) in
        [("dead-path", "[laser]"), ("lost-steps", "[drive]"), ("grating-slip", "[grating]")]
    {
        let card = Term::card(kind).expect(kind);
        let pairs = card.parameters.iter().map(|what| {
            let quotes = if what.unit.symbol.is_empty() { "" } else { "\"" };
            format!("{} = {quotes}1 {}{quotes}\n", what.name, what.unit)
        });
        let effect: String = pairs.collect();
        let said = refusal(&format!("{text}[[effect]]\nkind = \"{kind}\"\n{effect}"));
        assert!(
            said.ends_with(&format!("effect `{kind}` needs `{part}` in the machine file")),
            "{said}"
        );
    }
    let closed = refusal(&format!("{text}loop.closed = true\n"));
    assert!(closed.contains("`loop.closed` is `true`, but there is no `[drive]`"), "{closed}");
    let dividers = refusal(&format!("{text}dividers = {{ a = 110, b = 150 }}\n"));
    assert_eq!(dividers.lines().count(), 2, "{dividers}");
}

#[test]
fn the_reference_is_fresh() {
    expect_test::expect_file!["../../../docs/machine.md"].assert_eq(&super::reference());
}

/// What the reference shows can be read.
#[test]
fn examples_of_the_reference_read() {
    use super::keys::TABLES;
    let mut text = String::new();
    for table in TABLES.iter().filter(|table| table.name != "output") {
        let head =
            if table.many { format!("[[{}]]", table.name) } else { format!("[{}]", table.name) };
        let lines: Vec<_> = table.keys.iter().map(super::keys::Key::line).collect();
        text.extend([head.as_str(), "\n", &lines.join("\n"), "\n"]);
    }
    let machine = parse(&text);
    assert_eq!(machine.gears[0].mesh_order(), Some(120.0));
    assert_eq!(machine.lacks(&[Part::Workpiece, Part::Laser, Part::Dividers, Part::Drive]), None);
}

/// Rotary chains need nothing of the grinder.
#[test]
fn a_rotary_chain_reads() {
    let machine = parse(
        "[output]\nrotary = true\n[spindle]\nspeed = \"1 rev/day\"\n[[gear]]\nname = \"worm\"\n\
         order = 180\n[[effect]]\nkind = \"gear-error\"\ngear = \"worm\"\namplitude = \"5 arcsec\"\n",
    );
    assert!(machine.rotary);
    let drifting = "output.rotary = true\nspindle.speed = \"1 rpm\"\n[[effect]]\n\
                    kind = \"phase-drift\"\nrate = \"1 deg/h\"\n";
    let drift = parse(drifting).effects[0].clone();
    assert_eq!(
        (drift.parameters[0].key().as_str(), drift.values[0]),
        ("rate_arcsec_per_h", 3600.0)
    );
    assert_eq!(machine.effects[0].values, [5.0, 0.0, 180.0]);
    // δ is an angle, and may be a servo's degrees; the size of a part stays a length.
    let gear = Term::candidate(Term::card("gear-error").expect("known"), true);
    assert_eq!(gear.parameters[0].key(), "amplitude_arcsec");
    assert_eq!(gear.parameters[0].range, 0.0..=36_000.0);
    let disc = Term::candidate(Term::card("grating-eccentricity").expect("known"), true);
    assert_eq!(disc.parameters[0].key(), "eccentricity_um");
    assert!(
        refusal(
            "output.rotary = true\nspindle.speed = \"1 rpm\"\n[[effect]]\nkind = \"gear-error\"\n\
         order = 1\namplitude = \"1 mm\"\n"
        )
        .contains("expected one of the units")
    );
}

mod properties {
    use proptest::prelude::*;

    use super::*;
    use crate::prediction::{Sensor, gain, predict};
    use crate::{CATALOGUE, Effect, Entry, LeadUnit, Parameter, Record, Samples};

    /// A value inside the plausible range, whole where it has to be.
    fn inside(parameter: &Parameter, part: f64) -> f64 {
        let (low, high) = (*parameter.range.start(), *parameter.range.end());
        let value = low + (high - low) * part;
        if parameter.is_whole() { libm::round(value) } else { value }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// A lead that is written is read as the same lead.
        #[test]
        fn leads_come_back(n in 1_i64..100_000, d in 1_i64..10_000, kind in 0_usize..3) {
            let unit = [LeadUnit::Mm, LeadUnit::Inch, LeadUnit::PiMm][kind];
            let lead = Lead { ratio: num_rational::Ratio::new(n, d), unit };
            if (0.001..=1000.0).contains(&lead.mm()) {
                prop_assert_eq!(lead.to_string().parse(), Ok(lead));
            }
        }

        /// Any effect with any values comes back from the file to the bit, and the rest stays.
        #[test]
        fn effects_come_back(which in 0..CATALOGUE.len() - 2, part in 0.0..1.0_f64) {
            let card = CATALOGUE[which];
            let values: Vec<_> = card.parameters.iter().map(|p| inside(p, part)).collect();
            let term = Term::new(card, &values).unwrap();
            let file = MachineFile::parse(SG7430, Path::new("machine.toml")).unwrap();
            let more = file.with_effect(&term).unwrap();
            prop_assert!(more.text().starts_with(SG7430));
            let read = &more.model.effects[1];
            prop_assert_eq!(read.kind(), card.kind);
            prop_assert_eq!(&read.values, &values);
            let back = more.without_effect(1).unwrap().text();
            prop_assert_eq!(back.trim_end(), SG7430.trim_end());
        }

        /// What a sensor shows of an effect is its δ times the gain of its entry.
        #[test]
        fn sensors_show_what_the_sign_table_says(
            entry in 0_usize..6, closed: bool, slope in -9.0..9.0_f64,
        ) {
            let entry = Entry::ALL[entry];
            let mut model = parse(SG7430);
            (model.machine.loop_closed, model.machine.filter_cutoff_hz) = (closed, None);
            model.effects.clear();
            let record = Record::new(&model, &Samples::forward(&model, vec![5.0, 6.0, 8.0]));
            let before = predict(&model, &record).unwrap();
            let mut term = Term::new(Term::card("phase-drift").unwrap(), &[3600.0 * slope]).unwrap();
            term.entry = entry;
            let deltas = term.effect(&model, &record.columns).unwrap().deltas_um(&record);
            model.effects.push(term);
            let after = predict(&model, &record).unwrap();
            for sensor in Sensor::ALL {
                let shown = after.of(sensor)[2] - before.of(sensor)[2];
                let expected = gain(&model, entry, sensor) * (deltas[2] - deltas[0]);
                prop_assert!((shown - expected).abs() < 1e-9 * expected.abs().max(1.0));
            }
        }
    }

    /// The table of [`crate::prediction`], row by row.
    #[test]
    #[allow(clippy::float_cmp, reason = "the gains are constants, not results")]
    fn the_sign_table() {
        let step = 0.0125;
        let table = [
            (Entry::Motion, [-1.0, 0.0, -1.0 / step, 1.0, 0.0]),
            (Entry::LengthReference, [1.0, 0.0, 1.0 / step, 0.0, 1.0]),
            (Entry::AngleReference, [1.0, 0.0, 1.0 / step, 0.0, 1.0]),
            (Entry::Workpiece, [0.0, 0.0, 0.0, 1.0, 1.0]),
            (Entry::Electronics, [1.0, 0.0, 1.0 / step, 0.0, 1.0]),
            (Entry::Actuator, [1.0, 0.0, 1.0 / step, -1.0, 0.0]),
        ];
        let mut machine = parse(SG7430).machine;
        for (entry, row) in table {
            let mut seen = |closed, sensor| {
                machine.loop_closed = closed;
                gain(&machine, entry, sensor)
            };
            let found = [
                seen(false, Sensor::Recorder),
                seen(true, Sensor::Recorder),
                seen(true, Sensor::Counter),
                seen(false, Sensor::Thread),
                seen(true, Sensor::Thread),
            ];
            assert_eq!(found, row, "{entry}");
        }
    }
}
