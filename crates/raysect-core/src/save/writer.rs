use std::any::Any;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;

use serde_json::Value;

use super::{FORMAT, Reference, SaveError, Saved, SceneObject, Storable, VERSION};
use crate::{Attachment, NodeId, World};

/// Writes a world, and what is to be kept with it, as JSON.
///
/// Each object has a line and a number of its own; what is used in several places, or is equal to the last bit, is
/// written once. See the [module](super) for an example.
pub struct SceneWriter {
    pub(crate) name: String,
    pub(crate) meta: Option<Value>,
    pub(crate) acceleration: &'static str,
    objects: Vec<Arc<str>>,
    by_text: HashMap<Arc<str>, u64>,
    by_address: HashMap<usize, u64>,
    /// What addresses have been noted of: nothing else may come to lie there meanwhile.
    alive: Vec<Box<dyn Any + Send + Sync>>,
    nodes: Vec<String>,
    node_ids: HashMap<NodeId, u64>,
    settings: BTreeMap<String, String>,
    /// True if what cannot be saved is to stand there by its kind.
    pub(crate) describes: bool,
}

impl std::fmt::Debug for SceneWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SceneWriter({} objects, {} nodes)", self.objects.len(), self.nodes.len())
    }
}

impl SceneWriter {
    /// With everything that is in a world.
    ///
    /// # Errors
    /// [`SaveError`] with the name of the node for a shape or an attachment that does not say how it is saved, for a
    /// user's value of a type that a file does not know, and for detached nodes, which belong to no place.
    pub fn new<A: Attachment + SceneObject>(world: &World<A>) -> Result<Self, SaveError> {
        let mut writer = Self::empty();
        world.write(&mut writer)?;
        Ok(writer)
    }

    /// What is in a world, as text that can be compared with that of another. Everything that can be saved stands in it
    /// to the last bit; what does not say how it is saved stands there by its kind alone, and nothing can be read back.
    pub fn describe<A: Attachment + SceneObject>(world: &World<A>) -> String {
        let mut writer = Self { describes: true, ..Self::empty() };
        match world.write(&mut writer) {
            Ok(()) => writer.to_json(),
            Err(error) => format!("{error}\n{}", writer.to_json()),
        }
    }

    fn empty() -> Self {
        Self {
            name: String::new(),
            meta: None,
            acceleration: "",
            objects: Vec::new(),
            by_text: HashMap::new(),
            by_address: HashMap::new(),
            alive: Vec::new(),
            nodes: Vec::new(),
            node_ids: HashMap::new(),
            settings: BTreeMap::new(),
            describes: false,
        }
    }

    /// What an object says of itself, or its kind where a description has to do without.
    fn saved(&self, saved: Result<Saved, SaveError>) -> Result<Saved, SaveError> {
        match saved {
            Err(error) if self.describes => Ok(Saved::new(error.to_string())),
            other => other,
        }
    }

    /// Keeps a camera, a pipeline or anything else that is [`Storable`] under a name.
    ///
    /// # Errors
    /// Whatever prevents it from being saved, or [`SaveError::NoPlace`] for a name that is taken.
    pub fn keep<T: Storable>(&mut self, name: &str, value: &T) -> Result<(), SaveError> {
        let saved = value.save(Saved::new(T::KIND), self);
        let body = saved.and_then(|saved| saved.body(None)).map_err(|e| e.at(format!("'{name}'")))?;
        if self.settings.insert(name.to_owned(), body).is_some() {
            return Err(SaveError::NoPlace(format!("a second '{name}'")));
        }
        Ok(())
    }

    /// Writes another object, unless it stands there already, and gives the number to refer to it.
    ///
    /// # Errors
    /// Whatever prevents it from being saved.
    pub fn object<T: SceneObject + ?Sized>(&mut self, object: &T) -> Result<Reference, SaveError> {
        let saved = object.save(self);
        let saved = self.saved(saved)?;
        self.put(T::ROLE, saved)
    }

    /// As [`object`](Self::object), and looks only once at what is shared.
    ///
    /// # Errors
    /// Whatever prevents it from being saved.
    pub fn shared_object<T: SceneObject + ?Sized>(
        &mut self,
        object: &Arc<T>,
    ) -> Result<Reference, SaveError> {
        let saved = self.shared(object, |object, writer| object.save(writer));
        let saved = self.saved(saved)?;
        self.put(T::ROLE, saved)
    }

    /// Saves what is shared unless that has been done before: for wrappers that pass the question on.
    ///
    /// # Errors
    /// Those of `save`.
    pub fn shared<T: ?Sized + Send + Sync + 'static>(
        &mut self,
        object: &Arc<T>,
        save: impl FnOnce(&T, &mut Self) -> Result<Saved, SaveError>,
    ) -> Result<Saved, SaveError> {
        let address = Arc::as_ptr(object).cast::<()>() as usize;
        if let Some(&id) = self.by_address.get(&address) {
            return Ok(Saved::again(id));
        }
        let mut saved = save(object, self)?;
        saved.addresses.push(address);
        self.alive.push(Box::new(object.clone()));
        Ok(saved)
    }

    fn put(&mut self, role: &'static str, saved: Saved) -> Result<Reference, SaveError> {
        let id = match saved.known {
            Some(id) if saved.is_bare() => id,
            Some(id) => return Err(SaveError::NoPlace(format!("a field added to the shared object {id}"))),
            None => {
                let body: Arc<str> = match saved.body(Some(role)) {
                    Err(error) if self.describes => error.to_string().into(),
                    body => body?.into(),
                };
                let next = self.objects.len() as u64;
                let id = *self.by_text.entry(body.clone()).or_insert(next);
                if id == next {
                    self.objects.push(body);
                }
                id
            }
        };
        self.by_address.extend(saved.addresses.iter().map(|&address| (address, id)));
        Ok(Reference(id))
    }

    /// The number to refer to a node of the world.
    ///
    /// # Errors
    /// [`SaveError::NoPlace`] for a node of another world.
    pub fn node(&self, node: NodeId) -> Result<Reference, SaveError> {
        let id = self.node_ids.get(&node).copied();
        id.map(Reference).ok_or_else(|| SaveError::NoPlace(format!("{node} of another world")))
    }

    /// Numbers nodes in the order in which they come: the root is 0 and has no line of its own.
    pub(crate) fn root(&mut self, root: NodeId) {
        self.node_ids.insert(root, 0);
    }

    pub(crate) fn add_node(&mut self, node: NodeId, saved: &Saved) -> Result<(), SaveError> {
        let id = self.node_ids.len() as u64;
        self.node_ids.insert(node, id);
        self.nodes.push(format!("{{\"id\": {id}, {}}}", saved.body(None)?));
        Ok(())
    }

    /// The file as text.
    pub fn to_json(&self) -> String {
        let objects = self.objects.iter().enumerate();
        let objects: Vec<String> = objects.map(|(id, body)| format!("{{\"id\": {id}, {body}}}")).collect();
        let settings = self.settings.iter();
        let settings: Vec<String> =
            settings.map(|(name, body)| format!("{}: {{{body}}}", Value::from(name.as_str()))).collect();
        let list = |lines: &[String]| match lines {
            [] => String::new(),
            lines => format!("\n  {}\n", lines.join(",\n  ")),
        };
        let meta = self.meta.as_ref().map_or(String::new(), |meta| format!("\"meta\": {meta},\n"));
        format!(
            "{{\n\"format\": \"{FORMAT}\",\n\"version\": {VERSION},\n\"name\": {},\n\"acceleration\": \"{}\",\n{meta}\
             \"objects\": [{}],\n\"nodes\": [{}],\n\"settings\": {{{}}}\n}}\n",
            Value::from(self.name.as_str()),
            self.acceleration,
            list(&objects),
            list(&self.nodes),
            list(&settings),
        )
    }

    /// Writes the file. At any moment it is either the old one or the whole new one.
    ///
    /// # Errors
    /// [`SaveError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), SaveError> {
        let path = path.as_ref();
        crate::write_atomically(path, |file| file.write_all(self.to_json().as_bytes()))
            .map_err(|error| SaveError::File { path: path.to_owned(), source: Box::new(error.into()) })
    }
}
