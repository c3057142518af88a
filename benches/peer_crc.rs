//! The other crates' CRCs.

use crc::{CRC_16_MODBUS, CRC_16_UMTS, Crc, Table};
use crc_fast::CrcAlgorithm;
use crcxx::crc16::{self, LookupTable256xN, catalog};

use crate::contender::Contender;

type Sliced<const SLICES: usize> = crc16::Crc<'static, LookupTable256xN<SLICES>>;

static UMTS_1: Crc<u16, Table<1>> = Crc::<u16, Table<1>>::new(&CRC_16_UMTS);
static UMTS_16: Crc<u16, Table<16>> = Crc::<u16, Table<16>>::new(&CRC_16_UMTS);
static UMTS_XX8: Sliced<8> = Sliced::<8>::new(&catalog::CRC_16_UMTS);
static UMTS_XX16: Sliced<16> = Sliced::<16>::new(&catalog::CRC_16_UMTS);

static MODBUS_1: Crc<u16, Table<1>> = Crc::<u16, Table<1>>::new(&CRC_16_MODBUS);
static MODBUS_16: Crc<u16, Table<16>> = Crc::<u16, Table<16>>::new(&CRC_16_MODBUS);
static MODBUS_XX8: Sliced<8> = Sliced::<8>::new(&catalog::CRC_16_MODBUS);
static MODBUS_XX16: Sliced<16> = Sliced::<16>::new(&catalog::CRC_16_MODBUS);

/// CRC-16/UMTS.
#[must_use]
pub fn umts() -> Vec<Contender> {
    vec![
        Contender::new("crc, 1 table", |message| UMTS_1.checksum(message)),
        Contender::new("crc, 16 tables", |message| UMTS_16.checksum(message)),
        Contender::new("crc-fast", |message| fast(CrcAlgorithm::Crc16Umts, message)),
        Contender::new("crcxx, 8 tables", |message| UMTS_XX8.compute(message)),
        Contender::new("crcxx, 16 tables", |message| UMTS_XX16.compute(message)),
        Contender::new("crc16-umts-fast", |message| low(crc16_umts_fast::hash(message).into())),
        Contender::new("dynamixel2", |message| {
            dynamixel2::checksum::calculate_checksum(0, message)
        }),
    ]
}

/// CRC-16/MODBUS.
#[must_use]
pub fn modbus() -> Vec<Contender> {
    vec![
        Contender::new("crc, 1 table", |message| MODBUS_1.checksum(message)),
        Contender::new("crc, 16 tables", |message| MODBUS_16.checksum(message)),
        Contender::new("crc-fast", |message| fast(CrcAlgorithm::Crc16Modbus, message)),
        Contender::new("crcxx, 8 tables", |message| MODBUS_XX8.compute(message)),
        Contender::new("crcxx, 16 tables", |message| MODBUS_XX16.compute(message)),
    ]
}

#[inline]
fn fast(algorithm: CrcAlgorithm, message: &[u8]) -> u16 {
    low(crc_fast::checksum(algorithm, message))
}

/// The lower 16 bits, which hold a 16-bit CRC.
#[expect(clippy::cast_possible_truncation, reason = "the others are zero")]
#[inline]
const fn low(crc: u64) -> u16 {
    crc as u16
}
