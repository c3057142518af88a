//! What the document leaves unspecified about a board and its actuators.

use super::super::readings::readings;

readings! { BoardReadings,
    /// Whether actuators answer a request to address 0 that is not for the board.
    broadcast: "broadcast", "innfos.address.zero", Broadcast {
        /// Each does.
        #[default]
        Answer: "answer",
        /// None does, though they obey.
        Silent: "silent",
    },
    /// The full scale of a speed.
    full_speed: "full-speed", "innfos.speed.full-scale", FullSpeed {
        /// That of the model's motor.
        #[default]
        Model: "model",
        /// 6000 RPM of any motor.
        Same: "6000",
    },
}
