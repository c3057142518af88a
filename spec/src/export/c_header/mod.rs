//! Codes, numbers, addresses and ranges as one C99 header. What has no value in C, such as a
//! range that another register sets, stands in a comment.

mod device;
mod innfos;
mod protocol;
mod writer;

use super::ExportError;
use crate::Spec;
use writer::Header;

/// The whole header.
///
/// # Errors
/// If two things in the spec would have the same name in C.
pub fn export(spec: &Spec) -> Result<String, ExportError> {
    let mut header = Header::new();
    for file in &spec.protocols {
        protocol::write(&file.content, &mut header);
    }
    innfos::write(&spec.innfos.content, &mut header);
    for file in &spec.devices {
        device::write(&file.content, &mut header);
    }
    header.finish()
}
