//! CRCs of 16 bits that programs compute instead of the right one.

use crc::{Algorithm, Crc};

/// A CRC with its names.
pub(in crate::explain) struct Named {
    crc: Crc<u16>,
    pub(in crate::explain) name: &'static str,
}

impl Named {
    const fn new(algorithm: &'static Algorithm<u16>, name: &'static str) -> Self {
        Self { crc: Crc::<u16>::new(algorithm), name }
    }

    pub(in crate::explain) fn checksum(&self, bytes: &[u8]) -> u16 {
        self.crc.checksum(bytes)
    }
}

/// Those that libraries and microcontrollers have, and tables on the web.
pub(in crate::explain) static ALGORITHMS: [Named; 16] = [
    Named::new(&crc::CRC_16_UMTS, "CRC-16/UMTS (BUYPASS)"),
    Named::new(&crc::CRC_16_MODBUS, "CRC-16/MODBUS"),
    Named::new(&crc::CRC_16_CMS, "CRC-16/CMS (UMTS with the initial value FFFF)"),
    Named::new(&crc::CRC_16_ARC, "CRC-16/ARC (IBM)"),
    Named::new(&crc::CRC_16_IBM_3740, "CRC-16/IBM-3740 (CCITT-FALSE)"),
    Named::new(&crc::CRC_16_XMODEM, "CRC-16/XMODEM"),
    Named::new(&crc::CRC_16_KERMIT, "CRC-16/KERMIT (CCITT)"),
    Named::new(&crc::CRC_16_IBM_SDLC, "CRC-16/IBM-SDLC (X-25)"),
    Named::new(&crc::CRC_16_USB, "CRC-16/USB"),
    Named::new(&crc::CRC_16_MAXIM_DOW, "CRC-16/MAXIM-DOW"),
    Named::new(&crc::CRC_16_SPI_FUJITSU, "CRC-16/SPI-FUJITSU (AUG-CCITT)"),
    Named::new(&crc::CRC_16_MCRF4XX, "CRC-16/MCRF4XX"),
    Named::new(&crc::CRC_16_GENIBUS, "CRC-16/GENIBUS"),
    Named::new(&crc::CRC_16_GSM, "CRC-16/GSM"),
    Named::new(&crc::CRC_16_DDS_110, "CRC-16/DDS-110"),
    Named::new(&crc::CRC_16_DNP, "CRC-16/DNP"),
];
