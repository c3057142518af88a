//! Enums of bytes on the wire.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::token::{hex8, type_name};

/// An enum of the named bytes, which keeps unnamed bytes too.
pub(crate) fn wire_enum(name: &Ident, doc: &str, rows: &[(u8, &str, String)]) -> TokenStream {
    let count = rows.len();
    let variants: Vec<_> = rows.iter().map(|(_, name, _)| type_name(name)).collect();
    let codes: Vec<_> = rows.iter().map(|(code, ..)| hex8(*code)).collect();
    let names = rows.iter().map(|(_, name, _)| *name);
    let docs = rows.iter().map(|(code, _, doc)| format!(" `{code:#04X}`: {doc}"));
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum #name {
            #(#[doc = #docs] #variants,)*
            /// A byte without a name in the documents.
            Unknown(u8),
        }

        impl #name {
            /// Every named one, by ascending code.
            pub const ALL: [Self; #count] = [#(Self::#variants),*];

            /// The value with this byte.
            #[must_use]
            pub const fn from_code(code: u8) -> Self {
                match code {
                    #(#codes => Self::#variants,)*
                    code => Self::Unknown(code),
                }
            }

            /// The byte on the wire.
            #[must_use]
            pub const fn code(self) -> u8 {
                match self {
                    #(Self::#variants => #codes,)*
                    Self::Unknown(code) => code,
                }
            }

            /// Its name in the documents, or `unknown`.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    #(Self::#variants => #names,)*
                    Self::Unknown(_) => "unknown",
                }
            }
        }
    }
}
