//! Shim: the body is in `actucheck_fuzz::targets`.
#![cfg_attr(fuzzing, no_main)]
actucheck_fuzz::shim!(bus);
