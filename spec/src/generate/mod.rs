//! Generates the Rust source of the codec's tables from the spec: one file per module, formatted
//! and in the order of the YAML. The output is deterministic.

pub(crate) mod constants;
mod device;
mod own_device;
pub(crate) mod token;
mod value;
pub(crate) mod wire_enum;

use proc_macro2::TokenStream;
use quote::quote;

use crate::Spec;
use crate::model::{Citation, Device};
use crate::wire::Wire;

pub use own_device::{build_script, device_from_yaml, report};
#[cfg(feature = "exports")]
pub(crate) use token::words;

/// One generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module {
    /// Its name, without `.rs`.
    pub name: String,
    /// Its text.
    pub source: String,
}

/// Source that can't be generated: a name in the spec yields no Rust name, or two names yield the
/// same one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GenerateError {
    module: String,
    reason: String,
}

impl std::fmt::Display for GenerateError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} yields no Rust source: {}", self.module, self.reason)
    }
}

impl std::error::Error for GenerateError {}

/// The modules that the codec includes: one per wire, and `devices` with one module per device.
///
/// # Errors
/// If a name of the spec can't be turned into a Rust name.
pub fn codec(spec: &Spec) -> Result<Vec<Module>, GenerateError> {
    let mut modules = Vec::new();
    for wire in Wire::ALL {
        modules.push(format(wire.id(), &wire.generate(spec))?);
    }
    let devices =
        spec.devices.iter().map(|file| device::module(spec, &file.content, &quote!(crate)));
    modules.push(format("devices", &quote!(#(#devices)*))?);
    Ok(modules)
}

/// The module of one device of the spec.
///
/// # Errors
/// If a name of the spec can't be turned into a Rust name.
pub fn device(spec: &Spec, device: &Device) -> Result<Module, GenerateError> {
    format(&device.device, &device::module(spec, device, &quote!(crate)))
}

fn format(name: &str, tokens: &TokenStream) -> Result<Module, GenerateError> {
    let file = syn::parse2(tokens.clone())
        .map_err(|error| GenerateError { module: name.to_owned(), reason: error.to_string() })?;
    let source = format!("// Generated from YAML.\n\n{}", prettyplease::unparse(&file));
    Ok(Module { name: name.to_owned(), source })
}

/// The sections of a list of citations: `ja40 §2.3, ja40 §2.4.22`.
pub(crate) fn places(source: &[Citation]) -> String {
    let places: Vec<_> = source.iter().map(ToString::to_string).collect();
    places.join(", ")
}
