//! What is peculiar to a wire, in a folder a wire.

pub mod dynamixel2;
pub mod innfos;
