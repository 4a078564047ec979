use std::fmt;
use std::path::Path;

use serde_json::{Map, Value};

use super::entry::Made;
use super::strict::parse;
use super::{Entry, FORMAT, Registry, SaveError, SceneObject, Storable, VERSION};
use crate::{Attachment, NodeId, World};

/// A world as a file had it, and what was kept with it.
pub struct SavedScene<A: Attachment> {
    /// The world. Its nodes have the order of the tree that was saved, and ids of their own.
    pub world: World<A>,
    made: Made,
    settings: Map<String, Value>,
}

impl<A: Attachment> fmt::Debug for SavedScene<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kept: Vec<&str> = self.names().collect();
        write!(f, "SavedScene({} nodes, {kept:?})", self.made.nodes.len())
    }
}

impl<A: Attachment + SceneObject> SavedScene<A> {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SaveError::File`] with the path and what [`from_json`](Self::from_json) says, or the operating system.
    pub fn load(path: impl AsRef<Path>, registry: &Registry) -> Result<Self, SaveError> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path).map_err(SaveError::from);
        text.and_then(|text| Self::from_json(&text, registry))
            .map_err(|source| SaveError::File { path: path.to_owned(), source: Box::new(source) })
    }

    /// Reads a text that a [`SceneWriter`](super::SceneWriter) has written, or somebody by hand.
    ///
    /// Everything goes through the constructors of the types, with whatever they refuse.
    ///
    /// # Errors
    /// [`SaveError`], with line and column for what is not JSON, and with the object, node or setting for what makes
    /// no sense.
    pub fn from_json(text: &str, registry: &Registry) -> Result<Self, SaveError> {
        let value = parse(text)?;
        let nothing = Made::default();
        let file = Entry::of(&value, &nothing)?;
        check_version(&file)?;
        let mut made = Made::default();
        for (place, object) in file.list("objects")?.iter().enumerate() {
            make_object(object, registry, &mut made).map_err(|e| e.at(label("object", place, object)))?;
        }
        let mut world = World::new();
        world.read_root(&file)?;
        made.nodes.insert(0, world.root());
        for (place, node) in file.list("nodes")?.iter().enumerate() {
            make_node(node, &mut world, &mut made).map_err(|e| e.at(label("node", place, node)))?;
        }
        let settings = file.map("settings")?.clone();
        file.finish()?;
        Ok(Self { world, made, settings })
    }

    /// What was kept under a name.
    ///
    /// # Errors
    /// [`SaveError::At`] with the name, if nothing was kept under it, or something of another kind, or what its
    /// constructor refuses.
    pub fn get<T: Storable>(&self, name: &str) -> Result<T, SaveError> {
        self.read(name).map_err(|error| error.at(format!("'{name}'")))
    }

    fn read<T: Storable>(&self, name: &str) -> Result<T, SaveError> {
        let Some(value) = self.settings.get(name) else {
            let known = self.names().collect::<Vec<_>>().join(", ");
            return Err(SaveError::content(format!("nothing is kept under this name; there are: {known}")));
        };
        let entry = Entry::of(value, &self.made)?;
        let kind = entry.text("kind")?;
        if kind != T::KIND {
            return Err(SaveError::content(format!("it is a {kind}, not a {}", T::KIND)));
        }
        let value = T::load(&entry).map_err(SaveError::refused)?;
        entry.finish()?;
        Ok(value)
    }
}

impl<A: Attachment> SavedScene<A> {
    /// The names under which something was kept, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.settings.keys().map(String::as_str)
    }

    /// The node that has a number in the file; 0 is the root.
    pub fn node(&self, id: u64) -> Option<NodeId> {
        self.made.nodes.get(&id).copied()
    }
}

fn check_version(file: &Entry<'_>) -> Result<(), SaveError> {
    let format = file.text("format")?;
    if format != FORMAT {
        return Err(SaveError::content(format!("the format is '{format}', not '{FORMAT}'")));
    }
    let found = file.count("version")?;
    if found != VERSION {
        return Err(SaveError::Version { found, known: VERSION });
    }
    Ok(())
}

fn make_object(object: &Value, registry: &Registry, made: &mut Made) -> Result<(), SaveError> {
    let entry = Entry::of(object, made)?;
    let id = entry.count("id")?;
    if made.objects.contains_key(&id) {
        return Err(SaveError::content(format!("an object before has the number {id}, too")));
    }
    let object = registry.make(entry.text("role")?, entry.text("kind")?, &entry)?;
    made.objects.insert(id, object);
    Ok(())
}

fn make_node<A: Attachment + SceneObject>(
    node: &Value,
    world: &mut World<A>,
    made: &mut Made,
) -> Result<(), SaveError> {
    let entry = Entry::of(node, made)?;
    let id = entry.count("id")?;
    if made.nodes.contains_key(&id) {
        return Err(SaveError::content(format!("a node before has the number {id}, too")));
    }
    let node = world.read_node(&entry)?;
    entry.finish()?;
    made.nodes.insert(id, node);
    Ok(())
}

/// What an entry is called in messages: its place in the list, counted from 0, its number, its kind and its name.
fn label(list: &str, place: usize, value: &Value) -> String {
    let word = |key: &str| value.get(key).and_then(Value::as_str);
    let id = value.get("id").map_or(String::new(), |id| format!(" with id {id}"));
    let kind = word("kind").map_or(String::new(), |kind| format!(", {kind}"));
    let name = word("name").map_or(String::new(), |name| format!(" '{name}'"));
    format!("{list}s[{place}]{id}{kind}{name}")
}
