//! Typed instructions against the layouts that are generated from the YAML, the documents'
//! packets, and themselves.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop

use actucheck_codec::EncodeError;
use actucheck_codec::dynamixel2::instruction::{
    Action, BulkRead, BulkWrite, Clear, ControlTableBackup, DeviceData, DeviceRange, DeviceWrite,
    FactoryReset, FastSyncRead, FastSyncWrite, Ping, Read, Reboot, RegWrite, SyncRead, SyncWrite,
    Write,
};
use actucheck_codec::dynamixel2::{
    ClearOption, ControlTableBackupOption, FactoryResetOption, Frame, Instruction, Request,
    RequestError, frame,
};
use actucheck_codec::layout::{self, LayoutError};
use actucheck_spec::Spec;
use actucheck_spec::model::Outcome;
use actucheck_spec::wire::Packet;
use actucheck_spec::wire::dynamixel2::Packet::Instruction as Asks;
use proptest::collection::vec;
use proptest::prelude::*;

/// A field's name and bytes.
type Fields = Vec<(&'static str, Vec<u8>)>;

/// The fields of a typed instruction, named as the YAML names them.
fn fields(request: &Request<'_>) -> Fields {
    let number = |name, value: u16| (name, value.to_le_bytes().to_vec());
    let head = |address, length| vec![number("address", address), number("length", length)];
    let ids = |ids: &[u8]| ids.iter().map(|id| ("id", vec![*id])).collect::<Fields>();
    let blocks = |devices: Vec<DeviceData<'_>>| {
        let block =
            |device: DeviceData<'_>| [("id", vec![device.id]), ("data", device.data.into())];
        devices.into_iter().flat_map(block).collect::<Fields>()
    };
    match request {
        Request::Ping(_)
        | Request::Action(_)
        | Request::Reboot(_)
        | Request::Clear(Clear::Bare) => vec![],
        Request::Read(Read { address, length }) => head(*address, *length),
        Request::Write(Write { address, data }) | Request::RegWrite(RegWrite { address, data }) => {
            vec![number("address", *address), ("data", data.to_vec())]
        }
        Request::FactoryReset(reset) => vec![("option", vec![reset.option.code()])],
        Request::Clear(Clear::Option { option, key }) => {
            vec![("option", vec![option.code()]), ("key", key.to_vec())]
        }
        Request::ControlTableBackup(backup) => {
            vec![("option", vec![backup.option.code()]), ("key", backup.key.to_vec())]
        }
        Request::SyncRead(read) => [head(read.address, read.length), ids(read.ids)].concat(),
        Request::FastSyncRead(read) => [head(read.address, read.length), ids(read.ids)].concat(),
        Request::SyncWrite(write) => {
            let devices = write.devices.clone().collect();
            [head(write.address, write.length), blocks(devices)].concat()
        }
        Request::FastSyncWrite(write) => {
            let devices = write.devices.clone().collect();
            [head(write.address, write.length), blocks(devices)].concat()
        }
        Request::BulkRead(read) => {
            let each = |device: DeviceRange| {
                [vec![("id", vec![device.id])], head(device.address, device.length)].concat()
            };
            read.devices.clone().flat_map(each).collect()
        }
        Request::BulkWrite(write) => {
            let each = |device: DeviceWrite<'_>| {
                let length = u16::try_from(device.data.len()).unwrap();
                let data = vec![("data", device.data.to_vec())];
                [vec![("id", vec![device.id])], head(device.address, length), data].concat()
            };
            write.devices.clone().flat_map(each).collect()
        }
        Request::Unknown { .. } => panic!("{request:?}"),
    }
}

/// The same fields by the layout.
fn layout_fields(instruction: Instruction, params: &[u8]) -> Result<Fields, LayoutError> {
    let layout = instruction.parameters().unwrap();
    let item =
        |item: Result<layout::Item<'_>, _>| item.map(|item| (item.field.name, item.bytes.to_vec()));
    layout::fields(layout, params).map(item).collect()
}

/// Takes `params` apart and puts them together again, and compares with the layout.
fn judge(instruction: Instruction, params: &[u8]) -> Result<(), TestCaseError> {
    let expected = layout_fields(instruction, params);
    let request = match Request::of(instruction, params) {
        Ok(request) => request,
        Err(RequestError::Layout(error)) => {
            prop_assert_eq!(expected, Err(error));
            return Ok(());
        }
        Err(RequestError::Id { found }) => {
            // The ID comes before any other fault.
            prop_assert!(found > 252 && params.contains(&found));
            return Ok(());
        }
        Err(error) => return Err(TestCaseError::fail(format!("{error}"))),
    };
    prop_assert_eq!(request.instruction(), instruction);
    prop_assert_eq!(Ok(fields(&request)), expected);
    let mut buffer = [0; 256];
    let packet = request.encode(254, &mut buffer).unwrap();
    let mut scratch = [0; 256];
    let frame = Frame::parse(packet).unwrap();
    prop_assert_eq!(frame.copy_params(&mut scratch).unwrap(), params);
    prop_assert_eq!(Request::parse(&frame, &mut scratch), Ok(request));
    Ok(())
}

#[test]
fn the_documents_packets_are_read_and_built_again() {
    let spec = Spec::embedded().unwrap();
    let mut seen = Vec::new();
    for (_, vector) in spec.vectors().filter(|(_, vector)| vector.result == Outcome::Valid) {
        let Some(Packet::Dynamixel2(Asks { id, instruction, params })) = &vector.packet else {
            continue;
        };
        let instruction = Instruction::from_code(*instruction);
        if layout_fields(instruction, params).is_err() {
            continue;
        }
        let (mut buffer, mut scratch) = ([0; 512], [0; 512]);
        let frame = Frame::parse(vector.frame()).unwrap();
        let request = Request::parse(&frame, &mut scratch).unwrap();
        assert_eq!(request.encode(*id, &mut buffer).unwrap(), vector.frame(), "{}", vector.id);
        seen.push(instruction.code());
    }
    seen.sort_unstable();
    seen.dedup();
    let all = Instruction::ALL.iter().filter(|instruction| **instruction != Instruction::Status);
    assert_eq!(seen, all.map(|instruction| instruction.code()).collect::<Vec<_>>());
}

#[test]
fn the_keys_are_those_of_the_documents() {
    let spec = Spec::embedded().unwrap();
    let printed = |id: &str| spec.vectors().find(|(_, vector)| vector.id == id).unwrap().1.frame();
    let mut buffer = [0; 32];
    let clear = Clear::MULTI_TURN.encode(1, &mut buffer).unwrap();
    assert_eq!(clear, printed("dynamixel2.clear.instruction"));
    let store = ControlTableBackup::STORE.encode(1, &mut buffer).unwrap();
    assert_eq!(store, printed("ja40.backup.instruction"));
    let restore = ControlTableBackup::RESTORE;
    assert_eq!((restore.option.code(), restore.key), (2, ControlTableBackup::STORE.key));
}

#[test]
fn what_no_device_could_obey_is_refused() {
    let mut buffer = [0; 64];
    let broadcast = SyncRead { address: 580, length: 4, ids: [1, 254] }.encode(&mut buffer);
    assert_eq!(broadcast, Err(EncodeError::Id { found: 254 }));
    let devices = [DeviceData { id: 1, data: &[0; 4] }, DeviceData { id: 2, data: &[0; 3] }];
    let short = FastSyncWrite { address: 564, length: 4, devices }.encode(&mut buffer);
    assert_eq!(short, Err(EncodeError::DataLength { id: 2, found: 3, expected: 4 }));
    let ids: &[u8] = &[1];
    let read = Request::SyncRead(SyncRead { address: 580, length: 4, ids });
    assert_eq!(read.encode(1, &mut buffer), Err(EncodeError::Id { found: 1 }));

    let params = [0x44, 0x02, 0x04, 0x00, 0x01];
    let packet = frame::encode(1, Instruction::SyncRead, &[&params], &mut buffer);
    let frame = Frame::parse(packet.unwrap()).unwrap();
    let not_broadcast = RequestError::NotBroadcast { found: 1 };
    assert_eq!(Request::parse(&frame, &mut [0; 8]), Err(not_broadcast));
    let status = Frame::parse(b"\xFF\xFF\xFD\x00\x01\x04\x00\x55\x00\xA1\x0C").unwrap();
    assert_eq!(Request::parse(&status, &mut [0; 8]), Err(RequestError::Status));
}

/// Parameters that fit many instructions, the pattern of byte stuffing among them.
fn params() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        3 => Just(0xFF_u8), 2 => Just(0xFD), 4 => 0..6_u8, 1 => any::<u8>(),
    ];
    let head = prop_oneof![
        Just(vec![]),
        (any::<u16>(), 0..5_u16).prop_map(|(address, length)| [
            address.to_le_bytes(),
            length.to_le_bytes()
        ]
        .concat()),
    ];
    (head, vec(byte, 0..40)).prop_map(|(head, tail)| [head, tail].concat())
}

fn id() -> impl Strategy<Value = u8> {
    prop_oneof![0..=252_u8, Just(252)]
}

fn data(size: impl Into<prop::collection::SizeRange>) -> impl Strategy<Value = Vec<u8>> {
    vec(prop_oneof![3 => Just(0xFF_u8), 2 => Just(0xFD), 1 => any::<u8>()], size)
}

/// Builds an instruction and reads it: the fields are the same. A buffer one byte too small is an
/// error.
fn round_trip(
    id: u8,
    encode: impl Fn(&mut [u8]) -> Result<&[u8], EncodeError>,
    expected: &Request<'_>,
) -> Result<(), TestCaseError> {
    let (mut buffer, mut scratch) = ([0; 512], [0; 512]);
    let packet = encode(&mut buffer).unwrap();
    let frame = Frame::parse(packet).unwrap();
    prop_assert_eq!(frame.id(), id);
    let request = Request::parse(&frame, &mut scratch).unwrap();
    prop_assert_eq!(&request, expected);

    prop_assert_eq!(request.encoded_len(), Ok(packet.len()));
    prop_assert!(packet.len() <= frame::max_encoded_len(frame.params_len()));
    let (needed, available) = (packet.len(), packet.len() - 1);
    let too_small = EncodeError::Buffer(actucheck_codec::BufferTooSmall { needed, available });
    let mut small = vec![0; available];
    prop_assert_eq!(encode(&mut small), Err(too_small));
    if let Some(available) = frame.params_len().checked_sub(1) {
        let too_small = actucheck_codec::BufferTooSmall { needed: frame.params_len(), available };
        let mut small = vec![0; available];
        let parsed = Request::parse(&frame, &mut small);
        prop_assert_eq!(parsed, Err(RequestError::Buffer(too_small)));
    }
    Ok(())
}

proptest! {
    #[test]
    fn instructions_have_the_fields_of_their_layout(params in params()) {
        for instruction in Instruction::ALL {
            if instruction != Instruction::Status {
                judge(instruction, &params)?;
            }
        }
    }

    #[test]
    fn instructions_to_one_device_come_back(
        id in prop_oneof![id(), Just(254)], address in any::<u16>(), length in any::<u16>(),
        code in any::<u8>(), data in data(0..60), key in any::<[u8; 4]>(),
    ) {
        round_trip(id, |buffer| Ping.encode(id, buffer), &Request::Ping(Ping))?;
        round_trip(id, |buffer| Action.encode(id, buffer), &Request::Action(Action))?;
        round_trip(id, |buffer| Reboot.encode(id, buffer), &Request::Reboot(Reboot))?;
        let read = Read { address, length };
        round_trip(id, |buffer| read.encode(id, buffer), &Request::Read(read))?;
        let write = Write { address, data: &data };
        round_trip(id, |buffer| write.encode(id, buffer), &Request::Write(write))?;
        let write = RegWrite { address, data: &data };
        round_trip(id, |buffer| write.encode(id, buffer), &Request::RegWrite(write))?;
        let reset = FactoryReset { option: FactoryResetOption::from_code(code) };
        round_trip(id, |buffer| reset.encode(id, buffer), &Request::FactoryReset(reset))?;
        let clear = Clear::Option { option: ClearOption::from_code(code), key: &data };
        round_trip(id, |buffer| clear.encode(id, buffer), &Request::Clear(clear))?;
        round_trip(id, |buffer| Clear::Bare.encode(id, buffer), &Request::Clear(Clear::Bare))?;
        let backup = ControlTableBackup { option: ControlTableBackupOption::from_code(code), key };
        round_trip(id, |buffer| backup.encode(id, buffer), &Request::ControlTableBackup(backup))?;
    }

    #[test]
    fn instructions_to_several_devices_come_back(
        address in any::<u16>(), lengths in any::<u16>(), length in 0..6_u16,
        ids in vec(id(), 0..8), bytes in data(48), ranges in vec((id(), any::<u16>(), any::<u16>()), 0..8),
        writes in vec((id(), any::<u16>(), data(0..8)), 0..8),
    ) {
        let ids = ids.as_slice();
        let read = SyncRead { address, length: lengths, ids };
        round_trip(254, |buffer| read.encode(buffer), &Request::SyncRead(read))?;
        let read = FastSyncRead { address, length: lengths, ids };
        round_trip(254, |buffer| read.encode(buffer), &Request::FastSyncRead(read))?;

        let size = usize::from(length);
        let devices: Vec<_> = (0..).zip(ids)
            .map(|(index, id)| DeviceData { id: *id, data: &bytes[index * size..][..size] })
            .collect();
        let devices = devices.as_slice();
        let (mut buffer, mut scratch) = ([0; 512], [0; 512]);
        let write = SyncWrite { address, length, devices };
        let frame = Frame::parse(write.encode(&mut buffer).unwrap()).unwrap();
        let Ok(Request::SyncWrite(back)) = Request::parse(&frame, &mut scratch) else { panic!() };
        prop_assert_eq!((back.address, back.length), (address, length));
        prop_assert_eq!(back.devices.clone().collect::<Vec<_>>(), devices);
        round_trip(254, |buffer| write.encode(buffer), &Request::SyncWrite(back.clone()))?;
        let write = FastSyncWrite { address, length, devices };
        let back = FastSyncWrite { address, length, devices: back.devices };
        round_trip(254, |buffer| write.encode(buffer), &Request::FastSyncWrite(back))?;

        let devices: Vec<_> = ranges.iter()
            .map(|(id, address, length)| DeviceRange { id: *id, address: *address, length: *length })
            .collect();
        let read = BulkRead { devices: devices.as_slice() };
        let frame = Frame::parse(read.encode(&mut buffer).unwrap()).unwrap();
        let Ok(Request::BulkRead(back)) = Request::parse(&frame, &mut scratch) else { panic!() };
        prop_assert_eq!(back.devices.clone().collect::<Vec<_>>(), devices.clone());
        round_trip(254, |buffer| read.encode(buffer), &Request::BulkRead(back))?;

        let devices: Vec<_> = writes.iter()
            .map(|(id, address, data)| DeviceWrite { id: *id, address: *address, data })
            .collect();
        let write = BulkWrite { devices: devices.as_slice() };
        let frame = Frame::parse(write.encode(&mut buffer).unwrap()).unwrap();
        let Ok(Request::BulkWrite(back)) = Request::parse(&frame, &mut scratch) else { panic!() };
        prop_assert_eq!(back.devices.clone().collect::<Vec<_>>(), devices.clone());
        round_trip(254, |buffer| write.encode(buffer), &Request::BulkWrite(back))?;
    }

    #[test]
    fn unknown_instructions_keep_their_bytes(code in any::<u8>(), params in data(0..40)) {
        let instruction = Instruction::from_code(code);
        prop_assume!(matches!(instruction, Instruction::Unknown(_)));
        let unknown = Request::Unknown { code, params: &params };
        prop_assert_eq!(Request::of(instruction, &params), Ok(unknown.clone()));
        round_trip(7, |buffer| unknown.encode(7, buffer), &unknown)?;
    }
}
