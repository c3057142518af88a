//! The wire's constants, commands, modes, alarms and models.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::{Actuators, Alarms, Command, Format, FullScale, Innfos, Modes, Operation, WIRE};
use crate::generate::token::{constant_name, hex8, hex16, module_name, option, type_name};
use crate::generate::wire_enum::wire_enum;
use crate::generate::{constants, places};

pub(super) fn module(innfos: &Innfos) -> TokenStream {
    let name = module_name(WIRE.id());
    let doc = format!(" {}.", innfos.title);
    let (constants, commands) = (constants_of(innfos), commands(&innfos.commands));
    let (modes, alarms) = (modes(&innfos.modes), alarms(&innfos.alarms));
    let actuators = actuators(&innfos.actuators);
    quote! {
        #[doc = #doc]
        pub mod #name {
            use crate::innfos::{Actuator, CommandRow, Format, FullScale, Operation};

            #constants
            #commands
            #modes
            #alarms
            #actuators
        }
    }
}

fn constants_of(innfos: &Innfos) -> TokenStream {
    let (framing, presence, udp) = (&innfos.framing, &innfos.crc_presence, &innfos.udp);
    let (header, tail) = (hex8(framing.header), hex8(framing.tail));
    let (min_address, max_address) = (hex8(framing.address.min), hex8(framing.address.max));
    let broadcast = hex8(framing.address.broadcast);
    let framing_source = format!(" {}.", places(&framing.source));
    let (length, crc) =
        (constants::length(&framing.length, &framing_source), constants::crc(&innfos.crc));
    let (request, reply) = (usize::from(presence.request), usize::from(presence.reply));
    let presence_source = format!(" {}.", places(&presence.source));
    let optional = presence.optional.iter().map(|code| hex8(*code));
    let count = presence.optional.len();
    let (board, everyone) = (udp.address.octets(), udp.broadcast.octets());
    let port = Literal::u16_unsuffixed(udp.port);
    let udp_source = format!(" {}.", places(&udp.source));
    quote! {
        /// The first byte of a frame.
        ///
        #[doc = #framing_source]
        pub const HEADER: u8 = #header;
        /// The last byte of a frame.
        pub const TAIL: u8 = #tail;
        /// The smallest address that an actuator may have.
        pub const MIN_ADDRESS: u8 = #min_address;
        /// The largest address that an actuator may have.
        pub const MAX_ADDRESS: u8 = #max_address;
        /// The address that every actuator obeys.
        pub const BROADCAST_ADDRESS: u8 = #broadcast;
        #length
        #crc
        /// A request with at least this many bytes of data has a CRC.
        ///
        #[doc = #presence_source]
        pub const REQUEST_CRC_FROM: usize = #request;
        /// A reply with at least this many bytes of data has a CRC.
        ///
        #[doc = #presence_source]
        pub const REPLY_CRC_FROM: usize = #reply;
        /// The commands whose shorter replies may have a CRC, or zeros in its place.
        ///
        #[doc = #presence_source]
        pub const OPTIONAL_CRC_REPLIES: [u8; #count] = [#(#optional),*];
        /// The board's IPv4 address as delivered.
        ///
        #[doc = #udp_source]
        pub const BOARD: [u8; 4] = [#(#board),*];
        /// The IPv4 address of every board.
        pub const EVERY_BOARD: [u8; 4] = [#(#everyone),*];
        /// The board's UDP port.
        pub const PORT: u16 = #port;
    }
}

/// A command's name is unique per access only, so a command with a value has the verb in its name.
fn command_name(command: &Command) -> String {
    match (command.format, command.operation) {
        (None, _) => command.name.clone(),
        (Some(_), Operation::Read) => format!("Read {}", command.name),
        (Some(_), Operation::Write) => format!("Write {}", command.name),
    }
}

fn commands(commands: &[Command]) -> TokenStream {
    let names: Vec<_> = commands.iter().map(command_name).collect();
    let mut rows: Vec<_> = commands
        .iter()
        .zip(&names)
        .map(|(row, name)| (row.code, name.as_str(), command_doc(row)))
        .collect();
    rows.sort_by_key(|(code, ..)| *code);
    let declaration = wire_enum(&type_name("Command"), " A command of a host.", &rows);
    let arms = commands.iter().zip(&names).map(|(row, name)| {
        let (variant, row) = (type_name(name), command_row(row));
        quote!(Self::#variant => &#row,)
    });
    quote! {
        #declaration

        impl Command {
            /// The facts about the command; `None` for an unknown one.
            #[must_use]
            pub const fn row(self) -> Option<&'static CommandRow> {
                Some(match self {
                    #(#arms)*
                    Self::Unknown(_) => return None,
                })
            }
        }
    }
}

fn command_doc(command: &Command) -> String {
    let mut facts = match (command.format, command.operation) {
        (None, _) => "no value".to_owned(),
        (Some(format), Operation::Read) => format!("the reply carries a value, {format}"),
        (Some(format), Operation::Write) => format!("the request carries a value, {format}"),
    };
    facts.extend(command.unit.iter().map(|unit| format!(" in {unit}")));
    if command.reply.is_empty() {
        facts.push_str(", and no reply comes");
    }
    format!("{}; {facts}.\n\n {}.", command.name, places(&command.source))
}

fn command_row(command: &Command) -> TokenStream {
    let operation = match command.operation {
        Operation::Read => quote!(Read),
        Operation::Write => quote!(Write),
    };
    let request = Literal::u16_unsuffixed(command.request);
    let reply = command.reply.iter().map(|size| Literal::u16_unsuffixed(*size));
    let format = option(command.format.map(|format| match format {
        Format::Flag => quote!(Format::Flag),
        Format::Mode => quote!(Format::Mode),
        Format::Alarms => quote!(Format::Alarms),
        Format::Iq8 => quote!(Format::Iq8),
        Format::Iq24 => quote!(Format::Iq24),
        Format::Scaled => {
            // A validated spec has a factor for this format.
            let factor = Literal::f64_unsuffixed(command.factor.unwrap_or(1.0));
            quote!(Format::Scaled { factor: #factor })
        }
        Format::Mac => quote!(Format::Mac),
    }));
    let unit = option(command.unit.as_ref());
    let full_scale = option(command.full_scale.map(|full_scale| match full_scale {
        FullScale::Current => quote!(FullScale::Current),
        FullScale::MotorSpeed => quote!(FullScale::MotorSpeed),
    }));
    quote! {
        CommandRow {
            operation: Operation::#operation,
            request: #request,
            reply: &[#(#reply),*],
            format: #format,
            unit: #unit,
            full_scale: #full_scale,
        }
    }
}

fn modes(modes: &Modes) -> TokenStream {
    let doc = format!(" What the actuator controls ({}).", places(&modes.source));
    let mut rows: Vec<_> = modes
        .rows
        .iter()
        .map(|row| (row.code, row.name.as_str(), format!("{}.", row.name)))
        .collect();
    rows.sort_by_key(|(code, ..)| *code);
    wire_enum(&type_name("Mode"), &doc, &rows)
}

fn alarms(alarms: &Alarms) -> TokenStream {
    let doc = format!(" What the actuator warns of ({}).", places(&alarms.source));
    let methods = alarms.rows.iter().map(|row| {
        let (doc, mask) = (format!(" `{:#06X}`: {}.", row.mask, row.name), hex16(row.mask));
        let (get, with) =
            (module_name(&row.name), format_ident!("with_{}", module_name(&row.name)));
        let with_doc = format!(" The same with another {}.", row.name);
        quote! {
            #[doc = #doc]
            #[must_use]
            pub const fn #get(self) -> bool {
                self.0 & #mask != 0
            }

            #[doc = #with_doc]
            #[must_use]
            pub const fn #with(self, value: bool) -> Self {
                Self(if value { self.0 | #mask } else { self.0 & !#mask })
            }
        }
    });
    let masks = alarms.rows.iter().map(|row| hex16(row.mask));
    let names = alarms.rows.iter().map(|row| &row.name);
    let known = hex16(alarms.rows.iter().fold(0, |named, row| named | row.mask));
    let other_name = &alarms.other;
    let other = format!(" The bits that mean an {}.", other_name.to_lowercase());
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct Alarms(pub u16);

        impl Alarms {
            /// The names of the set bits: one name per named bit, then one name for all other bits.
            pub fn names(self) -> impl Iterator<Item = &'static str> {
                let rows = [#((#masks, #names),)* (!#known, #other_name)];
                rows.into_iter().filter(move |row: &(u16, _)| self.0 & row.0 != 0).map(|row| row.1)
            }

            #(#methods)*

            #[doc = #other]
            #[must_use]
            pub const fn others(self) -> u16 {
                self.0 & !#known
            }
        }
    }
}

fn actuators(actuators: &Actuators) -> TokenStream {
    let doc = format!(" Every model ({}).", places(&actuators.source));
    let names: Vec<_> = actuators.rows.iter().map(|row| constant_name(&row.name)).collect();
    let count = names.len();
    let constants = actuators.rows.iter().zip(&names).map(|(row, constant)| {
        let (name, doc) = (&row.name, format!(" The full scales of the {}.", row.name));
        let [current, motor, output] =
            [row.current, row.motor_speed, row.output_speed].map(Literal::f64_unsuffixed);
        quote! {
            #[doc = #doc]
            pub const #constant: Actuator = Actuator {
                name: #name,
                current: #current,
                motor_speed: #motor,
                output_speed: #output,
            };
        }
    });
    quote! {
        #[doc = #doc]
        pub const ACTUATORS: [Actuator; #count] = [#(#names),*];

        #(#constants)*
    }
}
