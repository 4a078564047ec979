use raysect_core::{BoundingSphere3D, Instance, SurfacePoint, SurfaceSampling};
use raysect_math::{Normal3D, Point3D, Rng, Vector3D};

use crate::{Optics, Scene, SurfaceHit};

/// An emitting surface that is sampled by its shape.
#[derive(Debug, Clone, Copy)]
pub struct Light {
    /// Its instance in the scene.
    pub instance: u32,
    sampling: SurfaceSampling,
    pub(super) sphere: BoundingSphere3D,
    importance: f64,
    /// Volume of the image of a unit cube: what areas scale with, together with the normal.
    volume_scale: f64,
}

/// Where light is looked for: a point, and the instance on whose surface it lies.
#[derive(Debug, Clone, Copy)]
pub struct Vertex {
    /// The point [m].
    pub point: Point3D,
    /// The instance; none for a point in space.
    pub instance: Option<u32>,
}

/// A direction drawn towards a light.
#[derive(Debug, Clone, Copy)]
pub struct LightSample {
    /// Number of the light.
    pub light: u32,
    /// Unit vector from the shading point.
    pub direction: Vector3D,
    /// Density of the choice, that of the light included [1/sr].
    pub density: f64,
    /// The light at the point that was drawn, as a path in that direction meets it; none where only a direction was drawn.
    pub hit: Option<SurfaceHit>,
}

impl Light {
    pub(crate) fn new(
        index: u32,
        instance: &Instance<Optics>,
        sphere: BoundingSphere3D,
        importance: f64,
    ) -> Self {
        Self {
            instance: index,
            sampling: instance.primitive.surface_sampling(),
            sphere,
            importance,
            volume_scale: instance.to_world.determinant().abs(),
        }
    }

    /// How much of the light sampling at a point goes to this light, besides its brightness: its importance times the
    /// square of the angle under which it appears. A light that encloses the point is left to the directions of the surface.
    fn weight(&self, scene: &Scene, at: &Vertex) -> f64 {
        // From a point on a convex light itself there is nothing of it to be seen outside, and all around inside.
        if at.instance == Some(self.instance) && scene.is_convex(self.instance) {
            return 0.0;
        }
        let from = at.point;
        let distance = from.vector_to(self.sphere.centre).length_squared();
        let radius = self.sphere.radius * self.sphere.radius;
        if distance > radius {
            return self.importance * radius / distance;
        }
        let instance = &scene.instances[self.instance as usize];
        if instance.primitive.contains(instance.to_local.transform_point(from)) {
            0.0
        } else {
            self.importance
        }
    }

    /// World area of the image of a unit of local area with a given unit normal.
    fn area_scale(&self, instance: &Instance<Optics>, normal: Normal3D) -> f64 {
        if let Some(scale) = instance.similarity {
            return scale * scale;
        }
        self.volume_scale * instance.to_local.transform_normal_with_inverse(normal).length()
    }

    /// Draws a direction, as the number of a light that is chosen with certainty.
    #[inline]
    pub(super) fn sample(
        &self,
        scene: &Scene,
        from: Point3D,
        light: u32,
        rng: &mut Rng,
    ) -> Option<LightSample> {
        let instance = &scene.instances[self.instance as usize];
        let local_from = instance.to_local.transform_point(from);
        if self.sampling == SurfaceSampling::SolidAngle {
            let s = instance.primitive.sample_direction(local_from, [rng.uniform(), rng.uniform()])?;
            let direction = instance.to_world.transform_vector(s.direction).normalise_unchecked();
            return Some(LightSample { light, direction, density: s.density, hit: None });
        }
        let u = [rng.uniform(), rng.uniform(), rng.uniform()];
        let s = instance.primitive.sample_surface(local_from, u)?;
        let to = from.vector_to(instance.to_world.transform_point(s.point));
        let squared = to.length_squared();
        let distance = squared.sqrt();
        let direction = to * (1.0 / distance);
        let surface = scene.sampled_surface(self.instance, &s, direction, distance);
        let cosine = surface.normal.dot(direction).abs();
        if cosine == 0.0 || distance == 0.0 {
            return None;
        }
        let density = s.density / self.area_scale(instance, s.normal) * squared / cosine;
        Some(LightSample { light, direction, density, hit: Some(SurfaceHit { surface, direction }) })
    }

    /// Density [1/sr] with which a surface point on the light is found by sampling from a point.
    fn density(&self, scene: &Scene, from: Point3D, direction: Vector3D, surface: &SurfacePoint) -> f64 {
        let instance = &scene.instances[self.instance as usize];
        let local_from = instance.to_local.transform_point(from);
        if self.sampling == SurfaceSampling::SolidAngle {
            let local = instance.to_local.transform_vector(direction).normalise_unchecked();
            return instance.primitive.direction_density(local_from, local);
        }
        let cosine = surface.normal.dot(direction).abs();
        let local = instance.primitive.surface_density(local_from, surface.local_point, surface.feature);
        if local == 0.0 || cosine == 0.0 {
            return 0.0;
        }
        if let Some(scale) = instance.similarity {
            let squared = from.vector_to(surface.point).length_squared();
            return local / (scale * scale) * squared / cosine;
        }
        // The local unit normal is the image of the world's, brought back to length one.
        let local_normal =
            instance.to_world.transform_normal_with_inverse(surface.normal).normalise_unchecked();
        let squared = from.vector_to(surface.point).length_squared();
        local / self.area_scale(instance, local_normal) * squared / cosine
    }
}

/// What of the light sampling at a point goes to all lights together, of a known brightness each.
fn total_weight(scene: &Scene, brightness: &[f64], at: &Vertex) -> f64 {
    scene.compiled.lights.iter().zip(brightness).map(|(light, b)| b * light.weight(scene, at)).sum()
}

/// Draws a light and a direction towards it; none if no light can be sampled from there.
#[inline(always)]
pub(crate) fn sample_lights(
    scene: &Scene,
    brightness: &[f64],
    at: &Vertex,
    rng: &mut Rng,
) -> Option<LightSample> {
    let lights = &scene.compiled.lights;
    if let [light] = &lights[..] {
        if light.weight(scene, at) == 0.0 {
            return None;
        }
        return light.sample(scene, at.point, 0, rng);
    }
    let total = total_weight(scene, brightness, at);
    if total.is_nan() || total <= 0.0 {
        return None;
    }
    let mut chosen = None;
    let mut rest = rng.uniform() * total;
    for (index, (light, brightness)) in lights.iter().zip(brightness).enumerate() {
        let weight = brightness * light.weight(scene, at);
        if weight > 0.0 {
            chosen = Some((index, weight));
            rest -= weight;
            if rest <= 0.0 {
                break;
            }
        }
    }
    let (index, weight) = chosen?;
    let mut drawn = lights[index].sample(scene, at.point, index as u32, rng)?;
    drawn.density = drawn.density * weight / total;
    Some(drawn)
}

/// Density [1/sr] with which [`sample_lights`] finds a point on a light.
pub(crate) fn light_density(
    scene: &Scene,
    brightness: &[f64],
    light: u32,
    at: &Vertex,
    direction: Vector3D,
    surface: &SurfacePoint,
) -> f64 {
    let lights = &scene.compiled.lights;
    let weight = brightness[light as usize] * lights[light as usize].weight(scene, at);
    if weight == 0.0 {
        return 0.0;
    }
    weight / total_weight(scene, brightness, at)
        * lights[light as usize].density(scene, at.point, direction, surface)
}
