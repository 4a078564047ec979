use std::any::Any;
use std::collections::BTreeMap;
use std::error::Error as StdError;
use std::fmt;
use std::sync::Arc;

use super::{Entry, SaveError, SceneObject};
use crate::Primitive;

/// What a maker of an object may fail with: errors of the file and of constructors alike.
pub type MakeError = Box<dyn StdError + Send + Sync>;

type Maker = dyn Fn(&Entry<'_>) -> Result<Box<dyn Any + Send + Sync>, MakeError> + Send + Sync;

/// How objects of each kind are made of what a file says.
///
/// It is an ordinary value: filled by the crates' `register` functions and by one line for each type of the user's.
/// Of two makers for a kind the later one counts.
#[derive(Default)]
pub struct Registry {
    makers: BTreeMap<&'static str, BTreeMap<String, Box<Maker>>>,
}

impl fmt::Debug for Registry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.makers.iter().map(|(role, kinds)| (role, kinds.keys()))).finish()
    }
}

impl Registry {
    /// Without shapes; it knows how nothing is attached to them.
    pub fn new() -> Self {
        let mut registry = Self::default();
        registry.object::<()>("Nothing", |_| Ok(Arc::new(())));
        registry
    }

    /// Adds a maker of shapes of a kind.
    ///
    /// ```
    /// # use raysect_core::{save::Registry, testing::Ball};
    /// let mut registry = Registry::new();
    /// registry.primitive("Ball", |entry| Ok(Ball::new(entry.number("radius")?)));
    /// ```
    pub fn primitive<P: Primitive>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<P, MakeError> + Send + Sync + 'static,
    ) {
        self.object::<dyn Primitive>(kind, move |entry| Ok(Arc::new(make(entry)?)));
    }

    /// Adds a maker of objects of a kind, for any role: what [`primitive`](Self::primitive) stands on.
    pub fn object<T: SceneObject + ?Sized>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<Arc<T>, MakeError> + Send + Sync + 'static,
    ) {
        let maker = move |entry: &Entry<'_>| -> Result<Box<dyn Any + Send + Sync>, MakeError> {
            Ok(Box::new(make(entry)?))
        };
        self.makers.entry(T::ROLE).or_default().insert(kind.to_owned(), Box::new(maker));
    }

    /// The object that an entry describes.
    pub(super) fn make(
        &self,
        role: &str,
        kind: &str,
        entry: &Entry<'_>,
    ) -> Result<Box<dyn Any + Send + Sync>, SaveError> {
        let kinds = self.makers.get(role);
        let Some(maker) = kinds.and_then(|kinds| kinds.get(kind)) else {
            let known: Vec<&str> = kinds.into_iter().flat_map(BTreeMap::keys).map(String::as_str).collect();
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            return Err(SaveError::UnknownKind { role: role.to_owned(), kind: kind.to_owned(), known });
        };
        let object = maker(entry).map_err(SaveError::refused)?;
        entry.finish()?;
        Ok(object)
    }
}
