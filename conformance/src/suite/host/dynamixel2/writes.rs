//! Answers to Write that are damaged, missing, of another device, or tell an error.

use super::{all, burst, instruction, refused, status, step, untold};
use crate::adapter::{Burst, Reported};
use crate::suite::check::{Check, Demand};
use crate::suite::{Author, changed};

const FIELDS: &str = "dynamixel2.status-packet.error.fields";

/// What is returned of each.
pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let steps = |answer: Vec<Burst>| {
        let write = instruction(1, 0x03, [0x74, 0x00, 0xA6, 0x01, 0x02, 0x83]);
        vec![step(write, vec![answer.clone(), answer.clone(), answer])]
    };
    let id = |name: &str| format!("dynamixel2.host.write.{name}/result");
    let damaged = changed(&status(1, 0, &[]), 9, |byte| byte ^ 0x10);
    let other = status(2, 0, &[]);
    let mut checks: Vec<_> = [
        ("damaged", "dynamixel2.receive.crc", damaged),
        ("other-device", "dynamixel2.status-packet.parameters", other),
    ]
    .into_iter()
    .map(|(name, requirement, answer)| {
        author.returned(id(name), requirement, steps(vec![burst(answer)]), untold())
    })
    .collect();
    let told = |name: &str, error: u8, told: Reported| {
        author.returned(id(name), FIELDS, steps(vec![burst(status(1, error, &[]))]), refused(told))
    };
    checks.extend((1..=7).map(|number| {
        let reported = Reported { id: 1, error: Some(number), ..Reported::default() };
        told(&format!("error-{number}"), number, reported)
    }));
    let alert = Reported { id: 1, error: Some(4), alert: Some(true), ..Reported::default() };
    checks.push(told("alert-and-error", 0x84, alert));
    let question = "What does a Write return that nothing answers?";
    let silent =
        author.returned(id("silence"), "dynamixel2.write.status", steps(Vec::new()), all([]));
    checks.push(Check { demand: Demand::record(question, []), ..silent });
    checks
}
