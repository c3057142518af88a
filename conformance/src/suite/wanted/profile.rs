//! What a device does where nothing is demanded, in a few words.

use actucheck_spec::model::HexBytes;

use super::{Told, all_told};
use crate::adapter::{Asked, Heard, Pause, Question, Reported};

/// What most answers to a write are.
const DONE: &str = "answers without an error";

/// What a device does in the first step, what is unusual in those after it, and what a register holds at the end that
/// was written.
pub(in crate::suite) fn behaviour(question: &Question, heard: &[Heard]) -> String {
    let Question::Device { wire, steps, .. } = question else { return String::new() };
    let told = all_told(*wire, steps, heard);
    let words = steps.iter().zip(told).enumerate().filter_map(|(place, (asked, told))| {
        let before = steps.get(..place).unwrap_or_default();
        let held = held(before, asked, &told).map(|held| format!("then holds {held}"));
        held.or_else(|| Some(in_words(asked, told)).filter(|words| place == 0 || words != DONE))
    });
    words.collect::<Vec<_>>().join("; ")
}

fn in_words(asked: &Asked, mut told: Told) -> String {
    // The last piece asks only whether the device is still there.
    if asked.send.iter().skip(1).any(|piece| piece.after == Pause::Answer)
        && told.answers.pop().is_none()
    {
        return "hears nothing more".to_owned();
    }
    let words = |answer: &Reported| match (answer.error, &answer.data) {
        (Some(error), _) if error > 0 => format!("answers error {error}"),
        (_, Some(data)) if data.len() == 1 => "answers 1 byte".to_owned(),
        (_, Some(data)) if !data.is_empty() => format!("answers {} bytes", data.len()),
        _ => DONE.to_owned(),
    };
    let mut all: Vec<_> = told.answers.iter().map(words).collect();
    if told.stray > 0 {
        all.push("sends what is no packet".to_owned());
    }
    if all.is_empty() { "stays silent".to_owned() } else { all.join(", then ") }
}

/// How much of what was written before is read in this step; `None` if it reads nothing of that.
fn held(before: &[Asked], asked: &Asked, told: &Told) -> Option<String> {
    let [answer] = told.answers.as_slice() else { return None };
    let data = answer.data.as_ref().filter(|data| !data.is_empty())?;
    let address = asked.packet.as_ref()?.call.as_ref()?.address?;
    let writes: Vec<_> = before.iter().filter_map(|asked| written_to(asked, address)).collect();
    Some(match writes.as_slice() {
        [] => return None,
        [one] => how_much(&one.0, &data.0),
        [first, .., last] if first != last && last.0 == data.0 => {
            "what was written last".to_owned()
        }
        [first, ..] if first.0 == data.0 => "what was written first".to_owned(),
        [.., last] => how_much(&last.0, &data.0),
    })
}

/// What a step writes to an address.
fn written_to(asked: &Asked, address: u16) -> Option<&HexBytes> {
    let call = asked.packet.as_ref()?.call.as_ref()?;
    call.data.as_ref().filter(|_| call.address == Some(address))
}

fn how_much(written: &[u8], held: &[u8]) -> String {
    // Later ones may be the same by chance.
    let count = written.iter().zip(held).take_while(|(one, other)| one == other).count();
    match written.len() {
        all if all == count && held.len() == all => "what was written".to_owned(),
        _ if count == 0 => "other bytes than were written".to_owned(),
        all => format!("the first {count} of {all} bytes that were written"),
    }
}
