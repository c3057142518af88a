//! The reports, as those who read them meet them: people, programs and browsers.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod browser;
mod compare;
mod html;
mod json;
mod junit;
mod order;
mod program;
mod sample;
mod text;
