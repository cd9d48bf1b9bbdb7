//! Work compiled for what the processor can do.
//!
//! Tables are indexed by bits from all over a word. Processors with BMI2 bring them together by one
//! instruction, others run by run.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{__cpuid, _pext_u64};
#[cfg(target_arch = "x86_64")]
use std::sync::LazyLock;

/// How bits are brought together into the index of a table.
pub trait Gather {
    /// The bits of `word` that `mask` names, lowest first; `shifted` gives the same by shifts.
    fn gather(word: u64, mask: u64, shifted: impl FnOnce() -> u64) -> u64;
}

/// By shifts and masks.
#[derive(Clone, Copy, Debug)]
enum Shifting {}

impl Gather for Shifting {
    #[inline(always)]
    fn gather(_word: u64, _mask: u64, shifted: impl FnOnce() -> u64) -> u64 {
        shifted()
    }
}

/// By one instruction.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
enum Extracting {}

#[cfg(target_arch = "x86_64")]
impl Gather for Extracting {
    #[inline(always)]
    fn gather(word: u64, mask: u64, _shifted: impl FnOnce() -> u64) -> u64 {
        // SAFETY: only `extracting` names this type, which is called when BMI2 has been found.
        let index = unsafe { _pext_u64(word, mask) };
        // SAFETY: as many bits as the mask has; who indexes a table is spared a check.
        unsafe { std::hint::assert_unchecked(index < 1 << mask.count_ones()) };
        index
    }
}

/// What gathers bits again and again.
pub(super) trait Work {
    /// What comes of it.
    type Answer;

    /// Does it; always inlined, to be compiled once a way of gathering.
    fn work<G: Gather>(self) -> Self::Answer;
}

/// A way of gathering.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gathering {
    #[cfg(target_arch = "x86_64")]
    Extracting,
    Shifting,
}

impl Gathering {
    /// All that this processor has, the best first.
    pub(super) fn all() -> Vec<Self> {
        let mut all = vec![];
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("bmi2") && !*EXTRACTS_SLOWLY {
            all.push(Self::Extracting);
        }
        all.push(Self::Shifting);
        all
    }

    /// The best that this processor has.
    pub(super) fn best() -> Self {
        Self::all()[0]
    }

    /// Has something done this way.
    #[inline(always)]
    pub(super) fn have<W: Work>(self, work: W) -> W::Answer {
        match self {
            // SAFETY: `all` has found BMI2 on this processor.
            #[cfg(target_arch = "x86_64")]
            Self::Extracting => unsafe { extracting(work) },
            Self::Shifting => shifting(work),
        }
    }
}

/// AMD's processors before Zen 3 have the instruction, and take some hundred clocks for it.
///
/// Asked once: a virtual machine answers as slowly as an engine simulates a thousand clocks.
#[cfg(target_arch = "x86_64")]
static EXTRACTS_SLOWLY: LazyLock<bool> = LazyLock::new(|| {
    let is_amd = __cpuid(0).ebx == u32::from_le_bytes(*b"Auth");
    let signature = __cpuid(1).eax;
    let family = (signature >> 8 & 0xf) + (signature >> 20 & 0xff);
    is_amd && family < 0x19
});

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "bmi2")]
fn extracting<W: Work>(work: W) -> W::Answer {
    work.work::<Extracting>()
}

#[inline(never)]
fn shifting<W: Work>(work: W) -> W::Answer {
    work.work::<Shifting>()
}
