//! Fast status packets: decoded and encoded, against the reference, for the fitting request and for
//! others.

use actucheck_codec::dynamixel2::FastStatus;
use actucheck_codec::dynamixel2::fast_status::{self, Block};
use actucheck_codec::dynamixel2::status::StatusError;
use actucheck_codec::{BufferTooSmall, EncodeError};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, HEADER, PREFIX, STATUS};
use actucheck_spec::wire::dynamixel2::{self as model, Packet};
use arbitrary::{Result, Unstructured};

use super::model::fault;
use crate::draw::Draw;
use crate::targets::shown;

/// Bytes before the blocks: header, ID, length, instruction.
const HEAD: usize = PREFIX + 1;
/// Bytes of a block beside its data.
const OVERHEAD: usize = 4;

/// The input is read as a packet, and then as choices from which a packet is built.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    for fast in requests(input) {
        agree(input, &fast);
    }
    if let Ok(blocks) = blocks(&mut Unstructured::new(input)) {
        there_and_back(&blocks);
    }
}

/// A request that the packet could answer: for a number of devices that fits its size, with the IDs
/// at the places of the blocks. And two requests that it can't answer: one with another last ID,
/// and one for another length.
fn requests(bytes: &[u8]) -> Vec<Fast> {
    let room = bytes.len().saturating_sub(HEAD);
    let fits = |devices: &usize| room.is_multiple_of(*devices) && room / devices >= OVERHEAD;
    let mut requests = vec![request(room, vec![1, 2])];
    let numbers: Vec<_> = (1..=6).filter(fits).collect();
    if !numbers.is_empty() {
        let devices = numbers[Draw::of(bytes).below(numbers.len())];
        let block = room / devices;
        let ids: Vec<_> = (0..devices).map(|device| bytes[HEAD + block * device + 1]).collect();
        let mut other_ids = ids.clone();
        other_ids[devices - 1] ^= 1;
        requests.extend([ids, other_ids].map(|ids| request(block - OVERHEAD, ids)));
    }
    requests
}

fn request(length: usize, ids: Vec<u8>) -> Fast {
    Fast { length: u16::try_from(length).unwrap_or(u16::MAX), ids }
}

/// Codec and reference find the same blocks or the same fault. Of several faults, the reference
/// reports that of the last CRC first.
fn agree(bytes: &[u8], fast: &Fast) {
    let found = FastStatus::parse(bytes, fast.length, &fast.ids);
    let blocks = |status: FastStatus<'_>| status.blocks().map(owned).collect();
    let found = found.map(|status| Packet::FastStatus { blocks: blocks(status) });
    let found = found.inspect_err(shown).map_err(|error| fault(&error));
    match reference::decode_fast(bytes, fast) {
        Err(Fault::Crc) => assert!(found.is_err(), "{fast:?}"),
        expected => assert_eq!(found, expected, "{fast:?}"),
    }
}

fn owned(block: Block<'_>) -> model::Block {
    model::Block { error: block.error.0, id: block.id, data: block.data.to_vec().into() }
}

fn blocks(choices: &mut Unstructured<'_>) -> Result<Vec<model::Block>> {
    let length = choices.int_in_range(0..=12)?;
    let devices = choices.int_in_range(1..=6)?;
    (0..devices)
        .map(|_| {
            let [error, id] = choices.arbitrary()?;
            let data = choices.bytes(length)?.to_vec().into();
            Ok(model::Block { error, id, data })
        })
        .collect()
}

fn there_and_back(blocks: &[model::Block]) {
    let packet = Packet::FastStatus { blocks: blocks.to_vec() };
    let expected = reference::encode(&packet).unwrap();
    let borrowed: Vec<_> = blocks
        .iter()
        .map(|block| Block { error: StatusError(block.error), id: block.id, data: &block.data })
        .collect();

    let mut buffer = vec![0; expected.len()];
    assert_eq!(fast_status::encode(&borrowed, &mut buffer), Ok(&expected[..]));
    let too_small = BufferTooSmall { needed: expected.len(), available: expected.len() - 1 };
    let built = fast_status::encode(&borrowed, &mut buffer[1..]);
    assert_eq!(built, Err(EncodeError::Buffer(too_small)));

    let length = blocks.first().map_or(0, |block| block.data.len());
    let mut fast = request(length, blocks.iter().map(|block| block.id).collect());
    agree(&expected, &fast);
    assert!(FastStatus::parse(&expected, fast.length, &fast.ids).is_ok());
    // The last device is not the one that was asked.
    if let Some(id) = fast.ids.last_mut() {
        *id ^= 1;
    }
    agree(&expected, &fast);
}

/// Turns the input into a fast status packet of one block, or of two if the size is even.
pub fn repair(input: &mut [u8]) {
    let Some(room) = input.len().checked_sub(HEAD).filter(|room| *room >= OVERHEAD) else { return };
    let length = u16::try_from(room + 1).unwrap_or(u16::MAX).to_le_bytes();
    input[..4].copy_from_slice(&HEADER);
    input[4..HEAD].copy_from_slice(&[BROADCAST, length[0], length[1], STATUS]);
    let block = if room.is_multiple_of(2) && room >= 2 * OVERHEAD { room / 2 } else { room };
    for end in (HEAD + block..=input.len()).step_by(block) {
        let crc = reference::crc(&input[..end - 2]).to_le_bytes();
        input[end - 2..end].copy_from_slice(&crc);
    }
}
