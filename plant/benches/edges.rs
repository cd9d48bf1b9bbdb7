//! Pulses of a metre of grinding: 3.2 million fringes and 2.3 million lines.
//!
//! Only the ratio is quoted, with effects against without: machines differ.

use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use helixlock_plant::Model;
use helixlock_plant::edges::Edges;
use helixlock_plant::motion::Pass;

const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "1000 mm" }
spindle.speed = "15 rpm"
lead_screw.lead = "12 mm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

const EFFECTS: &str = r#"
[[effect]]
kind = "screw-periodic"
amplitude = "1.5 um"
[[effect]]
kind = "screw-progressive"
linear = "35 um/m"
[[effect]]
kind = "gear-error"
order = 120
amplitude = "0.3 um"
[[effect]]
kind = "grating-eccentricity"
eccentricity = "10 um"
"#;

fn a_metre(c: &mut Criterion) {
    let mut group = c.benchmark_group("edges");
    group.sample_size(10).throughput(Throughput::Elements(5_478_000));
    for (name, effects) in [("without effects", ""), ("with four effects", EFFECTS)] {
        let text = format!("{MACHINE}{effects}");
        let machine = Model::parse(&text, Path::new("machine.toml")).expect("a machine");
        let pass = Pass::forward(&machine);
        group.bench_function(name, |b| {
            b.iter(|| Edges::new(&machine, &pass).expect("a pass").count());
        });
    }
    group.finish();
}

criterion_group!(benches, a_metre);
criterion_main!(benches);
