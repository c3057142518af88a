//! Instructions with an option.

use super::addressed;
use super::params::Params;
use crate::dynamixel2::{
    CLEAR_KEY, CONTROL_TABLE_BACKUP_KEY, ClearOption, ControlTableBackupOption, FactoryResetOption,
};
use crate::layout::LayoutError;

/// Sets the control table back to its factory defaults, then reboots (DYNAMIXEL Protocol 2.0,
/// Factory Reset; JA40 document, §1.6.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FactoryReset {
    /// The settings to reset.
    pub option: FactoryResetOption,
}

impl FactoryReset {
    fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
        encode(&[&[self.option.code()]])
    }

    /// Reads its parameters.
    ///
    /// # Errors
    /// If they are not one byte.
    pub fn parse(params: &[u8]) -> Result<Self, LayoutError> {
        let mut params = Params::new(params);
        let option = FactoryResetOption::from_code(params.u8("option")?);
        params.end()?;
        Ok(Self { option })
    }
}

addressed!(FactoryReset);

/// Clears a state of the device (DYNAMIXEL Protocol 2.0, Clear; JA40 document, §1.6.6).
///
/// ```
/// use actucheck_codec::dynamixel2::instruction::Clear;
/// let mut buffer = [0; 16];
/// let packet = Clear::MULTI_TURN.encode(1, &mut buffer)?;
/// assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x08\x00\x10\x01\x44\x58\x4C\x22\xB1\xDC");
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clear<'a> {
    /// Without parameters, as in the text of the JA40 document: clears a fault.
    Bare,
    /// With an option, as in the DYNAMIXEL document.
    Option {
        /// What is cleared.
        option: ClearOption,
        /// The key that prevents clearing by accident.
        key: &'a [u8],
    },
}

impl Clear<'static> {
    /// Resets Present Position to a value within one turn.
    pub const MULTI_TURN: Self =
        Self::Option { option: ClearOption::ClearMultiTurnInformation, key: &CLEAR_KEY };
}

impl<'a> Clear<'a> {
    fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
        match self {
            Self::Bare => encode(&[]),
            Self::Option { option, key } => encode(&[&[option.code()], key]),
        }
    }

    /// Reads its parameters, of any number.
    #[must_use]
    pub fn parse(params: &'a [u8]) -> Self {
        match params.split_first() {
            None => Self::Bare,
            Some((option, key)) => Self::Option { option: ClearOption::from_code(*option), key },
        }
    }
}

addressed!(Clear<'a>);

/// Stores the control table, or restores it (JA40 document, §1.6.7).
///
/// ```
/// use actucheck_codec::dynamixel2::instruction::ControlTableBackup;
/// let mut buffer = [0; 16];
/// let packet = ControlTableBackup::STORE.encode(1, &mut buffer)?;
/// assert_eq!(&packet[..13], b"\xFF\xFF\xFD\x00\x01\x08\x00\x20\x01\x43\x54\x52\x4C");
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ControlTableBackup {
    /// Whether to store or to restore.
    pub option: ControlTableBackupOption,
    /// The key that prevents a backup by accident: [`ControlTableBackup::KEY`].
    pub key: [u8; 4],
}

impl ControlTableBackup {
    /// The letters `CTRL`.
    pub const KEY: [u8; 4] = CONTROL_TABLE_BACKUP_KEY;
    /// Stores the EEPROM area and the gains.
    pub const STORE: Self = Self { option: ControlTableBackupOption::Store, key: Self::KEY };
    /// Restores the stored values. The document prints only the option to store; this option is
    /// from other documents of the same instruction.
    pub const RESTORE: Self = Self { option: ControlTableBackupOption::Restore, key: Self::KEY };

    fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
        encode(&[&[self.option.code()], &self.key])
    }

    /// Reads its parameters. The device must check the key.
    ///
    /// # Errors
    /// If they are not five bytes.
    pub fn parse(params: &[u8]) -> Result<Self, LayoutError> {
        let mut params = Params::new(params);
        let option = ControlTableBackupOption::from_code(params.u8("option")?);
        let key = params.array("key")?;
        params.end()?;
        Ok(Self { option, key })
    }
}

addressed!(ControlTableBackup);
