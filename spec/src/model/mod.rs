//! What the YAML files may say: one type a row, checked for shape by serde and for sense by
//! [`crate::check`].

mod bytes;
mod citation;
mod device;
mod document;
mod erratum;
mod innfos;
mod packet;
mod protocol;
mod requirement;
mod sentence;
mod vector;

pub use bytes::HexBytes;
pub use citation::Citation;
pub use device::{
    Access, Alarm, Area, BitField, Bound, Condition, Device, Meaning, NamedValue, Range, Register,
    Type, Unit,
};
pub use document::{Document, DocumentsFile};
pub use erratum::{ErrataFile, Erratum, Proof, ProofKind, Status};
pub use innfos::{
    Actuator, Actuators, AlarmBit, Alarms, Command, CrcPresence, Direction, Envelope, Format,
    FormatRow, FrameKind, FullScale, Innfos, Mode, Modes, Udp,
};
pub use packet::{Block, Packet};
pub use protocol::{
    ByteOrder, Crc, ErrorNumber, Field, Framing, Id, Instruction, Length, Protocol, Size,
    StatusFormat, Stuffing,
};
pub use requirement::{CheckedBy, Level, Requirement, RequirementsFile, Role};
pub use sentence::{NO_DEMAND, Section, Sentence, SentencesFile};
pub use vector::{Fault, Outcome, Vector, VectorsFile};
