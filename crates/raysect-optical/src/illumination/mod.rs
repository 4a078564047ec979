//! What a compiled optical scene knows: who emits, what paths are aimed at, who fills volumes.

mod brightness;
mod light;
mod targets;

use std::collections::BTreeMap;

use raysect_core::{Instance, SurfaceSampling};

use brightness::Brightness;
pub use light::{Light, LightSample, Vertex};
pub(crate) use light::{light_density, sample_lights};
pub use targets::Targets;

use crate::material::scatters;
use crate::{Facts, IndexUse, Medium, Optics, Structure};

/// What the integrator asks of an instance at every hit.
#[derive(Debug, Clone, Copy)]
pub struct InstanceFacts {
    /// True if the surface emits.
    pub emits: bool,
    /// True if every ray passes straight on.
    pub transparent: bool,
    /// True if something fills the volume.
    pub has_medium: bool,
    /// True if what fills the volume has structure along a ray.
    pub structured: bool,
    /// True if what fills the volume scatters.
    pub scatters: bool,
    /// What the surface does with the refractive indices on its sides.
    pub index_use: IndexUse,
    /// Number among the lights, if the surface is sampled as one.
    pub light: Option<u32>,
}

/// The facts of all instances of a scene, compiled with it.
#[derive(Debug)]
pub struct Illumination {
    /// By instance.
    pub facts: Vec<InstanceFacts>,
    /// The emitting surfaces that are sampled by their shape.
    pub lights: Vec<Light>,
    /// How bright they are, in the bins that paths carry.
    pub(crate) brightness: Brightness,
    /// What else is important: aimed at through bounding spheres, in the directional density.
    pub targets: Targets,
    /// Everything important, lights included: what Raysect aims at.
    pub all_targets: Targets,
    /// True if a surface lets rays pass straight on.
    pub any_transparent: bool,
    /// True if something fills a volume.
    pub any_medium: bool,
    /// True if something that fills a volume has structure along a ray.
    pub any_structure: bool,
    /// True if something that fills a volume scatters.
    pub any_scattering: bool,
    /// How many volumes refract.
    pub refracting: usize,
    /// True if two volumes of different materials refract with equal priority: where such overlap the order of their
    /// nodes decides.
    pub contestable: bool,
    /// True if something refracts by wavelength.
    pub any_dispersion: bool,
    /// What each instance calls its material.
    pub names: Vec<String>,
}

impl Illumination {
    pub(crate) fn compile(instances: &[Instance<Optics>]) -> Self {
        let known: Vec<Facts> = instances.iter().map(|i| i.attached.material().facts()).collect();
        let (mut lights, mut facts) = (Vec::new(), Vec::new());
        let (mut targets, mut all_targets) = (Vec::new(), Vec::new());
        for (index, (instance, known)) in instances.iter().zip(&known).enumerate() {
            let important = known.importance > 0.0;
            let sampled = match (instance.primitive.surface_sampling(), instance.similarity) {
                (SurfaceSampling::None, _) | (SurfaceSampling::SolidAngle, None) => false,
                _ => known.emits && important,
            };
            if important {
                let sphere = instance.primitive.bounding_sphere(&instance.to_world);
                all_targets.push((sphere, known.importance));
                if sampled {
                    lights.push(Light::new(index as u32, instance, sphere, known.importance));
                } else {
                    targets.push((sphere, known.importance));
                }
            }
            let medium = instance.attached.material().medium();
            facts.push(InstanceFacts {
                structured: medium.is_some_and(|m| m.structure() != Structure::Homogeneous),
                scatters: medium.is_some_and(scatters),
                emits: known.emits,
                transparent: known.transparent,
                has_medium: medium.is_some(),
                index_use: known.index_use,
                light: sampled.then(|| lights.len() as u32 - 1),
            });
        }
        Self {
            any_transparent: facts.iter().any(|f| f.transparent),
            any_structure: facts.iter().any(|f| f.structured),
            any_scattering: facts.iter().any(|f| f.scatters),
            any_medium: facts.iter().any(|f| f.has_medium),
            refracting: instances.iter().filter(|i| refracts(i)).count(),
            contestable: any_equal(instances.iter().filter_map(|i| i.attached.material().medium())),
            any_dispersion: known.iter().any(|f| f.disperses),
            names: known.into_iter().map(|f| f.name).collect(),
            facts,
            lights,
            brightness: Brightness::default(),
            targets: Targets::new(targets),
            all_targets: Targets::new(all_targets),
        }
    }
}

fn refracts(instance: &Instance<Optics>) -> bool {
    instance.attached.material().medium().is_some_and(|m| m.refraction().is_some())
}

/// True if two different media refract with the same priority.
fn any_equal<'a>(media: impl Iterator<Item = &'a dyn Medium>) -> bool {
    let mut first: BTreeMap<i32, &dyn Medium> = BTreeMap::new();
    media
        .filter_map(|medium| Some((medium.refraction()?.priority, medium)))
        .any(|(priority, medium)| !std::ptr::addr_eq(*first.entry(priority).or_insert(medium), medium))
}
