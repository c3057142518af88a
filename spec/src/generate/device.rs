//! A device's control table.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::token::{
    capitalised, constant_name, module_name, named_values, number, option, type_name,
};
use super::{places, value};
use crate::Spec;
use crate::model::{
    Access, Area, BitField, Bound, Condition, Device, Meaning, Range, Register, Unit,
};

/// `codec` is the path to the codec's crate.
pub(super) fn module(spec: &Spec, device: &Device, codec: &TokenStream) -> TokenStream {
    let name = module_name(&device.device);
    let doc = format!(" The {} control table: {}.", device.title, places(&device.source));
    let (id, title) = (&device.device, &device.title);
    let model_number = option(device.model_number.map(|number| quote!(#number)));
    let complete = device.complete;
    let instructions = device.instructions.iter().map(|name| type_name(name));
    let lock = option(device.eeprom_lock.as_ref().and_then(|name| {
        let address = device.register(name)?.address;
        Some(quote!(#address))
    }));
    let names: Vec<_> =
        device.registers.iter().map(|register| constant_name(&register.name)).collect();
    let registers = device.registers.iter().zip(&names).map(|(row, name)| {
        let (doc, value) = (register_doc(device, row), register(spec, device, row));
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
            use #codec::dynamixel2::Instruction;
            use #codec::register::{
                Access, Area, BitField, Bound, Condition, Device, Kind, Meaning, NamedValue, Range,
                Register, Row, Unit, Value,
            };

            /// The device as a whole.
            pub const DEVICE: Device = Device {
                id: #id,
                name: #title,
                model_number: #model_number,
                complete: #complete,
                instructions: &[#(Instruction::#instructions),*],
                eeprom_lock: #lock,
                registers: &[#(#names.row),*],
            };

            #(#registers)*
        }
    }
}

fn register_doc(device: &Device, register: &Register) -> Vec<String> {
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
    for meaning in &register.meanings {
        lines.push(format!(" {}.", capitalised(&meaning.in_words(device))));
    }
    lines.push(format!(" Source: {}.", places(&register.source)));
    lines
}

fn register(spec: &Spec, device: &Device, register: &Register) -> TokenStream {
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
    let settled = register.range.iter().all(|range| spec.settles(range));
    let unit = unit(register.unit.as_ref());
    let meanings = register.meanings.iter().map(|row| meaning(device, row));
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
            settled: #settled,
            unit: #unit,
            meanings: &[#(#meanings),*],
            values: #values,
            bits: &[#(#bits),*],
        }
    }
}

fn unit(unit: Option<&Unit>) -> TokenStream {
    option(unit.map(|unit| {
        let (factor, symbol) = (Literal::f64_unsuffixed(unit.factor), &unit.symbol);
        quote!(Unit { factor: #factor, symbol: #symbol })
    }))
}

fn meaning(device: &Device, meaning: &Meaning) -> TokenStream {
    let condition = condition(device, &meaning.when);
    let range = option(meaning.range.as_ref().map(|row| range(device, row)));
    let unit = unit(meaning.unit.as_ref());
    quote!(Meaning { when: #condition, range: #range, unit: #unit })
}

/// A validated spec has the register and the bits; otherwise the generated source does not compile.
fn condition(device: &Device, condition: &Condition) -> TokenStream {
    let Some(register) = device.register(&condition.register) else {
        return quote!(compile_error!("unknown register"));
    };
    let bits = condition.bits.as_ref().and_then(|name| register.bit_field(name));
    let whole = 64; // the whole value, with its sign
    let (lowest, width) =
        bits.map_or_else(|| (0, whole), |bits| (bits.lowest.into(), bits.width.into()));
    let (address, values) = (register.address, condition.one_of.iter().map(|value| number(*value)));
    let (lowest, width) = (Literal::u16_unsuffixed(lowest), Literal::u16_unsuffixed(width));
    let words = condition.in_words(device);
    quote! {
        Condition {
            address: #address,
            lowest: #lowest,
            width: #width,
            one_of: &[#(#values),*],
            words: #words,
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

/// A validated spec has both bounds and every register that they name; otherwise the generated
/// source does not compile.
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
