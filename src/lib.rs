//! A spectral, double-precision Monte Carlo ray tracer for physics and engineering.

pub use raysect_core as core;
pub use raysect_math as math;
pub use raysect_observer as observer;
pub use raysect_optical as optical;
pub use raysect_primitive as primitive;
