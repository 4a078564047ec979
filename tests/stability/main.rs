//! Where methods fail: tiny, huge, far, grazing and degenerate geometry, against exact arithmetic and closed forms.
//!
//! The judges are those of `cargo run --release --example stability`, which asks more cells with more rays.

#[path = "../../examples/common/stability/mod.rs"]
mod judges;

mod check;
mod families;
