//! Scenes as files: worlds, cameras and pipelines as readable JSON.
//!
//! ```
//! use raysect::prelude::*;
//! use raysect::save::{SavedScene, SceneWriter, registry};
//!
//! # fn main() -> raysect::Result<()> {
//! let mut world = World::new();
//! let lamp = Sphere::new(0.5)?.material(UniformSurfaceEmitter::new(2.5, 1.0));
//! world.add(lamp.transform(translate(0.0, 0.1, 4.0)).name("lamp"))?;
//! let camera = PinholeCamera::new((8, 8), 30.0)?.pixel_samples(16).quiet(true);
//! let mut rgb = RgbPipeline2D::new();
//!
//! let mut writer = SceneWriter::new(&world)?;
//! writer.keep("camera", &camera)?;
//! writer.keep("picture", &rgb)?;
//! let text = writer.to_json();                            // or writer.save("scene.json")
//!
//! let scene = SavedScene::from_json(&text, &registry())?; // or SavedScene::load("scene.json", …)
//! let same_camera: PinholeCamera = scene.get("camera")?;
//! let mut same_rgb: RgbPipeline2D = scene.get("picture")?;
//! assert!(scene.world.find("lamp").is_some());
//!
//! camera.observe(&world, &mut rgb)?;
//! same_camera.observe(&scene.world, &mut same_rgb)?;
//! assert_eq!(rgb.frame(), same_rgb.frame());              // to the last bit
//! # Ok(())
//! # }
//! ```
//!
//! A file can be edited by hand. Reading goes through the constructors: what they refuse, and what has no meaning, is an
//! error that names the place.
//!
//! # Your own shapes, materials and settings
//! Say what a file needs to know, and add one line to the registry:
//!
//! ```
//! use raysect::prelude::*;
//! use raysect::save::{MaterialRegistry, SaveError, Saved, SavedScene, SceneWriter, registry};
//!
//! /// A mirror that reflects all wavelengths alike.
//! struct Mirror { reflectance: f64 }
//!
//! impl Material for Mirror {
//!     fn surface(&self, hit: &SurfaceHit, path: &mut Path) -> Scatter {
//!         path.scale(self.reflectance);
//!         Scatter::Continue { direction: hit.mirrored() }
//!     }
//!     fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
//!         Ok(Saved::new("Mirror").number("reflectance", self.reflectance))
//!     }
//! }
//!
//! # fn main() -> raysect::Result<()> {
//! let mut registry = registry();
//! registry.material("Mirror", |entry| Ok(Mirror { reflectance: entry.number("reflectance")? }));
//!
//! let mut world = World::new();
//! world.add(Sphere::new(1.0)?.material(Mirror { reflectance: 0.9 }))?;
//! let text = SceneWriter::new(&world)?.to_json();
//! let read = SavedScene::from_json(&text, &registry)?.world;
//! assert_eq!(SceneWriter::new(&read)?.to_json(), text);
//! # Ok(())
//! # }
//! ```
//!
//! The same holds for [`Primitive::save`](crate::core::Primitive::save) with [`Registry::primitive`], and for
//! [`SpectralFunction::save`](crate::optical::SpectralFunction::save) with [`MaterialRegistry::function`]. Cameras,
//! pipelines and settings implement [`Storable`] and need no registry. What a file holds, and what cannot be saved, is
//! written in [`raysect_core::save`].

pub use crate::core::save::{
    Entry, MakeError, Registry, SaveError, Saved, SceneObject, SceneWriter, Storable,
};
pub use crate::optical::{MaterialRegistry, OpticalEntry, SavedScene};

/// A registry of every shape, material and spectral function of this library.
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    crate::primitive::register(&mut registry);
    crate::optical::register(&mut registry);
    registry
}
