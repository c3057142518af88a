//! DYNAMIXEL Protocol 2.0 and its JA dialect.

pub mod reference;
