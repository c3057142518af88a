//! Exports codes, numbers, addresses and ranges as one C99 header. Facts without a value in C, such
//! as a range that another register limits, are in comments.

mod device;
mod writer;

use super::ExportError;
use crate::Spec;
use crate::wire::Wire;

pub use writer::Header;
pub(crate) use writer::{Constant, lower, upper};

/// The whole header.
///
/// # Errors
/// If two things in the spec would have the same name in C.
pub fn export(spec: &Spec) -> Result<String, ExportError> {
    let mut header = Header::new();
    for wire in Wire::ALL {
        wire.exports().c_header(spec, &mut header);
    }
    for file in &spec.devices {
        device::write(&file.content, &mut header);
    }
    header.finish()
}
