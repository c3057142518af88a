//! The type of a register's value: a number, an enum of its named values, or a set of bits.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::token::{module_name, number, type_name, value_name};
use crate::model::{BitField, NamedValue, Register, Type};

/// The name of the type.
pub(super) fn of(register: &Register) -> Ident {
    if has_type(register) { type_name(&register.name) } else { number_type(register.kind) }
}

/// The types that the register's module must declare for it: none for a number.
pub(super) fn declarations(register: &Register) -> TokenStream {
    if !has_type(register) {
        return TokenStream::new();
    }
    let name = type_name(&register.name);
    let raw = number_type(register.kind);
    let kind = kind(register.kind);
    let declaration = if register.bits.is_empty() {
        let doc = format!(" What {} may be.", register.name);
        named(&name, &doc, &raw, &register.values)
    } else {
        bit_set(&name, &raw, register)
    };
    quote! {
        #declaration

        impl Value for #name {
            const KIND: Kind = Kind::#kind;

            fn raw(self) -> i64 {
                self.raw().into()
            }

            fn from_raw(raw: i64) -> Option<Self> {
                raw.try_into().ok().map(Self::from_raw)
            }
        }
    }
}

/// Sets of bits are unsigned; a signed register with bits stays a number.
fn has_type(register: &Register) -> bool {
    let unsigned = matches!(register.kind, Type::U8 | Type::U16 | Type::U32);
    if register.bits.is_empty() { !register.values.is_empty() } else { unsigned }
}

/// The variant of the codec's `Kind`.
pub(super) fn kind(kind: Type) -> Ident {
    type_name(&number_type(kind).to_string())
}

fn number_type(kind: Type) -> Ident {
    format_ident!(
        "{}",
        match kind {
            Type::U8 => "u8",
            Type::I8 => "i8",
            Type::U16 => "u16",
            Type::I16 => "i16",
            Type::U32 => "u32",
            Type::I32 => "i32",
        }
    )
}

/// An enum of the named values, which keeps unnamed values too.
fn named(name: &Ident, doc: &str, raw: &Ident, rows: &[NamedValue]) -> TokenStream {
    let variants: Vec<_> = rows.iter().map(|row| value_name(&row.name)).collect();
    let docs = rows.iter().map(|row| format!(" `{}`: {}.", row.value, row.name));
    let values: Vec<_> = rows.iter().map(|row| number(row.value)).collect();
    let actual = actual(rows, &variants);
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum #name {
            #(
                #[doc = #docs]
                #variants,
            )*
            /// A value without a name in the documents.
            Unknown(#raw),
        }

        impl #name {
            /// The value with this number.
            #[must_use]
            pub const fn from_raw(raw: #raw) -> Self {
                match raw {
                    #(#values => Self::#variants,)*
                    raw => Self::Unknown(raw),
                }
            }

            /// The number.
            #[must_use]
            pub const fn raw(self) -> #raw {
                match self {
                    #(Self::#variants => #values,)*
                    Self::Unknown(raw) => raw,
                }
            }

            #actual
        }
    }
}

/// The actual quantities of the values, if the documents state any.
fn actual(rows: &[NamedValue], variants: &[Ident]) -> TokenStream {
    let arms: Vec<_> = rows
        .iter()
        .zip(variants)
        .filter_map(|(row, variant)| {
            let actual = Literal::i64_unsuffixed(row.actual?);
            Some(quote!(Self::#variant => Some(#actual),))
        })
        .collect();
    if arms.is_empty() {
        return TokenStream::new();
    }
    quote! {
        /// The actual quantity, in the unit of its name, if the document states it.
        #[must_use]
        pub const fn actual(self) -> Option<i64> {
            match self {
                #(#arms)*
                _ => None,
            }
        }
    }
}

/// All bits of a register, with methods for the named ones.
fn bit_set(name: &Ident, raw: &Ident, register: &Register) -> TokenStream {
    let doc = format!(" The bits of {}.", register.name);
    let types = register.bits.iter().filter(|field| !field.values.is_empty()).map(|field| {
        let doc = format!(" What the bits {} of {} may be.", field.name, register.name);
        named(&type_name(&field.name), &doc, raw, &field.values)
    });
    let methods = register.bits.iter().map(|field| bit_field(raw, field));
    let mask: u64 = register.bits.iter().map(BitField::mask).sum();
    let mask = hex(mask);
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct #name(pub #raw);

        impl #name {
            /// The value with this number.
            #[must_use]
            pub const fn from_raw(raw: #raw) -> Self {
                Self(raw)
            }

            /// The number.
            #[must_use]
            pub const fn raw(self) -> #raw {
                self.0
            }

            /// The bits without a name in the documents, in their places.
            #[must_use]
            pub const fn unnamed(self) -> #raw {
                self.0 & !#mask
            }

            #(#methods)*
        }

        #(#types)*
    }
}

fn bit_field(raw: &Ident, field: &BitField) -> TokenStream {
    let get = module_name(&field.name);
    let with = format_ident!("with_{get}");
    let shift = Literal::u8_unsuffixed(field.lowest);
    let mask = hex(field.mask());
    let (get_doc, with_doc) = bit_field_docs(field);
    let part = quote!((self.0 & #mask) >> #shift);
    let (value, get_body, part_of_value) = if !field.values.is_empty() {
        let value = type_name(&field.name);
        (value.clone(), quote!(#value::from_raw(#part)), quote!(value.raw()))
    } else if field.width == 1 {
        (format_ident!("bool"), quote!(self.0 & #mask != 0), quote!((value as #raw)))
    } else {
        (raw.clone(), part, quote!(value))
    };
    quote! {
        #[doc = #get_doc]
        #[must_use]
        pub const fn #get(self) -> #value {
            #get_body
        }

        #[doc = #with_doc]
        #[must_use]
        pub const fn #with(self, value: #value) -> Self {
            Self((self.0 & !#mask) | ((#part_of_value << #shift) & #mask))
        }
    }
}

fn bit_field_docs(field: &BitField) -> (String, String) {
    let (name, lowest) = (&field.name, field.lowest);
    let place = match field.width {
        1 => format!("Bit {lowest}"),
        width => format!("Bits {lowest} to {}", lowest + width - 1),
    };
    (format!(" {place}: {name}."), format!(" The same with another {name}."))
}

fn hex(mask: u64) -> TokenStream {
    // The text is 0x and digits, so it always parses; an empty stream would not compile.
    format!("{mask:#04X}").parse().unwrap_or_default()
}
