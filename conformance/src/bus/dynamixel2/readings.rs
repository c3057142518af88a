//! What the documents leave unspecified about devices with a control table and their line.

use super::super::readings::readings;

readings! { LineReadings,
    /// What devices do that a Sync Read or a Bulk Read names after one that stays silent.
    after_missing: "after-missing", "dynamixel2.silent-device", AfterMissing {
        /// They answer as if it had.
        #[default]
        Answer: "answer",
        /// They wait for it for ever.
        Silent: "silent",
    },
    /// Whether a packet with a wrong CRC is answered.
    crc_error: "crc-error", "dynamixel2.crc-error.answer", CrcError {
        /// It is not.
        #[default]
        Silent: "silent",
        /// It is, with CRC Error, by who has the ID in it.
        Answer: "answer",
    },
    /// What a second Reg Write before the Action does.
    reg_write_again: "reg-write-again", "dynamixel2.reg-write.again", RegWriteAgain {
        /// It takes the place of the first.
        #[default]
        Replace: "replace",
        /// It is answered with Result Fail.
        Refuse: "refuse",
    },
    /// When the answer to a Factory Reset or a Reboot comes.
    restart_answer: "restart-answer", "dynamixel2.reset.answer", RestartAnswer {
        /// Before the restart, with the old ID.
        #[default]
        Before: "before",
        /// After it, with the new ID.
        After: "after",
    },
    /// What answers a Control Table Backup while torque is on.
    backup_under_torque: "backup-under-torque", "ja40.backup.torque", BackupUnderTorque {
        /// Result Fail.
        #[default]
        ResultFail: "result-fail",
        /// Access Error.
        AccessError: "access-error",
    },
    /// What Clear clears.
    clear: "clear", "ja40.clear.meaning", ClearMeaning {
        /// A fault without parameters, the turns with the option for them.
        #[default]
        AsSent: "as-sent",
        /// A fault, with the option too.
        Fault: "fault",
        /// The turns, without parameters too.
        Turns: "turns",
    },
    /// What a restore brings back.
    restore: "restore", "ja40.backup.restore-contents", Restore {
        /// The EEPROM area and the gains.
        #[default]
        All: "all",
        /// The EEPROM area.
        Eeprom: "eeprom",
    },
    /// Which values a register takes whose range and description differ.
    open_ranges: "open-ranges", "ja40.operating-mode.range", OpenRanges {
        /// Those that are printed or described.
        #[default]
        Described: "described",
        /// Those that are printed in the table.
        Printed: "printed",
    },
    /// What answers a limit outside its own range.
    limit_range: "limit-range", "ja40.invalid-value.error", LimitRange {
        /// Data Range Error.
        #[default]
        DataRangeError: "data-range-error",
        /// Data Limit Error.
        DataLimitError: "data-limit-error",
    },
    /// What torque does on overheating if no register says it.
    overheated: "overheated", "ja40.shutdown.effect", Overheated {
        /// It stays on.
        #[default]
        TorqueOn: "torque-on",
        /// It goes off.
        TorqueOff: "torque-off",
    },
    /// The register that states the time of a movement with a time-based profile.
    movement_time: "movement-time", "ja40.profile.time", MovementTime {
        /// Profile Velocity.
        #[default]
        ProfileVelocity: "profile-velocity",
        /// Profile Time.
        ProfileTime: "profile-time",
    },
    /// The unit of Present Velocity where the document gives it another than every other velocity.
    present_velocity: "present-velocity", "ja40.present-velocity.unit", PresentVelocity {
        /// The printed one.
        #[default]
        Printed: "printed",
        /// That of Velocity Limit.
        AsLimit: "as-limit",
    },
    /// What answers an option that no document lists.
    other_options: "other-options", "dynamixel2.options.others", OtherOptions {
        /// Data Range Error.
        #[default]
        DataRangeError: "data-range-error",
        /// No error.
        NoError: "no-error",
    },
}
