//! The control tables that name registers.

use actucheck::device::{KNOWN, NONE, Tables};
use clap::Args;

use super::Failure;

/// The option `--device`.
#[derive(Debug, Args)]
pub(crate) struct DeviceOption {
    #[arg(long, value_name = "[ID=]DEVICE,…", help = help())]
    device: Option<String>,
}

fn help() -> String {
    let names: Vec<_> = KNOWN.into_iter().chain([&NONE]).map(|device| device.id).collect();
    let names = names.join(", ");
    format!(
        "Whose registers are meant, of all devices or by ID: {names}, a YAML file like the spec's, or \
         a .model file of DYNAMIXEL's maker"
    )
}

impl DeviceOption {
    /// What the user wrote.
    pub(crate) fn words(&self) -> Option<String> {
        self.device.clone()
    }

    /// The tables that it says.
    pub(crate) fn tables(&self) -> Result<Tables, Failure> {
        let tables = self.device.as_deref().map(str::parse).transpose();
        tables.map(Option::unwrap_or_default).map_err(Failure::usage)
    }
}
