//! Scattering into a range of directions: light sampling, important directions and roulette for every material.

use raysect_core::{Candidate, Leaving, Ray, SurfacePoint};
use raysect_math::{Frame, Point3D, Vector3D};

use super::media::MediaList;
use super::{LightSampling, Path, heuristic, unit};
use crate::illumination::{LightSample, Targets, Vertex, sample_lights};
use crate::{Bsdf, Scatter, SurfaceHit};

/// Where a path looks for a light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    /// The point, on a surface or in a volume.
    pub(super) point: Point3D,
    /// How the ray leaves the surface, if there is one.
    pub(super) leaving: Option<Leaving>,
    /// The media that it goes into.
    pub(super) media: MediaList,
}

impl Path<'_> {
    /// Scatters at a surface: looks for a light, then chooses where to go on.
    ///
    /// The directions of the surface and those towards important things form one density; multiple importance
    /// sampling weighs it against the density of light sampling.
    #[inline]
    pub fn scatter<B: Bsdf + ?Sized>(&mut self, bsdf: &B, hit: &SurfaceHit) -> Scatter {
        if self.waves.by_bins {
            return self.scatter_by_bins(bsdf, hit);
        }
        self.scatter_as::<false, B>(bsdf, hit)
    }

    /// Where each bin has indices of its own.
    #[cold]
    #[inline(never)]
    fn scatter_by_bins<B: Bsdf + ?Sized>(&mut self, bsdf: &B, hit: &SurfaceHit) -> Scatter {
        self.scatter_as::<true, B>(bsdf, hit)
    }

    #[inline(always)]
    fn scatter_as<const BY_BINS: bool, B: Bsdf + ?Sized>(&mut self, bsdf: &B, hit: &SurfaceHit) -> Scatter {
        let frame = hit.frame();
        let incoming = frame.to_local(-hit.direction);
        if self.looks_for_lights() {
            let vertex = Vertex { point: hit.surface.point, instance: Some(hit.surface.instance) };
            if let Some(light) = &sample_lights(self.scene, &self.brightness, &vertex, &mut self.rng) {
                let outgoing = frame.to_local(light.direction);
                self.evaluate::<BY_BINS, B>(bsdf, incoming, outgoing);
                if self.reflected.iter().any(|f| *f > 0.0) {
                    let own = self.own_density::<BY_BINS, B>(bsdf, incoming, outgoing);
                    let density = self.mixed_density(hit.surface.point, light.direction, own);
                    let from = self.origin(hit, light.direction);
                    self.add_light(&from, light, density);
                }
            }
        }
        let (outgoing, direction) = self.choose::<BY_BINS, B>(bsdf, hit, &frame, incoming);
        let own = self.own_density::<BY_BINS, B>(bsdf, incoming, outgoing);
        let density = self.mixed_density(hit.surface.point, direction, own);
        if density.is_nan() || density <= 0.0 {
            return Scatter::Absorbed;
        }
        if density != own {
            // A direction that the surface would never take carries nothing.
            self.favour = if own > 0.0 { density / own } else { 1.0 };
        }
        let before = BY_BINS.then(|| self.carried_now());
        self.evaluate::<BY_BINS, B>(bsdf, incoming, outgoing);
        let inverse = 1.0 / density;
        self.throughput.iter_mut().zip(&self.reflected).for_each(|(t, f)| *t *= f * inverse);
        self.density = Some(density);
        if let Some(before) = before {
            self.favour *= self.favour_by_bins(before);
        }
        Scatter::Continue { direction }
    }

    /// True if lights are to be sampled. At the last scattering of a path that is cut off they are not: what it would
    /// have found by going on is missing then, and half an answer would only blur what the report says is missing.
    #[inline]
    pub(super) fn looks_for_lights(&self) -> bool {
        self.settings.light_sampling == LightSampling::Lights
            && !self.scene.compiled.lights.is_empty()
            && self.depth + 1 < self.settings.max_depth
    }

    /// What scattered paths are aimed at besides sampled lights, if anything.
    #[inline]
    fn targets(&self) -> Option<&Targets> {
        let compiled = &self.scene.compiled;
        let targets = match self.settings.light_sampling {
            LightSampling::Lights => &compiled.targets,
            LightSampling::BoundingSpheres => &compiled.all_targets,
            LightSampling::Off => return None,
        };
        (!targets.is_empty() && self.settings.important_path_weight > 0.0).then_some(targets)
    }

    #[inline]
    fn choose<const BY_BINS: bool, B: Bsdf + ?Sized>(
        &mut self,
        bsdf: &B,
        hit: &SurfaceHit,
        frame: &Frame,
        incoming: Vector3D,
    ) -> (Vector3D, Vector3D) {
        if let Some(direction) = self.aimed_direction(hit.surface.point) {
            return (frame.to_local(direction), direction);
        }
        let outgoing = if BY_BINS {
            self.sample_by_bins(bsdf, incoming)
        } else {
            bsdf.sample(incoming, self.context(), &mut self.rng)
        };
        (outgoing, unit(frame.to_world(outgoing)))
    }

    /// A direction towards something important, for the share of the paths that are aimed.
    #[inline(always)]
    pub(super) fn aimed_direction(&mut self, from: Point3D) -> Option<Vector3D> {
        if self.targets().is_none() || !self.rng.probability(self.settings.important_path_weight) {
            return None;
        }
        let mut rng = self.rng.clone();
        let direction = self.targets().map(|t| t.sample(from, &mut rng));
        self.rng = rng;
        direction.map(unit)
    }

    /// Density [1/sr] of a direction of which a share is aimed, and which has a density of its own.
    #[inline]
    pub(super) fn mixed_density(&self, from: Point3D, direction: Vector3D, own: f64) -> f64 {
        match self.targets() {
            None => own,
            Some(targets) => {
                let weight = self.settings.important_path_weight;
                weight * targets.density(from, direction) + (1.0 - weight) * own
            }
        }
    }

    /// The place of a surface from which a light is looked for.
    #[inline(always)]
    fn origin(&self, hit: &SurfaceHit, direction: Vector3D) -> Origin {
        let leaving = Some(Leaving::new(&hit.surface, hit.direction, direction, self.leaving.as_ref()));
        let mut origin = Origin { point: hit.surface.point, leaving, media: self.media };
        if self.scene.compiled.any_medium && hit.leads_through(direction) {
            self.pass_into(&mut origin.media, &hit.surface);
            if let Some(leaving) = &mut origin.leaving {
                self.coincident.note_passed(leaving);
            }
        }
        origin
    }

    /// Density [1/sr] of a direction that the surface itself chooses.
    #[inline(always)]
    fn own_density<const BY_BINS: bool, B: Bsdf + ?Sized>(
        &self,
        bsdf: &B,
        incoming: Vector3D,
        outgoing: Vector3D,
    ) -> f64 {
        if BY_BINS {
            return self.density_by_bins(bsdf, incoming, outgoing);
        }
        bsdf.pdf(incoming, outgoing, self.context())
    }

    /// The scattering function times cosine, into `reflected`.
    #[inline(always)]
    fn evaluate<const BY_BINS: bool, B: Bsdf + ?Sized>(
        &mut self,
        bsdf: &B,
        incoming: Vector3D,
        outgoing: Vector3D,
    ) {
        if BY_BINS {
            return self.evaluate_by_bins(bsdf, incoming, outgoing);
        }
        let at = self.context();
        bsdf.evaluate(incoming, outgoing, at, &mut self.reflected);
    }

    /// Adds the light of a sampled direction, if nothing is in its way. `density` is that with which the path would
    /// have gone there by itself.
    pub(super) fn add_light(&mut self, from: &Origin, light: &LightSample, density: f64) {
        let scene = self.scene;
        let instance = scene.compiled.lights[light.light as usize].instance;
        let leaving = from.leaving.as_ref();
        let ray = Ray::new(from.point, light.direction);
        self.ledger.shadow_rays += 1;
        let found;
        let at = match &light.hit {
            Some(hit) => hit,
            None => {
                let crossing = scene.hit_instance(instance, &ray, leaving, f64::INFINITY, &mut self.scratch);
                let Some(crossing) = crossing else { return };
                let surface = scene.finish(&ray, &Candidate { instance, crossing });
                found = SurfaceHit { surface, direction: light.direction };
                &found
            }
        };
        let surface = &at.surface;
        let ray = ray.with_max_distance(surface.distance);
        let mut around = from.media;
        if self.scene.compiled.any_transparent || !from.media.is_empty() {
            match self.walk_to_light(from, &ray, instance) {
                Some(media) => around = media,
                None => return,
            }
        } else {
            // A point drawn on a light that is not convex may lie behind another part of it.
            let own = light.hit.is_some() && !scene.is_convex(instance);
            let short = ray.with_max_distance(surface.distance * (1.0 - 1e-9));
            if own && scene.is_blocked(&short, leaving, &mut self.scratch, |i| i == instance) {
                return;
            }
            if scene.is_blocked(&ray, leaving, &mut self.scratch, |i| i != instance) {
                return;
            }
        }
        let material = scene.instances[instance as usize].attached.material();
        // The light stands in other media than the place that it is looked for from; one that a medium hides is not met.
        let emits = if scene.compiled.any_medium {
            let index_use = scene.compiled.facts[instance as usize].index_use;
            self.emission_in_media(material, at, &around, index_use)
        } else {
            material.emit(at, self.context(), &mut self.emitted)
        };
        if emits {
            let weight = heuristic(light.density, density) / light.density;
            let found = self.reflected.iter().zip(&self.emitted);
            let found = self.throughput.iter().zip(found);
            self.radiance.iter_mut().zip(found).for_each(|(r, (t, (f, e)))| *r += t * f * e * weight);
        }
    }

    /// Follows a shadow ray through transparent surfaces and media to a light; reduces `reflected` by what the media
    /// let through. The media in front of the light, or none if something opaque stands in the way.
    fn walk_to_light(&mut self, from: &Origin, ray: &Ray, light: u32) -> Option<MediaList> {
        let scene = self.scene;
        let (mut ray, mut leaving, mut media) = (*ray, from.leaving, from.media);
        loop {
            let next = scene.hit(&ray, leaving.as_ref(), &mut self.scratch);
            let distance = next.map_or(ray.max_distance, |h| h.crossing.distance);
            self.attenuate_shadow(&media, &ray, distance);
            let Some(next) = next else { return Some(media) };
            if next.instance == light {
                // Unless this is another part of the light, in front of the point that was drawn.
                let met = scene.is_convex(light) || distance >= ray.max_distance * (1.0 - 1e-9);
                return met.then_some(media);
            }
            let surface: SurfacePoint = scene.finish(&ray, &next);
            if !scene.compiled.facts[next.instance as usize].transparent
                && self.is_interface(&media, &surface)
            {
                return None;
            }
            self.change_list(&mut media, &surface);
            leaving = Some(Leaving::new(&surface, ray.direction, ray.direction, leaving.as_ref()));
            ray =
                Ray::new(surface.point, ray.direction).with_max_distance(ray.max_distance - surface.distance);
        }
    }
}
