//! The wavelength of a path where something disperses.

use super::Path;
use crate::SpectralTable;

/// How paths are refracted by media whose index depends on the wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dispersion {
    /// Each path draws one wavelength in every bin. It carries all bins up to the first interface that disperses, and
    /// from there only one of them, chosen at random with the weight that makes up for the others. The average of a
    /// bin is without bias, however wide the bin.
    #[default]
    Sampled,
    /// The index is its mean over the slice that a path carries: Raysect's cheap model, in which a prism turns each
    /// slice (`spectral_rays`) by one angle.
    Mean,
}

impl Path<'_> {
    /// Keeps one bin, drawn in proportion to what it still carries, and settles the wavelength in it.
    #[cold]
    pub(super) fn keep_one_bin(&mut self) {
        let total: f64 = self.throughput.iter().sum();
        if total.is_nan() || total <= 0.0 {
            return;
        }
        let mut rest = self.rng.uniform() * total;
        let mut kept = 0;
        for (bin, carried) in self.throughput.iter().enumerate() {
            if *carried > 0.0 {
                kept = bin;
                rest -= carried;
                if rest <= 0.0 {
                    break;
                }
            }
        }
        // What the surfaces have left of the light has not changed: roulette looks at that.
        let share = self.throughput[kept] / total;
        self.throughput.fill(0.0);
        self.throughput[kept] = total;
        self.carried *= share;
        let place = (kept as f64 + self.rng.uniform()) / self.slice.bins as f64;
        self.kept = Some(self.slice.min + (self.slice.max - self.slice.min) * place);
    }

    /// A refractive index for the path.
    #[inline]
    pub(super) fn index(&self, function: &SpectralTable) -> f64 {
        match self.kept {
            Some(wavelength) => function.function().evaluate(wavelength),
            None => self.slice.mean(function),
        }
    }
}
