//! The facts of a device that do not change: its control table, and the registers with a role.

use std::ops;

use actucheck_codec::register::{Access, Bound, Device, Range, Row};
use actucheck_spec::model;

use super::indirect::Indirect;
use super::readings::LineReadings;

/// Counts in a turn of a device whose file does not tell them.
const COUNTS_PER_TURN: u32 = 4096;

/// What a device is, shared by all devices that are the same.
#[derive(Debug)]
pub(super) struct Model {
    pub(super) table: &'static Device,
    /// What is done where the documents leave something unspecified.
    pub(super) readings: LineReadings,
    /// Counts of the position registers in a turn.
    pub(super) counts_per_turn: f64,
    /// The registers of the RAM area that a backup has.
    pub(super) backup: Vec<&'static Row>,
    /// Bits of Hardware Error Status, and when they are set.
    pub(super) alarms: Vec<Watch>,
    pub(super) roles: Roles,
    /// The registers whose range depends on other registers.
    pub(super) bounded: Vec<&'static Row>,
    pub(super) indirect: Indirect,
    /// Whether there is a register at an address.
    taken: Vec<bool>,
}

/// A bit that is set when a register passes a limit.
#[derive(Debug)]
pub(super) struct Watch {
    /// The bit's value.
    pub(super) bit: i64,
    pub(super) watched: &'static Row,
    pub(super) below: Option<&'static Row>,
    pub(super) above: Option<&'static Row>,
    /// What must hold beside that.
    pub(super) when: Option<When>,
}

/// A condition on some bits of a register.
#[derive(Debug)]
pub(super) struct When {
    pub(super) row: &'static Row,
    lowest: u8,
    mask: i64,
    one_of: Vec<i64>,
}

impl When {
    fn new(table: &Device, written: &model::Condition) -> Option<Self> {
        let row = table.register_named(&written.register)?;
        let (lowest, mask) = match &written.bits {
            Some(name) => {
                let bits = row.bits.iter().find(|bits| bits.name == name)?;
                (bits.lowest, mask(0, bits.width))
            }
            None => (0, -1),
        };
        Some(Self { row, lowest, mask, one_of: written.one_of.clone() })
    }

    /// Whether it holds for this value of the register.
    pub(super) fn holds(&self, value: i64) -> bool {
        let bits = value.checked_shr(self.lowest.into()).unwrap_or_default() & self.mask;
        self.one_of.contains(&bits)
    }
}

/// Defines the registers with a role by their names.
macro_rules! roles {
    ($($field:ident: $name:literal,)*) => {
        /// The registers that the device itself reads or writes, where it has them.
        #[derive(Debug)]
        pub(super) struct Roles {
            $(pub(super) $field: Option<&'static Row>,)*
        }

        impl Roles {
            fn of(table: &Device) -> Self {
                Self { $($field: table.register_named($name),)* }
            }
        }
    };
}

roles! {
    model_number: "Model Number",
    firmware_version: "Firmware Version",
    id: "ID",
    baud_rate: "Baud Rate",
    return_delay_time: "Return Delay Time",
    status_return_level: "Status Return Level",
    registered_instruction: "Registered Instruction",
    backup_ready: "Backup Ready",
    hardware_error_status: "Hardware Error Status",
    shutdown: "Shutdown",
    torque_enable: "Torque Enable",
    operating_mode: "Operating Mode",
    drive_mode: "Drive Mode",
    homing_offset: "Homing Offset",
    max_voltage_limit: "Max Voltage Limit",
    min_voltage_limit: "Min Voltage Limit",
    min_position_limit: "Min Position Limit",
    current_limit: "Current Limit",
    velocity_limit: "Velocity Limit",
    pwm_limit: "PWM Limit",
    movement_duration: "Movement Duration",
    profile_time: "Profile Time",
    profile_acceleration: "Profile Acceleration",
    profile_velocity: "Profile Velocity",
    goal_pwm: "Goal PWM",
    goal_current: "Goal Current",
    goal_velocity: "Goal Velocity",
    goal_position: "Goal Position",
    realtime_tick: "Realtime Tick",
    moving: "Moving",
    moving_status: "Moving Status",
    present_pwm: "Present PWM",
    present_current: "Present Current",
    present_velocity: "Present Velocity",
    present_position: "Present Position",
    velocity_trajectory: "Velocity Trajectory",
    position_trajectory: "Position Trajectory",
    present_input_voltage: "Present Input Voltage",
    present_temperature: "Present Temperature",
}

impl Model {
    /// The device with this table, which `written` has as the spec or the user's file has it.
    pub(super) fn new(
        table: &'static Device,
        written: &model::Device,
        readings: LineReadings,
    ) -> Self {
        let named = |name: &String| table.register_named(name);
        let watch = |alarm: &model::Alarm| {
            let status = table.register_named("Hardware Error Status")?;
            let bit = status.bits.iter().find(|bits| bits.name == alarm.bit)?;
            let when = match &alarm.when {
                Some(when) => Some(When::new(table, when)?),
                None => None,
            };
            Some(Watch {
                bit: 1_i64.checked_shl(bit.lowest.into())?,
                watched: named(&alarm.register)?,
                below: alarm.below.as_ref().and_then(named),
                above: alarm.above.as_ref().and_then(named),
                when,
            })
        };
        let end = table.registers.iter().map(|row| end(row)).max().unwrap_or_default();
        let mut taken = vec![false; end];
        for row in table.registers {
            let place = usize::from(row.address)..self::end(row);
            taken.get_mut(place).unwrap_or_default().fill(true);
        }
        Self {
            table,
            readings,
            counts_per_turn: written.counts_per_turn.unwrap_or(COUNTS_PER_TURN).into(),
            backup: written.backup.iter().filter_map(named).collect(),
            alarms: written.alarms.iter().filter_map(watch).collect(),
            roles: Roles::of(table),
            bounded: table.registers.iter().copied().filter(|row| is_bounded(row)).collect(),
            indirect: Indirect::of(table),
            taken,
        }
    }

    /// The size of the control table.
    pub(super) const fn size(&self) -> usize {
        self.taken.len()
    }

    /// Whether there is a register at each of these addresses.
    pub(super) fn has(&self, addresses: ops::Range<usize>) -> bool {
        self.taken.get(addresses).is_some_and(|taken| !taken.contains(&false))
    }

    /// The registers that have a byte at one of these addresses.
    pub(super) fn rows(&self, addresses: &ops::Range<usize>) -> &'static [&'static Row] {
        let registers = self.table.registers;
        let first = registers.partition_point(|row| end(row) <= addresses.start);
        let last = registers.partition_point(|row| usize::from(row.address) < addresses.end);
        registers.get(first..last).unwrap_or_default()
    }
}

/// Whether hosts write it, within a range that depends on other registers.
fn is_bounded(row: &Row) -> bool {
    let is_register = |bound: Bound| matches!(bound, Bound::Register { .. });
    let refers = matches!(row.range, Range::Between { min, max }
        if is_register(min) || is_register(max));
    row.settled && row.access == Access::ReadWrite && (refers || !row.meanings.is_empty())
}

/// `width` ones from the bit `lowest` on.
pub(super) fn mask(lowest: u8, width: u8) -> i64 {
    let ones = 1_i64.checked_shl(width.into()).map_or(-1, |end| end - 1);
    ones.checked_shl(lowest.into()).unwrap_or_default()
}

/// The address after a register's last byte.
pub(super) fn end(row: &Row) -> usize {
    usize::from(row.address) + usize::from(row.kind.size())
}
