//! The op of a device.

use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::serve::read;
use crate::{Hex, Library, Refusal};

/// A device of a library, which takes bytes and answers them.
pub trait Slave {
    /// Takes bytes that come so many milliseconds after the last ones, and returns all that it sends to them. No other
    /// time passes. After a panic it is asked again.
    fn hear(&mut self, after_ms: u64, bytes: &[u8]) -> Vec<u8>;
}

/// Hands bytes to the device, which is made if there is none yet.
pub(crate) fn answer<L: Library>(
    fields: Map<String, Value>,
    slave: &mut Option<Box<dyn Slave>>,
) -> Result<Value, Refusal> {
    #[derive(Deserialize)]
    struct Heard {
        after_ms: u64,
        bytes: Hex,
    }
    let Heard { after_ms, bytes } = read(fields)?;
    let device = match slave {
        Some(device) => device,
        None => slave.insert(L::slave()?),
    };
    Ok(json!({ "bytes": Hex(device.hear(after_ms, &bytes)) }))
}
