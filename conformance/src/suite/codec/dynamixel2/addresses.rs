//! Every instruction that has an address, at the ends of what an address and a number of bytes can
//! be, and with the pattern of byte stuffing across them.

use super::requests::{self, Request, Row};
use super::{BOTH_WAYS, parameters_of};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::plan::{Family, Group};

/// The ends, and where another bit or byte is needed.
const ADDRESSES: [u16; 16] = [
    0, 1, 0x7F, 0x80, 0xFD, 0xFE, 0xFF, 0x100, 0x101, 0x1FF, 0x7FFF, 0x8000, 0xFD00, 0xFF00,
    0xFFFE, 0xFFFF,
];

/// Numbers of bytes to read. A status packet, of a Fast Sync Read too, has room for each.
const NUMBERS: [u16; 10] = [2, 0x7F, 0x80, 0xFD, 0xFF, 0x100, 0x101, 0x7FFF, 0x8000, 0xFF00];

pub(super) fn families(author: Author<'_>) -> [Family<'_>; 3] {
    [
        Family::new("dynamixel2.address.", move || addresses(author)),
        Family::new("dynamixel2.number-of-bytes.", move || numbers(author)),
        Family::of("dynamixel2.pattern.", move || patterns(&author)),
    ]
}

/// The instruction for device 1.
fn both_ways(
    author: &Author<'_>,
    stem: &str,
    request: Request,
    address: u16,
    data: &[u8],
) -> Vec<Check> {
    let requirement = parameters_of(author.spec, request.title);
    let row = Row { id: 1, address, data: data.to_vec() };
    author.both_ways(stem, &requirement, &request.packet(&[row]))
}

fn addresses(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    requests::ALL.into_iter().flat_map(move |request| {
        ADDRESSES.into_iter().map(move |address| {
            let stem = format!("dynamixel2.address.{}.{address}", request.name);
            Group::new(stem, &BOTH_WAYS, move |stem| {
                both_ways(&author, stem, request, address, &[0x2A])
            })
        })
    })
}

fn numbers(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    let reads = requests::ALL.into_iter().filter(|request| !request.writes());
    reads.flat_map(move |request| {
        NUMBERS.into_iter().map(move |number| {
            let stem = format!("dynamixel2.number-of-bytes.{}.{number}", request.name);
            Group::new(stem, &BOTH_WAYS, move |stem| {
                both_ways(&author, stem, request, 0, &vec![0; usize::from(number)])
            })
        })
    })
}

/// FF FF FD across the address and what follows it, and at both ends of the data.
fn patterns(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for request in requests::ALL {
        let mut places: Vec<(&str, u16, Vec<u8>)> = Vec::new();
        if request.has_length() {
            places.push(("address-and-number", 0xFFFF, vec![0x2A; 0x00FD]));
        } else {
            places.push(("address-and-data", 0xFFFF, vec![0xFD]));
            places.push(("high-byte-and-data", 0xFF00, vec![0xFF, 0xFD]));
        }
        if request.writes() {
            places.push(("first-data", 0, vec![0xFF, 0xFF, 0xFD, 0x2A]));
            places.push(("last-data", 0xFFFC, vec![0x2A, 0xFF, 0xFF, 0xFD]));
        } else {
            places.push(("high-byte-and-number", 0xFF00, vec![0; 0xFDFF]));
        }
        for (place, address, data) in places {
            let stem = format!("dynamixel2.pattern.{}.{place}", request.name);
            let row = Row { id: 1, address, data };
            let packet = request.packet(&[row]);
            checks.extend(author.both_ways(&stem, "dynamixel2.stuffing.transmit", &packet));
        }
    }
    checks
}
