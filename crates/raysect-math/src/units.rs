//! Lengths in metres and angles in degrees from other units.
//!
//! The mile is the international one, 1609.344 m exactly (Raysect 0.9.1 has 1609.34).

/// Kilometres in metres.
pub const fn km(value: f64) -> f64 {
    value * 1e3
}
/// Centimetres in metres.
pub const fn cm(value: f64) -> f64 {
    value * 1e-2
}
/// Millimetres in metres.
pub const fn mm(value: f64) -> f64 {
    value * 1e-3
}
/// Micrometres in metres.
pub const fn um(value: f64) -> f64 {
    value * 1e-6
}
/// Nanometres in metres.
pub const fn nm(value: f64) -> f64 {
    value * 1e-9
}
/// International miles in metres.
pub const fn mile(value: f64) -> f64 {
    value * 1609.344
}
/// Yards in metres.
pub const fn yard(value: f64) -> f64 {
    value * 0.9144
}
/// Feet in metres.
pub const fn foot(value: f64) -> f64 {
    value * 0.3048
}
/// Inches in metres.
pub const fn inch(value: f64) -> f64 {
    value * 0.0254
}
/// Thousandths of an inch in metres.
pub const fn mil(value: f64) -> f64 {
    value * 2.54e-5
}
/// Radians in degrees.
pub const fn radian(value: f64) -> f64 {
    value.to_degrees()
}
