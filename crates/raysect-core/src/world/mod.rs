//! The scene-graph: a description of the world that compiles into a [`Scene`].

mod node;
mod saving;
mod tree;

use std::any::Any;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, OnceLock};

use raysect_math::{AffineMatrix3D, Point3D};

pub use node::{Node, NodeId, NodeKind};
use tree::Slot;

use crate::{
    Acceleration, Candidate, CoreError, Instance, Intersection, Primitive, Ray, Scene, Scratch, SurfacePoint,
};

/// What hangs on the shapes of a world, and what the compiled scene knows about all of it.
///
/// Optics attaches materials; `()` attaches nothing, for geometry alone.
pub trait Attachment: Send + Sync + Sized + 'static {
    /// What is made of all attachments of a scene: lights, facts, tables.
    type Compiled: Send + Sync;

    /// Called once for each compiled scene.
    ///
    /// # Errors
    /// Whatever makes the combination of shapes and attachments impossible.
    fn compile(
        instances: &[Instance<Self>],
    ) -> Result<Self::Compiled, Box<dyn std::error::Error + Send + Sync>>;
}

impl Attachment for () {
    type Compiled = ();
    fn compile(_: &[Instance<()>]) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        Ok(())
    }
}

/// A tree of coordinate frames, shapes and observers.
///
/// It is a description: changed through `&mut`, compiled into a [`Scene`] at the first question after a change.
/// Adding or moving a frame or an observer keeps the compiled scene; several worlds may live side by side.
///
/// ```
/// use raysect_core::{Node, Ray, World};
/// use raysect_math::{Vector3D, Point3D, translate};
/// # use raysect_core::testing::Ball;
/// let mut world = World::<()>::new();
/// let group = world.add(Node::group().transform(translate(0.0, 0.0, 5.0)))?;
/// let ball = world.add(Node::of(Ball::new(1.0), ()).parent(group).name("ball"))?;
/// let hit = world.hit(&Ray::new(Point3D::ORIGIN, Vector3D::Z))?.unwrap();
/// assert_eq!((hit.node, hit.distance()), (ball, 4.0));
/// # Ok::<(), raysect_core::CoreError>(())
/// ```
pub struct World<A: Attachment> {
    slots: Vec<Slot<A>>,
    free: Vec<u32>,
    tag: u32,
    acceleration: Acceleration,
    scene: OnceLock<Scene<A>>,
}

static NEXT_TAG: AtomicU32 = AtomicU32::new(0);

impl<A: Attachment> Default for World<A> {
    fn default() -> Self {
        Self::new()
    }
}

impl<A: Attachment> std::fmt::Debug for World<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.tree())
    }
}

impl<A: Attachment> World<A> {
    /// An empty world: only the root.
    pub fn new() -> Self {
        let root = Slot::new(Node::group().name("world"), None, 0);
        Self {
            slots: vec![root],
            free: Vec::new(),
            tag: NEXT_TAG.fetch_add(1, Ordering::Relaxed),
            acceleration: Acceleration::default(),
            scene: OnceLock::new(),
        }
    }

    /// The root of the tree.
    pub fn root(&self) -> NodeId {
        NodeId { world: self.tag, index: 0, generation: 0 }
    }

    /// Adds a node under its parent, or under the root.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`] for a parent of another world, [`CoreError::Transform`] for a transform without
    /// inverse.
    pub fn add(&mut self, node: impl Into<Node<A>>) -> Result<NodeId, CoreError> {
        let node = node.into();
        node.check()?;
        let parent = node.parent.unwrap_or(self.root());
        let parent_index = self.index(parent)?;
        if node.is_shape() {
            self.scene.take();
        }
        let index = match self.free.pop() {
            Some(index) => {
                let generation = self.slots[index as usize].generation;
                self.slots[index as usize] = Slot::new(node, Some(parent_index), generation);
                index
            }
            None => {
                self.slots.push(Slot::new(node, Some(parent_index), 0));
                self.slots.len() as u32 - 1
            }
        };
        self.slots[parent_index as usize].children.push(index);
        Ok(self.id(index))
    }

    /// Moves a node relative to its parent.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], [`CoreError::Root`], [`CoreError::Transform`].
    pub fn set_transform(&mut self, node: NodeId, transform: AffineMatrix3D) -> Result<(), CoreError> {
        let index = self.movable(node)?;
        self.slots[index as usize].node.transform = transform;
        self.slots[index as usize].node.check()?;
        self.forget_if_shapes(index);
        Ok(())
    }

    /// Hangs a node, with all below it, under another parent; also brings a detached one back.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], [`CoreError::Root`], or [`CoreError::Cycle`] if the parent lies below the node.
    pub fn set_parent(&mut self, node: NodeId, parent: NodeId) -> Result<(), CoreError> {
        let (index, target) = (self.movable(node)?, self.index(parent)?);
        if self.ancestors(target).any(|i| i == index) {
            return Err(CoreError::Cycle { node, parent });
        }
        self.unhang(index);
        self.slots[index as usize].parent = Some(target);
        self.slots[target as usize].children.push(index);
        self.forget_if_shapes(index);
        Ok(())
    }

    /// Takes a node, with all below it, out of the tree. It keeps its id and can be hung in again with
    /// [`set_parent`](Self::set_parent); until then it is not part of the scene.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], [`CoreError::Root`].
    pub fn detach(&mut self, node: NodeId) -> Result<(), CoreError> {
        let index = self.movable(node)?;
        self.forget_if_shapes(index);
        self.unhang(index);
        Ok(())
    }

    /// Removes a node and all below it for good; their ids become unknown.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`], [`CoreError::Root`].
    pub fn remove(&mut self, node: NodeId) -> Result<(), CoreError> {
        let index = self.movable(node)?;
        self.forget_if_shapes(index);
        self.unhang(index);
        for gone in self.below(index) {
            let slot = &mut self.slots[gone as usize];
            let generation = slot.generation.wrapping_add(1);
            *slot = Slot::new(Node::group(), None, generation);
            slot.vacant = true;
            self.free.push(gone);
        }
        Ok(())
    }

    /// Renames a node.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn set_name(&mut self, node: NodeId, name: impl Into<String>) -> Result<(), CoreError> {
        let index = self.index(node)?;
        self.slots[index as usize].node.name = name.into();
        Ok(())
    }

    /// Replaces what is attached to a shape; `false` if the node is not a shape.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    #[doc(alias = "material")]
    pub fn set_attached(&mut self, node: NodeId, attached: A) -> Result<bool, CoreError> {
        let index = self.index(node)?;
        self.scene.take();
        Ok(self.slots[index as usize].node.set_attached(attached))
    }

    /// Keeps a user's own value with a node, under a key.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn set_meta(
        &mut self,
        node: NodeId,
        key: impl Into<String>,
        value: impl Any + Send + Sync,
    ) -> Result<(), CoreError> {
        let index = self.index(node)?;
        self.slots[index as usize].node.meta.insert(key.into(), Arc::new(value));
        Ok(())
    }

    /// A user's value kept with a node, if there is one of this type under the key.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn meta<T: Any>(&self, node: NodeId, key: &str) -> Result<Option<&T>, CoreError> {
        Ok(self.node(node)?.meta.get(key).and_then(|v| (**v).downcast_ref()))
    }

    /// Chooses the acceleration structure and drops the compiled scene, so that the next question rebuilds it.
    #[doc(alias = "accelerator")]
    pub fn set_acceleration(&mut self, acceleration: Acceleration) {
        self.acceleration = acceleration;
        self.scene.take();
    }

    /// Compiles the scene now, anew even if nothing has changed.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    #[doc(alias = "build_accelerator")]
    pub fn rebuild(&mut self) -> Result<(), CoreError> {
        self.scene.take();
        self.scene().map(|_| ())
    }

    /// True if a compiled scene is at hand; a change of a shape drops it.
    pub fn is_compiled(&self) -> bool {
        self.scene.get().is_some()
    }

    /// The compiled scene.
    ///
    /// # Errors
    /// [`CoreError::Transform`] if a chain of transforms has no inverse, [`CoreError::Compile`] if the attachments
    /// refuse.
    pub fn scene(&self) -> Result<&Scene<A>, CoreError> {
        if let Some(scene) = self.scene.get() {
            return Ok(scene);
        }
        let scene = self.compile()?;
        Ok(self.scene.get_or_init(|| scene))
    }

    fn compile(&self) -> Result<Scene<A>, CoreError> {
        let mut instances = Vec::new();
        for index in self.below(0) {
            let slot = &self.slots[index as usize];
            let Some((primitive, attached)) = slot.node.shape() else { continue };
            let to_world = self.root_transform(index);
            let to_local = to_world
                .inverse()
                .map_err(|source| CoreError::Transform { name: self.label(index), source })?;
            instances.push(Instance::new(
                primitive.clone(),
                attached.clone(),
                to_world,
                to_local,
                self.id(index),
            ));
        }
        let compiled = A::compile(&instances).map_err(CoreError::Compile)?;
        Ok(Scene::new(instances, compiled, &self.acceleration))
    }

    /// The nearest hit of a ray.
    ///
    /// # Errors
    /// [`CoreError::Ray`] for a ray that leads nowhere; as [`scene`](Self::scene).
    pub fn hit(&self, ray: &Ray) -> Result<Option<Intersection>, CoreError> {
        ray.check()?;
        let scene = self.scene()?;
        let hit: Option<Candidate> = scene.hit(ray, None, &mut Scratch::default());
        Ok(hit.map(|h| scene.intersection(ray, &h)))
    }

    /// The surfaces at the nearest hits of many rays, in the order of the rays: as [`hit`](Self::hit) for each of them, on
    /// all processors. The node that a ray hits is that of the instance of this number in the
    /// [`scene`](Self::scene).
    ///
    /// # Errors
    /// As [`hit`](Self::hit).
    pub fn hit_all(&self, rays: &[Ray]) -> Result<Vec<Option<SurfacePoint>>, CoreError> {
        rays.iter().try_for_each(Ray::check)?;
        Ok(self.scene()?.hit_all(rays))
    }

    /// Every crossing of every shape along a ray, in order.
    ///
    /// # Errors
    /// As [`hit`](Self::hit).
    #[doc(alias = "next_intersection")]
    pub fn crossings(&self, ray: &Ray) -> Result<Vec<Intersection>, CoreError> {
        ray.check()?;
        let scene = self.scene()?;
        let all = scene.crossings(ray, &mut Scratch::default());
        Ok(all.iter().map(|h| scene.intersection(ray, h)).collect())
    }

    /// The shapes that contain a point of the world.
    ///
    /// # Errors
    /// As [`scene`](Self::scene).
    pub fn contains(&self, point: Point3D) -> Result<Vec<NodeId>, CoreError> {
        let scene = self.scene()?;
        let mut nodes = Vec::new();
        scene.containing(point, |i| nodes.push(scene.instances[i as usize].node));
        Ok(nodes)
    }

    /// The shape of a node, if it is one.
    ///
    /// # Errors
    /// [`CoreError::UnknownNode`].
    pub fn primitive(&self, node: NodeId) -> Result<Option<&Arc<dyn Primitive>>, CoreError> {
        Ok(self.node(node)?.shape().map(|(p, _)| p))
    }
}
