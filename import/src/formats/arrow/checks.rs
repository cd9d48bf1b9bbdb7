//! What an Arrow file says of its own parts, before the library believes it and asks for as much
//! memory.

use arrow_ipc::{Block, RecordBatch, root_as_footer, root_as_message};

use crate::limits;

/// The mark, and the length of the footer before the last one.
const MARK: &[u8] = b"ARROW1";
const LENGTH: usize = 4;
/// Stands before the length of a message since format version 5.
const CONTINUES: [u8; 4] = [0xFF; 4];
/// Bytes before a packed buffer that say how long it is unpacked.
const PREFIX: usize = 8;

/// True, as `Some`, when every batch lies in the file, every buffer in its batch, and all of them
/// unpack to no more than the limit.
pub(super) fn parts_fit(bytes: &[u8]) -> Option<()> {
    let tail = bytes.len().checked_sub(MARK.len() + LENGTH)?;
    let length = u32::from_le_bytes(bytes.get(tail..tail + LENGTH)?.try_into().ok()?);
    let begin = tail.checked_sub(usize::try_from(length).ok()?)?;
    let footer = root_as_footer(&bytes[begin..tail]).ok()?;
    let mut left = limits::UNPACKED;
    for block in footer.dictionaries().into_iter().chain(footer.recordBatches()).flatten() {
        left = left.checked_sub(unpacked(bytes, block)?)?;
    }
    Some(())
}

/// Bytes that the buffers of a block unpack to.
fn unpacked(bytes: &[u8], block: &Block) -> Option<usize> {
    let from = usize::try_from(block.offset()).ok()?;
    let body = from.checked_add(usize::try_from(block.metaDataLength()).ok()?)?;
    let end = body.checked_add(usize::try_from(block.bodyLength()).ok()?)?;
    let (head, body) = (bytes.get(from..body)?, bytes.get(body..end)?);
    let head = head.strip_prefix(&CONTINUES).unwrap_or(head);
    let message = root_as_message(head.get(LENGTH..)?).ok()?;
    match (message.header_as_record_batch(), message.header_as_dictionary_batch()) {
        (Some(batch), _) => of_batch(body, batch),
        (_, Some(dictionary)) => of_batch(body, dictionary.data()?),
        _ => None,
    }
}

fn of_batch(body: &[u8], batch: RecordBatch<'_>) -> Option<usize> {
    let few = |count: i64| usize::try_from(count).ok().filter(|count| *count <= limits::CELLS);
    few(batch.length())?;
    for node in batch.nodes()? {
        few(node.length())?;
        few(node.null_count())?;
    }
    let mut sum = 0_usize;
    for buffer in batch.buffers()? {
        let (from, length) = (usize::try_from(buffer.offset()), usize::try_from(buffer.length()));
        let (from, length) = (from.ok()?, length.ok()?);
        let held = body.get(from..from.checked_add(length)?)?;
        let packed = batch.compression().and_then(|_| held.first_chunk::<PREFIX>());
        // A length of −1 stands before a buffer that is not packed.
        let plain = packed.map(|prefix| i64::from_le_bytes(*prefix)).filter(|plain| *plain != -1);
        sum = sum.checked_add(plain.map_or(Some(length), |plain| usize::try_from(plain).ok())?)?;
    }
    Some(sum)
}
