//! The `helixlock` command; the library beside it says what it does.

use std::process::ExitCode;

fn main() -> ExitCode {
    helixlock::main()
}
