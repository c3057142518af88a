//! A device's control table.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::token::{
    capitalised, constant_name, module_name, named_values, number, option, type_name,
};
use super::{places, value};
use crate::model::{Access, Area, BitField, Bound, Device, Range, Register};

pub(super) fn module(device: &Device) -> TokenStream {
    let name = module_name(&device.device);
    let doc = format!(" The {} control table: {}.", device.title, places(&device.source));
    let (id, title) = (&device.device, &device.title);
    let model_number = option(device.model_number.map(|number| quote!(#number)));
    let instructions = device.instructions.iter().map(|name| type_name(name));
    let lock = option(device.eeprom_lock.as_ref().and_then(|name| {
        let address = device.register(name)?.address;
        Some(quote!(#address))
    }));
    let names: Vec<_> =
        device.registers.iter().map(|register| constant_name(&register.name)).collect();
    let registers = device.registers.iter().zip(&names).map(|(row, name)| {
        let (doc, value) = (register_doc(row), register(device, row));
        let (value_type, declarations) = (value::of(row), value::declarations(row));
        quote! {
            #(#[doc = #doc])*
            pub const #name: Register<#value_type> = Register::new(&#value);

            #declarations
        }
    });
    quote! {
        #[doc = #doc]
        pub mod #name {
            use crate::dynamixel2::Instruction;
            use crate::register::{
                Access, Area, BitField, Bound, Device, Kind, NamedValue, Range, Register, Row, Unit,
                Value,
            };

            /// The device as a whole.
            pub const DEVICE: Device = Device {
                id: #id,
                name: #title,
                model_number: #model_number,
                instructions: &[#(Instruction::#instructions),*],
                eeprom_lock: #lock,
                registers: &[#(#names.row),*],
            };

            #(#registers)*
        }
    }
}

fn register_doc(register: &Register) -> Vec<String> {
    let area = match register.area {
        Area::Eeprom => "EEPROM area",
        Area::Ram => "RAM area",
    };
    let access = match register.access {
        Access::R => "read-only",
        Access::Rw => "read and write",
    };
    let size = match register.kind.size() {
        1 => "1 byte".to_owned(),
        size => format!("{size} bytes"),
    };
    let mut facts = Vec::new();
    facts.extend(register.initial.map(|initial| format!("initially {initial}")));
    facts.extend(register.range.as_ref().map(ToString::to_string));
    facts.extend(register.unit.as_ref().map(|unit| format!("one count is {unit}")));
    let mut lines = vec![format!(
        " {}: address {}, {size}, {area}, {access}.",
        register.name, register.address
    )];
    lines.push(String::new());
    if !facts.is_empty() {
        lines.push(format!(" {}.", capitalised(&facts.join(", "))));
    }
    lines.push(format!(" Source: {}.", places(&register.source)));
    lines
}

fn register(device: &Device, register: &Register) -> TokenStream {
    let (name, address) = (&register.name, register.address);
    let kind = value::kind(register.kind);
    let area = match register.area {
        Area::Eeprom => quote!(Eeprom),
        Area::Ram => quote!(Ram),
    };
    let access = match register.access {
        Access::R => quote!(ReadOnly),
        Access::Rw => quote!(ReadWrite),
    };
    let initial = option(register.initial.map(number));
    let range =
        register.range.as_ref().map_or_else(|| quote!(Range::Any), |row| range(device, row));
    let unit = option(register.unit.as_ref().map(|unit| {
        let (factor, symbol) = (Literal::f64_unsuffixed(unit.factor), &unit.symbol);
        quote!(Unit { factor: #factor, symbol: #symbol })
    }));
    let values = named_values(&register.values);
    let bits = register.bits.iter().map(bit_field);
    quote! {
        Row {
            name: #name,
            address: #address,
            kind: Kind::#kind,
            area: Area::#area,
            access: Access::#access,
            initial: #initial,
            range: #range,
            unit: #unit,
            values: #values,
            bits: &[#(#bits),*],
        }
    }
}

fn range(device: &Device, range: &Range) -> TokenStream {
    if let Some(values) = &range.one_of {
        let values = values.iter().map(|value| number(*value));
        return quote!(Range::OneOf(&[#(#values),*]));
    }
    let (min, max) = (bound(device, range.min.as_ref()), bound(device, range.max.as_ref()));
    quote!(Range::Between { min: #min, max: #max })
}

/// A checked spec has both bounds and every register that they name; else the source won't compile.
fn bound(device: &Device, bound: Option<&Bound>) -> TokenStream {
    match bound {
        Some(Bound::Value(value)) => {
            let value = number(*value);
            quote!(Bound::Value(#value))
        }
        Some(Bound::Register(name)) => {
            let plain = name.trim_start_matches('-');
            let negated = plain != name;
            let address = device.register(plain).map_or_else(
                || quote!(compile_error!("unknown register")),
                |register| {
                    let address = register.address;
                    quote!(#address)
                },
            );
            quote!(Bound::Register { address: #address, negated: #negated })
        }
        None => quote!(compile_error!("a range without a bound")),
    }
}

fn bit_field(field: &BitField) -> TokenStream {
    let (name, lowest, width) = (&field.name, field.lowest, field.width);
    let values = named_values(&field.values);
    quote!(BitField { name: #name, lowest: #lowest, width: #width, values: #values })
}
