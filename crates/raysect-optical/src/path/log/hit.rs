use raysect_core::NodeId;
use raysect_math::{Normal3D, Point3D};

/// What a path meets at a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexHit {
    /// The node of the shape.
    pub node: NodeId,
    /// The name of the node, if it has one, and names were [asked for](super::LoggedPath::with_names).
    pub name: String,
    /// What the shape is.
    pub shape: &'static str,
    /// What its material is called.
    pub material: String,
    /// True if the path arrives at the inner side of the surface, or is inside its volume.
    pub inside: bool,
    /// The place in the space of the shape [m].
    pub local_point: Point3D,
    /// Outward unit normal of the surface, in world space; none where the volume scatters.
    pub normal: Option<Normal3D>,
}
