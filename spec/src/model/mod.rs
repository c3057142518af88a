//! What the YAML files may say that are not a wire's own: one type a row, checked for shape by serde and for sense by
//! [`crate::validate`].

mod bytes;
mod citation;
mod device;
mod document;
mod erratum;
mod framing;
mod register;
mod requirement;
mod sentence;
mod vector;

pub use bytes::HexBytes;
pub use citation::Citation;
pub use device::{Alarm, Condition, Device};
pub use document::{Document, DocumentsFile};
pub use erratum::{ErrataFile, Erratum, Proof, ProofKind, Status};
pub use framing::{ByteOrder, Crc, Id, Length};
pub use register::{
    Access, Area, BitField, Bound, Meaning, NamedValue, Range, Register, Type, Unit,
};
pub use requirement::{CheckedBy, Level, Requirement, RequirementsFile, Role};
pub use sentence::{NO_DEMAND, Section, Sentence, SentencesFile};
pub use vector::{Fault, Outcome, Vector, VectorsFile};
