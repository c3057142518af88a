//! The wire's constants, instructions and error numbers.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Dynamixel2, Field, Instruction, Size, WIRE};
use crate::generate::token::{constant_name, hex8, module_name, named_values, type_name};
use crate::generate::wire_enum::wire_enum;
use crate::generate::{constants, places};

pub(super) fn module(wire: &Dynamixel2) -> TokenStream {
    let name = module_name(WIRE.id());
    let doc = format!(" {}.", wire.title);
    let constants = constants_of(wire);
    let instructions = instructions(wire);
    let errors = errors(wire);
    quote! {
        #[doc = #doc]
        pub mod #name {
            use crate::layout::{Field, Size};
            use crate::register::NamedValue;

            #constants
            #instructions
            #errors
        }
    }
}

fn constants_of(wire: &Dynamixel2) -> TokenStream {
    let framing = &wire.framing;
    let header = framing.header.iter().map(|byte| hex8(*byte));
    let header_size = framing.header.len();
    let (min_id, max_id) = (hex8(framing.id.min), hex8(framing.id.max));
    let broadcast = hex8(framing.id.broadcast);
    let minimum = framing.length.minimum;
    let framing_source = format!(" {}.", places(&framing.source));
    let length = constants::length(&framing.length, &framing_source);

    let pattern = wire.stuffing.pattern.iter().map(|byte| hex8(*byte));
    let pattern_size = wire.stuffing.pattern.len();
    let insert = hex8(wire.stuffing.insert);
    let stuffing_source = format!(" {}.", places(&wire.stuffing.source));

    let crc = constants::crc(&wire.crc);

    let alert = 1_u8.checked_shl(wire.status.alert_bit.into()).unwrap_or(0);
    let alert = hex8(alert);
    let status_source = format!(" {}.", places(&wire.status.source));
    quote! {
        /// The first bytes of every packet, including the reserved byte.
        ///
        #[doc = #framing_source]
        pub const HEADER: [u8; #header_size] = [#(#header),*];
        /// The smallest ID that a device may have.
        pub const MIN_ID: u8 = #min_id;
        /// The largest ID that a device may have.
        pub const MAX_ID: u8 = #max_id;
        /// The ID that every device obeys.
        pub const BROADCAST_ID: u8 = #broadcast;
        #length
        /// The smallest length that a packet may have.
        pub const MIN_LENGTH: u16 = #minimum;
        /// The bytes after which a body always has [`STUFFING_BYTE`].
        ///
        #[doc = #stuffing_source]
        pub const STUFFING_PATTERN: [u8; #pattern_size] = [#(#pattern),*];
        /// The byte that stuffing inserts after [`STUFFING_PATTERN`].
        pub const STUFFING_BYTE: u8 = #insert;
        #crc
        /// The bit of a status packet's error byte that signals a hardware error.
        ///
        #[doc = #status_source]
        pub const ALERT_BIT: u8 = #alert;
    }
}

fn instructions(wire: &Dynamixel2) -> TokenStream {
    let mut rows: Vec<_> = wire
        .instructions
        .iter()
        .map(|row| {
            let doc = format!("{}\n\n {}.", row.summary, places(&row.source));
            (row.code, row.name.as_str(), doc)
        })
        .collect();
    let status = format!("What a device answers.\n\n {}.", places(&wire.status.source));
    rows.push((wire.status.instruction, "Status", status));
    rows.sort_by_key(|(code, ..)| *code);
    let name = type_name("Instruction");
    let declaration = wire_enum(&name, " The instruction of a packet.", &rows);
    let options = wire.instructions.iter().flat_map(options);
    let fixed = wire.instructions.iter().flat_map(fixed);

    let arms = |pick: fn(&Instruction) -> Option<&Vec<Field>>| {
        let arms = wire.instructions.iter().filter_map(|row| {
            let (variant, layout) = (type_name(&row.name), layout(pick(row)?));
            Some(quote!(Self::#variant => Some(#layout),))
        });
        quote!(#(#arms)*)
    };
    let parameters = arms(|row| Some(&row.parameters));
    let status = arms(|row| row.status.as_ref());
    let fast_status = arms(|row| row.fast_status.as_ref());
    let list = |pick: fn(&Instruction) -> bool| {
        let variants: Vec<_> = wire
            .instructions
            .iter()
            .filter(|row| pick(row))
            .map(|row| type_name(&row.name))
            .collect();
        quote!(matches!(self, #(Self::#variants)|*))
    };
    let broadcast_only = list(|row| row.broadcast_only);
    let answers_broadcast = list(|row| row.answers_broadcast);
    quote! {
        #declaration
        #(#options)*
        #(#fixed)*

        impl Instruction {
            /// Layout of the parameters of an instruction packet; `None` for
            /// [`Instruction::Status`] and for an unknown one.
            #[must_use]
            pub const fn parameters(self) -> Option<&'static [Field]> {
                match self {
                    #parameters
                    _ => None,
                }
            }

            /// Layout of the parameters of a device's status packet; `None` if a device sends no
            /// status packet of its own.
            #[must_use]
            pub const fn status(self) -> Option<&'static [Field]> {
                match self {
                    #status
                    _ => None,
                }
            }

            /// Layout of one device's block in a fast status packet; `None` if the answer is not
            /// one.
            #[must_use]
            pub const fn fast_status(self) -> Option<&'static [Field]> {
                match self {
                    #fast_status
                    _ => None,
                }
            }

            /// Whether it may be sent to the broadcast ID only.
            #[must_use]
            pub const fn broadcast_only(self) -> bool {
                #broadcast_only
            }

            /// Whether devices answer it when it is sent to the broadcast ID.
            #[must_use]
            pub const fn answers_broadcast(self) -> bool {
                #answers_broadcast
            }
        }
    }
}

/// An enum for each parameter of one byte with named values, such as `FactoryResetOption`.
fn options(instruction: &Instruction) -> Vec<TokenStream> {
    let one_byte = |field: &&Field| field.size == Some(Size::Bytes(1)) && !field.values.is_empty();
    let fields = instruction.parameters.iter().filter(one_byte);
    let options = fields.map(|field| {
        let name = type_name(&format!("{} {}", instruction.name, field.name));
        let mut rows: Vec<_> = field
            .values
            .iter()
            .filter_map(|row| {
                Some((u8::try_from(row.value).ok()?, row.name.as_str(), format!("{}.", row.name)))
            })
            .collect();
        rows.sort_by_key(|(code, ..)| *code);
        let doc = format!(
            " The {} of {} ({}).",
            field.name,
            instruction.name,
            places(&instruction.source)
        );
        wire_enum(&name, &doc, &rows)
    });
    options.collect()
}

/// A constant for each parameter with fixed bytes, such as `CLEAR_KEY`.
fn fixed(instruction: &Instruction) -> Vec<TokenStream> {
    let constant = |field: &Field| {
        let bytes = field.fixed.as_ref()?;
        let name = constant_name(&format!("{} {}", instruction.name, field.name));
        let (size, bytes) = (bytes.len(), bytes.iter().map(|byte| hex8(*byte)));
        let doc = format!(
            " The {} of {} ({}).",
            field.name,
            instruction.name,
            places(&instruction.source)
        );
        Some(quote! {
            #[doc = #doc]
            pub const #name: [u8; #size] = [#(#bytes),*];
        })
    };
    instruction.parameters.iter().filter_map(constant).collect()
}

fn errors(wire: &Dynamixel2) -> TokenStream {
    let mut rows = vec![(0, "None", "The instruction was carried out.".to_owned())];
    rows.extend(
        wire.status.errors.iter().map(|row| (row.number, row.name.as_str(), row.summary.clone())),
    );
    let doc = " The result of an instruction: a status packet's error byte without the alert bit.";
    wire_enum(&type_name("Error Number"), doc, &rows)
}

fn layout(fields: &[Field]) -> TokenStream {
    let fields = fields.iter().map(|field| {
        let (name, optional) = (&field.name, field.optional);
        let size = match &field.size {
            None => {
                let each = layout(&field.each);
                quote!(Size::Each(#each))
            }
            Some(Size::Bytes(size)) => quote!(Size::Bytes(#size)),
            Some(Size::Named(name)) if name == "rest" => quote!(Size::Rest),
            Some(Size::Named(name)) => quote!(Size::HeldBy(#name)),
        };
        let values = named_values(&field.values);
        quote!(Field { name: #name, size: #size, optional: #optional, values: #values })
    });
    quote!(&[#(#fields),*])
}
