//! Control tables: the types of the generated device modules.
//!
//! A [`Device`] has one [`Row`] per register: the plain facts, for looking registers up by address
//! or by name. Each register is also a constant of its module, a [`Register`] that knows the type
//! of its values and checks what it writes:
//!
//! ```
//! use actucheck_codec::ja40::{self, OperatingMode};
//! let mut buffer = [0; 32];
//! let packet = ja40::GOAL_POSITION.write(1, 2000)?.encode(&mut buffer)?;
//! assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x09\x00\x03\x34\x02\xD0\x07\x00\x00\x1E\xC9");
//!
//! let error = ja40::TEMPERATURE_LIMIT.write(1, 101).unwrap_err();
//! assert_eq!(error.to_string(), "Temperature Limit is 0 to 100, not 101");
//! assert!(ja40::PRESENT_POSITION.write(1, 0).is_err(), "read-only");
//!
//! assert_eq!(ja40::OPERATING_MODE.decode(&[17])?, OperatingMode::CalibrationMode);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod data;
mod device;
mod error;
mod meaning;
mod range;
mod row;
mod several;
mod typed;

pub use block::RegisterBlock;
pub use data::Data;
pub use device::Device;
pub use error::RegisterError;
pub use meaning::{Condition, Meaning};
pub use range::{Bound, Range};
pub use row::{Access, Area, BitField, Kind, NamedValue, Row, Unit};
pub use several::RegisterSyncWrite;
pub use typed::{Register, RegisterRead, RegisterWrite, Value};
