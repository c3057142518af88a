//! Each mistake is made on purpose, and is among those that fit what comes of it.

use actucheck::explain::mistake::{Fit, fits};
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::reference as dynamixel2;
use actucheck_spec::wire::{Context, Direction, Packet, Wire};
use proptest::prelude::*;

use actucheck_spec::wire::dynamixel2::{Packet as Dynamixel2, WIRE as DYNAMIXEL2};
use actucheck_spec::wire::innfos::{Packet as Innfos, WIRE as INNFOS};

use super::made::{Dice, Make, OF_DYNAMIXEL2, OF_INNFOS, crc_of, dice, with_crc};

/// A mistake is found, unless what it makes is a packet still.
fn find(wire: Wire, packet: &Packet, make: &Make, dice: &Dice) -> Result<(), TestCaseError> {
    let (name, make) = make;
    let (frame, context) = (wire.encode(packet).unwrap(), wire.context(packet));
    let Some(bytes) = make(&frame, dice).filter(|bytes| wire.decode(bytes, &context).is_err())
    else {
        return Ok(());
    };
    let found = fits(wire, &bytes, &context);
    let named = |fit: &Fit| fit.meant.is_empty() || fit.meant.contains(&frame);
    // Where a likelier mistake leads to the same packet, it is told instead.
    let told = found.iter().any(|fit| fit.mistake == *name && named(fit))
        || found.iter().any(|fit| fit.meant.contains(&frame) && fit.trials <= 64);
    prop_assert!(told, "{name}: {bytes:02x?} of {frame:02x?} is explained by {found:#?}");
    Ok(())
}

/// With a header and a length that fits, but a CRC by chance.
fn like_a_packet(wire: Wire, bytes: &[u8]) -> Vec<u8> {
    let length = u16::try_from(bytes.len()).unwrap();
    if wire == DYNAMIXEL2 {
        return [&[0xFF, 0xFF, 0xFD, 0, 1], &length.to_le_bytes()[..], bytes].concat();
    }
    let length = length.saturating_sub(2).to_be_bytes();
    [&[0xEE, 1, 0x0A], &length[..], bytes, &[0xED]].concat()
}

fn of_dynamixel2() -> impl Strategy<Value = Packet> {
    let byte = prop_oneof![3 => any::<u8>(), 1 => Just(0xFF), 1 => Just(0xFD), 1 => Just(0)];
    let pattern = Just(vec![0xFF, 0xFF, 0xFD]);
    let part = prop_oneof![8 => byte.prop_map(|byte| vec![byte]), 1 => pattern];
    let params = prop::collection::vec(part, 0..24).prop_map(|parts| parts.concat());
    (0..253_u8, any::<u8>(), params, any::<bool>()).prop_map(|(id, code, params, status)| {
        let params = params.into();
        if status || code == 0x55 {
            Dynamixel2::Status { id, error: code, params }.into()
        } else {
            Dynamixel2::Instruction { id, instruction: code, params }.into()
        }
    })
}

/// With no address EE: without it a packet is the same as without its first byte.
fn of_innfos() -> impl Strategy<Value = Packet> {
    let data = prop::collection::vec(any::<u8>(), 0..6);
    let direction = prop::sample::select(Direction::ALL.as_slice());
    let address = prop_oneof![0..0xEE_u8, 0xEF..=0xFF_u8];
    (direction, address, 0x45..0xFF_u8, data).prop_map(|(direction, address, command, data)| {
        Innfos { direction, address, command, data: data.into() }.into()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_mistake_is_among_those_that_fit(packet in of_dynamixel2(), dice in dice()) {
        for make in OF_DYNAMIXEL2 {
            find(DYNAMIXEL2, &packet, make, &dice)?;
        }
    }

    #[test]
    fn a_mistake_of_the_other_wire_is_too(packet in of_innfos(), dice in dice()) {
        for make in OF_INNFOS {
            find(INNFOS, &packet, make, &dice)?;
        }
    }

    #[test]
    fn nothing_explains_a_packet(packet in prop_oneof![of_dynamixel2(), of_innfos()]) {
        let (wire, context) = (packet.wire(), packet.context());
        prop_assert_eq!(fits(wire, &wire.encode(&packet).unwrap(), &context), vec![]);
    }

    /// Any bytes are explained in bounded words, or not at all.
    #[test]
    fn any_bytes_are_looked_at(
        bytes in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..2000),
            prop::collection::vec(any::<u8>(), 0..24),
        ],
    ) {
        for wire in Wire::ALL {
            for bytes in [bytes.clone(), like_a_packet(wire, &bytes)] {
                for direction in [None, Some(Direction::Request)] {
                    for fit in fits(wire, &bytes, &Context { fast: None, direction }) {
                        prop_assert!(fit.to_string().len() < 500);
                    }
                }
            }
        }
    }
}

/// Many single bytes make a long packet right. A few are named, with how many fit by chance.
#[test]
fn of_what_fits_by_chance_a_few_are_named() {
    let packet = dynamixel2::frame(1, &[7; 1000]);
    let damaged = |wrong: u16| with_crc(&packet, crc_of(&packet) ^ wrong);
    let many = |fit: &Fit| fit.mistake == "one byte changed" && fit.more > 1;
    let mut found =
        (1..50).flat_map(|wrong| fits(DYNAMIXEL2, &damaged(wrong), &Context::default()));
    let fit = found.find(many).unwrap();
    assert_eq!(fit.conditions.len(), 3);
    let text = fit.to_string();
    assert!(text.contains(&format!(", or in one of {} more ways (", fit.more)), "{text}");
    assert!(text.ends_with(" were tried, so about 4 fit by chance)"), "{text}");
}

/// Each mistake that is made above is found in some test vector, and nearly always first.
#[test]
fn each_mistake_is_named_first_for_the_test_vectors() {
    let spec = Spec::embedded().unwrap();
    for (wire, makes) in [(DYNAMIXEL2, OF_DYNAMIXEL2), (INNFOS, OF_INNFOS)] {
        for (name, make) in makes {
            let (mut first, mut all) = (0, 0);
            let vectors = spec.vectors().filter(|(file, _)| file.wire == wire);
            for packet in vectors.filter_map(|(_, vector)| vector.packet.as_ref()) {
                let (Some(frame), context) = (wire.encode(packet), packet.context()) else {
                    continue;
                };
                for at in 0..3 {
                    let dice = Dice { at: at * 7919, byte: 37 };
                    let Some(bytes) = make(&frame, &dice) else { continue };
                    if context.fast.is_some() || wire.decode(&bytes, &context).is_ok() {
                        continue;
                    }
                    all += 1;
                    let found = fits(wire, &bytes, &context);
                    // A wrong length is likelier than no instruction, address or command, and a CRC that
                    // is missing or needless than another direction.
                    let second =
                        ["no instruction 0x55", "no address or no command", "other direction"]
                            .contains(name);
                    // A changed header is a wrong header too.
                    let is_first = |fit: &Fit| {
                        fit.mistake == *name
                            || name.starts_with("one b") && fit.meant.contains(&frame)
                    };
                    let told = if second { 2 } else { 1 };
                    first += usize::from(found.iter().take(told).any(is_first));
                }
            }
            // A mistake of many trials has others before it that fit by chance.
            let nearly = match *name {
                name if name.starts_with("one b") => all / 2,
                _ => all * 9 / 10,
            };
            assert!(first >= nearly && all > 0, "{wire}: {name}: first for {first} of {all}");
        }
    }
}

/// What is told of some bytes, in these words.
#[test]
fn what_fits_is_told_in_words() {
    let four = "ff ff 01 02 01 fb ff ff 02 02 01 fa ff ff 03 02 01 f9 ff ff 04 02 01 f8";
    let six = format!("{four} ff ff 05 02 01 f7 ff ff 06 02 01 f6");
    let (request, reply) = (Some(Direction::Request), Some(Direction::Reply));
    for (wire, direction, bytes, told) in [
        (DYNAMIXEL2, None, four, "they are packets of Protocol 1.0, of ID 1, 2, 3, 4"),
        (DYNAMIXEL2, None, &six, "they are packets of Protocol 1.0, of ID 1, 2, 3, 4 and 2 more"),
        (
            DYNAMIXEL2,
            None,
            "ff ff fd 00 01 06 00 03 ff ff fd 6f 50",
            "the sender left out byte stuffing (1 byte FD), which the CRC covers",
        ),
        // Any address and any command would be right.
        (
            INNFOS,
            request,
            "ee 0a 00 04 01 00 00 00 01 d8 ed",
            "the address or the command is missing",
        ),
        (
            INNFOS,
            reply,
            "ee 06 07 00 01 01 7e 80 ed",
            "the CRC is left out (it is right, but such a frame has none)\nfits if it is a request",
        ),
        (INNFOS, request, "ee 06 0a 00 04 01 00", "3 more bytes follow, or 5 if it has a CRC"),
        (INNFOS, request, "ee 06 0a 00 04 01 00 00 00 01", "2 more bytes follow: D8 ED"),
        (INNFOS, request, "ee 06 0a 00 04 01 00 00 00 01 d8", "the end byte ED follows"),
        (INNFOS, request, "ee 06 0a 00 04 01 00 00 00 02", ""),
        (
            INNFOS,
            request,
            "ee 01 0a 00 01 01 ff ff ed",
            "the CRC does not cover the first byte of data, or the CRC does not cover the last \
             byte of data",
        ),
    ] {
        let hex = |byte| u8::from_str_radix(byte, 16).unwrap();
        let bytes: Vec<_> = bytes.split(' ').map(hex).collect();
        let found = fits(wire, &bytes, &Context { fast: None, direction });
        let found: Vec<_> = found.iter().map(Fit::to_string).collect();
        let told = if told.is_empty() { String::new() } else { format!("fits if {told}") };
        assert_eq!(found.join("\n"), told, "{bytes:02x?}");
    }
}

#[test]
fn one_more_way_is_one() {
    let mut fit = fits(DYNAMIXEL2, &[0xFF], &Context::default()).remove(0);
    fit.more = 1;
    assert_eq!(fit.to_string(), "fits if the rest of the packet follows, or in 1 more way");
}
