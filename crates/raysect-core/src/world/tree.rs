//! Walking the tree: frames, lists of nodes, the printed tree.

use raysect_math::AffineMatrix3D;

use super::{Attachment, Node, NodeId, NodeKind, World};
use crate::CoreError;

/// A place in the arena: a node with its links, or vacant.
pub(super) struct Slot<A> {
    pub(super) node: Node<A>,
    pub(super) parent: Option<u32>,
    pub(super) children: Vec<u32>,
    pub(super) generation: u32,
    pub(super) vacant: bool,
}

impl<A> Slot<A> {
    pub(super) fn new(node: Node<A>, parent: Option<u32>, generation: u32) -> Self {
        Self { node, parent, children: Vec::new(), generation, vacant: false }
    }
}

impl<A: Attachment> World<A> {
    pub(super) fn id(&self, index: u32) -> NodeId {
        NodeId { world: self.tag, index, generation: self.slots[index as usize].generation }
    }

    pub(super) fn index(&self, id: NodeId) -> Result<u32, CoreError> {
        let known = id.world == self.tag
            && self.slots.get(id.index as usize).is_some_and(|s| s.generation == id.generation && !s.vacant);
        if known { Ok(id.index) } else { Err(CoreError::UnknownNode(id)) }
    }

    pub(super) fn node(&self, id: NodeId) -> Result<&Node<A>, CoreError> {
        Ok(&self.slots[self.index(id)? as usize].node)
    }

    pub(super) fn movable(&self, id: NodeId) -> Result<u32, CoreError> {
        match self.index(id)? {
            0 => Err(CoreError::Root),
            index => Ok(index),
        }
    }

    pub(super) fn label(&self, index: u32) -> String {
        self.slots[index as usize].node.label()
    }

    /// The node itself, its parent, and so on up.
    pub(super) fn ancestors(&self, index: u32) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(Some(index), |&i| self.slots[i as usize].parent)
    }

    /// The node itself and all below it, parents before children, in the order of addition.
    pub(super) fn below(&self, index: u32) -> Vec<u32> {
        let (mut all, mut stack) = (Vec::new(), vec![index]);
        while let Some(i) = stack.pop() {
            all.push(i);
            stack.extend(self.slots[i as usize].children.iter().rev());
        }
        all
    }

    pub(super) fn unhang(&mut self, index: u32) {
        if let Some(parent) = self.slots[index as usize].parent.take() {
            self.slots[parent as usize].children.retain(|&c| c != index);
        }
    }

    /// Drops the compiled scene if shapes are moved; frames and observers alone change nothing in it.
    pub(super) fn forget_if_shapes(&mut self, index: u32) {
        if self.below(index).iter().any(|&i| self.slots[i as usize].node.is_shape()) {
            self.scene.take();
        }
    }

    pub(super) fn root_transform(&self, index: u32) -> AffineMatrix3D {
        self.ancestors(index).fold(AffineMatrix3D::IDENTITY, |m, i| self.slots[i as usize].node.transform * m)
    }

    fn top(&self, index: u32) -> u32 {
        self.ancestors(index).last().unwrap_or(index)
    }

    /// The map from the space of a node to that of another one in the same tree.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], or [`CoreError::Unconnected`] if one of them is detached.
    pub fn to(&self, from: NodeId, target: NodeId) -> Result<AffineMatrix3D, CoreError> {
        let (a, b) = (self.index(from)?, self.index(target)?);
        if self.top(a) != self.top(b) {
            return Err(CoreError::Unconnected(from, target));
        }
        let into = self
            .root_transform(b)
            .inverse()
            .map_err(|source| CoreError::Transform { name: self.label(b), source })?;
        Ok(into * self.root_transform(a))
    }

    /// The map from the space of a node to that of the root of its tree.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn to_root(&self, node: NodeId) -> Result<AffineMatrix3D, CoreError> {
        Ok(self.root_transform(self.index(node)?))
    }

    /// The map from the root of the tree of a node to the space of the node.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], [`CoreError::Transform`].
    pub fn to_local(&self, node: NodeId) -> Result<AffineMatrix3D, CoreError> {
        let index = self.index(node)?;
        self.root_transform(index)
            .inverse()
            .map_err(|source| CoreError::Transform { name: self.label(index), source })
    }

    /// The transform of a node relative to its parent.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn transform(&self, node: NodeId) -> Result<AffineMatrix3D, CoreError> {
        Ok(self.node(node)?.transform)
    }

    /// The parent of a node; none for the root and for a detached node.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn parent(&self, node: NodeId) -> Result<Option<NodeId>, CoreError> {
        Ok(self.slots[self.index(node)? as usize].parent.map(|i| self.id(i)))
    }

    /// The nodes that hang directly under a node, in the order of addition.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn children(&self, node: NodeId) -> Result<Vec<NodeId>, CoreError> {
        Ok(self.slots[self.index(node)? as usize].children.iter().map(|&i| self.id(i)).collect())
    }

    /// The name of a node, empty if it has none.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn name(&self, node: NodeId) -> Result<&str, CoreError> {
        Ok(&self.node(node)?.name)
    }

    /// What a node is.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn kind(&self, node: NodeId) -> Result<NodeKind, CoreError> {
        Ok(self.node(node)?.kind())
    }

    fn of_kind(&self, kind: NodeKind) -> Vec<NodeId> {
        let all = self.below(0).into_iter();
        all.filter(|&i| self.slots[i as usize].node.kind() == kind).map(|i| self.id(i)).collect()
    }

    /// The shapes of the world, in the order of the tree.
    pub fn primitives(&self) -> Vec<NodeId> {
        self.of_kind(NodeKind::Shape)
    }

    /// The observers of the world, in the order of the tree.
    pub fn observers(&self) -> Vec<NodeId> {
        self.of_kind(NodeKind::Observer)
    }

    /// The first node with a name, in the order of the tree.
    pub fn find(&self, name: &str) -> Option<NodeId> {
        self.below(0).into_iter().find(|&i| self.slots[i as usize].node.name == name).map(|i| self.id(i))
    }

    /// The tree as text, one node a line.
    #[doc(alias = "print_scenegraph")]
    pub fn tree(&self) -> String {
        self.print(None)
    }

    /// The tree as text, with a mark at one node.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn tree_marking(&self, node: NodeId) -> Result<String, CoreError> {
        Ok(self.print(Some(self.index(node)?)))
    }

    fn print(&self, marked: Option<u32>) -> String {
        let mut text = String::new();
        self.print_below(0, "", "", marked, &mut text);
        text
    }

    fn print_below(&self, index: u32, lead: &str, indent: &str, marked: Option<u32>, text: &mut String) {
        let mark = if marked == Some(index) { "  <" } else { "" };
        text.push_str(&format!("{lead}{}{mark}\n", self.label(index)));
        let children = &self.slots[index as usize].children;
        for (i, &child) in children.iter().enumerate() {
            let last = i + 1 == children.len();
            let (branch, rest) = if last { ("└─ ", "   ") } else { ("├─ ", "│  ") };
            self.print_below(child, &format!("{indent}{branch}"), &format!("{indent}{rest}"), marked, text);
        }
    }
}
