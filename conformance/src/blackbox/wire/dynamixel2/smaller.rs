//! Smaller packets of the same kind.

use actucheck_spec::wire::Target;
use actucheck_spec::wire::dynamixel2::reference::call;
use actucheck_spec::wire::dynamixel2::{Block, Packet};

use crate::blackbox::shrink::{bytes, lower};
use crate::shrink::without;

/// Packets that are smaller or plainer in one way each.
pub(super) fn packets(packet: &Packet) -> Vec<Packet> {
    match packet {
        Packet::Instruction { id, instruction, params } => {
            let of = |id, params: Vec<u8>| Packet::Instruction {
                id,
                instruction: *instruction,
                params: params.into(),
            };
            let mut smaller: Vec<_> =
                instructions(packet).into_iter().map(|params| of(*id, params)).collect();
            smaller.extend((2..253).contains(id).then(|| of(1, params.0.clone())));
            smaller
        }
        Packet::Status { id, error, params } => {
            let of =
                |id, error, params: Vec<u8>| Packet::Status { id, error, params: params.into() };
            let mut smaller: Vec<_> = bytes(params).map(|params| of(*id, *error, params)).collect();
            smaller.extend((*error > 0).then(|| of(*id, 0, params.0.clone())));
            smaller.extend((*id > 1).then(|| of(1, *error, params.0.clone())));
            smaller
        }
        Packet::FastStatus { blocks } => {
            fast_blocks(blocks).into_iter().map(|blocks| Packet::FastStatus { blocks }).collect()
        }
    }
}

/// Fewer devices, less data of each, plainer data and errors.
fn fast_blocks(blocks: &[Block]) -> Vec<Vec<Block>> {
    let mut smaller: Vec<_> = without(blocks).collect();
    let changed = |change: &dyn Fn(&mut Block)| {
        let mut blocks = blocks.to_vec();
        blocks.iter_mut().for_each(change);
        blocks
    };
    let size = blocks.first().map_or(0, |block| block.data.len());
    smaller.extend(lower(size).map(|size| changed(&|block| block.data.0.truncate(size))));
    smaller.push(changed(&|block| block.data.0.fill(0)));
    smaller.push(changed(&|block| block.error = 0));
    // A change of the only block is a change of all of them.
    let each = if blocks.len() > 1 { blocks } else { &[] };
    for (place, block) in each.iter().enumerate() {
        let with = |block| {
            let mut blocks = blocks.to_vec();
            blocks.iter_mut().skip(place).take(1).for_each(|slot| *slot = Block::clone(&block));
            blocks
        };
        if block.error > 0 {
            smaller.push(with(Block { error: 0, ..block.clone() }));
        }
        if block.data.iter().any(|byte| *byte > 0) {
            let data = vec![0; block.data.len()].into();
            smaller.push(with(Block { data, ..block.clone() }));
        }
    }
    smaller.retain(|smaller| smaller != blocks);
    smaller
}

/// Smaller parameters that still fit the instruction.
fn instructions(packet: &Packet) -> Vec<Vec<u8>> {
    let Packet::Instruction { params, .. } = packet else { return Vec::new() };
    let call = call(packet);
    if call.is_general {
        return bytes(params).collect();
    }
    let head: Vec<u8> =
        [call.address, call.length].into_iter().flatten().flat_map(u16::to_le_bytes).collect();
    let mut smaller = Vec::new();
    // Each number in front, on its own.
    for (place, number) in head.chunks_exact(2).enumerate() {
        let number = number.iter().rev().fold(0, |number, byte| number << 8 | usize::from(*byte));
        for lower in lower(number) {
            let mut params = params.0.clone();
            let lower = u16::try_from(lower).unwrap_or_default().to_le_bytes();
            params.iter_mut().skip(2 * place).zip(lower).for_each(|(slot, byte)| *slot = byte);
            smaller.push(params);
        }
    }
    let behind = |rest: Vec<u8>| [head.as_slice(), &rest].concat();
    // The length in front is that of each device's data.
    let headed = |devices: Vec<Target>| {
        let data = devices.first().and_then(|device| device.data.as_ref());
        let size = data.map(|data| u16::try_from(data.len()).unwrap_or_default());
        let length = call.length.and(size);
        let head = [call.address, length].into_iter().flatten().flat_map(u16::to_le_bytes);
        head.chain(rows(&devices)).collect::<Vec<_>>()
    };
    if let Some(data) = &call.data {
        smaller.extend(bytes(data).map(behind));
    }
    if let Some(ids) = &call.ids {
        smaller.extend(without(ids).map(behind));
    }
    if let Some(devices) = &call.devices {
        let smaller_devices = without(devices).chain(plainer(devices));
        smaller.extend(smaller_devices.map(headed));
    }
    smaller
}

/// The parameters of a call for several devices, without what comes before the first of them.
fn rows(devices: &[Target]) -> Vec<u8> {
    let mut params = Vec::new();
    for Target { id, address, length, data, .. } in devices {
        params.push(*id);
        if let Some(address) = address {
            params.extend(address.to_le_bytes());
            let size = data.as_ref().map(|data| u16::try_from(data.len()).unwrap_or_default());
            params.extend(length.or(size).unwrap_or_default().to_le_bytes());
        }
        params.extend(data.iter().flat_map(|data| data.iter()));
    }
    params
}

/// The same number of devices with plainer or less data, and lower addresses and lengths: all of
/// them, and each if they are few.
fn plainer(devices: &[Target]) -> Vec<Vec<Target>> {
    const FEW: usize = 8;
    let mut smaller = Vec::new();
    let mut change = |places: std::ops::Range<usize>| {
        let first = devices.get(places.start).cloned().unwrap_or_default();
        let mut add = |change: &dyn Fn(&mut Target)| {
            let mut devices = devices.to_vec();
            devices.iter_mut().skip(places.start).take(places.len()).for_each(change);
            smaller.push(devices);
        };
        for lower in lower(first.address.unwrap_or_default().into()) {
            add(&|device| device.address = u16::try_from(lower).ok());
        }
        for lower in lower(first.length.unwrap_or_default().into()) {
            add(&|device| device.length = u16::try_from(lower).ok());
        }
        let size = first.data.map_or(0, |data| data.len());
        for size in lower(size) {
            add(&|device| device.data.iter_mut().for_each(|data| data.0.truncate(size)));
        }
        add(&|device| device.data.iter_mut().for_each(|data| data.0.fill(0)));
    };
    change(0..devices.len());
    if (2..=FEW).contains(&devices.len()) {
        (0..devices.len()).for_each(|place| change(place..place + 1));
    }
    smaller.retain(|smaller| smaller != devices);
    smaller
}
