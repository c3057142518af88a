//! The codes of instructions.

pub(crate) const PING: u8 = 0x01;
pub(crate) const READ: u8 = 0x02;
pub(crate) const WRITE: u8 = 0x03;
pub(crate) const REG_WRITE: u8 = 0x04;
pub(crate) const ACTION: u8 = 0x05;
pub(crate) const FACTORY_RESET: u8 = 0x06;
pub(crate) const REBOOT: u8 = 0x08;
pub(crate) const CLEAR: u8 = 0x10;
pub(crate) const BACKUP: u8 = 0x20;
pub(crate) const SYNC_READ: u8 = 0x82;
pub(crate) const SYNC_WRITE: u8 = 0x83;
pub(crate) const FAST_SYNC_READ: u8 = 0x8A;
pub(crate) const FAST_SYNC_WRITE: u8 = 0x8B;
pub(crate) const BULK_READ: u8 = 0x92;
pub(crate) const BULK_WRITE: u8 = 0x93;
