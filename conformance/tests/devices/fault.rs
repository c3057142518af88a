//! A fault of firmware.

/// Makes what is answered of what was asked and the right answer.
pub(crate) type Answers = fn(&[u8], Vec<u8>) -> Vec<u8>;

/// A fault: what it changes of what the device hears, or of what it answers.
#[derive(Clone, Copy)]
pub(crate) struct Fault {
    pub(crate) name: &'static str,
    /// What the device does, in words.
    pub(crate) does: &'static str,
    /// The devices on the line; the first is checked.
    pub(crate) devices: &'static str,
    /// The check that must fail.
    pub(crate) found_by: &'static str,
    /// Makes what the devices hear of what was sent at once.
    pub(crate) hears: Option<fn(Vec<u8>) -> Vec<u8>>,
    /// Makes what they answer of that.
    pub(crate) answers: Option<Answers>,
}

impl Fault {
    /// The id of the check that must fail.
    pub(crate) fn check(&self) -> String {
        format!("{}.device.{}", self.wire(), self.found_by)
    }

    /// The wire of its devices.
    pub(crate) fn wire(&self) -> &'static str {
        if self.devices.starts_with("dd-") { "innfos" } else { "dynamixel2" }
    }
}

/// A device that hears wrong.
pub(crate) const fn hearing(
    name: &'static str,
    does: &'static str,
    found_by: &'static str,
    hears: fn(Vec<u8>) -> Vec<u8>,
) -> Fault {
    Fault { name, does, devices: "ja40@1", found_by, hears: Some(hears), answers: None }
}

/// A device that answers wrong.
pub(crate) const fn answering(
    name: &'static str,
    does: &'static str,
    found_by: &'static str,
    answers: Answers,
) -> Fault {
    Fault { name, does, devices: "ja40@1", found_by, hears: None, answers: Some(answers) }
}

/// The same fault of other devices.
pub(crate) const fn on(devices: &'static str, fault: Fault) -> Fault {
    Fault { devices, ..fault }
}
