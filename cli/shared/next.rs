//! The command that comes next, with the user's own files, for a shell to take as it stands.

use std::ffi::OsStr;
use std::io::Write;
use std::path::Path;

/// A command line that a report ends with.
pub(crate) struct Next(Vec<String>);

impl Next {
    /// A command of `helixlock`.
    pub(crate) fn command(name: &str) -> Self {
        Self::program("helixlock").words([name])
    }

    /// Another program.
    pub(crate) fn program(name: &str) -> Self {
        Self(vec![name.to_owned()])
    }

    /// With more words.
    pub(crate) fn words(mut self, words: impl IntoIterator<Item: AsRef<OsStr>>) -> Self {
        let words = words.into_iter().map(|word| word.as_ref().to_string_lossy().into_owned());
        self.0.extend(words);
        self
    }

    /// With an output.
    pub(crate) fn output(self, path: impl AsRef<OsStr>) -> Self {
        self.words(["-o"]).words([path])
    }

    /// The line; none after a pipe, which cannot be read again.
    pub(crate) fn print(self, out: &mut impl Write) -> anyhow::Result<()> {
        if self.0.iter().any(|word| is_pipe(Path::new(word))) {
            return Ok(());
        }
        Ok(writeln!(out, "next: {}", self.line()?)?)
    }

    /// The words as a shell reads them.
    pub(crate) fn line(&self) -> anyhow::Result<String> {
        Ok(shlex::try_join(self.0.iter().map(String::as_str))?)
    }
}

fn is_pipe(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_reads_the_words_back() {
        let mut out = Vec::new();
        Next::command("compare").words(["my machine.toml"]).output("a'b").print(&mut out).unwrap();
        let line = String::from_utf8(out).unwrap();
        let words = shlex::split(line.strip_prefix("next: ").unwrap().trim_end()).unwrap();
        assert_eq!(words, ["helixlock", "compare", "my machine.toml", "-o", "a'b"]);
    }
}
