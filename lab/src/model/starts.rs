//! What passes began with, where an effect that delays has followed the machine before their first rows.
//!
//! A log begins when somebody presses a button: the machine may stand still, and what delays shows what is
//! there, or it moves, and what delays is behind it. Which it was is in no column, so that each pass has one
//! number more wherever the rows ask for it.

use helixlock_plant::{Column, EffectError, Term};

use super::columns::Columns;
use super::component::Component;
use super::fit::{plain_noises, with_noise};
use super::problem::Problem;
use crate::policy::extent::MOST_STARTS;

impl Problem {
    /// An effect that delays where it is open what every pass began with; `None` for any other effect, and
    /// where there are very many passes.
    #[must_use]
    pub(crate) fn with_starts(&self, term: &Term) -> Option<Term> {
        let mut passes: Vec<usize> = self.layout.blocks.iter().map(|block| block.pass).collect();
        passes.sort_unstable();
        passes.dedup();
        (term.nature().delays && passes.len() <= MOST_STARTS).then(|| term.with_starts(passes))
    }

    /// Leaves open what passes began with for the machine file's own effects that delay: every model may follow
    /// any value of it, as it may any zero. The prediction gets those that stand out of the readings' noise.
    pub(super) fn find_starts(&mut self) -> Result<(), EffectError> {
        let starts = self.starts_of_file()?;
        if starts.raw.is_empty() {
            return Ok(());
        }
        // A start that is far off is no outlier.
        let resting = self.predicted.clone();
        self.start_as_seen(&starts, &resting);
        self.mark_outliers(&self.residual());
        self.start_as_seen(&starts, &resting);
        self.starts = starts.raw.len();
        self.free = starts;
        Ok(())
    }

    /// Columns of what passes began with, of the file's effects that delay.
    fn starts_of_file(&self) -> Result<Columns, EffectError> {
        let terms = self.model.effects.iter().filter_map(|term| self.with_starts(term));
        let mut all = Columns::default();
        for term in terms {
            let own = Component::new(term).starts_alone(self)?.raw.into_iter();
            let shown = own.filter(|column| column.iter().any(|value| *value != 0.0));
            all = all.and(&Columns::free(shown));
        }
        Ok(all)
    }

    /// Gives a prediction from rest what passes began with where it is worth a number: as much as the readings
    /// differ from their neighbours is noise.
    fn start_as_seen(&mut self, starts: &Columns, resting: &[f64]) {
        let pairs = self.observed.iter().zip(resting);
        let left: Vec<f64> = pairs.map(|(seen, said)| seen - said).collect();
        let mut noises = plain_noises(self, &left);
        for (noise, least) in noises.iter_mut().zip(&self.least_variance) {
            noise.white = noise.white.max(*least);
        }
        let fit = |columns: &Columns| with_noise(&self.layout, columns, &left, &noises);
        let without = fit(&Columns::default()).log_likelihood;
        let is_seen = |column: &&Column| {
            let with_it = fit(&Columns::free([(*column).clone()])).log_likelihood;
            self.price_of_a_number() < 2.0 * (with_it - without)
        };
        let seen = fit(&Columns::free(starts.raw.iter().filter(is_seen).cloned()));
        self.predicted =
            self.observed.iter().zip(&seen.left).map(|(seen, left)| seen - left).collect();
    }
}
