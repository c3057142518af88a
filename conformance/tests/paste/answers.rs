//! Mistakes that may explain an implementation's wrong answers.

use actucheck::adapter::{Output, Question};
use actucheck::explain::mistake::of_answer;
use actucheck_spec::wire::dynamixel2::reference as dynamixel2;
use actucheck_spec::wire::dynamixel2::{Packet as Dynamixel2, WIRE as DYNAMIXEL2};
use actucheck_spec::wire::{Context, Packet};

/// Where the right answer is known, a wrong one that is a packet of its own is explained too.
#[test]
fn a_wrong_answer_is_explained_by_the_right_one() {
    let body = [3, 0x34, 2, 0xFF, 0xFF, 0xFD, 9];
    let stuffed = dynamixel2::stuff(&body);
    let twice = dynamixel2::stuff(&stuffed);
    let frame = |body: &[u8]| dynamixel2::frame(1, body);
    let packet = |params: &[u8]| -> Packet {
        Dynamixel2::Instruction { id: 1, instruction: 3, params: params.to_vec().into() }.into()
    };
    let encode = Question::Encode { wire: DYNAMIXEL2, packet: packet(&body[1..]).into() };
    let unstuff = Question::Unstuff { wire: DYNAMIXEL2, bytes: stuffed.clone().into() };
    let decode = Question::Decode {
        wire: DYNAMIXEL2,
        bytes: frame(&stuffed).into(),
        context: Context::default(),
    };
    let stream = Question::Stream { wire: DYNAMIXEL2, chunks: Vec::new(), direction: None };
    let [right, left, other] = [&body[1..], &stuffed[1..], &[1, 2]].map(packet);
    let read = |packet: &Packet| Output::Packet(packet.clone());
    let found = |packet: &Packet| Output::Packets(vec![other.clone(), packet.clone()]);
    let stuff = Question::Stuff { wire: DYNAMIXEL2, bytes: body.to_vec().into() };
    let bytes = |bytes: &[u8]| Output::Bytes(bytes.to_vec().into());
    let digits = Question::Crc { wire: DYNAMIXEL2, bytes: b"123456789".to_vec().into() };
    for (question, right, wrong, mistake) in [
        (&encode, bytes(&frame(&stuffed)), bytes(&frame(&body)), Some("no byte stuffing")),
        (&encode, bytes(&frame(&stuffed)), bytes(&frame(&twice)), Some("byte stuffing twice")),
        (&encode, bytes(&frame(&stuffed)), bytes(&frame(&[1, 2])), None),
        (&stuff, bytes(&stuffed), bytes(&body), Some("no byte stuffing")),
        (&stuff, bytes(&stuffed), bytes(&twice), Some("byte stuffing twice")),
        (&stuff, bytes(&stuffed), bytes(&[]), None),
        (&unstuff, bytes(&body), bytes(&stuffed), Some("byte stuffing left in")),
        (&unstuff, bytes(&body), bytes(&body[1..]), None),
        (&decode, read(&right), read(&left), Some("byte stuffing left in")),
        (&decode, read(&right), read(&other), None),
        (&stream, found(&right), found(&left), Some("byte stuffing left in")),
        (&stream, found(&right), found(&other), None),
        // The check value of MODBUS in the catalogue.
        (&digits, Output::Crc(0xFEE8), Output::Crc(0x4B37), Some("other CRC")),
        (&digits, Output::Crc(0xFEE8), Output::Crc(0xE8FE), Some("CRC bytes swapped")),
        (&digits, Output::Crc(0xFEE8), Output::Crc(u64::MAX), None),
    ] {
        let found = of_answer(question, &right, &wrong).map(|(mistake, _)| mistake);
        assert_eq!(found, mistake, "{question} answered with {wrong}");
    }
}
