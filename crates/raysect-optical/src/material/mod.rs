//! What surfaces and volumes do to light.

mod absorbing;
mod bsdf;
mod conductor;
mod dielectric;
mod emitter;
mod fresnel;
mod lambert;
mod medium;
mod microfacet;
mod mirror;
mod modifier;
mod null;
mod phase_function;
mod surface_hit;
mod volume;

use std::sync::Arc;

pub use absorbing::AbsorbingSurface;
pub use bsdf::Bsdf;
pub use conductor::Conductor;
pub(crate) use conductor::LAWS;
pub use dielectric::Dielectric;
pub use emitter::{
    AnisotropicSurfaceEmitter, Checkerboard, DebugLight, UniformSurfaceEmitter, UnitySurfaceEmitter,
};
pub use fresnel::FresnelLaw;
pub use lambert::Lambert;
pub(crate) use medium::scatters;
pub use medium::{Coefficients, Medium, MediumPoint, Refraction, Structure};
pub(crate) use microfacet::MASKINGS;
pub use microfacet::{Masking, RoughConductor, RoughDielectric};
pub use mirror::PerfectReflectingSurface;
pub(crate) use modifier::add_share;
pub use modifier::{Add, Blend, Roughen, VolumeTransform};
pub use null::NullMaterial;
pub use phase_function::{HenyeyGreenstein, PhaseFunction, Rayleigh};
pub use surface_hit::SurfaceHit;
pub use volume::{HomogeneousVolumeEmitter, InhomogeneousVolumeEmitter, ProfileVolume, UniformVolume};

use raysect_core::save::{SaveError, Saved, SceneObject, SceneWriter, short_name};
use raysect_math::{MathError, Vector3D};

use crate::{OpticalError, Path, Slice, SpectralTable};

/// What is known at a surface besides the hit: small, copied freely, and independent of the path.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// The bins that the path carries, with their tables.
    pub slice: &'a Slice,
    /// Refractive index on the side from which the path arrives.
    pub index_in: f64,
    /// Refractive index on the other side.
    pub index_out: f64,
    /// The wavelength that stands for the path where something disperses [nm].
    pub wavelength: f64,
}

/// How a path goes on from a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scatter {
    /// It ends.
    Absorbed,
    /// It goes straight on, as if the surface were not there.
    PassThrough,
    /// It goes on along a unit vector in world space, on whichever side of the surface that lies.
    Continue {
        /// Where to.
        direction: Vector3D,
    },
}

/// What a surface does with the refractive indices on its sides. It matters where they differ from bin to bin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum IndexUse {
    /// It may read the one pair that [`Path::context`] or [`Material::emit`] gives. A path that comes to it keeps one bin,
    /// so that the pair is that of its wavelength: right for every material.
    #[default]
    One,
    /// It is a [`Bsdf`] that reads the pair it is given, and answers with [`Path::scatter`]: it is asked for each bin with
    /// the indices of that bin, and paths carry all bins on. What it emits does not depend on the indices.
    EachBin,
    /// It reads none.
    None,
}

/// What a scene wants to know about a material before any ray is traced.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// What to call it in messages and in `plan`.
    pub name: String,
    /// How much paths are to be aimed at what carries it, relative to others; 0 for not at all.
    pub importance: f64,
    /// True if the surface emits.
    pub emits: bool,
    /// True if the surface lets every ray pass straight on, also those that look for a light.
    pub transparent: bool,
    /// True if its refraction depends on the wavelength.
    pub disperses: bool,
    /// True if no path ever goes on from the surface: it is black, though it may emit.
    pub absorbs: bool,
    /// What the surface does with the refractive indices on its sides.
    pub index_use: IndexUse,
}

impl Facts {
    /// The facts of an opaque, dark surface.
    pub fn named(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            importance: 0.0,
            emits: false,
            transparent: false,
            disperses: false,
            absorbs: false,
            index_use: IndexUse::One,
        }
    }

    /// The facts of a surface that emits and reflects nothing.
    pub fn emitter(name: impl Into<String>) -> Self {
        Self { emits: true, absorbs: true, ..Self::named(name) }
    }

    /// Refuses an importance that is negative or not finite; a scene asks it of all its materials.
    pub(crate) fn check(&self) -> Result<(), MathError> {
        let admitted = self.importance >= 0.0 && self.importance.is_finite();
        let name = "importance of a material";
        MathError::check(admitted, self.importance, name, "", "finite and not negative").map(drop)
    }

    /// The same of a surface that reads no refractive index.
    pub(crate) fn without_index(self) -> Self {
        Self { index_use: IndexUse::None, ..self }
    }
}

/// What a surface and the volume behind it do to light.
///
/// Only [`surface`](Self::surface) must be given:
///
/// ```
/// use raysect_optical::{Facts, Material, Path, Scatter, SurfaceHit};
///
/// /// A perfect mirror.
/// struct Mirror;
///
/// impl Material for Mirror {
///     fn surface(&self, hit: &SurfaceHit, _: &mut Path) -> Scatter {
///         Scatter::Continue { direction: hit.mirrored() }
///     }
///     fn facts(&self) -> Facts {
///         Facts::named("mirror")
///     }
/// }
/// ```
pub trait Material: Send + Sync + 'static {
    /// Writes the radiance [W/m²/sr/nm] that leaves the hit towards where the path comes from into `out`, one value
    /// a bin; `false` for none (then `out` is not looked at). It has no side effect and follows no path: light
    /// sampling asks the same question. Set [`Facts::emits`] to be asked at all.
    fn emit(&self, _hit: &SurfaceHit, _at: Context<'_>, _out: &mut [f64]) -> bool {
        false
    }

    /// Says how a path goes on, and multiplies its throughput. It never emits. A material that scatters into a
    /// range of directions implements [`Bsdf`] and answers with [`Path::scatter`].
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter;

    /// What fills the volume behind the surface.
    fn medium(&self) -> Option<&dyn Medium> {
        None
    }

    /// What a scene wants to know about it.
    fn facts(&self) -> Facts {
        Facts::named(short_name(std::any::type_name::<Self>()))
    }

    /// Refuses a range of wavelengths that it cannot describe.
    ///
    /// # Errors
    /// What is wrong there.
    fn check(&self, _slice: &Slice) -> Result<(), OpticalError> {
        Ok(())
    }

    /// What a file needs to know to make it again; see [`raysect_core::save`]. It refers to a
    /// [`SpectralTable`](crate::SpectralTable) by [`SceneWriter::object`], and to an `Arc` of another material by
    /// [`SceneWriter::shared_object`].
    ///
    /// # Errors
    /// [`SaveError::NotSaved`] by default.
    fn save(&self, _writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Err(SaveError::NotSaved { role: "material", kind: self.facts().name })
    }
}

/// Refuses a table whose bins are not between 0 and 1, but for the rounding of averages over narrow bins: differences
/// of integrals that begin at the first entry of a table.
fn check_shares(slice: &Slice, table: &SpectralTable, name: &'static str) -> Result<(), OpticalError> {
    let rounding = 64.0 * f64::EPSILON * slice.max / slice.bin_width();
    for &value in slice.table(table) {
        let admitted = (-rounding..=1.0 + rounding).contains(&value);
        MathError::check(admitted, value, name, "", "0 … 1")?;
    }
    Ok(())
}

/// A material within another one; [`OpticalEntry::material`](crate::OpticalEntry::material) reads it.
impl SceneObject for dyn Material {
    const ROLE: &'static str = "material";

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Material::save(self, writer)
    }
}

impl<M: Material + ?Sized> Material for Arc<M> {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        (**self).emit(hit, at, out)
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        (**self).surface(hit, path)
    }
    fn medium(&self) -> Option<&dyn Medium> {
        (**self).medium()
    }
    fn facts(&self) -> Facts {
        (**self).facts()
    }
    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        (**self).check(slice)
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        writer.shared(self, |material, writer| material.save(writer))
    }
}
