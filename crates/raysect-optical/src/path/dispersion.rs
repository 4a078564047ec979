//! The wavelengths of a path where something disperses.

use raysect_math::{Rng, Vector3D};

use super::{Path, media::MediaList};
use crate::{Bsdf, Context, IndexUse, Material, Slice, SpectralTable, SurfaceHit};

/// How paths are refracted by media whose index depends on the wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dispersion {
    /// Each path draws one wavelength in every bin. It carries all bins up to the first smooth interface that disperses,
    /// and from there only one of them, chosen at random with the weight that makes up for the others. At rough
    /// interfaces it carries them on: one of them chooses the direction, and each is weighed by how likely all of them
    /// together were to choose it. The average of a bin is without bias, however wide the bin.
    #[default]
    Sampled,
    /// The index is its mean over the slice that a path carries: Raysect's cheap model, in which a prism turns each
    /// slice (`spectral_rays`) by one angle.
    Mean,
}

/// The refractive index of one side of a surface as a function of the wavelength; none where nothing refracts.
pub(super) type Side<'a> = Option<&'a SpectralTable>;

/// What a path knows of its wavelengths.
#[derive(Debug)]
pub(super) struct Wavelengths {
    /// True if wavelengths are drawn where something disperses.
    drawn: bool,
    /// The place of the wavelengths within their bins, 0 … 1, once something disperses.
    place: Option<f64>,
    /// The one wavelength that has been kept [nm].
    pub(super) kept: Option<f64>,
    /// True if the indices at the surface of the moment are those of `indices`, bin by bin.
    pub(super) by_bins: bool,
    /// Refractive indices before and behind the surface of the moment, bin by bin.
    indices: Vec<(f64, f64)>,
}

impl Wavelengths {
    pub(super) fn new(drawn: bool) -> Self {
        Self { drawn, place: None, kept: None, by_bins: false, indices: Vec::new() }
    }

    /// Forgets those of the last path.
    #[inline]
    pub(super) fn restart(&mut self) {
        (self.place, self.kept, self.by_bins) = (None, None, false);
    }

    fn place(&mut self, rng: &mut Rng) -> f64 {
        *self.place.get_or_insert_with(|| rng.uniform())
    }
}

fn disperses(side: Side<'_>) -> bool {
    side.is_some_and(|table| !table.function().is_constant())
}

/// A wavelength [nm] at a place within a bin, 0 … 1.
fn wavelength(slice: &Slice, bin: usize, place: f64) -> f64 {
    slice.min + (slice.max - slice.min) * ((bin as f64 + place) / slice.bins as f64)
}

fn evaluate(side: Side<'_>, wavelength: f64) -> f64 {
    side.map_or(1.0, |table| table.function().evaluate(wavelength))
}

impl Path<'_> {
    /// Notes the indices before and behind a surface that does with them what it says.
    #[inline]
    pub(super) fn note_indices(&mut self, near: Side<'_>, far: Side<'_>, index_use: IndexUse) {
        self.waves.by_bins = false;
        if self.carries_dispersed(near, far) {
            match index_use {
                IndexUse::One => self.keep_one_bin(),
                IndexUse::EachBin => return self.note_each_bin(near, far),
                IndexUse::None => {}
            }
        }
        self.indices = (self.index(near), self.index(far));
    }

    /// True if the path carries all bins where the index is another one in each.
    #[inline]
    fn carries_dispersed(&self, near: Side<'_>, far: Side<'_>) -> bool {
        self.waves.drawn && self.waves.kept.is_none() && (disperses(near) || disperses(far))
    }

    /// The index of one side, for the path as a whole.
    #[inline]
    pub(super) fn index(&self, side: Side<'_>) -> f64 {
        let Some(table) = side else { return 1.0 };
        match self.waves.kept {
            Some(wavelength) => table.function().evaluate(wavelength),
            None => self.slice.mean(table),
        }
    }

    /// Notes the indices of every bin.
    #[cold]
    fn note_each_bin(&mut self, near: Side<'_>, far: Side<'_>) {
        let (slice, place) = (self.slice, self.waves.place(&mut self.rng));
        let pair = |bin| {
            let wavelength = wavelength(slice, bin, place);
            (evaluate(near, wavelength), evaluate(far, wavelength))
        };
        self.waves.indices.clear();
        self.waves.indices.extend((0..slice.bins).map(pair));
        self.waves.by_bins = true;
        // The pair that stands for all shows whether there is anything to be met.
        let different = self.waves.indices.iter().find(|(near, far)| near != far);
        self.indices = *different.unwrap_or(&self.waves.indices[0]);
    }

    /// Keeps one bin, drawn in proportion to what it still carries, and settles the wavelength in it.
    #[cold]
    fn keep_one_bin(&mut self) {
        let Some((kept, total)) = self.draw_wavelength() else { return };
        // What the surfaces have left of the light has not changed: roulette looks at that.
        self.carried *= self.brightest() / total;
        self.throughput.fill(0.0);
        self.throughput[kept] = total;
        let place = self.waves.place(&mut self.rng);
        self.waves.kept = Some(wavelength(self.slice, kept, place));
    }

    /// A bin, drawn in proportion to what it carries, and what all of them carry; none if that is nothing.
    fn draw_wavelength(&mut self) -> Option<(usize, f64)> {
        let total: f64 = self.throughput.iter().sum();
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let mut rest = self.rng.uniform() * total;
        let mut drawn = 0;
        for (bin, carried) in self.throughput.iter().enumerate() {
            if *carried > 0.0 {
                drawn = bin;
                rest -= carried;
                if rest <= 0.0 {
                    break;
                }
            }
        }
        Some((drawn, total))
    }

    /// What is known at the surface of the moment of one bin.
    fn context_of(&self, bin: usize) -> Context<'_> {
        let (index_in, index_out) = self.waves.indices[bin];
        let place = self.waves.place.unwrap_or(0.5);
        Context { slice: self.slice, index_in, index_out, wavelength: wavelength(self.slice, bin, place) }
    }

    /// A direction drawn by one of the bins.
    #[cold]
    pub(super) fn sample_by_bins<B: Bsdf + ?Sized>(&mut self, bsdf: &B, incoming: Vector3D) -> Vector3D {
        let bin = self.draw_wavelength().map_or(0, |(bin, _)| bin);
        let mut rng = self.rng.clone();
        let outgoing = bsdf.sample(incoming, self.context_of(bin), &mut rng);
        self.rng = rng;
        outgoing
    }

    /// Density [1/sr] of [`sample_by_bins`](Self::sample_by_bins): whichever bin chooses a direction, each is weighed by
    /// how likely all of them were to choose it (A. Wilkie et al., *Hero Wavelength Spectral Sampling*, Computer
    /// Graphics Forum 33(4), 2014, with the bins drawn by what they carry).
    #[cold]
    pub(super) fn density_by_bins<B: Bsdf + ?Sized>(
        &self,
        bsdf: &B,
        incoming: Vector3D,
        outgoing: Vector3D,
    ) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for (bin, &carried) in self.throughput.iter().enumerate().filter(|(_, carried)| **carried > 0.0) {
            sum += carried * bsdf.pdf(incoming, outgoing, self.context_of(bin));
            total += carried;
        }
        if total > 0.0 { sum / total } else { 0.0 }
    }

    /// The scattering function times cosine into `reflected`, each bin with its own indices.
    #[cold]
    pub(super) fn evaluate_by_bins<B: Bsdf + ?Sized>(
        &mut self,
        bsdf: &B,
        incoming: Vector3D,
        outgoing: Vector3D,
    ) {
        let (mut reflected, mut all) =
            (std::mem::take(&mut self.reflected), std::mem::take(&mut self.emitted));
        for (bin, value) in reflected.iter_mut().enumerate() {
            *value = 0.0;
            if self.throughput[bin] > 0.0 {
                bsdf.evaluate(incoming, outgoing, self.context_of(bin), &mut all);
                *value = all[bin];
            }
        }
        (self.reflected, self.emitted) = (reflected, all);
    }

    /// The throughput of the brightest bin.
    #[inline]
    pub(super) fn brightest(&self) -> f64 {
        self.throughput.iter().fold(0.0, |a: f64, &b| if b > a { b } else { a })
    }

    /// What all bins together carry, and the brightest of them.
    #[cold]
    pub(super) fn carried_now(&self) -> (f64, f64) {
        (self.throughput.iter().sum(), self.brightest())
    }

    /// What takes the brightest bin for roulette to what the surface has left of the light of all bins together, for
    /// what these and the brightest of them have carried before. A bin that has been drawn against the odds has had its
    /// luck: it is not to be killed for being dim.
    #[cold]
    pub(super) fn favour_by_bins(&self, (total, brightest): (f64, f64)) -> f64 {
        let (left, now) = (self.throughput.iter().sum::<f64>() / total, self.brightest() / brightest);
        if now > 0.0 { left / now } else { 1.0 }
    }

    /// What a light emits towards a path that looks for it through given media, into `emitted`; `false` for nothing,
    /// also where another medium hides the light.
    pub(super) fn emission_in_media(
        &mut self,
        material: &dyn Material,
        at: &SurfaceHit,
        media: &MediaList,
        index_use: IndexUse,
    ) -> bool {
        let Some((near, far)) = self.sides(media, &at.surface) else { return false };
        if index_use == IndexUse::One && self.carries_dispersed(near, far) {
            return self.emission_by_bins(material, at, near, far);
        }
        let context = Context { index_in: self.index(near), index_out: self.index(far), ..self.context() };
        material.emit(at, context, &mut self.emitted)
    }

    #[cold]
    fn emission_by_bins(
        &mut self,
        material: &dyn Material,
        at: &SurfaceHit,
        near: Side<'_>,
        far: Side<'_>,
    ) -> bool {
        let (slice, place) = (self.slice, self.waves.place(&mut self.rng));
        let (mut all, mut any) = (std::mem::take(&mut self.attenuation), false);
        for bin in 0..slice.bins {
            let wavelength = wavelength(slice, bin, place);
            let (index_in, index_out) = (evaluate(near, wavelength), evaluate(far, wavelength));
            let context = Context { slice, index_in, index_out, wavelength };
            let emits = material.emit(at, context, &mut all);
            self.emitted[bin] = if emits { all[bin] } else { 0.0 };
            any |= emits;
        }
        self.attenuation = all;
        any
    }
}
