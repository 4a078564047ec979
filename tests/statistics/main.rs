//! Are the error bars right, and are the averages that a stop rule ends unbiased?

#[allow(dead_code, reason = "glass is not looked at here")]
#[path = "../../examples/common/cornell.rs"]
mod cornell;

mod adaptive;
mod coverage;
mod dark;
mod pictures;
mod scopes;
mod score;
mod seeds;
mod sensors;
mod trust;
mod truth;
mod until;
