//! Scattering in volumes: where a path is scattered, by what, and where it goes.

use raysect_core::Ray;
use raysect_math::{Point3D, Rng, Vector3D};

use super::Path;
use super::media::MediaList;
use super::scatter::Origin;
use crate::illumination::{Vertex, sample_lights};
use crate::{Coefficients, Medium, PhaseFunction, Structure};

/// One medium among those that scatter at a place.
#[derive(Clone, Copy)]
struct Scatterer<'a> {
    /// Number of the instance that it fills.
    instance: u32,
    medium: &'a dyn Medium,
    share: f64,
}

impl<'a> Path<'a> {
    /// True if something in a list scatters.
    #[inline]
    pub(super) fn is_turbid(&self, media: &MediaList) -> bool {
        let compiled = &self.scene.compiled;
        compiled.any_scattering && media.as_slice().iter().any(|&i| compiled.facts[i as usize].scatters)
    }

    /// Draws where along a piece the path is scattered, and multiplies the throughput by what that makes of it; none if
    /// it goes through. What the media absorb is in the weights: no path is ended by it.
    pub(super) fn free_flight(&mut self, ray: &Ray, distance: f64) -> Option<f64> {
        let media = self.media;
        if self.is_homogeneous(&media) {
            self.add_up(&media, ray, 0.5 * distance);
            self.exponential_flight(distance)
        } else {
            self.delta_tracking(&media, ray, distance)
        }
    }

    /// Number of a bin, drawn in proportion to a weight times what the path carries in it; none if nothing is left.
    fn draw_bin(&mut self, weights: impl Fn(usize) -> f64) -> Option<usize> {
        let carried = |path: &Self, i: usize| path.throughput[i] * weights(i);
        let bins = self.throughput.len();
        let total: f64 = (0..bins).map(|i| carried(self, i)).sum();
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let mut rest = self.rng.uniform() * total;
        let mut drawn = None;
        for i in 0..bins {
            let weight = carried(self, i);
            if weight > 0.0 {
                drawn = Some(i);
                rest -= weight;
                if rest <= 0.0 {
                    break;
                }
            }
        }
        drawn
    }

    /// In a homogeneous medium the flight of one bin, drawn by what it carries, is exponential; the density is that of
    /// all bins together (A. Wilkie et al., *Hero Wavelength Spectral Sampling*, EGSR 2014).
    fn exponential_flight(&mut self, distance: f64) -> Option<f64> {
        let bin = self.draw_bin(|_| 1.0)?;
        let total: f64 = self.throughput.iter().sum();
        let flight = -self.rng.uniform().ln() / self.attenuation[bin];
        let scattered = flight < distance;
        let length = if scattered { flight } else { distance };
        let mut density = 0.0;
        for (carried, attenuation) in self.throughput.iter().zip(&self.attenuation) {
            let rate = if scattered { *attenuation } else { 1.0 };
            density += carried / total * rate * (-attenuation * length).exp();
        }
        for i in 0..self.throughput.len() {
            self.throughput[i] *= (-self.attenuation[i] * length).exp() / density;
        }
        scattered.then_some(flight)
    }

    /// In a medium with structure tentative collisions come at the rate of a bound, and are scatterings or nothing
    /// (E. Woodcock et al. 1965; M. Galtier et al., *Integral formulation of null-collision Monte Carlo algorithms*,
    /// JQSRT 125, 57, 2013). Where the bound fails the weights grow, and the report says so.
    fn delta_tracking(&mut self, media: &MediaList, ray: &Ray, distance: f64) -> Option<f64> {
        let majorant = self.majorant(media, ray);
        if majorant == 0.0 {
            return None;
        }
        if !majorant.is_finite() {
            self.ledger.unresolved += 1;
            self.throughput.fill(0.0);
            return None;
        }
        let mut at = 0.0;
        loop {
            at -= self.rng.uniform().ln() / majorant;
            if at >= distance {
                return None;
            }
            self.add_up(media, ray, at);
            let exceeds = self.attenuation.iter().any(|&a| a > majorant * (1.0 + 1e-12));
            self.ledger.unresolved += u64::from(exceeds);
            let (mut carried, mut scattered) = (0.0, 0.0);
            for (t, s) in self.throughput.iter().zip(&self.scattering) {
                carried += t;
                scattered += t * s / majorant;
            }
            if carried <= 0.0 {
                return None;
            }
            // Some share of both, so that no weight is without limit where the bound is reached.
            let chance = (scattered / carried).clamp(0.0, 0.9);
            if self.rng.probability(chance) {
                self.scale(1.0 / (majorant * chance));
                return Some(at);
            }
            let weights = self.throughput.iter_mut().zip(&self.attenuation);
            weights.for_each(|(t, a)| *t *= (1.0 - a / majorant) / (1.0 - chance));
        }
    }

    /// A bound on the attenuation of all media together along a ray.
    fn majorant(&mut self, media: &MediaList, ray: &Ray) -> f64 {
        let (mut bound, context) = (0.0, self.context());
        for &instance in media.as_slice() {
            let Some(medium) = self.medium(instance) else { continue };
            if medium.structure() == Structure::Homogeneous {
                let alone = MediaList::of(instance);
                self.add_up(&alone, ray, 0.0);
                bound += self.attenuation.iter().fold(0.0, |a: f64, &b| a.max(b));
            } else {
                bound += medium.majorant(context);
            }
        }
        bound
    }

    /// Scatters at a place where [`free_flight`](Self::free_flight) has ended: looks for a light, then chooses where to
    /// go on; answers with the direction and the number of the instance that scatters, none if nothing does.
    pub(super) fn scatter_in_volume(&mut self, ray: &Ray, distance: f64) -> Option<(Vector3D, u32)> {
        let scatterer = self.choose_scatterer(ray, distance)?;
        let phase = scatterer.medium.phase_function()?;
        let (point, incoming) = (ray.point_at(distance), ray.direction);
        let vertex = Vertex { point, instance: None };
        if self.looks_for_lights()
            && let Some(light) = &sample_lights(self.scene, &self.brightness, &vertex, &mut self.rng)
        {
            let scattered = phase.pdf(incoming, light.direction);
            if scattered > 0.0 {
                let density = self.mixed_density(point, light.direction, scattered);
                self.reflected.fill(scattered);
                let from = Origin { point, leaving: None, media: self.media };
                self.add_light(&from, light, density);
            }
        }
        let direction = self.choose_in_volume(phase, point, incoming);
        let scattered = phase.pdf(incoming, direction);
        let density = self.mixed_density(point, direction, scattered);
        if density.is_nan() || density <= 0.0 {
            return None;
        }
        self.scale(scattered / density);
        self.density = Some(density);
        self.favour = if scattered > 0.0 { density / scattered } else { 1.0 };
        self.vertex = vertex;
        Some((direction, scatterer.instance))
    }

    fn choose_in_volume(
        &mut self,
        phase: &dyn PhaseFunction,
        point: Point3D,
        incoming: Vector3D,
    ) -> Vector3D {
        match self.aimed_direction(point) {
            Some(direction) => direction,
            None => phase.sample(incoming, &mut self.rng),
        }
    }

    /// Chooses one of the media that scatter at a place by how much it scatters of what the path carries, and multiplies
    /// the throughput by its scattering coefficient over the chance of the choice.
    fn choose_scatterer(&mut self, ray: &Ray, distance: f64) -> Option<Scatterer<'a>> {
        let media = self.media;
        let mut scattering = std::mem::take(&mut self.scattering);
        let mut chosen: Option<(Scatterer<'a>, f64)> = None;
        let (mut total, mut rng): (f64, Rng) = (0.0, self.rng.clone());
        self.reflected.fill(0.0);
        let mut kept = std::mem::take(&mut self.reflected);
        let mut emission = std::mem::take(&mut self.emitted);
        let mut attenuation = std::mem::take(&mut self.attenuation);
        for &instance in media.as_slice() {
            let Some(medium) = self.medium(instance) else { continue };
            let whole = Scatterer { instance, medium, share: 1.0 };
            each_scatterer(whole, &mut |part: Scatterer<'a>| {
                scattering.fill(0.0);
                let mut out = Coefficients {
                    emission: &mut emission,
                    attenuation: &mut attenuation,
                    scattering: &mut scattering,
                };
                self.ask(part.medium, instance, ray, distance, &mut out);
                scattering.iter_mut().for_each(|s| *s *= part.share);
                let strength: f64 = self.throughput.iter().zip(&scattering).map(|(t, s)| t * s).sum();
                total += strength;
                if strength > 0.0 && (chosen.is_none() || rng.uniform() * total < strength) {
                    kept.copy_from_slice(&scattering);
                    chosen = Some((part, strength));
                }
            });
        }
        let answer = chosen.map(|(part, strength)| {
            let inverse = total / strength;
            self.throughput.iter_mut().zip(&kept).for_each(|(t, s)| *t *= s * inverse);
            part
        });
        (self.scattering, self.reflected, self.rng) = (scattering, kept, rng);
        (self.emitted, self.attenuation) = (emission, attenuation);
        answer
    }
}

/// The parts of a medium that scatter.
fn each_scatterer<'a>(whole: Scatterer<'a>, each: &mut dyn FnMut(Scatterer<'a>)) {
    if whole.medium.phase_function().is_some() {
        each(whole);
    }
    for (share, medium) in whole.medium.parts().into_iter().flatten() {
        each_scatterer(Scatterer { medium, share: whole.share * share, ..whole }, each);
    }
}
