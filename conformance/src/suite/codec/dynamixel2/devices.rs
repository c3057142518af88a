//! Instructions for 1 to 253 devices.

use super::requests::{self, Request, Row};
use super::{BOTH_WAYS, parameters_of};
use crate::suite::Author;
use crate::suite::plan::{Family, Group};

/// How many IDs there are.
const ALL: u8 = 253;

/// Numbers of devices: few, around powers of two, and every device or one less.
fn numbers() -> impl Iterator<Item = u8> + Clone {
    (1..=20).chain(31..=33).chain(63..=65).chain(127..=129).chain(ALL - 1..=ALL)
}

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    const PREFIX: &str = "dynamixel2.devices.";
    Family::new(PREFIX, move || {
        let several = requests::ALL.into_iter().filter(|request| request.is_to_all());
        several.flat_map(move |request| {
            // Every number of one of them.
            let every = (1..=ALL).filter(move |_| request.title == "Sync Read");
            let some = numbers().filter(move |_| request.title != "Sync Read");
            every.chain(some).map(move |number| {
                let stem = format!("{PREFIX}{}.{number}", request.name);
                Group::new(stem, &BOTH_WAYS, move |stem| {
                    let requirement = parameters_of(author.spec, request.title);
                    author.both_ways(stem, &requirement, &request.packet(&rows(number, request)))
                })
            })
        })
    })
}

/// Devices whose IDs are in no order, each with an address and data of its own where it may have
/// them.
fn rows(number: u8, request: Request) -> Vec<Row> {
    // 100 and 253 have no common divisor, so no ID comes twice.
    let ids = (0..number).map(|index| u16::from(index) * 100 % u16::from(ALL));
    let row = |id: u16| {
        let address = 132 + if request.name.starts_with("bulk") { id } else { 0 };
        let id = u8::try_from(id).unwrap_or_default();
        Row { id, address, data: vec![id, !id] }
    };
    ids.map(row).collect()
}
