//! A Factory Reset of the ID or the rate too. It is sent only to a device whose ID and rate are already those with
//! which it leaves the factory, so that it is found again.

use actucheck_spec::model::{Area, Register};
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;

use super::effects::CLEARS_SINCE;
use super::restart::{back, initial};
use super::writable::{bytes, lasting};
use super::written::Step;
use super::{Talk, code, instruction, named};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::Check;

/// Options of Factory Reset: everything, and all but the ID.
const ALL: u8 = 0xFF;
const KEEP_ID: u8 = 0x01;

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let all = [whole(talk), but_the_id(talk), for_all(talk)];
    all.into_iter().flatten().filter(|_| talk.knows("Factory Reset")).collect()
}

/// What every such check needs.
fn needs() -> Permissions {
    Permissions::from([Permission::Eeprom, Permission::Reset])
}

/// Everything is set back.
fn whole(talk: &Talk<'_>) -> Option<Check> {
    let mut steps = vec![as_from_the_factory(talk, "ID")?, as_from_the_factory(talk, "Baud Rate")?];
    steps.extend(reset(talk, ALL)?);
    steps.extend(initial(talk, |register| register.area == Area::Eeprom));
    Some(talk.demands(needs(), named("reset.all/initial-values"), &["factory-reset.all"], steps))
}

/// Everything but the ID.
fn but_the_id(talk: &Talk<'_>) -> Option<Check> {
    let mut steps = vec![as_from_the_factory(talk, "Baud Rate")?];
    steps.extend(reset(talk, KEEP_ID)?);
    let is_reset = |register: &Register| register.area == Area::Eeprom && register.name != "ID";
    steps.extend(initial(talk, is_reset));
    let id = talk.register("ID")?;
    steps.push(talk.holds(id.address, vec![talk.id()]));
    let rows = ["factory-reset.keep-id"];
    Some(talk.demands(needs(), named("reset.keep-id/initial-values"), &rows, steps))
}

/// A reset of everything that goes to all devices is not carried out. It is sent where no other device could.
fn for_all(talk: &Talk<'_>) -> Option<Check> {
    let one = lasting(talk).filter(|_| talk.target.present == [talk.id()])?;
    let own = format!("{}.factory-reset.broadcast-all", talk.document()?);
    talk.author.spec.requirement(&own)?;
    let mut steps = vec![as_from_the_factory(talk, "ID")?, as_from_the_factory(talk, "Baud Rate")?];
    // The DYNAMIXEL document has it of certain firmware.
    if talk.document() == Some(super::WIRE.id()) {
        let firmware = talk.register("Firmware Version")?;
        let newer = (CLEARS_SINCE..=255).collect();
        steps.push(talk.given(firmware, "firmware 42 or newer", (0, 8), newer));
    }
    let other = bytes(one.register, one.other());
    let packet = instruction(BROADCAST, code::FACTORY_RESET, vec![ALL]);
    steps.extend([
        talk.sets(one.register.address, &other),
        talk.silent_at(packet),
        back(talk),
        talk.holds(one.register.address, other),
    ]);
    let rows = ["factory-reset.broadcast-all"];
    Some(talk.demands(needs(), named("reset.broadcast-all/nothing"), &rows, steps))
}

/// A register that must hold what it holds when the device leaves the factory.
fn as_from_the_factory(talk: &Talk<'_>, name: &str) -> Option<Step> {
    let register = talk.register(name)?;
    let value = u64::try_from(register.initial?).ok()?;
    Some(talk.given(register, &format!("the {name} {value} of the factory"), (0, 8), vec![value]))
}

/// A register that is changed, and a reset.
fn reset(talk: &Talk<'_>, option: u8) -> Option<[Step; 3]> {
    let one = lasting(talk)?;
    let reset = instruction(talk.id(), code::FACTORY_RESET, vec![option]);
    let set = talk.sets(one.register.address, &bytes(one.register, one.other()));
    Some([set, talk.done_by(reset), back(talk)])
}
