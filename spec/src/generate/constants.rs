//! The constants that every wire has: those of the CRC and of the length field.

use proc_macro2::TokenStream;
use quote::quote;

use super::places;
use super::token::hex16;
use crate::model::{ByteOrder, Crc, Length};

pub(crate) fn crc(crc: &Crc) -> TokenStream {
    let (polynomial, initial) = (hex16(crc.polynomial), hex16(crc.initial));
    let (final_xor, check) = (hex16(crc.final_xor), hex16(crc.check));
    let (reflected, low_byte_first) = (crc.reflected, crc.byte_order == ByteOrder::Little);
    let doc = format!(" The polynomial of {}, highest power in the highest bit.", crc.name);
    let source = format!(" {}.", places(&crc.source));
    quote! {
        #[doc = #doc]
        ///
        #[doc = #source]
        pub const CRC_POLYNOMIAL: u16 = #polynomial;
        /// The CRC's value before the first byte.
        pub const CRC_INITIAL: u16 = #initial;
        /// Whether the CRC takes and gives the lowest bit of a byte first.
        pub const CRC_REFLECTED: bool = #reflected;
        /// The value that is xored with the CRC's last value.
        pub const CRC_FINAL_XOR: u16 = #final_xor;
        /// The CRC of the nine ASCII characters `123456789`.
        pub const CRC_CHECK: u16 = #check;
        /// Whether the CRC's low byte comes first on the wire.
        pub const CRC_LOW_BYTE_FIRST: bool = #low_byte_first;
    }
}

/// `source` is the citation of the framing.
pub(crate) fn length(length: &Length, source: &str) -> TokenStream {
    let (size, low_byte_first) = (usize::from(length.size), length.byte_order == ByteOrder::Little);
    let doc = format!(" Bytes of the length field, which counts {}.", length.covers);
    quote! {
        #[doc = #doc]
        ///
        #[doc = #source]
        pub const LENGTH_SIZE: usize = #size;
        /// Whether the length field's low byte comes first.
        pub const LENGTH_LOW_BYTE_FIRST: bool = #low_byte_first;
    }
}
