//! What a call of a host must return, and the judgement of a conversation.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::check::Demand;
use super::host;
use crate::adapter::{CallError, Course, Question, Reported, Returned, Step, Trouble};
use crate::verdict::Verdict;

/// How often a call may send its packet that is answered right.
const ASKED: usize = 4;
/// The size in bytes up to which every library should send packets.
const LONG: usize = 128;

/// What a call must return.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Due {
    /// What may be returned, and nothing else. If it is absent, the call must fail.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub devices: Option<Vec<Reported>>,
    /// Whether it may be a part of that. What says nothing but who answered may be missing anyway.
    #[serde(default)]
    pub partly: bool,
    /// The errors that are right as well. Another one gets a warning, one without a reason does not. If
    /// there are none, the call must not fail.
    #[serde(default)]
    pub or: Vec<Trouble>,
}

/// In words: `device 1: data a6000000, or an error (corrupt)`.
impl fmt::Display for Due {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = if self.partly { "some of " } else { "" };
        let devices = self.devices.as_ref();
        let devices =
            devices.map(|devices| format!("{part}{}", Returned::Devices(devices.clone())));
        let or: Vec<_> = self.or.iter().map(ToString::to_string).collect();
        let error = (!or.is_empty()).then(|| format!("an error ({})", or.join(" or ")));
        let all: Vec<_> = devices.into_iter().chain(error).collect();
        f.write_str(&all.join(", or "))
    }
}

/// The verdict on a conversation, of which the last call is judged, and the reason.
pub(super) fn judge(question: &Question, demand: &Demand, courses: &[Course]) -> (Verdict, String) {
    let Question::Converse { wire, steps } = question else { return unjudged() };
    let (Some(Step { packet, .. }), Some(course)) = (steps.last(), courses.last()) else {
        return unjudged();
    };
    let frame = wire.encode(&packet.packet).unwrap_or_default();
    let sent = host::sent(*wire, &frame, course);
    let (verdict, detail) = judge_last(demand, course, &frame, &sent);
    // A busy machine may be why nothing was heard, or why an answer came too late.
    let by_time = sent.is_empty() || matches!(demand, Demand::Return(_)) && holds(&sent, &frame);
    let was_late = courses.iter().any(|course| course.late);
    if was_late && by_time && matches!(verdict, Verdict::Fail | Verdict::Warn) {
        let busy = "the machine was too busy for the line; ask it again when it is less busy";
        return (Verdict::NotRun, format!("{busy} ({detail})"));
    }
    (verdict, detail)
}

/// Whether a frame is in these bytes.
fn holds(bytes: &[u8], frame: &[u8]) -> bool {
    bytes.windows(frame.len().max(1)).any(|part| part == frame)
}

fn judge_last(demand: &Demand, course: &Course, frame: &[u8], sent: &[u8]) -> (Verdict, String) {
    let is_refused =
        matches!(&course.returned, Returned::Err(error) if error.class == Trouble::Refused);
    match demand {
        // A library may have a limit, which it must not exceed.
        Demand::Send if sent.is_empty() && is_refused && frame.len() > LONG => {
            (Verdict::Skip, format!("the library refuses a packet of {} bytes", frame.len()))
        }
        Demand::Send if sent.is_empty() => fail("the call sends nothing"),
        // A host that is not content with the answer may ask again.
        Demand::Send
            if course.more == 0
                && sent.len() <= ASKED * frame.len()
                && sent.chunks(frame.len().max(1)).all(|chunk| chunk == frame) =>
        {
            (Verdict::Pass, String::new())
        }
        // There is no such packet, as its length would be too long.
        Demand::Withhold if frame.is_empty() && !sent.is_empty() => {
            fail("sends bytes of a packet that is longer than its length can say")
        }
        Demand::Withhold if holds(sent, frame) => fail(format!("sends {}", packet_of(frame))),
        Demand::Withhold => (Verdict::Pass, String::new()),
        Demand::Send => fail(format!("the call must send {}", packet_of(frame))),
        Demand::Return(_) if !holds(sent, frame) => {
            fail(format!("nothing answers, as the call does not send {}", packet_of(frame)))
        }
        Demand::Return(due) => due.judge(&course.returned),
        _ => unjudged(),
    }
}

fn packet_of(frame: &[u8]) -> actucheck_spec::model::HexBytes {
    frame.to_vec().into()
}

fn fail(detail: impl Into<String>) -> (Verdict, String) {
    (Verdict::Fail, detail.into())
}

/// A file of checks may have anything in it.
fn unjudged() -> (Verdict, String) {
    (Verdict::NotRun, "the demand is not one on a conversation".to_owned())
}

impl Due {
    fn judge(&self, returned: &Returned) -> (Verdict, String) {
        match returned {
            Returned::Err(_) if self.or.is_empty() => {
                fail(format!("returned {returned}, but must return {self}"))
            }
            Returned::Err(CallError { class, .. })
                if *class == Trouble::Unspecified || self.or.contains(class) =>
            {
                (Verdict::Pass, String::new())
            }
            Returned::Err(CallError { class, .. }) => {
                (Verdict::Warn, format!("failed as {class}, but must return {self}"))
            }
            Returned::Devices(devices) => match &self.devices {
                None => fail(format!("returned {returned}, but must return {self}")),
                Some(due) => self.judge_devices(devices, due),
            },
        }
    }

    fn judge_devices(&self, returned: &[Reported], due: &[Reported]) -> (Verdict, String) {
        let is_right = |reported: &&Reported| due.iter().any(|device| reported.fits(device));
        let is_there = |device: &&Reported| {
            let bare = Reported { id: device.id, ..Reported::default() };
            **device == bare || returned.iter().any(|reported| reported.fits(device))
        };
        let wrong = returned.iter().find(|reported| !is_right(reported));
        let missing = due.iter().find(|device| !is_there(device));
        match (wrong, missing) {
            (Some(wrong), _) => fail(format!("returned {wrong}, but must return {self}")),
            (None, Some(missing)) if !self.partly => {
                fail(format!("{missing} is missing; it must return {self}"))
            }
            _ => (Verdict::Pass, String::new()),
        }
    }
}
