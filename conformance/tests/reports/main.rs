//! The reports, as people, programs and browsers see them.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod browser;
mod ci;
mod compare;
mod html;
mod json;
mod junit;
#[cfg(unix)]
mod kept;
mod order;
mod outside;
mod parts;
mod program;
mod sample;
mod text;
mod traffic;
