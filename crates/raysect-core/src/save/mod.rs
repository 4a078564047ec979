//! Scenes as files: a world, and what is to be kept with it, as readable JSON.
//!
//! A [`SceneWriter`] takes a world and whatever else is [`Storable`], and writes a text with one line for each object
//! and node. A [`SavedScene`] is read from it, with a [`Registry`] that knows how each kind of object is made:
//!
//! ```
//! use raysect_core::save::{Registry, SavedScene, SceneWriter};
//! use raysect_core::{Node, World, testing::Ball};
//! use raysect_math::translate;
//!
//! let mut world = World::<()>::new();
//! world.add(Node::of(Ball::new(0.1), ()).transform(translate(0.0, 0.0, 3.0)).name("moon"))?;
//! let text = SceneWriter::new(&world)?.to_json();
//!
//! let mut registry = Registry::new();
//! registry.primitive("Ball", |entry| Ok(Ball::new(entry.number("radius")?)));
//! let read = SavedScene::<()>::from_json(&text, &registry)?.world;
//! assert_eq!(read.tree(), world.tree());
//!
//! // Every number comes back with every bit: what is read is written as the same text.
//! assert_eq!(SceneWriter::new(&read)?.to_json(), text);
//! # Ok::<(), raysect_core::save::SaveError>(())
//! ```
//!
//! # What a file holds
//! - `format` and `version`; other versions are refused.
//! - `objects`: shapes, what is attached to them, and what these share, in an order in which each refers to objects
//!   before it only. Objects that are equal are written once, and shared after reading.
//! - `nodes` in the order of the tree, each after its parent: kind, name, parent, transform relative to it, and users'
//!   values of plain types ([`String`], [`bool`], [`f64`], integers). The root has the number 0 and no line.
//! - `settings`: cameras, pipelines and users' own, by the names under which they were kept.
//!
//! Nothing is left out without a word. What cannot be saved is an error that names the node: closures, shapes and
//! materials that do not say how they are saved, users' values of other types, numbers that are not finite, detached
//! nodes, an acceleration structure of the user's own.
//!
//! # Your own types
//! A shape says what a file needs to know by [`Primitive::save`], and one line of the registry
//! makes it again. Settings of your own implement [`Storable`].

mod entry;
mod error;
mod registry;
mod saved;
mod scene;
mod strict;
mod writer;

use std::sync::Arc;

pub use entry::Entry;
pub use error::SaveError;
pub use registry::{MakeError, Registry};
pub use saved::Saved;
pub use scene::SavedScene;
pub use writer::SceneWriter;

use crate::Primitive;

/// What the field `format` of a file says.
pub const FORMAT: &str = "raysect scene";

/// The version of the files that are written and read.
pub const VERSION: u64 = 1;

/// The number by which a file refers to an object or a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reference(u64);

/// What stands in a file as an object of its own, made again by a [`Registry`]: shapes, materials, and what they share.
pub trait SceneObject: Send + Sync + 'static {
    /// What such objects are for, in one word.
    const ROLE: &'static str;

    /// Kind and fields.
    ///
    /// # Errors
    /// Why it cannot be saved.
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError>;
}

impl SceneObject for dyn Primitive {
    const ROLE: &'static str = "shape";

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Primitive::save(self, writer)
    }
}

/// In a world of geometry alone.
impl SceneObject for () {
    const ROLE: &'static str = "attachment";

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Nothing"))
    }
}

/// What can be kept beside a world under a name: a camera, a pipeline, settings of a user's own.
///
/// ```
/// use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
///
/// struct Exposure { seconds: f64, frames: u64 }
///
/// impl Storable for Exposure {
///     const KIND: &'static str = "Exposure";
///
///     fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
///         Ok(saved.number("seconds", self.seconds).count("frames", self.frames))
///     }
///
///     fn load(entry: &Entry) -> Result<Self, MakeError> {
///         Ok(Self { seconds: entry.number("seconds")?, frames: entry.count("frames")? })
///     }
/// }
/// ```
pub trait Storable: Sized {
    /// What it is called in a file.
    const KIND: &'static str;

    /// Adds its fields to those that are there.
    ///
    /// # Errors
    /// Why it cannot be saved.
    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError>;

    /// Makes it of its fields.
    ///
    /// # Errors
    /// What is wrong with them.
    fn load(entry: &Entry<'_>) -> Result<Self, MakeError>;
}

/// The name of a type without its path, for messages; a closure is called by its name.
pub fn short_name(full: &'static str) -> &'static str {
    if full.contains("{{closure}}") {
        return "closure";
    }
    let end = full.find('<').unwrap_or(full.len());
    full[..end].rsplit("::").next().unwrap_or(full)
}

/// Saves what is shared by its owner once.
pub(crate) fn save_shared<P: Primitive + ?Sized>(
    shape: &Arc<P>,
    writer: &mut SceneWriter,
) -> Result<Saved, SaveError> {
    writer.shared(shape, |shape, writer| shape.save(writer))
}
