//! What earlier answers decide about the steps of a conversation.

use std::borrow::Cow;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Wire;

use crate::adapter::{Asked, Bits, Heard, Pause, Piece};
use crate::suite::device;

/// A step as it is sent: with the number that an earlier answer decides, if it has one. Without that answer it
/// sends nothing, and awaits nothing.
pub(super) fn step<'a>(
    wire: Wire,
    step: &'a Asked,
    steps: &[Asked],
    heard: &[Heard],
) -> Cow<'a, Asked> {
    let Some(sum) = &step.sum else { return Cow::Borrowed(step) };
    let told = steps.get(sum.step).zip(heard.get(sum.step));
    let told = told.and_then(|(asked, heard)| data(wire, asked, &heard.received()));
    let number = told.and_then(|data| sum.bytes(&data.0));
    let write = number.zip(device::instructions(wire));
    let write = write.map(|(number, own)| (own.write)(sum.id, sum.address, &number));
    let after = step.send.first().map_or(Pause::None, |piece| piece.after);
    let piece = write.and_then(|packet| {
        let bytes = wire.encode(&packet)?.into();
        Some(Piece { after, bytes })
    });
    let awaits = if piece.is_some() { step.awaits } else { 0 };
    Cow::Owned(Asked { send: piece.into_iter().collect(), awaits, ..step.clone() })
}

/// The data of the first answer in what came back, if it has no error.
pub(super) fn data(wire: Wire, asked: &Asked, came: &[u8]) -> Option<HexBytes> {
    let packets = asked.packets(wire, came);
    let first = packets.iter().flat_map(|packet| device::reported(wire, packet)).next()?;
    first.data.filter(|_| first.error.unwrap_or_default() == 0)
}

/// Whether the first answer has no error, and holds these bits.
pub(super) fn holds(wire: Wire, asked: &Asked, heard: &Heard, bits: &Bits) -> bool {
    data(wire, asked, &heard.received()).is_some_and(|data| bits.are_in(&data.0))
}
