//! What almost every program uses: `use raysect::prelude::*;`.

pub use crate::core::{Acceleration, Multicore, Node, NodeId, Primitive, Serial};
pub use crate::math::units::{cm, foot, inch, km, mm, nm, um};
pub use crate::math::{
    AffineMatrix3D, Normal3D, Point2D, Point3D, Vector2D, Vector3D, rotate, rotate_basis, rotate_vector,
    rotate_x, rotate_y, rotate_z, translate,
};
pub use crate::observer::{
    CancelToken, Estimate, Frame, Observer, PinholeCamera, Pipeline, Pipelines, PowerPipeline2D,
    RadiancePipeline2D, RenderReport, RgbPipeline2D, Scope, Sensor, Stop, minutes, seconds,
};
pub use crate::optical::library::schott;
pub use crate::optical::{
    AbsorbingSurface, Add, AnisotropicSurfaceEmitter, Blend, Bsdf, Checkerboard, Conductor, Context,
    DebugLight, Dielectric, Facts, FresnelLaw, InterpolatedSf, Lambert, LightSampling, Masking, Material,
    Materials, NullMaterial, Path, PathSettings, PerfectReflectingSurface, Ray, RoughConductor,
    RoughDielectric, Roughen, Scatter, Sellmeier, SpectralFunction, SpectralTable, Spectrum, SurfaceHit,
    UniformSurfaceEmitter, UnitySurfaceEmitter, WithMaterial, World,
};
pub use crate::primitive::{
    BiConcave, BiConvex, Cone, Cuboid, Cylinder, Intersect, Meniscus, Mesh, MeshData, Parabola, Place,
    PlanoConcave, PlanoConvex, Sphere, Subtract, Torus, Union,
};
