//! What almost every program uses: `use raysect::prelude::*;`.

pub use crate::core::{Acceleration, Multicore, Node, NodeId, Primitive, Serial};
pub use crate::math::units::{cm, foot, inch, km, mm, nm, um};
pub use crate::math::{
    AffineMatrix3D, Normal3D, Point2D, Point3D, Vector2D, Vector3D, rotate, rotate_basis, rotate_vector,
    rotate_x, rotate_y, rotate_z, translate,
};
pub use crate::observer::{
    AdaptiveSampling, BayerPipeline2D, ColourMap, FunctionalPipeline, MonoDisplay, PowerPipeline0D,
    PowerPipeline1D, RadiancePipeline0D, RadiancePipeline1D, Shown, SpectralPowerPipeline,
    SpectralPowerPipeline0D, SpectralPowerPipeline1D, SpectralPowerPipeline2D, SpectralRadiancePipeline,
    SpectralRadiancePipeline0D, SpectralRadiancePipeline1D, SpectralRadiancePipeline2D,
};
pub use crate::observer::{
    CancelToken, Estimate, Frame, Observer, PinholeCamera, Pipeline, Pipelines, PowerPipeline2D,
    RadiancePipeline2D, RenderReport, Replay, RgbPipeline2D, Scope, Sensor, Statepoint, Stop, minutes,
    seconds,
};
pub use crate::observer::{
    CcdArray, FibreOptic, MeshCamera, MeshPixel, OpenCvCamera, OrthographicCamera, Pixel, SightLine,
    Sightline, SightlineArray, Target, Targeted, TargetedCcdArray, TargetedPixel, ThinLensCamera,
    VectorCamera,
};
pub use crate::optical::library::schott;
pub use crate::optical::{
    AbsorbingSurface, Add, AnisotropicSurfaceEmitter, BlackBody, Blend, Bsdf, Checkerboard, Conductor,
    Context, DebugLight, Dielectric, Dispersion, Facts, FresnelLaw, GaussianLine, HenyeyGreenstein,
    HomogeneousVolumeEmitter, InhomogeneousVolumeEmitter, InterpolatedSf, Lambert, LightSampling, LoggedPath,
    Masking, Material, Materials, NullMaterial, NumericallyIntegratedSf, Path, PathEvent, PathSettings,
    PerfectReflectingSurface, ProfileVolume, Ray, Rayleigh, RoughConductor, RoughDielectric, Roughen,
    Scatter, Sellmeier, SpectralFunction, SpectralTable, Spectrum, SurfaceHit, TopHat, UniformSurfaceEmitter,
    UniformVolume, UnitySurfaceEmitter, VolumeTransform, WavelengthUnit, WithMaterial, World,
};
pub use crate::primitive::{
    BiConcave, BiConvex, Cone, Cuboid, Cylinder, Intersect, Meniscus, Mesh, MeshData, Parabola, Place,
    PlanoConcave, PlanoConvex, Sphere, Subtract, Torus, Union,
};
