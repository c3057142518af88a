//! The dissector for Wireshark shows what the reference model reads, in every test vector and in
//! damaged ones. Without `tshark` these tests are skipped.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod dynamixel2;
mod innfos;
mod pcap;
mod tshark;

use std::collections::BTreeSet;

use actucheck_spec::model::{Fault, Vector};
use actucheck_spec::wire::{Context, Packet, Wire};
use actucheck_spec::{Spec, export};

fn spec() -> Spec {
    Spec::embedded().unwrap()
}

/// The test vectors of a wire that have bytes: a frame and its context.
fn vectors(spec: &Spec, wire: Wire) -> Vec<(Vec<u8>, Context)> {
    let own = spec.vectors().filter(|(file, _)| file.wire == wire).map(|(_, vector)| vector);
    let frame = |vector: &Vector| (vector.frame().to_vec(), vector.context());
    own.map(frame).filter(|(bytes, _)| !bytes.is_empty()).collect()
}

/// A frame damaged in every way that is one step away: bits, missing and extra bytes. The middle of
/// a long one is all the same.
fn damaged(frame: &[u8]) -> Vec<Vec<u8>> {
    let mut all = Vec::new();
    let ends = |at: &usize| *at < 40 || *at + 6 > frame.len();
    for at in (0..frame.len()).filter(ends) {
        for mask in [0x01, 0x80] {
            let mut flipped = frame.to_vec();
            flipped[at] ^= mask;
            all.push(flipped);
        }
        let mut without = frame.to_vec();
        without.remove(at);
        all.push(without);
        all.push(frame[..at].to_vec());
    }
    all.push([frame, &[0x00]].concat());
    all.push([frame, frame].concat());
    all.retain(|bytes| !bytes.is_empty());
    all
}

/// What a reader that takes the end of the frame from its length says of the first one.
fn first_rule(wire: Wire, bytes: &[u8], context: &Context) -> Result<Packet, Fault> {
    let sizes = (0..=bytes.len()).rev();
    let read = sizes.map(|size| wire.decode(&bytes[..size], context));
    read.into_iter().find(|result| *result != Err(Fault::Trailing)).unwrap()
}

/// Random numbers that are the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % end
    }
}

/// Valid and damaged frames and noise, one after the other.
fn stream(random: &mut Random, frames: &[Vec<u8>], parts: usize) -> Vec<u8> {
    let mut stream = Vec::new();
    for _ in 0..parts {
        let frame = &frames[random.below(frames.len())];
        match random.below(6) {
            0 => {
                let damaged = damaged(frame);
                stream.extend(&damaged[random.below(damaged.len())]);
            }
            1 => {
                let noise = [0xFF, 0xFD, 0x00, 0xEE, 0xED, 0x03];
                stream.extend((0..random.below(9)).map(|_| noise[random.below(noise.len())]));
            }
            _ => stream.extend(frame),
        }
    }
    stream
}

/// The differences between what is expected and what is shown, of which a few are enough.
fn differences<T: PartialEq + std::fmt::Debug>(expected: &[T], shown: &[T]) -> Vec<String> {
    let pairs = expected.iter().zip(shown).enumerate();
    let mut all: Vec<_> = pairs
        .filter(|(_, (expected, shown))| expected != shown)
        .map(|(number, (expected, shown))| format!("{number}:\n  {expected:?}\n  {shown:?}"))
        .take(5)
        .collect();
    if expected.len() != shown.len() {
        all.push(format!("{} expected, {} shown", expected.len(), shown.len()));
    }
    all
}

/// The expert infos of a wire that the script declares.
fn declared_experts(script: &str, wire: Wire) -> BTreeSet<&str> {
    let own = script.split_once(&format!("Proto(\"{wire}\"")).unwrap().1;
    let table = own.split_once("add_experts(proto, {\n").unwrap().1.split_once("\n})").unwrap().0;
    table.lines().map(|line| line.split_once(" = ").unwrap().0.trim()).collect()
}

/// A bug in the script, as the text to replace.
type Planted = (&'static str, &'static str);

/// Plants each bug; one that no difference shows is returned.
fn unnoticed(planted: &[Planted], look: impl Fn(&str) -> Vec<String>) -> Vec<&'static str> {
    let script = export::wireshark::export(&spec());
    let missed = planted.iter().filter(|(right, wrong)| {
        assert!(script.contains(right), "no `{right}` in the script");
        look(&script.replace(right, wrong)).is_empty()
    });
    missed.map(|(_, wrong)| *wrong).collect()
}
