//! One question after the other over a serial port, each until it is answered.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

use super::super::frame::{Decoder, Received};
use super::super::message::{Answer, Request};
use super::super::port::{Line, open_port};

/// How often a question is asked.
const TRIES: usize = 3;

/// So many times the port may be silent for a while before the question is asked again: a second.
const SILENCES: usize = 5;

/// An answer comes behind at most one frame of the telemetry, and frames that were on their way.
const FRAMES: usize = 8;

/// A board at the other end of a line.
#[derive(Debug)]
pub(super) struct Dialogue {
    place: PathBuf,
    line: Line,
    decoder: Decoder,
}

impl Dialogue {
    /// Opens the port, for nobody else.
    pub(super) fn open(path: &Path) -> anyhow::Result<Self> {
        let line = Line::new(open_port(path)?);
        Ok(Self { place: path.to_owned(), line, decoder: Decoder::default() })
    }

    /// The answer to a request.
    pub(super) fn ask(&mut self, request: &Request) -> anyhow::Result<Answer> {
        for _ in 0..TRIES {
            let sent = self.line.write(&request.on_the_wire());
            sent.with_context(|| self.place.display().to_string())?;
            if let Some(answer) = self.listen(request)? {
                return Ok(answer);
            }
        }
        bail!(
            "{}: no answer, expected a board whose bitstream was made with `--pins rx`\n\
             hint: the other port of the pair? `helixlock board list`",
            self.place.display()
        )
    }

    /// What comes until it is silent, or is something else for too long.
    fn listen(&mut self, request: &Request) -> anyhow::Result<Option<Answer>> {
        let (mut silences, mut frames) = (0, 0);
        let mut bytes = [0; 256];
        while silences < SILENCES && frames < FRAMES {
            let got =
                self.line.read(&mut bytes).with_context(|| self.place.display().to_string())?;
            let Some(got) = got else {
                silences += 1;
                continue;
            };
            if got == 0 {
                bail!("{}: the port is gone", self.place.display());
            }
            for received in bytes[..got].iter().filter_map(|byte| self.decoder.take(*byte)) {
                match received {
                    Received::Answer(answer) if answer.is_to(request) => return Ok(Some(answer)),
                    _ => frames += 1,
                }
            }
        }
        Ok(None)
    }
}
