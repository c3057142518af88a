//! Faults of Control Table Backup, and of a Factory Reset of everything.

use std::sync::atomic::{AtomicBool, Ordering};

use super::change::{each, failed, is, read_of, tells, with_params};
use super::code::{BACKUP, FACTORY_RESET, REBOOT};
use super::fault::{Fault, answering, hearing};
use super::rewrite::{changed, packet};

const TORQUE_ENABLE: u16 = 512;
const PWM_LIMIT: (u16, u16) = (36, 2);
const BACKUP_READY: (u16, u16) = (878, 1);

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering(
        "backup-with-data",
        "answers Control Table Backup with a byte",
        "backup.status/answer",
        |asked, answer| {
            if is(asked, BACKUP) { each(answer, |_, _, data| data.push(0)) } else { answer }
        },
    ),
    answering(
        "backup-wants-another-key",
        "answers the key of Control Table Backup with Data Range Error",
        "backup.parameters/answer",
        |asked, answer| failed(asked, answer, BACKUP, 4),
    ),
    answering(
        "backup-not-told",
        "shows no backup in Backup Ready",
        "backup.store/ready",
        |asked, answer| tells(asked, answer, BACKUP_READY, 0),
    ),
    hearing(
        "backup-never-restored",
        "stores a backup where it must restore one",
        "backup.restore/eeprom",
        |heard| with_params(heard, BACKUP, |params| params[0] = 1),
    ),
    answering(
        "backup-of-some-registers",
        "does not restore PWM Limit",
        "backup.contents/eeprom",
        |asked, answer| {
            static IS_RESTORED: AtomicBool = AtomicBool::new(false);
            if has_option(asked, BACKUP, 2) {
                IS_RESTORED.store(true, Ordering::Relaxed);
            }
            let is_it = read_of(asked) == Some(PWM_LIMIT);
            if is_it && IS_RESTORED.swap(false, Ordering::Relaxed) {
                each(answer, |_, _, data| data[0] ^= 1)
            } else {
                answer
            }
        },
    ),
    hearing(
        "backup-under-torque",
        "stores a backup while torque is on",
        "backup.torque-on/nothing",
        // What has no torque stores it.
        |heard| changed(heard, TORQUE_ENABLE, |data| data.fill(0)),
    ),
    hearing(
        "reset-of-nothing",
        "only restarts at a Factory Reset of everything",
        "reset.all/initial-values",
        |heard| restarts(heard, 0xFF),
    ),
    hearing(
        "reset-but-id-of-nothing",
        "only restarts at a Factory Reset of all but the ID",
        "reset.keep-id/initial-values",
        |heard| restarts(heard, 0x01),
    ),
    hearing(
        "reset-for-all",
        "carries out a Factory Reset of everything that goes to all devices",
        "reset.broadcast-all/nothing",
        |heard| {
            let is_for_all = heard.get(4) == Some(&0xFE) && has_option(&heard, FACTORY_RESET, 0xFF);
            if is_for_all { packet(FACTORY_RESET, &[0xFF]) } else { heard }
        },
    ),
];

/// Whether this is an instruction with an option.
fn has_option(asked: &[u8], code: u8, option: u8) -> bool {
    is(asked, code) && asked.get(8) == Some(&option)
}

/// Takes a Factory Reset with an option for a Reboot.
fn restarts(heard: Vec<u8>, option: u8) -> Vec<u8> {
    let is_for_it = heard.get(4) == Some(&1) && has_option(&heard, FACTORY_RESET, option);
    if is_for_it { packet(REBOOT, &[]) } else { heard }
}
