//! Against numbers of Raysect: the Cornell box, also against itself in other formats, crossings of rays with shapes, and
//! values of functions and maps.
//!
//! `tests/data/cornell_glass.npz` and `cornell_diffuse.npz` were rendered with Raysect 0.9.1: 24×24 pixels, 15 bins over
//! 375 to 740 nm, a field of view of 45 degrees from z = −3.3, and without the factor cos θ of its pinhole camera.
//!
//! `tests/data/crossings.jsonl` holds 40 rays and 40 points for each of 52 shapes: crossings by Raysect 0.9.1, those of
//! tori by 50-digit arithmetic and those of meshes in double precision by a search through all triangles, since
//! Raysect's own are good to 1e-3 and 1e-6 only.
//!
//! What sensors of Raysect 0.9.1 read in uniform surroundings stands in `recorded_sensors.rs`.
//!
//! `tests/data/values.json` holds values by Raysect 0.9.1 with the relative tolerances within which they are right.

#[path = "../../examples/common/comparison.rs"]
mod comparison;
#[path = "../../examples/common/cornell.rs"]
mod cornell;
#[path = "../../examples/common/crossings.rs"]
mod crossings;
#[path = "../../examples/common/finding.rs"]
mod finding;
#[path = "../../examples/common/json.rs"]
mod json;
#[path = "../../examples/common/recorded_shape.rs"]
mod recorded_shape;
#[path = "../../examples/common/reference.rs"]
mod reference;
#[path = "../../examples/common/values/mod.rs"]
mod values;

mod controls;
mod formats;
mod frames;
mod migration;
mod recorded_crossings;
mod recorded_sensors;
mod recorded_spectra;
mod recorded_values;
mod spectra;
