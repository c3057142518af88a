//! Every golden packet goes through every target, whole and cut at each byte.

use actucheck_fuzz::TARGETS;
use actucheck_spec::Spec;

#[test]
fn golden_packets_pass_every_target() {
    let spec = Spec::embedded().unwrap();
    let frames: Vec<_> = spec.vectors().map(|(_, vector)| vector.frame()).collect();
    assert!(frames.len() > 40, "{} seeds", frames.len());
    for target in &TARGETS {
        for frame in &frames {
            for end in 0..=frame.len() {
                (target.body)(&frame[..end]);
            }
        }
    }
}
