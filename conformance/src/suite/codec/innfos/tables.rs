//! Packets of the document's tables.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Command, Format, Innfos, Packet, reference};

use crate::suite::Author;

/// A request and a reply of each size, by their commands; those with four bytes come last.
pub(super) const fn of_each_size(direction: Direction) -> &'static [u8] {
    match direction {
        Direction::Request => &[0x06, 0x2A, 0x61, 0x0A],
        Direction::Reply => &[0x2A, 0x5F, 0x06],
    }
}

/// Packets in this direction, one per command that has one and leaves nothing unspecified.
pub(in crate::suite) fn all(
    author: Author<'_>,
    direction: Direction,
) -> impl Iterator<Item = Packet> {
    let innfos = rows(author);
    innfos.commands.iter().filter_map(move |row| of_row(innfos, row, direction))
}

/// The packet of [`all`] with this command.
pub(in crate::suite) fn of_command(
    author: Author<'_>,
    direction: Direction,
    code: u8,
) -> Option<Packet> {
    of_row(rows(author), rows(author).command(code)?, direction)
}

/// The wire's tables.
pub(in crate::suite) const fn rows(author: Author<'_>) -> &Innfos {
    &author.spec.wires.innfos.content
}

fn of_row(innfos: &Innfos, row: &Command, direction: Direction) -> Option<Packet> {
    row.size_in(direction)?;
    let data = row.format_in(direction).map_or(&[][..], sample).to_vec().into();
    // An actuator, or the board.
    let packet =
        |address| Packet { direction, address, command: row.code, data: Clone::clone(&data) };
    [6, 0].into_iter().map(packet).find(|packet| reference::is_in_tables(innfos, packet))
}

/// A value of this format. Its bytes differ, and as a fraction of a full scale it is a valid one.
const fn sample(format: Format) -> &'static [u8] {
    match format {
        Format::Flag => &[0x01],
        Format::Mode => &[0x06],
        Format::Alarms => &[0x01, 0x05],
        Format::Iq8 => &[0x12, 0x34],
        Format::Iq24 => &[0x00, 0x12, 0x34, 0x56],
        Format::Scaled => &[0x00, 0x00, 0x0B, 0xC1],
        Format::Mac => &[0x01, 0x64, 0x5A, 0xDF],
    }
}
