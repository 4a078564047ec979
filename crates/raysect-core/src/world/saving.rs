//! A world to and from a file.

use std::any::Any;
use std::sync::Arc;

use serde_json::{Map, Value};

use super::node::Meta;
use super::{Attachment, Node, NodeId, NodeKind, World};
use crate::Acceleration;
use crate::save::{Entry, SaveError, Saved, SceneObject, SceneWriter};

/// Users' values that a file knows, each by the name of its type.
macro_rules! plain_values {
    ($($name:literal $type:ty, $write:expr, $read:expr;)+) => {
        fn meta_to_json(value: &(dyn Any + Send + Sync)) -> Option<(&'static str, Value)> {
            $(if let Some(value) = value.downcast_ref::<$type>() {
                let write: fn(&$type) -> Option<Value> = $write;
                return Some(($name, write(value)?));
            })+
            None
        }

        fn meta_from_json(kind: &str, value: &Value) -> Option<Arc<dyn Any + Send + Sync>> {
            match kind {
                $($name => {
                    let read: fn(&Value) -> Option<$type> = $read;
                    Some(Arc::new(read(value)?))
                })+
                _ => None,
            }
        }
    };
}

plain_values! {
    "String" String, |v| Some(v.as_str().into()), |v| v.as_str().map(str::to_owned);
    "bool" bool, |&v| Some(v.into()), Value::as_bool;
    "f64" f64, |&v| v.is_finite().then(|| v.into()), Value::as_f64;
    "i32" i32, |&v| Some(v.into()), |v| v.as_i64()?.try_into().ok();
    "i64" i64, |&v| Some(v.into()), Value::as_i64;
    "u32" u32, |&v| Some(v.into()), |v| v.as_u64()?.try_into().ok();
    "u64" u64, |&v| Some(v.into()), Value::as_u64;
    "usize" usize, |&v| Some(v.into()), |v| v.as_u64()?.try_into().ok();
}

/// The accelerations that a file knows.
const ACCELERATIONS: [(&str, Acceleration); 3] =
    [("Automatic", Acceleration::Automatic), ("List", Acceleration::List), ("Tree", Acceleration::Tree)];

/// What the fields `kind` of nodes say.
const KINDS: [(&str, NodeKind); 3] =
    [("group", NodeKind::Group), ("observer", NodeKind::Observer), ("shape", NodeKind::Shape)];

impl<A: Attachment + SceneObject> World<A> {
    /// Puts everything into a file.
    pub(crate) fn write(&self, writer: &mut SceneWriter) -> Result<(), SaveError> {
        writer.acceleration = match self.acceleration {
            Acceleration::Automatic => "Automatic",
            Acceleration::List => "List",
            Acceleration::Tree => "Tree",
            Acceleration::Custom(_) if writer.describes => "Custom",
            Acceleration::Custom(_) => {
                return Err(SaveError::NoPlace("an acceleration structure of the user's own".to_owned()));
            }
        };
        let loose = (1..self.slots.len()).find(|&i| !self.slots[i].vacant && self.slots[i].parent.is_none());
        if let Some(index) = loose.filter(|_| !writer.describes) {
            let label = self.label(index as u32);
            return Err(SaveError::NoPlace(format!("the detached node '{label}'")));
        }
        let root = &self.slots[0].node;
        writer.meta = meta_of(root, writer)?;
        writer.name.clone_from(&root.name);
        writer.root(self.root());
        for index in self.below(0).into_iter().skip(1) {
            self.write_node(index, writer)
                .map_err(|error| error.at(format!("node '{}'", self.label(index))))?;
        }
        Ok(())
    }

    fn write_node(&self, index: u32, writer: &mut SceneWriter) -> Result<(), SaveError> {
        let slot = &self.slots[index as usize];
        let node = &slot.node;
        let kind = KINDS.iter().find(|(_, kind)| *kind == node.kind()).map_or("", |(name, _)| name);
        let mut saved = Saved::new(kind);
        if !node.name.is_empty() {
            saved = saved.text("name", &node.name);
        }
        if let Some(parent) = slot.parent.filter(|&parent| parent != 0) {
            saved = saved.reference("parent", writer.node(self.id(parent))?);
        }
        saved = saved.transform("transform", &node.transform);
        if let Some((primitive, attached)) = node.shape() {
            saved = saved.reference("shape", writer.shared_object(primitive)?);
            saved = saved.reference(A::ROLE, writer.shared_object(attached)?);
        }
        if let Some(meta) = meta_of(node, writer)? {
            saved = saved.field("meta", meta);
        }
        writer.add_node(self.id(index), &saved)
    }

    /// Takes over what a file says of the whole.
    pub(crate) fn read_root(&mut self, file: &Entry<'_>) -> Result<(), SaveError> {
        file.text("name")?.clone_into(&mut self.slots[0].node.name);
        self.slots[0].node.meta = read_meta(file)?;
        self.acceleration = file.choice("acceleration", &ACCELERATIONS)?;
        Ok(())
    }

    /// Adds a node as a file describes it.
    pub(crate) fn read_node(&mut self, entry: &Entry<'_>) -> Result<NodeId, SaveError> {
        let kind = entry.choice("kind", &KINDS)?;
        let shape = match kind {
            NodeKind::Shape => Some((entry.object("shape")?, entry.object(A::ROLE)?)),
            NodeKind::Group | NodeKind::Observer => None,
        };
        let mut node = Node::new(kind, shape).transform(entry.transform("transform")?);
        if entry.has("name") {
            node = node.name(entry.text("name")?);
        }
        if entry.has("parent") {
            node = node.parent(entry.node("parent")?);
        }
        node.meta = read_meta(entry)?;
        Ok(self.add(node)?)
    }
}

/// The users' values of a node; a description does without those that cannot be saved.
fn meta_of<A>(node: &Node<A>, writer: &SceneWriter) -> Result<Option<Value>, SaveError> {
    match write_meta(&node.meta) {
        Err(_) if writer.describes => Ok(None),
        other => other,
    }
}

/// The users' values of a node, if there are some: each with its type, as in `{"channel": {"u32": 7}}`.
fn write_meta(meta: &Meta) -> Result<Option<Value>, SaveError> {
    let mut all = Map::new();
    for (key, value) in meta {
        let Some((kind, value)) = meta_to_json(&**value) else {
            let what = format!("the user's value '{key}', which is of no plain type or not finite,");
            return Err(SaveError::NoPlace(what));
        };
        all.insert(key.clone(), Value::Object([(kind.to_owned(), value)].into_iter().collect()));
    }
    Ok((!all.is_empty()).then_some(Value::Object(all)))
}

fn read_meta(entry: &Entry<'_>) -> Result<Meta, SaveError> {
    let mut meta = Meta::new();
    if entry.has("meta") {
        for (key, value) in entry.map("meta")? {
            let typed = value.as_object().filter(|typed| typed.len() == 1).and_then(|t| t.iter().next());
            let Some(value) = typed.and_then(|(kind, value)| meta_from_json(kind, value)) else {
                let what = format!("the user's value '{key}' must be like {{\"f64\": 0.5}}, not {value}");
                return Err(SaveError::Content(what));
            };
            meta.insert(key.clone(), value);
        }
    }
    Ok(meta)
}
