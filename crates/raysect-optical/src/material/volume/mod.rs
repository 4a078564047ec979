//! What fills volumes behind a surface that lets everything pass.

mod homogeneous;
mod inhomogeneous;
mod profile;
mod uniform;

pub use homogeneous::HomogeneousVolumeEmitter;
pub use inhomogeneous::InhomogeneousVolumeEmitter;
pub use profile::ProfileVolume;
pub use uniform::UniformVolume;

use raysect_core::save::short_name;

use super::Facts;

/// The facts of a volume behind a surface that lets everything pass.
fn volume_facts<M: ?Sized>(importance: f64) -> Facts {
    let name = short_name(std::any::type_name::<M>());
    Facts { importance, transparent: true, ..Facts::named(name).without_index() }
}
