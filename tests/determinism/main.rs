//! The same seed gives the same bits: on any engine, in any number of passes, whatever happened in between.

#[path = "../../examples/common/cornell.rs"]
mod cornell;

mod adaptive;
mod bits;
mod cancelling;
mod engines;
mod folder;
mod killing;
mod lanes;
mod masks;
mod memory;
mod panics;
mod parallel;
mod passes;
mod refusals;
mod regions;
mod replays;
mod statepoints;
mod world;
