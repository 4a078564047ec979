//! Spectra, materials and the path tracer of raysect.
//!
//! A [`World`] holds shapes with materials; a path goes from where light is measured against its direction to where
//! it comes from. Wavelengths are in nanometres, radiance in W/m²/sr/nm; a spectrum has bins that hold averages.
//!
//! ```
//! use raysect_math::{Point3D, Vector3D, translate};
//! use raysect_optical::{Lambert, Ray, UniformSurfaceEmitter, WithMaterial, World};
//! use raysect_primitive::{Cuboid, Sphere};
//!
//! let mut world = World::new();
//! let floor = Cuboid::new(Point3D::new(-9.0, -1.0, -9.0), Point3D::new(9.0, 0.0, 9.0))?;
//! world.add(floor.material(Lambert::new(0.5)))?;
//! let lamp = Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0));
//! world.add(lamp.transform(translate(0.0, 6.0, 0.0)))?;
//!
//! // The floor below the lamp reflects ρ L (R/d)² = 0.5 / 36.
//! let ray = Ray::new(Point3D::new(5.0, 5.0, 0.0), Vector3D::new(-1.0, -1.0, 0.0)).spectrum(500.0, 501.0, 1);
//! let seen = ray.sample(&world, 1000)?.total;
//! assert!((seen.mean() - 0.5 / 36.0).abs() < 4.0 * seen.error());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Your own material
//! Implement [`Material`]; if it scatters into a range of directions, implement [`Bsdf`] too and let
//! [`Path::scatter`] do light sampling and weights:
//!
//! ```
//! use raysect_math::{Rng, Vector3D};
//! use raysect_optical::{Bsdf, Context, Material, Path, Scatter, SpectralTable, SurfaceHit};
//! use std::f64::consts::TAU;
//!
//! /// A Phong lobe about the mirror direction.
//! struct Phong { reflectivity: SpectralTable, exponent: f64 }
//!
//! impl Bsdf for Phong {
//!     fn sample(&self, incoming: Vector3D, _: Context, rng: &mut Rng) -> Vector3D {
//!         let cosine = rng.uniform().powf(1.0 / (self.exponent + 1.0));
//!         let (sine, angle) = ((1.0 - cosine * cosine).sqrt(), TAU * rng.uniform());
//!         let lobe = Vector3D::new(sine * angle.cos(), sine * angle.sin(), cosine);
//!         let mirror = Vector3D::new(-incoming.x, -incoming.y, incoming.z);
//!         raysect_math::Frame::from_z(mirror).to_world(lobe)
//!     }
//!     fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, _: Context) -> f64 {
//!         let mirror = Vector3D::new(-incoming.x, -incoming.y, incoming.z);
//!         (self.exponent + 1.0) / TAU * mirror.dot(outgoing).max(0.0).powf(self.exponent)
//!     }
//!     fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context, out: &mut [f64]) {
//!         let lobe = if outgoing.z > 0.0 { self.pdf(incoming, outgoing, at) } else { 0.0 };
//!         for (out, r) in out.iter_mut().zip(at.slice.table(&self.reflectivity)) {
//!             *out = r * lobe;
//!         }
//!     }
//! }
//!
//! impl Material for Phong {
//!     fn surface(&self, hit: &SurfaceHit, path: &mut Path) -> Scatter {
//!         path.scatter(self, hit)
//!     }
//! }
//! ```
//!
//! A surface that leaves a path one way only, or a few, says so itself; its colour multiplies the throughput:
//!
//! ```
//! use raysect_optical::{Material, Path, Scatter, SpectralTable, SurfaceHit};
//!
//! /// A thin coloured film that reflects a share of the light and lets the others pass.
//! struct Film { reflected: f64, colour: SpectralTable }
//!
//! impl Material for Film {
//!     fn surface(&self, hit: &SurfaceHit, path: &mut Path) -> Scatter {
//!         if path.rng().probability(self.reflected) {
//!             return Scatter::Continue { direction: hit.mirrored() };
//!         }
//!         let tables = path.slice();
//!         for (t, colour) in path.throughput().iter_mut().zip(tables.table(&self.colour)) {
//!             *t *= colour;
//!         }
//!         Scatter::PassThrough
//!     }
//! }
//! ```
//!
//! [`testing::check_bsdf`] judges a surface of your own as it does those of the library.

pub mod colour;
mod error;
pub mod illumination;
pub mod library;
mod material;
mod path;
mod ray;
mod register;
mod slice;
mod spectral_function;
mod spectrum;
pub mod testing;
mod world;

pub use error::OpticalError;
pub use material::{
    AbsorbingSurface, Add, AnisotropicSurfaceEmitter, Blend, Bsdf, Checkerboard, Coefficients, Conductor,
    Context, DebugLight, Dielectric, Facts, FresnelLaw, HenyeyGreenstein, HomogeneousVolumeEmitter, IndexUse,
    InhomogeneousVolumeEmitter, Lambert, Masking, Material, Medium, MediumPoint, NullMaterial,
    PerfectReflectingSurface, PhaseFunction, ProfileVolume, Rayleigh, Refraction, RoughConductor,
    RoughDielectric, Roughen, Scatter, Structure, SurfaceHit, UniformSurfaceEmitter, UniformVolume,
    UnitySurfaceEmitter, VolumeTransform,
};
pub use path::{
    Dispersion, LEDGER_NUMBERS, Ledger, LightSampling, LoggedPath, Path, PathEvent, PathSettings, PathVertex,
    VertexHit,
};
pub use ray::{Ray, SampledSpectrum};
pub use register::{MaterialRegistry, OpticalEntry, SavedScene, register};
pub use slice::{Slice, Slicing, SpectralTable, Table};
pub use spectral_function::{
    BlackBody, GaussianLine, InterpolatedSf, NumericallyIntegratedSf, Sellmeier, SpectralFunction, TopHat,
    WavelengthUnit,
};
pub use spectrum::{Spectrum, photon_energy};
pub use world::{Materials, Optics, Scene, WithMaterial, World};
