//! The world of optics: shapes with materials.

use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneObject, SceneWriter};
use raysect_core::{Attachment, Instance, Node, NodeId, Primitive};

use crate::illumination::Illumination;
use crate::{Material, OpticalError};

/// What hangs on a shape in an optical world: its material.
pub struct Optics(pub(crate) Arc<dyn Material>);

impl Optics {
    /// Around a material.
    pub fn new(material: impl Material) -> Self {
        Self(Arc::new(material))
    }

    /// The material.
    pub fn material(&self) -> &dyn Material {
        &*self.0
    }
}

impl std::fmt::Debug for Optics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Optics({})", self.0.facts().name)
    }
}

impl SceneObject for Optics {
    const ROLE: &'static str = "material";

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        writer.shared(&self.0, |material, writer| material.save(writer))
    }
}

/// A world of shapes with materials.
pub type World = raysect_core::World<Optics>;

/// A compiled optical world.
pub type Scene = raysect_core::Scene<Optics>;

impl Attachment for Optics {
    type Compiled = Illumination;

    fn compile(
        instances: &[Instance<Self>],
    ) -> Result<Illumination, Box<dyn std::error::Error + Send + Sync>> {
        for instance in instances {
            let material = instance.attached.material();
            material.facts().check().map_err(OpticalError::from)?;
            if material.medium().is_some() && !instance.primitive.is_solid() {
                let (material, shape) = (material.facts().name, format!("{instance:?}"));
                return Err(OpticalError::NoVolume { material, shape }.into());
            }
        }
        Ok(Illumination::compile(instances))
    }
}

/// Gives shapes a material.
pub trait WithMaterial: Primitive + Sized {
    /// A node of this shape with a material, to be added to a [`World`].
    fn material(self, material: impl Material) -> Node<Optics> {
        Node::of(self, Optics::new(material))
    }
}

impl<P: Primitive> WithMaterial for P {}

/// Changes materials in an optical world.
pub trait Materials {
    /// Gives a shape another material; `false` if the node is not a shape.
    ///
    /// # Errors
    /// [`raysect_core::CoreError::UnknownNode`].
    fn set_material(&mut self, node: NodeId, material: impl Material) -> Result<bool, OpticalError>;
}

impl Materials for World {
    fn set_material(&mut self, node: NodeId, material: impl Material) -> Result<bool, OpticalError> {
        Ok(self.set_attached(node, Optics::new(material))?)
    }
}
