//! Ten millimetres of the 6 mm example, loop open and loop closed, plant included.

use std::path::Path;

use criterion::{Criterion, Throughput};
use helixlock_plant::Model;
use helixlock_sim::{Course, Options, simulate};

pub(crate) fn closed_loop(criterion: &mut Criterion) {
    let path = Path::new("examples/sg7430-6mm/machine.toml");
    let machine = Model::read(path).expect("the example is a machine file");
    let options = Options { length_mm: Some(10.0) };
    let course = Course::new(&machine, &options).expect("the example can be simulated");
    let mut group = criterion.benchmark_group("closed_loop");
    group.throughput(Throughput::Elements(course.clocks())).sample_size(20);
    group.bench_function("clocks", |bencher| {
        bencher.iter(|| simulate(&machine, &options, &mut |_| {}).map(|run| run.closed.clocks));
    });
    group.finish();
}
