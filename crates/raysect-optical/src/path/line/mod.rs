//! The line integral: dL/ds = j − α L along a straight piece of a path, through all media that fill it.

mod cells;
mod part;
mod room;
mod rule;
mod samples;

use raysect_core::Ray;

use part::{Part, is_declared};
pub(super) use room::LineRoom;

use super::Path;
use super::media::MediaList;
use crate::material::add_share;
use crate::{Coefficients, Medium, MediumPoint, Structure};

impl<'a> Path<'a> {
    /// The media of a list that count, of the refracting ones only that of the highest priority.
    fn each_medium(&self, media: &MediaList, mut each: impl FnMut(u32, &'a dyn Medium)) {
        let counts = self.refracting(media).map(|(i, _)| i);
        for &instance in media.as_slice() {
            if let Some(medium) = self.medium(instance)
                && (medium.refraction().is_none() || counts == Some(instance))
            {
                each(instance, medium);
            }
        }
    }

    /// The same, with mixtures taken apart whose structure is not declared.
    fn each_part(&self, media: &MediaList, mut each: impl FnMut(Part<'a>, Structure)) {
        self.each_medium(media, |instance, medium| {
            let (whole, structure) = (Part::whole(instance, medium), medium.structure());
            if is_declared(structure) { each(whole, structure) } else { whole.each(&mut each) }
        });
    }

    /// Asks one medium for its coefficients at a place along a ray.
    pub(in crate::path) fn ask(
        &self,
        medium: &dyn Medium,
        instance: u32,
        ray: &Ray,
        distance: f64,
        out: &mut Coefficients<'_>,
    ) {
        self.ask_part(Part::whole(instance, medium), ray, distance, out);
    }

    /// Asks a part for its share of the coefficients.
    fn ask_part(&self, part: Part<'_>, ray: &Ray, distance: f64, out: &mut Coefficients<'_>) {
        let at = MediumPoint {
            point: ray.point_at(distance),
            direction: -ray.direction,
            to_local: &self.scene.instances[part.instance as usize].to_local,
            at: self.context(),
        };
        add_share(part.share, part.medium, &at, out);
    }

    /// Adds up the coefficients of the media of a list at a place along a ray into `emitted`, `attenuation` and
    /// `scattering`.
    pub(in crate::path) fn add_up(&mut self, media: &MediaList, ray: &Ray, distance: f64) {
        let mut emission = std::mem::take(&mut self.emitted);
        let mut attenuation = std::mem::take(&mut self.attenuation);
        let mut scattering = std::mem::take(&mut self.scattering);
        emission.fill(0.0);
        attenuation.fill(0.0);
        scattering.fill(0.0);
        self.each_medium(media, |instance, medium| {
            let mut out = Coefficients {
                emission: &mut emission,
                attenuation: &mut attenuation,
                scattering: &mut scattering,
            };
            self.ask(medium, instance, ray, distance, &mut out);
        });
        (self.emitted, self.attenuation, self.scattering) = (emission, attenuation, scattering);
    }

    /// True if the coefficients are the same all along a ray.
    pub(in crate::path) fn is_homogeneous(&self, media: &MediaList) -> bool {
        let facts = &self.scene.compiled.facts;
        !self.scene.compiled.any_structure || media.as_slice().iter().all(|&i| !facts[i as usize].structured)
    }

    /// Collects the emission of a piece of the path, and reduces the throughput unless something scatters there, which
    /// does that itself.
    pub(in crate::path) fn cross_media(&mut self, ray: &Ray, distance: f64, scatters: bool) {
        if distance == 0.0 || distance.is_infinite() {
            return;
        }
        let media = self.media;
        if !self.is_homogeneous(&media) {
            self.integrate_line(&media, ray, distance, true);
            let sum = &self.line.sum;
            for i in 0..self.throughput.len() {
                self.radiance[i] += self.throughput[i] * sum.light[i];
                if !scatters {
                    self.throughput[i] *= (-sum.depth[i]).exp();
                }
            }
            return;
        }
        self.add_up(&media, ray, 0.5 * distance);
        for i in 0..self.throughput.len() {
            let (emission, attenuation) = (self.emitted[i], self.attenuation[i]);
            if emission != 0.0 {
                self.radiance[i] += self.throughput[i] * emission * effective_length(attenuation, distance);
            }
            if attenuation != 0.0 && !scatters {
                self.throughput[i] *= (-attenuation * distance).exp();
            }
        }
    }

    /// Reduces `reflected` by what the media of a list let through.
    pub(in crate::path) fn attenuate_shadow(&mut self, media: &MediaList, ray: &Ray, distance: f64) {
        if media.is_empty() || distance == 0.0 {
            return;
        }
        if !self.is_homogeneous(media) {
            self.integrate_line(media, ray, distance, false);
            let through = self.reflected.iter_mut().zip(&self.line.sum.depth);
            through.for_each(|(f, depth)| *f *= (-depth).exp());
            return;
        }
        self.add_up(media, ray, 0.5 * distance);
        for (f, attenuation) in self.reflected.iter_mut().zip(&self.attenuation) {
            if *attenuation != 0.0 {
                *f *= (-attenuation * distance).exp();
            }
        }
    }

    /// Solves along a piece where something has structure; the answer is in `line.sum`.
    ///
    /// Media whose structure is declared are solved from break to break; those of unknown structure are asked at
    /// places of their own, and what they emit there is seen through the others.
    fn integrate_line(&mut self, media: &MediaList, ray: &Ray, distance: f64, emission: bool) {
        let mut room = std::mem::take(&mut self.line);
        room.sum.clear(self.slice.bins);
        room.breaks.clear();
        room.samples.clear();
        let mut cell = f64::INFINITY;
        self.each_part(media, |part, structure| {
            let to_local = &self.scene.instances[part.instance as usize].to_local;
            let local =
                Ray::new(to_local.transform_point(ray.origin), to_local.transform_vector(ray.direction))
                    .with_max_distance(distance);
            part.medium.breakpoints(&local, &mut room.breaks);
            if let Structure::Smooth { length_scale } = structure {
                cell = cell.min(length_scale / local.direction.length());
            }
        });
        if emission {
            self.place_samples(media, ray, distance, &mut room.samples);
        }
        room.breaks.retain(|&t| t > 0.0 && t < distance);
        room.breaks.extend(room.samples.iter().map(|s| s.distance));
        room.breaks.push(distance);
        room.breaks.sort_by(f64::total_cmp);
        room.samples.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let (mut start, mut next) = (0.0, 0);
        for k in 0..room.breaks.len() {
            let end = room.breaks[k];
            if end > start {
                self.advance(&mut room, media, ray, start, end, cell);
                start = end;
            }
            while room.samples.get(next).is_some_and(|s| s.distance <= end) {
                self.take_sample(&mut room, ray, next);
                next += 1;
            }
        }
        self.line = room;
    }
}

/// ∫₀ˢ exp(−α t) dt = (1 − exp(−α s)) / α, right down to α = 0.
fn effective_length(attenuation: f64, distance: f64) -> f64 {
    let depth = attenuation * distance;
    if depth == 0.0 { distance } else { -(-depth).exp_m1() / attenuation }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effective_lengths_have_their_limits() {
        assert_eq!(effective_length(0.0, 2.0), 2.0);
        assert!((effective_length(1e-12, 2.0) - 2.0).abs() < 1e-11);
        assert!((effective_length(3.0, 2.0) - (1.0 - (-6.0f64).exp()) / 3.0).abs() < 1e-16);
        assert_eq!(effective_length(f64::INFINITY, 2.0), 0.0);
    }
}
