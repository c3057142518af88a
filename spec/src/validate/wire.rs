//! A wire's file has the wire's id, and keeps the rules that it alone has.

use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    Wire::ALL.into_iter().flat_map(|wire| wire.validate(spec)).collect()
}
