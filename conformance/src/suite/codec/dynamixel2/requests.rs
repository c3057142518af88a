//! The instructions that have an address, with any devices, addresses and data.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;

/// An instruction that has an address.
#[derive(Clone, Copy)]
pub(super) struct Request {
    /// As the documents call it.
    pub(super) title: &'static str,
    /// The same in an id.
    pub(super) name: &'static str,
    code: u8,
    shape: Shape,
}

/// What it has in which order.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// Address, number of bytes.
    Read,
    /// Address, data.
    Write,
    /// Address, number of bytes, then each ID.
    SyncRead,
    /// Address, number of bytes, then each ID with data.
    SyncWrite,
    /// Each ID with address and number of bytes.
    BulkRead,
    /// Each ID with address, number of bytes and data.
    BulkWrite,
}

/// What is asked of a device.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) id: u8,
    pub(super) address: u16,
    /// The data to write; as many bytes as this are read.
    pub(super) data: Vec<u8>,
}

/// Every such instruction.
pub(super) const ALL: [Request; 9] = [
    request("Read", "read", 0x02, Shape::Read),
    request("Write", "write", 0x03, Shape::Write),
    request("Reg Write", "reg-write", 0x04, Shape::Write),
    request("Sync Read", "sync-read", 0x82, Shape::SyncRead),
    request("Sync Write", "sync-write", 0x83, Shape::SyncWrite),
    request("Fast Sync Read", "fast-sync-read", 0x8A, Shape::SyncRead),
    request("Fast Sync Write", "fast-sync-write", 0x8B, Shape::SyncWrite),
    request("Bulk Read", "bulk-read", 0x92, Shape::BulkRead),
    request("Bulk Write", "bulk-write", 0x93, Shape::BulkWrite),
];

const fn request(title: &'static str, name: &'static str, code: u8, shape: Shape) -> Request {
    Request { title, name, code, shape }
}

impl Request {
    /// Whether it is for several devices.
    pub(super) const fn is_to_all(self) -> bool {
        !matches!(self.shape, Shape::Read | Shape::Write)
    }

    /// Whether it has data.
    pub(super) const fn writes(self) -> bool {
        matches!(self.shape, Shape::Write | Shape::SyncWrite | Shape::BulkWrite)
    }

    /// Whether the number of bytes stands after the address.
    pub(super) fn has_length(self) -> bool {
        self.shape != Shape::Write
    }

    /// Its packet for these devices; the first one only if it is for one device. All have the
    /// address and the number of bytes of the first one if the instruction has them once.
    pub(super) fn packet(self, rows: &[Row]) -> Packet {
        let Some(first) = rows.first() else {
            return Packet::Instruction {
                id: BROADCAST,
                instruction: self.code,
                params: Vec::new().into(),
            };
        };
        let register = |row: &Row| [row.address, size(row)].map(u16::to_le_bytes).concat();
        let address = first.address.to_le_bytes();
        let params = match self.shape {
            Shape::Read => register(first),
            Shape::Write => [&address, first.data.as_slice()].concat(),
            Shape::SyncRead => {
                register(first).into_iter().chain(rows.iter().map(|row| row.id)).collect()
            }
            Shape::SyncWrite => {
                let devices = rows.iter().flat_map(|row| [&[row.id], row.data.as_slice()].concat());
                register(first).into_iter().chain(devices).collect()
            }
            Shape::BulkRead => {
                let device = |row: &Row| [&[row.id], register(row).as_slice()].concat();
                rows.iter().flat_map(device).collect()
            }
            Shape::BulkWrite => {
                let device =
                    |row: &Row| [&[row.id], register(row).as_slice(), row.data.as_slice()].concat();
                rows.iter().flat_map(device).collect::<Vec<_>>()
            }
        };
        let id = if self.is_to_all() { BROADCAST } else { first.id };
        Packet::Instruction { id, instruction: self.code, params: params.into() }
    }
}

fn size(row: &Row) -> u16 {
    u16::try_from(row.data.len()).unwrap_or(u16::MAX)
}
