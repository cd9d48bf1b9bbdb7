use super::*;
use crate::dump::{Dump, Variable};
use crate::vcd::VcdWriter;

fn open(text: &str) -> Result<VcdReader<&[u8]>, TraceError> {
    VcdReader::new(text.as_bytes(), Path::new("wave.vcd"))
}

fn refusal(text: &str) -> String {
    match open(text) {
        Err(error) => error.to_string(),
        Ok(reader) => reader.filter_map(Result::err).map(|error| error.to_string()).collect(),
    }
}

const DECLARED: &str = "$timescale 1ns $end\n$scope module top $end\n$var wire 1 ! a $end\n\
                        $upscope $end\n$enddefinitions $end\n";

#[test]
fn what_is_written_is_read() {
    let variables = [
        Variable::bits("device.meter.t1", 1),
        Variable::real("plant.error_um"),
        Variable::bits("device.count", 12),
    ];
    let mut text = Vec::new();
    let mut dump = VcdWriter::new(&mut text, Tick::PICOSECOND, &variables).unwrap();
    dump.at(5).unwrap();
    dump.bits(0, 1).unwrap();
    dump.real(1, -1.25e-9).unwrap();
    dump.bits(2, 0x1801).unwrap();
    dump.bits(2, 0x801).unwrap(); // no change within twelve bits
    dump.finish(9).unwrap();

    let mut reader = open(std::str::from_utf8(&text).unwrap()).unwrap();
    let mut paths: Vec<_> = reader.signals().iter().map(|signal| signal.path.clone()).collect();
    paths.sort();
    assert_eq!(paths, ["device.count", "device.meter.t1", "plant.error_um"]);
    let changes: Vec<_> = reader.by_ref().map(Result::unwrap).collect();
    let at_five: Vec<_> = changes.iter().filter(|change| change.ticks == 5).collect();
    assert_eq!(at_five.len(), 3);
    assert_eq!(at_five[1].value, Value::Real(-1.25e-9));
    assert_eq!(reader.ticks(), 9);
}

#[test]
fn kinds_beyond_the_standard_are_taken() {
    let text = "$timescale 10 us $end $attrbegin misc 07 \"\" 1 $end\n$scope interface bus $end\n\
                $var logic 1 ! ready $end\n$var wire 8 \" data[7:0] $end\n$var wire 1 # data [3] $end\n\
                $upscope $end\n$enddefinitions $end #0 1! b101 \" #7 0!";
    let mut reader = open(text).unwrap();
    let paths: Vec<_> = reader.signals().iter().map(|signal| signal.path.as_str()).collect();
    assert_eq!(paths, ["bus.ready", "bus.data", "bus.data[3]"]);
    assert_eq!(reader.by_ref().count(), 3);
    assert_eq!(reader.tick().femtoseconds(), 10_000_000_000);
    assert_eq!(reader.ticks(), 7);
}

#[test]
fn errors_name_the_line_of_the_file() {
    assert_eq!(
        refusal(&format!("{DECLARED}#0\n1!\n#5\n1?\n")),
        "wave.vcd:9: found code `?`, expected a code that `$var` declares"
    );
    assert_eq!(
        refusal(&format!("{DECLARED}#5\n#4\n")),
        "wave.vcd:7: found time 4 after 5, expected times that do not go back"
    );
    assert_eq!(
        refusal("position_mm,error_um\n1,2\n"),
        "wave.vcd:1: found text, expected a value change dump, which begins with `$`"
    );
    assert_eq!(
        refusal("$timescale 1ns $end\n$scope module top $end\n"),
        "wave.vcd:3: found the end of the file, expected `$enddefinitions` before it"
    );
}
