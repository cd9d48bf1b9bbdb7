//! Malformed comma-separated text.

use super::Case;

/// Below this header, in the fourth line, a single cell is wrong.
fn cell(text: &str) -> Vec<u8> {
    format!("# a pass\nposition_mm,error_um,pass\n0,0.1,1\n0.5,{text},1\n1,0.3,1\n").into_bytes()
}

/// Cells that are no finite numbers.
const CELLS: &[(&str, &str)] = &[
    ("a word", "abc"),
    ("a number with its unit", "0.2 um"),
    ("a number with its unit, together", "0.2um"),
    ("a decimal comma in quotes", "\"0,2\""),
    ("a negative decimal comma in quotes", "\"-0,2\""),
    ("thousands in quotes", "\"1,234.5\""),
    ("NaN", "NaN"),
    ("nan", "nan"),
    ("-nan", "-nan"),
    ("NA", "NA"),
    ("N/A", "N/A"),
    ("null", "null"),
    ("None", "None"),
    ("a dash for a missing value", "-"),
    ("a plus alone", "+"),
    ("inf", "inf"),
    ("-Infinity", "-Infinity"),
    ("too large", "1e999"),
    ("too large and negative", "-1e400"),
    ("an exponent without digits", "1e"),
    ("a Fortran exponent", "1.5D-3"),
    ("two points", "1.2.3"),
    ("two signs", "--1"),
    ("a blank inside", "1 234"),
    ("an underscore inside", "1_000"),
    ("hexadecimal", "0x1F"),
    ("a fraction", "1/6"),
    ("a percentage", "12%"),
    ("true", "true"),
    ("a date", "2026-11-21"),
    ("a time of day", "08:15:00"),
    ("a typographic minus", "\u{2212}0.2"),
    ("a typographic minus before a word", "\u{2212}x"),
    ("Arabic digits", "\u{661}\u{662}"),
    ("full-width digits", "\u{ff11}"),
    ("a formula", "=A1"),
    ("a spreadsheet's error", "#VALUE!"),
    ("a no-break space inside", "1\u{a0}234"),
    ("a negative number in parentheses", "(0.2)"),
    ("a very long word", "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz"),
    ("a quote that opens in the middle", "0\"2"),
    ("a semicolon at the end", "0.2;"),
];

/// Whole files.
const FILES: &[(&str, &[u8])] = &[
    ("nothing", b""),
    ("a byte-order mark only", b"\xEF\xBB\xBF"),
    ("blank lines only", b"\n\n  \n"),
    ("comments only", b"# one\n# two\n"),
    ("a header only", b"time_s,error_um\n"),
    ("a header and comments", b"time_s,error_um\n# no rows\n"),
    ("a header without a line end", b"time_s,error_um"),
    ("no header", b"0,0.1\n1,0.2\n"),
    ("no header, one column", b"0.1\n0.2\n"),
    ("a header in a comment", b"# time_s,error_um\n0,0.1\n"),
    ("a name twice", b"time_s,error_um,time_s\n1,2,3\n"),
    ("a name twice, blanks apart", b"time_s, error_um , error_um\n1,2,3\n"),
    ("a name missing", b"time_s,,error_um\n1,2,3\n"),
    ("a name missing at the end", b"time_s,error_um,\n1,2,\n"),
    ("a name of blanks", b"time_s,   ,error_um\n1,2,3\n"),
    ("a bad cell between semicolons", b"time_s;error_um\n0;0.1\n1;x\n"),
    ("an instant behind numbers", b"time,error_um\n1,2\n2026-11-21T08:15:00Z,3\n"),
    ("a number behind an instant", b"time,error_um\n2026-11-21T08:15:00Z,2\n7,3\n"),
    ("semicolons and decimal commas", b"time_s;error_um\n0,5;0,1\n"),
    ("blanks for commas", b"time_s error_um\n0 0.1\n"),
    ("decimal commas", b"time_s,error_um\n0,5,0,1\n"),
    ("a row too short", b"time_s,error_um\n1,2\n3\n5,6\n"),
    ("a row too long", b"time_s,error_um\n1,2\n3,4,5\n"),
    ("a comma at the end of each row", b"time_s,error_um\n1,2,\n"),
    ("a row of commas", b"time_s,error_um\n1,2\n,,,\n"),
    ("cut off between cells", b"time_s,error_um,pass\n1,2,1\n3,4"),
    ("cut off inside a quoted cell", b"time_s,error_um\n1,2\n3,\"4"),
    ("cut off after a sign", b"time_s,error_um\n1,2\n3,-"),
    ("cut off after an exponent", b"time_s,error_um\n1,2\n3,4e-"),
    ("a comment behind a row", b"time_s,error_um\n1,2 # first\n"),
    ("a second header", b"time_s,error_um\n1,2\ntime_s,error_um\n3,4\n"),
    ("a row of units", b"time,error\ns,um\n1,2\n"),
    ("a title above the header", b"Pass 7\ntime_s,error_um\n1,2\n"),
    ("a separator line of a spreadsheet", b"sep=,\ntime_s,error_um\n1,2\n"),
    ("CRLF and a bad cell", b"time_s,error_um\r\n1,2\r\n3,x\r\n"),
    ("a lone carriage return and a bad cell", b"time_s,error_um\r1,2\r3,x\r"),
    ("a line break in a name", b"\"time\n_s\",error_um\n1,2\n"),
    ("a bad cell behind quoted commas", b"\"a,b\",error_um\n\"1\",x\n2,3\n"),
    (
        "a bad cell behind wide characters",
        "time_s,\u{8bef}\u{5dee}_um\n1,\u{8bef}\n2,3\n".as_bytes(),
    ),
    ("bytes that are no text", b"time_s,error_um\n1,\xFF\xFE\n"),
    ("TOML", b"title = \"a machine\"\n[spindle]\nspeed = \"6 rpm\"\n"),
];

/// All of them.
pub(super) fn cases() -> Vec<Case> {
    let cells = CELLS.iter().map(|(name, text)| (*name, cell(text)));
    let files = FILES.iter().map(|(name, bytes)| (*name, bytes.to_vec()));
    cells.chain(files).collect()
}
