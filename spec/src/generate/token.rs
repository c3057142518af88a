//! Names and numbers of the spec as Rust tokens.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};

use crate::model::NamedValue;

/// `Goal Position` as `GoalPosition`.
pub(crate) fn type_name(name: &str) -> Ident {
    let words = words(name);
    let name: String = words.iter().map(|word| capitalised(word)).collect();
    ident(&name)
}

/// The name of a value as a variant: `Torque on, EEPROM area locked` as `TorqueOn`. Text in
/// parentheses or after a comma explains the name and is left out. A leading number moves to the
/// end, so `9,600 bps` becomes `Bps9600`.
pub(crate) fn value_name(name: &str) -> Ident {
    let name = name.split(" (").next().unwrap_or(name);
    let name = name.split(", ").next().unwrap_or(name).replace(',', "");
    let words = words(&name);
    let is_number = |word: &&str| word.bytes().all(|byte| byte.is_ascii_digit());
    let numbers = words.iter().copied().take_while(is_number).count();
    let (numbers, rest) = words.split_at_checked(numbers).unwrap_or_default();
    let name: String = rest.iter().chain(numbers).map(|word| capitalised(word)).collect();
    ident(&name)
}

/// `Goal Position` as `GOAL_POSITION`.
pub(crate) fn constant_name(name: &str) -> Ident {
    ident(&words(name).join("_").to_uppercase())
}

/// `ja-variant` as `ja_variant`.
pub(crate) fn module_name(name: &str) -> Ident {
    ident(&words(name).join("_").to_lowercase())
}

/// A byte in the documents' notation: `0x8A`.
pub(crate) fn hex8(value: u8) -> impl ToTokens {
    hex(&format!("{value:#04X}"))
}

/// Two bytes in the documents' notation: `0x8005`.
pub(crate) fn hex16(value: u16) -> impl ToTokens {
    hex(&format!("{value:#06X}"))
}

/// A number that may be negative.
pub(crate) fn number(value: i64) -> TokenStream {
    let digits = Literal::u64_unsuffixed(value.unsigned_abs());
    if value < 0 { quote!(-#digits) } else { quote!(#digits) }
}

/// An option of tokens.
pub(crate) fn option(value: Option<impl ToTokens>) -> TokenStream {
    value.map_or_else(|| quote!(None), |value| quote!(Some(#value)))
}

/// A list of named values as a slice.
pub(crate) fn named_values(values: &[NamedValue]) -> TokenStream {
    let rows = values.iter().map(|row| {
        let (value, name) = (number(row.value), &row.name);
        quote!(NamedValue { value: #value, name: #name })
    });
    quote!(&[#(#rows),*])
}

fn hex(text: &str) -> TokenStream {
    // The text is 0x and digits, so it always parses; an empty stream would not compile.
    text.parse().unwrap_or_default()
}

/// The letters and digits of a name, split at everything else.
pub(crate) fn words(name: &str) -> Vec<&str> {
    name.split(|character: char| !character.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect()
}

/// The same text with a capital first letter.
pub(crate) fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

/// The identifier for a name that is not valid in Rust: it says so, and does not compile.
pub(super) const NOT_A_NAME: &str = "not_a_rust_name";

fn ident(name: &str) -> Ident {
    syn::parse_str(name).unwrap_or_else(|_| Ident::new(NOT_A_NAME, Span::call_site()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_take_the_form_that_rust_expects() {
        assert_eq!(type_name("Fast Sync Read").to_string(), "FastSyncRead");
        assert_eq!(type_name("CRC Error").to_string(), "CRCError");
        assert_eq!(value_name("9,600 bps").to_string(), "Bps9600");
        assert_eq!(value_name("Torque on, EEPROM area locked").to_string(), "TorqueOn");
        assert_eq!(value_name("Profile unused (step)").to_string(), "ProfileUnused");
        assert_eq!(constant_name("Feedforward 2nd Gain").to_string(), "FEEDFORWARD_2ND_GAIN");
        assert_eq!(constant_name("In-Position").to_string(), "IN_POSITION");
        assert_eq!(module_name("ja-variant").to_string(), "ja_variant");
    }

    #[test]
    fn numbers_keep_the_base_that_the_documents_use() {
        assert_eq!(hex8(10).to_token_stream().to_string(), "0x0A");
        assert_eq!(hex16(0x234).to_token_stream().to_string(), "0x0234");
        assert_eq!(number(-16384).to_string(), "- 16384");
    }
}
