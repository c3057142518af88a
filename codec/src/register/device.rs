use super::Row;
use crate::dynamixel2::Instruction;

/// An actuator's control table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Device {
    /// The id that the documents' YAML gives it.
    pub id: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The model number that Ping returns, if the document states it.
    pub model_number: Option<u16>,
    /// Whether the control table has every register. A table that has not tells nothing about other
    /// addresses.
    pub complete: bool,
    /// The instructions that it supports.
    pub instructions: &'static [Instruction],
    /// Address of the register that keeps the EEPROM area read-only while it is not 0.
    pub eeprom_lock: Option<u16>,
    /// The control table, in ascending order of address.
    pub registers: &'static [&'static Row],
}

impl Device {
    /// The register that begins at this address.
    #[must_use]
    pub fn register(&self, address: u16) -> Option<&'static Row> {
        let index =
            self.registers.binary_search_by_key(&address, |register| register.address).ok()?;
        self.registers.get(index).copied()
    }

    /// The register with this name: `Goal Position`.
    #[must_use]
    pub fn register_named(&self, name: &str) -> Option<&'static Row> {
        self.registers.iter().copied().find(|register| register.name == name)
    }

    /// The registers that lie wholly within `length` bytes from `address`.
    pub fn registers_in(
        &self,
        address: u16,
        length: u16,
    ) -> impl Iterator<Item = &'static Row> + use<> {
        let end = u32::from(address) + u32::from(length);
        self.registers.iter().copied().filter(move |register| {
            let last = u32::from(register.address) + u32::from(register.kind.size());
            register.address >= address && last <= end
        })
    }
}
