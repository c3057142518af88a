//! Typed registers of a device that is not in the spec, for crates that use the codec.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use proc_macro2::Ident;
use quote::quote;

use super::token::{constant_name, module_name, type_name, value_name};
use super::{device, format};
use crate::load::File;
use crate::model::{Device, NamedValue};
use crate::{Diagnostic, Spec};

/// The Rust source of a module with a device's typed registers, from YAML with the schema
/// `spec/schema/device.schema.json`. The module has the device's name, and refers to the codec as
/// `actucheck_codec`. `path` is the file's name in defects.
///
/// # Errors
/// Every defect of the YAML, with its place.
///
/// ```
/// use actucheck_spec::generate::device_from_yaml;
/// let yaml = "
/// device: gripper
/// title: Gripper
/// wire: dynamixel2
/// source: [manual §1]
/// instructions: [Ping, Read, Write]
/// registers:
///   - {address: 64, name: Grip Force, type: u8, area: ram, access: rw,
///      range: {min: 0, max: 100}, source: [manual §2]}
/// ";
/// let source = device_from_yaml("gripper.yaml", yaml).unwrap();
/// assert!(source.contains("pub const GRIP_FORCE: Register<u8>"));
///
/// let defects = device_from_yaml("gripper.yaml", &yaml.replace("u8", "u9")).unwrap_err();
/// assert!(defects[0].to_string().starts_with("gripper.yaml:8:43: "), "{}", defects[0]);
/// ```
pub fn device_from_yaml(path: &str, yaml: &str) -> Result<String, Vec<Diagnostic>> {
    let spec = Spec::with_own_device(path, yaml)?;
    let file = spec.devices.first().ok_or_else(Vec::new)?;
    let defects = names(file);
    if !defects.is_empty() {
        return Err(defects);
    }
    let module = device::module(&spec, &file.content, &quote!(actucheck_codec));
    // Lints are for handwritten code, and a small device does not use every type.
    let module = quote!(#[allow(unused_imports, clippy::all, clippy::pedantic)] #module);
    let module = format(&file.content.device, &module);
    module
        .map(|module| module.source)
        .map_err(|error| vec![file.diagnostic("device", error.to_string())])
}

/// Does all the work of a build script: writes the result of [`device_from_yaml`] for the file
/// `yaml` to `OUT_DIR`, with the file's name and the ending `rs`. Defects end the build with file,
/// line, column and an excerpt.
///
/// # Errors
/// If a file can't be read or written.
pub fn build_script(yaml: impl AsRef<Path>) -> io::Result<()> {
    let yaml = yaml.as_ref();
    println!("cargo::rerun-if-changed={}", yaml.display());
    match device_from_yaml(&yaml.to_string_lossy(), &fs::read_to_string(yaml)?) {
        Ok(source) => {
            let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
            fs::write(out.join(yaml.file_stem().unwrap_or_default()).with_extension("rs"), source)
        }
        Err(defects) => {
            report(&defects);
            Ok(())
        }
    }
}

/// Reports an error to Cargo from a build script, which ends the build.
pub fn report(defects: &[Diagnostic]) {
    for defect in defects {
        println!("cargo::error={defect}");
        defect.excerpt().lines().skip(1).for_each(|line| println!("cargo::error={line}"));
    }
}

/// Names that the module itself uses, so that no register's type may have them.
const TAKEN: [&str; 15] = [
    "Instruction",
    "Access",
    "Area",
    "BitField",
    "Bound",
    "Condition",
    "Device",
    "Kind",
    "Meaning",
    "NamedValue",
    "Range",
    "Register",
    "Row",
    "Unit",
    "Value",
];

/// The names that are not valid in Rust, or that two nodes share.
fn names(file: &File<Device>) -> Vec<Diagnostic> {
    let device = &file.content;
    let mut defects = Vec::new();
    let mut find = |list: &mut Names, node: String, name: &str, ident: &Ident| {
        defects.extend(list.add(name, ident).map(|text| file.diagnostic(&node, text)));
    };
    let module = module_name(&device.device);
    find(&mut Names::default(), "device".to_owned(), &device.device, &module);
    let mut constants = Names::default();
    constants.taken("DEVICE", "the device as a whole");
    let mut types = Names::default();
    for name in TAKEN {
        types.taken(name, "a type of the codec");
    }
    for (index, register) in device.registers.iter().enumerate() {
        let node = format!("registers[{index}]");
        let name = &register.name;
        find(&mut constants, format!("{node}.name"), name, &constant_name(name));
        if !register.values.is_empty() || !register.bits.is_empty() {
            find(&mut types, format!("{node}.name"), name, &type_name(name));
        }
        let mut values = |node: &str, rows: &[NamedValue]| {
            let mut variants = Names::default();
            variants.taken("Unknown", "the values without a name");
            for (index, row) in rows.iter().enumerate() {
                let node = format!("{node}.values[{index}].name");
                find(&mut variants, node, &row.name, &value_name(&row.name));
            }
        };
        values(&node, &register.values);
        for (index, bits) in register.bits.iter().enumerate() {
            values(&format!("{node}.bits[{index}]"), &bits.values);
        }
        let mut methods = Names::default();
        for (index, bits) in register.bits.iter().enumerate() {
            let (node, name) = (format!("{node}.bits[{index}].name"), &bits.name);
            find(&mut methods, node.clone(), name, &module_name(name));
            if !bits.values.is_empty() {
                find(&mut types, node, name, &type_name(name));
            }
        }
    }
    defects
}

/// The Rust names of one scope, with the node of each.
#[derive(Default)]
struct Names(BTreeMap<String, String>);

impl Names {
    fn taken(&mut self, ident: &str, by: &str) {
        self.0.insert(ident.to_owned(), by.to_owned());
    }

    /// Takes the name, or says why it can't be taken.
    fn add(&mut self, name: &str, ident: &Ident) -> Option<String> {
        let ident = ident.to_string();
        if ident == super::token::NOT_A_NAME {
            return Some(format!("`{name}` makes no Rust name; begin it with a letter"));
        }
        let earlier = self.0.insert(ident.clone(), format!("`{name}`"))?;
        Some(format!("`{name}` becomes `{ident}` in Rust, and so does {earlier}"))
    }
}
