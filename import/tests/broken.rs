//! Broken files of every format, each with the message its user gets.
//!
//! A case is a whole sample with one thing changed: `expected/broken.txt` holds what is changed and
//! what is said, side by side. `UPDATE_EXPECT=1` rewrites it, for a person to read.

use std::fmt::Write;
use std::path::Path;

use expect_test::expect_file;
use helixlock_import::{ImportError, Recipe, Source, apply};

/// What is changed in a sample.
enum Change {
    /// The first place of a text becomes another.
    Replace(&'static str, &'static str),
    /// The whole file.
    Whole(&'static [u8]),
    /// Only so many bytes of it.
    Cut(usize),
    /// A byte.
    Byte(usize, u8),
}

use Change::{Byte, Cut, Replace, Whole};

/// Sample, change, and what the recipe says.
type Case = (&'static str, Change, &'static str);

const TABLES: &[Case] = &[
    ("german.csv", Whole(b""), ""),
    ("german.csv", Whole(b"\n\n \n"), ""),
    ("german.csv", Whole(b"hello world\n"), ""),
    ("german.csv", Whole(b"Position [mm];Fehler [um]\n"), ""),
    ("german.csv", Whole(b"\x00\x01\x02\x03\x04\x05"), ""),
    ("german.csv", Whole(b"%PDF-1.7 rest"), ""),
    ("german.csv", Whole(b"\x1F\x8B\x08\x00"), ""),
    ("german.csv", Whole(b"ARROW1\x00\x00"), ""),
    ("german.csv", Whole(b"\x89HDF\r\n\x1a\n"), ""),
    ("german.csv", Whole(b"MATLAB 5.0 MAT-file, Platform: PCWIN64"), ""),
    ("german.csv", Whole(b"FEA1\x00\x00\x00\x00"), ""),
    ("german.csv", Whole(b"\xFF\xFF\xFF\xFF\x10\x00\x00\x00"), ""),
    ("german.csv", Whole(b"\0\0\0\0\x02\0\0\0\x01\0\0\0\0\0\0\0\x02\0\0\0x\0\0\0\0\0\0\0\0\0"), ""),
    ("german.csv", Replace("10,000;", "1o,000;"), ""),
    ("german.csv", Replace("10,000;", "10,0,00;"), ""),
    ("german.csv", Replace("10,000;", "inf;"), ""),
    ("german.csv", Replace("10,000;", "1e999;"), ""),
    ("german.csv", Replace("10,000;", "10,000 mm;"), ""),
    ("german.csv", Replace("10,000;", "10,000;;;;;"), ""),
    ("german.csv", Replace("10,000;", ""), ""),
    ("german.csv", Replace("10,000;", "\"10,000;"), ""),
    ("german.csv", Replace("gut\r\n190", "gut\r\n1x90"), ""),
    ("german.csv", Replace("Fehler [", "Position ["), ""),
    ("german.csv", Replace("Fehler [\u{b5}m]", "Spannung [V]"), ""),
    ("german.csv", Replace("Position [mm]", "Farbe"), ""),
    ("german.csv", Replace("Position [mm]", "Position"), ""),
    ("german.csv", Replace("Fehler [\u{b5}m]", "Fehler"), ""),
    ("german.csv", Cut(560), ""),
    ("german.csv", Replace("", ""), "[text]\nencoding = \"klingon\""),
    ("german.csv", Replace("", ""), "[text]\nencoding = \"UTF-8\""),
    ("german.csv", Replace("", ""), "[text]\ndelimiter = \"semicolon\""),
    ("german.csv", Replace("", ""), "[text]\ndecimal = \".\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"phd2\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"renishaw\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"iso230\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"camonitor\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"twincat\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"linuxcnc-comp\""),
    ("german.csv", Replace("", ""), "[file]\nformat = \"spreadsheet\""),
    ("german.csv", Replace("", ""), "[[column]]\nfrom = \"Position [mm]\"\nunit = \"\u{b0}C\""),
    ("german.csv", Replace("", ""), "[[column]]\nfrom = \"Position [mm]\"\nunit = \"parsec\""),
    ("german.csv", Replace("", ""), "[[column]]\nfrom = \"Fehler [\u{b5}m]\"\nminus = \"Soll\""),
    ("german.csv", Replace("", ""), "[[column]]\nfrom = \"Fehler [\u{b5}m]\"\nto = \"none\""),
    ("chinese-gbk.csv", Replace("20.000", "20.0O0"), ""),
    ("chinese-gbk.csv", Replace("101.03", "101..03"), ""),
    ("chinese-gbk.csv", Cut(200), "[text]\nencoding = \"UTF-8\""),
    ("chinese-utf16.txt", Cut(101), ""),
    ("chinese-utf16.txt", Byte(121, 0xD8), ""),
    ("runs-as-columns.csv", Replace("100;1,0", "100;x1,0"), ""),
    ("runs-as-columns.csv", Replace("100;1,0;", "100;"), ""),
    ("runs-as-columns.csv", Replace("Sollposition", "Bemerkung"), ""),
    ("runs-as-columns.csv", Replace("mm;", ";"), ""),
    ("target-actual.txt", Replace("100\t", "100;"), ""),
    ("target-actual.txt", Replace("Actual (mm)", "Actual"), ""),
    ("target-actual.txt", Replace("Target (mm)", "Colour"), ""),
    ("target-actual.txt", Replace("200\t", "2OO\t"), ""),
    ("target-actual.txt", Replace("", ""), "[table]\npreamble = 1000"),
    ("zones.csv", Replace("23:59:42.5", "23:59:72.5"), ""),
    ("zones.csv", Replace("2024-03-10T23:59:43", "2024-13-10T23:59:43"), ""),
    ("zones.csv", Replace("2024-03-10T23:59:43", "2024-02-30T23:59:43"), ""),
    ("zones.csv", Replace("+02:00,3.0", "+99:00,3.0"), ""),
    ("zones.csv", Replace("", ""), "[table]\nzone = \"Mars\""),
    ("date-and-clock.csv", Replace("59:55,5", "5955,5"), ""),
    ("date-and-clock.csv", Replace("10.03.2024;23:59:55", "40.03.2024;23:59:55"), ""),
    ("date-and-clock.csv", Replace("Abweichung (mm)", "Abweichung"), ""),
    ("blocks.txt", Replace("45  2.12", "45  2.l2"), ""),
    ("blocks.txt", Replace("45  2.12", "45  2.12  7"), ""),
    ("blocks.txt", Replace("Error (arcsec)", "Error (furlong)"), ""),
    ("blocks.txt", Replace("Run 1 reverse", "the weather changed here and we waited"), ""),
    ("missing.csv", Replace("---", "broken"), ""),
    ("missing.csv", Replace("error_um", "time_s"), ""),
    ("missing.csv", Replace("3,1.5,20.2", "3,1.5"), "[table]\nheader = 3"),
    ("keysight.pos", Replace("50.000\t", "5O.000\t"), ""),
    ("keysight.pos", Replace("Units: mm", "Units: unknown"), ""),
    ("runs-as-columns.csv", Replace("150;1,5;3,5", "150;1,5;3.5"), ""),
    ("runs-as-columns.csv", Replace("200;2,0", "2OO;2,0"), ""),
    ("target-actual.txt", Replace("300\t299.99972", "300\t299,99972"), ""),
    ("zones.csv", Replace("3.0,40,68.02", "3.0,4O,68.02"), ""),
    ("zones.csv", Replace("68.03,760", "68.03,76O"), ""),
    ("zones.csv", Replace("6.0,160,", "six,160,"), ""),
    ("date-and-clock.csv", Replace("3,00;0,00091", "3,00;0,0x91"), ""),
    ("date-and-clock.csv", Replace("10.03.2024;23:59:57,5", "10.03.2024;23:61:57,5"), ""),
    ("blocks.txt", Replace("180  0.00", "18O  0.00"), ""),
    ("missing.csv", Replace("5,1.25,20.3", "5,1.25,warm"), ""),
    ("missing.csv", Replace("3,1.5,20.2", "3;1.5,20.2"), ""),
    ("keysight.pos", Replace("100.000\t0.00020", "100.000\t0.000.20"), ""),
    ("keysight.pos", Replace("0.00130\t0.00050", "0.00130\t-+"), ""),
    ("chinese-gbk.csv", Replace("30.000", "30,000"), ""),
];

const LOGS: &[Case] = &[
    ("worm.pec", Replace("!WormPeriod=480", "!WormPeriod"), ""),
    ("worm.pec", Replace("!WormPeriod=480", "!WormPeriod=soon"), ""),
    ("worm.pec", Replace("1 8388712 ", "1 8388712 more "), ""),
    ("worm.pec", Replace("1 8388712 ", "one 8388712 "), ""),
    ("worm.pec", Replace("2 8388817 ", "1 8388817 "), ""),
    ("worm.pec", Whole(b"!WormPeriod=480\n"), ""),
    ("laser.rtl", Replace("Target-count: 5", "Target-count: 6"), ""),
    ("laser.rtl", Replace("Run-count: 4", "Run-count: 5"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  1   2"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  1   2   0.8oo"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  1   9   0.800"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  1   1   0.800"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  0   2   0.800"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  x   2   0.800"), ""),
    ("laser.rtl", Replace("  1   2   0.800", "  1   -2   0.800"), ""),
    ("laser.rtl", Replace("100.0000", "1OO.0000"), ""),
    ("laser.rtl", Replace("Targets :", "Goals :"), ""),
    ("laser.rtl", Replace("Run Target Data:", "Data:"), ""),
    ("laser.rtl", Cut(330), ""),
    ("iso230.dat", Replace("REF_DATA_FWD[2,1]=20.0010", "REF_DATA_FWD[2,1]=20.OO10"), ""),
    ("iso230.dat", Replace("REF_DATA_FWD[2,1]", "REF_DATA_FWD[2]"), ""),
    ("iso230.dat", Replace("TGT_DATA[2]=20", "TGT_DATA[2,1]=20"), ""),
    ("iso230.dat", Replace("TGT_DATA[2]=20\n", ""), ""),
    ("iso230.dat", Replace("TGT_DATA[2]=20", "TGT_DATA[2]=twenty"), ""),
    ("iso230.dat", Replace("UNIT=mm", "UNIT=ell"), ""),
    ("iso230.dat", Cut(110), ""),
    ("iso230.md", Replace("2|20.0|20.0010", "2|20.0|20.oo10"), ""),
    ("iso230.md", Replace("2|20.0|20.0010|", "2|20.0|"), ""),
    ("iso230.md", Replace("2|20.0|", "two|20.0|"), ""),
    ("iso230.md", Replace("3|30.0|", "3|3O.0|"), ""),
    ("guide-log.txt", Replace("2017-02-18 23:58:30", "18 February"), ""),
    ("guide-log.txt", Replace("2017-02-19 00:03:10", "2017-02-10 00:03:10"), ""),
    ("guide-log.txt", Replace("Pixel scale = 3.82", "Pixel scale = 3,82"), ""),
    ("guide-log.txt", Replace("Pixel scale = 3.82", "Pixel scale = -1"), ""),
    ("guide-log.txt", Replace("Pixel scale = 3.82 arc-sec/px, ", ""), ""),
    ("guide-log.txt", Replace("2,6.400,\"Mount\"", "2,,\"Mount\""), ""),
    ("guide-log.txt", Replace("2,6.400,\"Mount\"", "2,six,\"Mount\""), ""),
    ("guide-log.txt", Replace("RARawDistance", "RARaw"), ""),
    ("guide-log.txt", Replace("RAGuideDistance", "RAGuide"), ""),
    ("guide-log.txt", Replace(",Time,", ",Clock,"), ""),
    (
        "guide-log.txt",
        Replace("3,9.600,\"Mount\",-0.1,0.2,", "3,9.600,\"Mount\"\n3,9.600,\"Mount\",-0.1,0.2,x"),
        "",
    ),
    ("guide-log.txt", Cut(500), ""),
    ("guide-log.txt", Replace("", ""), "[phd2]\nscale_arcsec = \"big\""),
    ("guide-log.txt", Replace("", ""), "[phd2]\naxis = \"x\""),
    ("debug-log.txt", Replace("", ""), ""),
    ("debug-log.txt", Replace("raw xDistance=0.12", "raw xDistance=o.12"), ""),
    ("debug-log.txt", Replace("returns 0.00 from", "returns none from"), ""),
    ("debug-log.txt", Replace("23:59:40.107", "25:59:40.107"), ""),
    ("debug-log.txt", Replace("23:59:43.", "23:58:43."), ""),
    ("debug-log.txt", Cut(600), ""),
    ("screw.comp", Replace("50.0 50.0012 49.9991", "50.0 50.0012"), ""),
    ("screw.comp", Replace("50.0012", "50,0012"), ""),
    ("screw.comp", Replace("100.0 100.0025", "40.0 100.0025"), ""),
    ("screw.comp", Replace("", ""), ""),
    ("screw.comp", Replace("", ""), "[calibration]\nunit = \"parsec\""),
    ("halsampler.txt", Replace("", ""), ""),
    ("halsampler.txt", Replace("5 0.0500", "5 0.O500"), "[halsampler]\nperiod_s = 0.001"),
    ("halsampler.txt", Replace("", ""), "[halsampler]\nperiod_s = \"fast\""),
    (
        "camonitor.log",
        Replace("IOC:m1-PosSet 2024-03-10 10:00:00.1", "IOC:m1-PosSet yesterday 10:00:00.1"),
        "",
    ),
    (
        "camonitor.log",
        Replace(
            "IOC:m1-PosSet 2024-03-10 10:00:00.100000 2",
            "IOC:m1-PosSet 2024-03-10 10:00:00.100000 x",
        ),
        "",
    ),
    ("camonitor.log", Cut(120), ""),
    ("camonitor.log", Replace("", ""), ""),
    ("scope.csv", Replace("40\t1,", "40\tx1,"), ""),
    ("scope.csv", Replace("0\t0,000000", "nought\t0,000000"), "[text]\ndecimal = \".\""),
    ("scope.csv", Cut(300), ""),
    ("scope.csv", Replace("", ""), ""),
    ("scope-stamps.csv", Replace("16000100000;1.0467", "160001o0000;1.0467"), ""),
    ("scope-stamps.csv", Replace("133801416000300000", "300"), ""),
    ("scope-stamps.csv", Replace("133801416000300000", "133801415000300000"), ""),
    ("scope-stamps.csv", Replace("133801416000000000;0.0", "begin;0.0"), ""),
    ("scope-stamps.csv", Replace("133801416000200000;", ";"), ""),
    ("scope-stamps.csv", Replace("2.0812041582916", "2.08l2"), ""),
    ("scope-stamps.csv", Replace(";104.1460893441", ""), ""),
    ("scope-stamps.csv", Replace(";104.1460893441", ";104.1460893441;1"), ""),
    ("scope-stamps.csv", Replace("EOF", "EOF\nmore"), ""),
    ("scope-stamps.csv", Replace("Name;SetPos;", "Channel;SetPos;"), ""),
    ("scope-stamps.csv", Cut(668), ""),
    ("scope-stamps.csv", Cut(930), ""),
    ("scope-rates.csv", Replace("38\t21,52\trun", "38\t21;52\trun"), ""),
    ("scope-rates.csv", Replace("38\t21,52\trun", "\t21,52\trun"), ""),
    ("scope-rates.csv", Replace("38\t21,52\trun", "-38\t21,52\trun"), ""),
    ("worm.pec", Replace("3 8388921 1.7581", "3 8388921 1.75.81"), ""),
    ("worm.pec", Replace("4 8389026 ", "4 83890z6 "), ""),
    ("worm.pec", Replace("!StepsPerWorm=50133", "!StepsPerWorm=many"), ""),
    ("laser.rtl", Replace(" 300.0000 400.0000", " 300.0000 4OO.0000"), ""),
    ("iso230.dat", Replace("REF_DATA_BWD[1,2]=10.0025", "REF_DATA_BWD[1,2]=1O.0025"), ""),
    ("iso230.dat", Replace("TGT_DATA[1]=10", "TGT_DATA[1]=ten"), ""),
    ("iso230.md", Replace("1|10.0|10.0010|10.0020", "1|10.0|10.0010|1O.0020"), ""),
    ("guide-log.txt", Replace("0.215,-0.029", "o.215,-0.029"), ""),
    ("debug-log.txt", Replace("raw xDistance=0.12", "raw xDistance=0.1.2"), ""),
    ("screw.comp", Replace("150.0 150.0031", "15O.0 150.0031"), ""),
    ("screw.comp", Replace("100.0001", "100.0oo1"), "[calibration]\nunit = \"mm\""),
    (
        "halsampler.txt",
        Replace("9 0.0900 0.000974", "9 0.0900 0.0oo974"),
        "[halsampler]\nperiod_s = 0.001",
    ),
    ("camonitor.log", Replace("00:00.200000 5.305231", "00:00.200000 5.3O5231"), ""),
    ("camonitor.log", Replace("10:00:00.300000 7.8", "10:70:00.300000 7.8"), ""),
    ("scope.csv", Replace("80\t2,147184", "80\t2,14.7184"), ""),
    ("scope.csv", Replace("120\t3,211772", "1z0\t3,211772"), ""),
    ("worm.pec", Replace("5 8389130 ", "5 8389130,5x "), ""),
    ("worm.pec", Replace("6 8389235 2.0355", "5.5x 8389235 2.0355"), ""),
    ("laser.rtl", Replace(" 0.0000 100.0000", " 0,,0000 100.0000"), ""),
    ("iso230.dat", Replace("REF_DATA_FWD[2,2]=20.0020", "REF_DATA_FWD[2;2]=20.0020"), ""),
    ("iso230.md", Replace("3|30.0|30.0010", "3|30.0|30..0010"), ""),
    ("guide-log.txt", Replace("1,3.200,", "1,3.2.00,"), ""),
    ("guide-log.txt", Replace("0.117,-0.029,0.070", "0.117,-0.029,0.o70"), ""),
    ("debug-log.txt", Replace("23:59:40.107", "2x:59:40.107"), ""),
    ("screw.comp", Replace("50.0 50.0012 49.9991", "50.0 50.0012 4q.9991"), ""),
    ("halsampler.txt", Replace("12 0.1200", "12 0.12OO"), "[halsampler]\nperiod_s = 0.001"),
    ("scope.csv", Replace("0,537925", "0,537,925"), ""),
    ("camonitor.log", Replace("00:00.430000 4.789089", "00:00.430000 --4.789089"), ""),
];

const BINARY: &[Case] = &[
    ("stepper.sr", Cut(100), ""),
    ("stepper.sr", Byte(30, b'x'), ""),
    ("stepper.sr", Replace("", ""), "[sigrok]\nstep = \"TX\""),
    ("stepper.sr", Replace("", ""), "[sigrok]\nstep = 1"),
    ("array.npy", Replace("", ""), ""),
    ("array.npy", Cut(9), ""),
    ("array.npy", Cut(40), ""),
    ("array.npy", Cut(200), ""),
    ("array.npy", Replace("'<f8'", "'<c8'"), ""),
    ("array.npy", Replace("'<f8'", "'|O8'"), ""),
    ("array.npy", Replace("(12, 2)", "(3,2,4)"), ""),
    ("array.npy", Replace("'shape'", "'shope'"), ""),
    ("array.npy", Replace("'descr'", "'dascr'"), ""),
    ("array.npy", Replace("(12, 2)", "(9e9,9)"), ""),
    ("record.npy", Cut(250), ""),
    ("record.npy", Replace("'<f4'", "'<S4'"), ""),
    ("record.npy", Replace("time_s", "tame_s"), ""),
    ("workbook.xlsx", Cut(600), ""),
    ("workbook.xlsx", Cut(30), ""),
    ("workbook.xlsx", Replace("", ""), "[sheet]\nname = \"Tabelle9\""),
    ("workbook.xlsx", Replace("", ""), "[[column]]\nfrom = \"Soll (mm)\"\nto = \"none\""),
    ("workbook.xlsx", Whole(b"PK\x03\x04 nothing of a book"), ""),
    ("workbook.xlsx", Whole(b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 rest"), ""),
    ("sheet.ods", Cut(400), ""),
    ("sheet.ods", Replace("", ""), "[sheet]\nname = \"Sheet2\""),
    ("sheet.ods", Whole(b"PAR1 nothing PAR1"), ""),
    ("plain.mat", Replace("", ""), ""),
    ("plain.mat", Replace("", ""), "[arrays]\nrows = 7"),
    ("plain.mat", Replace("", ""), "[arrays]\nrows = 1"),
    ("plain.mat", Cut(300), ""),
    ("session.mat", Cut(128), ""),
    ("session.mat", Cut(400), ""),
    ("session.mat", Byte(140, 0xFF), ""),
    ("session73.mat", Cut(512), ""),
    ("session73.mat", Cut(4000), ""),
    ("logger.h5", Cut(96), ""),
    ("logger.h5", Cut(2000), ""),
    ("logger.h5", Byte(8, 9), ""),
    ("session.feather", Cut(8), ""),
    ("session.feather", Cut(2000), ""),
    ("structure.mat", Cut(200), ""),
    ("structure.mat", Cut(130), ""),
    ("table.h5", Cut(3000), ""),
    ("report.md", Replace("| 25.20000 |", "| 25.2OOO0 |"), ""),
    ("report.md", Replace("2 | 1 | 25.20000 | 25.20070 |", "2 | 1 | 25.20000 |"), ""),
    ("report.md", Replace("", ""), "[markdown]\nheader = \"From | To\""),
    ("servo.csv", Replace("38,100,97", "38,1oo,97"), ""),
    (
        "servo.csv",
        Replace("", ""),
        "[[column]]\nfrom = \"Goal Position\"\nto = \"angle_rev\"\nunit = \"0/4096 rev\"\n[[column]]\nfrom = \"Present Position\"\nunit = \"mm\"",
    ),
    ("servo.csv", Replace("", ""), "[table]\nperiod_s = 0.1"),
    ("servo.csv", Replace("", ""), "[table]\nparentheses = \"positive\""),
    ("report.md", Replace("| 25.20000 |", "| 25.2000.0 |"), ""),
    ("servo.csv", Replace("71,200,197", "71,2oo,197"), ""),
    ("servo.csv", Replace("104,300,297,0.20", "104,300,297,0.2o"), ""),
];

const RECIPES: &[&str] = &[
    "[text]\ndelimeter = \";\"",
    "[txt]\ndelimiter = \";\"",
    "[text]\ndecimal = \";\"",
    "[text]\ndecimal = 5",
    "[table]\npreamble = -1",
    "[table]\nheader = 12",
    "[table]\nheader = \"one\"",
    "[table]\nmissing = \"nan\"",
    "[table]\nruns = \"both\"",
    "[file]\nformat = \"word\"",
    "[file\nformat = \"table\"",
    "[[column]]\nto = \"error_um\"",
    "[[column]]\nfrom = \"a\"\nfactor = 2",
    "[[column]]\nfrom = \"a\"\nsign = 0",
    "[[column]]\nfrom = \"a\"\nsign = 3",
    "[[column]]\nfrom = \"a\"\npass = 0",
    "[[column]]\nfrom = \"a\"\n[[column]]\nfrom = \"a\"",
    "column = \"a\"",
    "[channels]\nlatency_s = \"late\"",
    "[channels]\nlatency_s = nan",
];

fn changed(name: &str, change: &Change) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples");
    let mut bytes = std::fs::read(folder.join(name)).expect("the sample is there");
    match change {
        Whole(whole) => return whole.to_vec(),
        Cut(length) => bytes.truncate(*length),
        Byte(at, byte) => bytes[*at] = *byte,
        Replace("", _) => {}
        Replace(from, to) => {
            // Samples in windows-1252 hold a character a byte.
            let plain = |text: &str| -> Vec<u8> {
                if name == "german.csv" {
                    text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect()
                } else {
                    text.as_bytes().to_vec()
                }
            };
            let (from, to) = (plain(from), plain(to));
            let at = bytes.windows(from.len()).position(|window| window == from);
            let at = at.unwrap_or_else(|| panic!("{name} holds no {from:?}"));
            bytes.splice(at..at + from.len(), to);
        }
    }
    bytes
}

fn told(change: &Change) -> String {
    match change {
        Whole(whole) => format!("is {}", whole.escape_ascii()),
        Cut(length) => format!("ends after {length} bytes"),
        Byte(at, byte) => format!("byte {at} is {byte:#04x}"),
        Replace("", _) => "is whole".to_owned(),
        Replace(from, to) => format!("{} becomes {}", from.escape_debug(), to.escape_debug()),
    }
}

/// The message, held to the form all messages have.
fn message(name: &str, error: &ImportError) -> String {
    let text = error.to_string();
    assert!(text.starts_with(name), "{text}");
    let first = text.lines().next().unwrap_or_default();
    assert!(!first.ends_with('.') && first.len() < 400, "{text}");
    match error {
        ImportError::Unanswered(_) => assert!(text.contains("hint: answer in a recipe"), "{text}"),
        _ => assert!(text.contains("found ") && text.contains(", expected "), "{text}"),
    }
    text.replace("\n\n", "\n")
}

/// True when the message says line and column, or the cell of a sheet.
fn has_column(error: &ImportError) -> bool {
    match error {
        ImportError::Found { place, .. } => place.at.column.is_some(),
        ImportError::Unanswered(question) => question.place.at.column.is_some(),
        _ => false,
    }
}

#[test]
fn broken_files_are_refused_with_their_place() {
    let (mut text, mut accepted) = (String::new(), Vec::new());
    let mut with_column = 0;
    for (name, change, recipe) in [TABLES, LOGS, BINARY].into_iter().flatten() {
        let bytes = changed(name, change);
        let given = match Recipe::parse(recipe, "recipe.toml") {
            Ok(given) => given,
            Err(error) => {
                let said = message("recipe.toml", &error);
                writeln!(text, "# {name} with {}\n{said}\n", recipe.escape_debug())
                    .expect("memory");
                continue;
            }
        };
        let by = if recipe.is_empty() {
            String::new()
        } else {
            format!(", with {}", recipe.escape_debug())
        };
        let found = apply(&[Source { name, bytes: &bytes }], &given);
        let Err(error) = found else {
            accepted.push(format!("{name} {}{by}", told(change)));
            continue;
        };
        writeln!(text, "# {name} {}{by}\n{}\n", told(change), message(name, &error))
            .expect("memory");
        with_column += usize::from(has_column(&error));
    }
    for recipe in RECIPES {
        let error = Recipe::parse(recipe, "recipe.toml").expect_err(recipe);
        let said = message("recipe.toml", &error);
        assert!(said.starts_with("recipe.toml:"), "{said}");
        writeln!(text, "# recipe {}\n{said}\n", recipe.escape_debug()).expect("memory");
    }
    assert!(120 <= with_column, "{with_column}");
    assert!(accepted.is_empty(), "accepted:\n{}", accepted.join("\n"));
    expect_file!["expected/broken.txt"].assert_eq(&text);
}
