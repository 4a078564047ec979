use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use raysect_math::AffineMatrix3D;

use crate::{CoreError, Primitive};

/// Names a node of a world. Ids of other worlds and of removed nodes are recognised and refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId {
    pub(crate) world: u32,
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "node {}.{}", self.world, self.index)
    }
}

/// What a node is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeKind {
    /// A coordinate frame that other nodes hang in.
    Group,
    /// The seat of a camera or sensor.
    Observer,
    /// A shape.
    Shape,
}

/// A user's values by name.
pub(crate) type Meta = BTreeMap<String, Arc<dyn Any + Send + Sync>>;

/// A node to be added to a [`World`](crate::World): a frame, an observer or a shape.
pub struct Node<A> {
    kind: NodeKind,
    shape: Option<(Arc<dyn Primitive>, Arc<A>)>,
    pub(crate) transform: AffineMatrix3D,
    pub(crate) parent: Option<NodeId>,
    pub(crate) name: String,
    pub(crate) meta: Meta,
}

impl<A> fmt::Debug for Node<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.label())
    }
}

impl<A> Node<A> {
    pub(super) fn new(kind: NodeKind, shape: Option<(Arc<dyn Primitive>, Arc<A>)>) -> Self {
        Self {
            kind,
            shape,
            transform: AffineMatrix3D::IDENTITY,
            parent: None,
            name: String::new(),
            meta: Meta::new(),
        }
    }

    /// A coordinate frame that other nodes hang in.
    pub fn group() -> Self {
        Self::new(NodeKind::Group, None)
    }

    /// The seat of a camera or sensor, which moves with its parents.
    pub fn observer() -> Self {
        Self::new(NodeKind::Observer, None)
    }

    /// A shape with what is attached to it.
    pub fn of(primitive: impl Primitive, attached: A) -> Self {
        Self::new(NodeKind::Shape, Some((Arc::new(primitive), Arc::new(attached))))
    }

    /// Places it relative to its parent.
    pub fn transform(mut self, transform: AffineMatrix3D) -> Self {
        self.transform = transform;
        self
    }

    /// Hangs it under a node instead of the root.
    pub fn parent(mut self, parent: NodeId) -> Self {
        self.parent = Some(parent);
        self
    }

    /// Names it.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Keeps a user's own value with it.
    pub fn meta(mut self, key: impl Into<String>, value: impl Any + Send + Sync) -> Self {
        self.meta.insert(key.into(), Arc::new(value));
        self
    }

    pub(crate) fn kind(&self) -> NodeKind {
        self.kind
    }

    pub(crate) fn is_shape(&self) -> bool {
        self.shape.is_some()
    }

    pub(crate) fn shape(&self) -> Option<&(Arc<dyn Primitive>, Arc<A>)> {
        self.shape.as_ref()
    }

    pub(crate) fn set_attached(&mut self, attached: A) -> bool {
        match &mut self.shape {
            Some(shape) => {
                shape.1 = Arc::new(attached);
                true
            }
            None => false,
        }
    }

    /// Its name, or what it is.
    pub(crate) fn label(&self) -> String {
        let kind = match (&self.shape, self.kind) {
            (Some((primitive, _)), _) => primitive.kind(),
            (None, NodeKind::Observer) => "Observer",
            (None, _) => "Group",
        };
        if self.name.is_empty() { kind.to_owned() } else { format!("{} ({kind})", self.name) }
    }

    pub(crate) fn check(&self) -> Result<(), CoreError> {
        match self.transform.inverse() {
            Ok(_) => Ok(()),
            Err(source) => Err(CoreError::Transform { name: self.label(), source }),
        }
    }
}

impl<P: Primitive> From<P> for Node<()> {
    fn from(primitive: P) -> Self {
        Self::of(primitive, ())
    }
}
