//! Malformed value change dumps.

use super::Case;

/// Changes that break the format, after a good header of five lines.
const CHANGES: &[(&str, &str)] = &[
    ("a code that was not declared", "#0\n1?\n"),
    ("a vector for a code that was not declared", "#0\nb101 ?\n"),
    ("a real number for a code that was not declared", "#0\nr1.5 ?\n"),
    ("time that goes back", "#5\n1!\n#4\n0!\n"),
    ("time that goes back far", "#100\n#0\n"),
    ("a negative time", "#-5\n"),
    ("a time with a fraction", "#1.5\n"),
    ("a time without a number", "#\n1!\n"),
    ("a time beyond 64 bits", "#99999999999999999999\n"),
    ("a time in hexadecimal", "#0x10\n"),
    ("a level that is none", "#0\n2!\n"),
    ("a level in words", "#0\nH!\n"),
    ("a code without a level", "#0\n!\n"),
    ("a level without a code", "#0\n1\n"),
    ("a level without a code, at the end", "#0\n1"),
    ("a vector with a digit too high", "#0\nb102 !\n"),
    ("a vector without a code", "#0\nb101\n"),
    ("a vector without bits", "#0\nb !\n"),
    ("a real number that is none", "#0\nrabc !\n"),
    ("a real number with a comma", "#0\nr1,5 !\n"),
    ("a real number without a code", "#0\nr1.5\n"),
    ("text without a code", "#0\nsIDLE\n"),
    ("a code with a control character", "#0\n1\u{1}\n"),
    ("a code that is too long", "#0\n1!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!!\n"),
    ("a command nobody knows", "#0\n$dumpports\n1!\n$end\n"),
    ("an end of nothing", "#0\n1!\n$end\n"),
    ("a second declaration", "#0\n$var wire 1 # c $end\n"),
    ("a second unit of time", "#0\n$timescale 1ns $end\n"),
    ("a second scope", "$scope module late $end\n#0\n"),
    ("a second end of declarations", "$enddefinitions $end\n#0\n"),
    ("a comment that does not end", "#0\n$comment no end\n"),
    ("a row of a table", "1,2,3\n"),
    ("a word", "hello\n"),
    ("cut off inside a command", "#0\n$dump"),
    ("cut off inside a vector", "#0\nb10"),
    ("a time with a letter", "#10ns\n"),
];

/// Whole files.
const FILES: &[(&str, &str)] = &[
    ("nothing", ""),
    ("blank lines only", "\n\n\n"),
    ("a table", "time_s,error_um\n1,2\n"),
    ("changes without declarations", "#0\n1!\n"),
    ("no end of declarations", "$timescale 1ns $end\n$var wire 1 ! a $end\n"),
    ("an end of declarations that does not end", "$timescale 1ns $end\n$enddefinitions\n#0\n"),
    ("no unit of time", "$var wire 1 ! a $end\n$enddefinitions $end\n#0\n1!\n"),
    ("a unit of time of zero", "$timescale 0 ns $end\n$enddefinitions $end\n"),
    ("a unit of time without a unit", "$timescale 10 $end\n$enddefinitions $end\n"),
    ("a unit of time without a number", "$timescale ns $end\n$enddefinitions $end\n"),
    ("a unit of time nobody knows", "$timescale 1 parsec $end\n$enddefinitions $end\n"),
    ("a unit of time with a fraction", "$timescale 1.5 ns $end\n$enddefinitions $end\n"),
    ("a unit of time that is too large", "$timescale 9999999999 s $end\n$enddefinitions $end\n"),
    ("a unit of time cut off", "$timescale 1ns\n$enddefinitions $end\n"),
    (
        "a variable without a width",
        "$timescale 1ns $end\n$var wire ! a $end\n$enddefinitions $end\n",
    ),
    (
        "a variable with a negative width",
        "$timescale 1ns $end\n$var wire -1 ! a $end\n$enddefinitions $end\n",
    ),
    (
        "a variable without a name",
        "$timescale 1ns $end\n$var wire 1 ! $end\n$enddefinitions $end\n",
    ),
    ("a variable with nothing", "$timescale 1ns $end\n$var $end\n$enddefinitions $end\n"),
    (
        "a variable with a broken range",
        "$timescale 1ns $end\n$var wire 8 ! a [7:x] $end\n$enddefinitions $end\n",
    ),
    (
        "a variable with a code too long",
        "$timescale 1ns $end\n$var wire 1 !!!!!!!!!!!!!!!!!!!!!!! a $end\n$enddefinitions $end\n",
    ),
    ("a scope without a name", "$timescale 1ns $end\n$scope module $end\n$enddefinitions $end\n"),
    ("a scope with nothing", "$timescale 1ns $end\n$scope $end\n$enddefinitions $end\n"),
];

/// All of them.
pub(super) fn cases() -> Vec<Case> {
    const HEADER: &str = "$timescale 1ns $end\n$scope module top $end\n$var wire 1 ! a $end\n\
                          $upscope $end\n$enddefinitions $end\n";
    let changes =
        CHANGES.iter().map(|(name, text)| (*name, format!("{HEADER}{text}").into_bytes()));
    let files = FILES.iter().map(|(name, text)| (*name, text.as_bytes().to_vec()));
    changes.chain(files).collect()
}
