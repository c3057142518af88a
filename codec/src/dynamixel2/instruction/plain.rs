//! Instructions without parameters.

use super::addressed;

macro_rules! plain {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl $name {
            #[allow(clippy::unused_self)] // as the instructions that have some
            fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
                encode(&[])
            }
        }

        addressed!($name);
    };
}

plain! {
    /// Asks whether a device is present; [`PingStatus`](crate::dynamixel2::status::PingStatus) is
    /// the answer (DYNAMIXEL Protocol 2.0, Ping; JA40 document, §1.6.1).
    Ping
}

plain! {
    /// Carries out the write that a [`RegWrite`](super::RegWrite) registered (DYNAMIXEL Protocol
    /// 2.0, Action).
    Action
}

plain! {
    /// Reboots (DYNAMIXEL Protocol 2.0, Reboot; JA40 document, §1.6.5).
    Reboot
}
