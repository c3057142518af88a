// Generated from YAML.

/// Wire.
pub mod dynamixel2 {
    use crate::layout::{Field, Size};
    use crate::register::NamedValue;
    /// The first bytes of every packet, including the reserved byte.
    ///
    /// book §1.
    pub const HEADER: [u8; 4usize] = [0xFF, 0xFF, 0xFD, 0x00];
    /// The smallest ID that a device may have.
    pub const MIN_ID: u8 = 0x00;
    /// The largest ID that a device may have.
    pub const MAX_ID: u8 = 0xFC;
    /// The ID that every device obeys.
    pub const BROADCAST_ID: u8 = 0xFE;
    /// Bytes of the length field, which counts instruction to CRC.
    ///
    /// book §1.
    pub const LENGTH_SIZE: usize = 2usize;
    /// Whether the length field's low byte comes first.
    pub const LENGTH_LOW_BYTE_FIRST: bool = true;
    /// The smallest length that a packet may have.
    pub const MIN_LENGTH: u16 = 3u16;
    /// The bytes after which a body always has [`STUFFING_BYTE`].
    ///
    /// book §1.
    pub const STUFFING_PATTERN: [u8; 3usize] = [0xFF, 0xFF, 0xFD];
    /// The byte that stuffing inserts after [`STUFFING_PATTERN`].
    pub const STUFFING_BYTE: u8 = 0xFD;
    /// The polynomial of CRC-16/UMTS, highest power in the highest bit.
    ///
    /// book §1.
    pub const CRC_POLYNOMIAL: u16 = 0x8005;
    /// The CRC's value before the first byte.
    pub const CRC_INITIAL: u16 = 0x0000;
    /// Whether the CRC takes and gives the lowest bit of a byte first.
    pub const CRC_REFLECTED: bool = false;
    /// The value that is xored with the CRC's last value.
    pub const CRC_FINAL_XOR: u16 = 0x0000;
    /// The CRC of the nine ASCII characters `123456789`.
    pub const CRC_CHECK: u16 = 0xFEE8;
    /// Whether the CRC's low byte comes first on the wire.
    pub const CRC_LOW_BYTE_FIRST: bool = true;
    /// The bit of a status packet's error byte that signals a hardware error.
    ///
    /// book §1.
    pub const ALERT_BIT: u8 = 0x80;
    /// The instruction of a packet.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Instruction {
        /** `0x01`: Asks.

 book §1.*/
        Ping,
        /** `0x55`: What a device answers.

 book §1.*/
        Status,
        /// A byte without a name in the documents.
        Unknown(u8),
    }
    impl Instruction {
        /// Every named one, by ascending code.
        pub const ALL: [Self; 2usize] = [Self::Ping, Self::Status];
        /// The value with this byte.
        #[must_use]
        pub const fn from_code(code: u8) -> Self {
            match code {
                0x01 => Self::Ping,
                0x55 => Self::Status,
                code => Self::Unknown(code),
            }
        }
        /// The byte on the wire.
        #[must_use]
        pub const fn code(self) -> u8 {
            match self {
                Self::Ping => 0x01,
                Self::Status => 0x55,
                Self::Unknown(code) => code,
            }
        }
        /// Its name in the documents, or `unknown`.
        #[must_use]
        pub const fn name(self) -> &'static str {
            match self {
                Self::Ping => "Ping",
                Self::Status => "Status",
                Self::Unknown(_) => "unknown",
            }
        }
    }
    impl Instruction {
        /// Layout of the parameters of an instruction packet; `None` for
        /// [`Instruction::Status`] and for an unknown one.
        #[must_use]
        pub const fn parameters(self) -> Option<&'static [Field]> {
            match self {
                Self::Ping => Some(&[]),
                _ => None,
            }
        }
        /// Layout of the parameters of a device's status packet; `None` if a device sends no
        /// status packet of its own.
        #[must_use]
        pub const fn status(self) -> Option<&'static [Field]> {
            match self {
                Self::Ping => Some(&[]),
                _ => None,
            }
        }
        /// Layout of one device's block in a fast status packet; `None` if the answer is not
        /// one.
        #[must_use]
        pub const fn fast_status(self) -> Option<&'static [Field]> {
            match self {
                _ => None,
            }
        }
        /// Whether it may be sent to the broadcast ID only.
        #[must_use]
        pub const fn broadcast_only(self) -> bool {
            matches!(self,)
        }
        /// Whether devices answer it when it is sent to the broadcast ID.
        #[must_use]
        pub const fn answers_broadcast(self) -> bool {
            matches!(self,)
        }
    }
    /// The result of an instruction: a status packet's error byte without the alert bit.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum ErrorNumber {
        /// `0x00`: The instruction was carried out.
        None,
        /// `0x01`: It failed.
        ResultFail,
        /// A byte without a name in the documents.
        Unknown(u8),
    }
    impl ErrorNumber {
        /// Every named one, by ascending code.
        pub const ALL: [Self; 2usize] = [Self::None, Self::ResultFail];
        /// The value with this byte.
        #[must_use]
        pub const fn from_code(code: u8) -> Self {
            match code {
                0x00 => Self::None,
                0x01 => Self::ResultFail,
                code => Self::Unknown(code),
            }
        }
        /// The byte on the wire.
        #[must_use]
        pub const fn code(self) -> u8 {
            match self {
                Self::None => 0x00,
                Self::ResultFail => 0x01,
                Self::Unknown(code) => code,
            }
        }
        /// Its name in the documents, or `unknown`.
        #[must_use]
        pub const fn name(self) -> &'static str {
            match self {
                Self::None => "None",
                Self::ResultFail => "Result Fail",
                Self::Unknown(_) => "unknown",
            }
        }
    }
}

// Generated from YAML.

/// Board.
pub mod innfos {
    use crate::innfos::{Actuator, CommandRow, Format, FullScale, Operation};
    /// The first byte of a frame.
    ///
    /// book §2.
    pub const HEADER: u8 = 0xEE;
    /// The last byte of a frame.
    pub const TAIL: u8 = 0xED;
    /// The smallest address that an actuator may have.
    pub const MIN_ADDRESS: u8 = 0x01;
    /// The largest address that an actuator may have.
    pub const MAX_ADDRESS: u8 = 0xFF;
    /// The address that every actuator obeys.
    pub const BROADCAST_ADDRESS: u8 = 0x00;
    /// Bytes of the length field, which counts data.
    ///
    /// book §2.
    pub const LENGTH_SIZE: usize = 2usize;
    /// Whether the length field's low byte comes first.
    pub const LENGTH_LOW_BYTE_FIRST: bool = false;
    /// The polynomial of CRC-16/MODBUS, highest power in the highest bit.
    ///
    /// book §2.
    pub const CRC_POLYNOMIAL: u16 = 0x8005;
    /// The CRC's value before the first byte.
    pub const CRC_INITIAL: u16 = 0xFFFF;
    /// Whether the CRC takes and gives the lowest bit of a byte first.
    pub const CRC_REFLECTED: bool = true;
    /// The value that is xored with the CRC's last value.
    pub const CRC_FINAL_XOR: u16 = 0x0000;
    /// The CRC of the nine ASCII characters `123456789`.
    pub const CRC_CHECK: u16 = 0x4B37;
    /// Whether the CRC's low byte comes first on the wire.
    pub const CRC_LOW_BYTE_FIRST: bool = true;
    /// A request with at least this many bytes of data has a CRC.
    ///
    /// book §2.
    pub const REQUEST_CRC_FROM: usize = 1usize;
    /// A reply with at least this many bytes of data has a CRC.
    ///
    /// book §2.
    pub const REPLY_CRC_FROM: usize = 2usize;
    /// The commands whose shorter replies may have a CRC, or zeros in its place.
    ///
    /// book §2.
    pub const OPTIONAL_CRC_REPLIES: [u8; 0usize] = [];
    /// The board's IPv4 address as delivered.
    ///
    /// book §2.
    pub const BOARD: [u8; 4] = [10u8, 0u8, 0u8, 2u8];
    /// The IPv4 address of every board.
    pub const EVERY_BOARD: [u8; 4] = [10u8, 0u8, 0u8, 255u8];
    /// The board's UDP port.
    pub const PORT: u16 = 2000;
    /// A command of a host.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Command {
        /** `0x01`: State; the reply carries a value, flag.

 book §2.*/
        ReadState,
        /// A byte without a name in the documents.
        Unknown(u8),
    }
    impl Command {
        /// Every named one, by ascending code.
        pub const ALL: [Self; 1usize] = [Self::ReadState];
        /// The value with this byte.
        #[must_use]
        pub const fn from_code(code: u8) -> Self {
            match code {
                0x01 => Self::ReadState,
                code => Self::Unknown(code),
            }
        }
        /// The byte on the wire.
        #[must_use]
        pub const fn code(self) -> u8 {
            match self {
                Self::ReadState => 0x01,
                Self::Unknown(code) => code,
            }
        }
        /// Its name in the documents, or `unknown`.
        #[must_use]
        pub const fn name(self) -> &'static str {
            match self {
                Self::ReadState => "Read State",
                Self::Unknown(_) => "unknown",
            }
        }
    }
    impl Command {
        /// The facts about the command; `None` for an unknown one.
        #[must_use]
        pub const fn row(self) -> Option<&'static CommandRow> {
            Some(
                match self {
                    Self::ReadState => {
                        &CommandRow {
                            operation: Operation::Read,
                            request: 0,
                            reply: &[1],
                            format: Some(Format::Flag),
                            unit: None,
                            full_scale: None,
                        }
                    }
                    Self::Unknown(_) => return None,
                },
            )
        }
    }
    /// What the actuator controls (book §2).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Mode {
        /// A byte without a name in the documents.
        Unknown(u8),
    }
    impl Mode {
        /// Every named one, by ascending code.
        pub const ALL: [Self; 0usize] = [];
        /// The value with this byte.
        #[must_use]
        pub const fn from_code(code: u8) -> Self {
            match code {
                code => Self::Unknown(code),
            }
        }
        /// The byte on the wire.
        #[must_use]
        pub const fn code(self) -> u8 {
            match self {
                Self::Unknown(code) => code,
            }
        }
        /// Its name in the documents, or `unknown`.
        #[must_use]
        pub const fn name(self) -> &'static str {
            match self {
                Self::Unknown(_) => "unknown",
            }
        }
    }
    /// What the actuator warns of (book §2).
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct Alarms(pub u16);
    impl Alarms {
        /// The names of the set bits: one name per named bit, then one name for all other bits.
        pub fn names(self) -> impl Iterator<Item = &'static str> {
            let rows = [(!0x0000, "None")];
            rows.into_iter()
                .filter(move |row: &(u16, _)| self.0 & row.0 != 0)
                .map(|row| row.1)
        }
        /// The bits that mean an none.
        #[must_use]
        pub const fn others(self) -> u16 {
            self.0 & !0x0000
        }
    }
    /// Every model (book §2).
    pub const ACTUATORS: [Actuator; 0usize] = [];
}

// Generated from YAML.

/// The Motor control table: book §2.
pub mod motor {
    use crate::dynamixel2::Instruction;
    use crate::register::{
        Access, Area, BitField, Bound, Condition, Device, Kind, Meaning, NamedValue,
        Range, Register, Row, Unit, Value,
    };
    /// The device as a whole.
    pub const DEVICE: Device = Device {
        id: "motor",
        name: "Motor",
        model_number: None,
        complete: false,
        instructions: &[Instruction::Ping],
        eeprom_lock: Some(2u16),
        registers: &[LIMIT.row, TORQUE.row, GOAL.row, MODE.row, STATE.row],
    };
    /// Limit: address 0, 2 bytes, EEPROM area, read and write.
    ///
    /// Initially 5, 0 to 10.
    /// Source: book §2.
    pub const LIMIT: Register<u16> = Register::new(
        &Row {
            name: "Limit",
            address: 0u16,
            kind: Kind::U16,
            area: Area::Eeprom,
            access: Access::ReadWrite,
            initial: Some(5),
            range: Range::Between {
                min: Bound::Value(0),
                max: Bound::Value(10),
            },
            settled: true,
            unit: None,
            meanings: &[],
            values: &[],
            bits: &[],
        },
    );
    /// Torque: address 2, 1 byte, RAM area, read and write.
    ///
    /// Source: book §2.
    pub const TORQUE: Register<u8> = Register::new(
        &Row {
            name: "Torque",
            address: 2u16,
            kind: Kind::U8,
            area: Area::Ram,
            access: Access::ReadWrite,
            initial: None,
            range: Range::Any,
            settled: true,
            unit: None,
            meanings: &[],
            values: &[],
            bits: &[],
        },
    );
    /// Goal: address 4, 2 bytes, RAM area, read and write.
    ///
    /// -Limit to Limit.
    /// Source: book §2.
    pub const GOAL: Register<i16> = Register::new(
        &Row {
            name: "Goal",
            address: 4u16,
            kind: Kind::I16,
            area: Area::Ram,
            access: Access::ReadWrite,
            initial: None,
            range: Range::Between {
                min: Bound::Register {
                    address: 0u16,
                    negated: true,
                },
                max: Bound::Register {
                    address: 0u16,
                    negated: false,
                },
            },
            settled: true,
            unit: None,
            meanings: &[],
            values: &[],
            bits: &[],
        },
    );
    /// Mode: address 8, 1 byte, EEPROM area, read and write.
    ///
    /// Initially 4, one of 4, 17.
    /// Source: book §2.
    pub const MODE: Register<Mode> = Register::new(
        &Row {
            name: "Mode",
            address: 8u16,
            kind: Kind::U8,
            area: Area::Eeprom,
            access: Access::ReadWrite,
            initial: Some(4),
            range: Range::OneOf(&[4, 17]),
            settled: true,
            unit: None,
            meanings: &[],
            values: &[
                NamedValue {
                    value: 4,
                    name: "Turning",
                },
            ],
            bits: &[],
        },
    );
    /// What Mode may be.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Mode {
        /// `4`: Turning.
        Turning,
        /// A value without a name in the documents.
        Unknown(u8),
    }
    impl Mode {
        /// The value with this number.
        #[must_use]
        pub const fn from_raw(raw: u8) -> Self {
            match raw {
                4 => Self::Turning,
                raw => Self::Unknown(raw),
            }
        }
        /// The number.
        #[must_use]
        pub const fn raw(self) -> u8 {
            match self {
                Self::Turning => 4,
                Self::Unknown(raw) => raw,
            }
        }
    }
    impl Value for Mode {
        const KIND: Kind = Kind::U8;
        fn raw(self) -> i64 {
            self.raw().into()
        }
        fn from_raw(raw: i64) -> Option<Self> {
            raw.try_into().ok().map(Self::from_raw)
        }
    }
    /// State: address 9, 4 bytes, RAM area, read-only.
    ///
    /// One count is 0.01 rev/min.
    /// Source: book §2, book §3.
    pub const STATE: Register<State> = Register::new(
        &Row {
            name: "State",
            address: 9u16,
            kind: Kind::U32,
            area: Area::Ram,
            access: Access::ReadOnly,
            initial: None,
            range: Range::Any,
            settled: true,
            unit: Some(Unit {
                factor: 0.01,
                symbol: "rev/min",
            }),
            meanings: &[],
            values: &[],
            bits: &[
                BitField {
                    name: "Moving",
                    lowest: 0u8,
                    width: 1u8,
                    values: &[],
                },
                BitField {
                    name: "Profile",
                    lowest: 4u8,
                    width: 2u8,
                    values: &[
                        NamedValue {
                            value: 3,
                            name: "Trapezoidal",
                        },
                    ],
                },
            ],
        },
    );
    /// The bits of State.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct State(pub u32);
    impl State {
        /// The value with this number.
        #[must_use]
        pub const fn from_raw(raw: u32) -> Self {
            Self(raw)
        }
        /// The number.
        #[must_use]
        pub const fn raw(self) -> u32 {
            self.0
        }
        /// The bits without a name in the documents, in their places.
        #[must_use]
        pub const fn unnamed(self) -> u32 {
            self.0 & !0x31
        }
        /// Bit 0: Moving.
        #[must_use]
        pub const fn moving(self) -> bool {
            self.0 & 0x01 != 0
        }
        /// The same with another Moving.
        #[must_use]
        pub const fn with_moving(self, value: bool) -> Self {
            Self((self.0 & !0x01) | (((value as u32) << 0) & 0x01))
        }
        /// Bits 4 to 5: Profile.
        #[must_use]
        pub const fn profile(self) -> Profile {
            Profile::from_raw((self.0 & 0x30) >> 4)
        }
        /// The same with another Profile.
        #[must_use]
        pub const fn with_profile(self, value: Profile) -> Self {
            Self((self.0 & !0x30) | ((value.raw() << 4) & 0x30))
        }
    }
    /// What the bits Profile of State may be.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Profile {
        /// `3`: Trapezoidal.
        Trapezoidal,
        /// A value without a name in the documents.
        Unknown(u32),
    }
    impl Profile {
        /// The value with this number.
        #[must_use]
        pub const fn from_raw(raw: u32) -> Self {
            match raw {
                3 => Self::Trapezoidal,
                raw => Self::Unknown(raw),
            }
        }
        /// The number.
        #[must_use]
        pub const fn raw(self) -> u32 {
            match self {
                Self::Trapezoidal => 3,
                Self::Unknown(raw) => raw,
            }
        }
    }
    impl Value for State {
        const KIND: Kind = Kind::U32;
        fn raw(self) -> i64 {
            self.raw().into()
        }
        fn from_raw(raw: i64) -> Option<Self> {
            raw.try_into().ok().map(Self::from_raw)
        }
    }
}
