//! Bits of a word brought together into the index of a table, lowest first.

/// Rust that brings bits of `word` together: by one instruction, or each run of neighbouring bits by
/// a shift and a mask.
pub(super) fn gathered(word: &str, bits: &[u32]) -> String {
    let mask: u64 = bits.iter().map(|bit| 1_u64 << bit).sum();
    format!("G::gather({word}, {mask:#x}, || {})", shifted(word, bits))
}

/// Run by run.
fn shifted(word: &str, bits: &[u32]) -> String {
    let mut parts = vec![];
    let mut low = 0;
    for run in bits.chunk_by(|bit, next| bit + 1 == *next) {
        let mask = ((1_u64 << run.len()) - 1) << low;
        parts.push(if low <= run[0] {
            format!("{word} >> {} & {mask:#x}", run[0] - low)
        } else {
            format!("{word} << {} & {mask:#x}", low - run[0])
        });
        low += u32::try_from(run.len()).expect("a word has few bits");
    }
    parts.join(" | ")
}
