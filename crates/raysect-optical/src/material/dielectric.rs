use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::{
    Coefficients, Context, Facts, Material, Medium, MediumPoint, Refraction, Scatter, SurfaceHit,
    check_shares,
};
use crate::{OpticalError, Path, Slice, SpectralFunction, SpectralTable};

/// A smooth transparent solid: Fresnel reflection and refraction at its surface, absorption inside.
///
/// One path is either reflected or refracted, by the unpolarised Fresnel reflectance. Where the index depends on the
/// wavelength a path keeps one of its bins and a wavelength in it, unless the mean over its slice is asked for
/// ([`Dispersion`](crate::Dispersion)). Radiance changes by the square of the ratio of the indices, so
/// that L/n² is kept.
///
/// Solids may overlap or touch: the one of higher [priority](Self::priority) counts.
#[derive(Debug, Clone)]
pub struct Dielectric {
    refraction: Refraction,
    transmission: SpectralTable,
    /// The attenuation [1/m] that belongs to the transmission.
    attenuation: SpectralTable,
    transmission_only: bool,
    importance: f64,
    name: String,
}

impl Dielectric {
    /// Of a refractive index and a transmission per metre (0 … 1), as functions of the wavelength.
    ///
    /// # Errors
    /// None today; a range in which the index is not positive is refused when it is observed.
    pub fn new(
        index: impl Into<SpectralTable>,
        transmission: impl Into<SpectralTable>,
    ) -> Result<Self, OpticalError> {
        let transmission = transmission.into();
        let attenuation = SpectralTable::new(Attenuation(transmission.clone()));
        Ok(Self {
            refraction: Refraction { index: index.into(), external_index: 1.0.into(), priority: 0 },
            transmission,
            attenuation,
            transmission_only: false,
            importance: 1.0,
            name: "Dielectric".to_owned(),
        })
    }

    /// With another index outside, where no other refracting medium is.
    pub fn external_index(mut self, index: impl Into<SpectralTable>) -> Self {
        self.refraction.external_index = index.into();
        self
    }

    /// With a priority among overlapping dielectrics; 0 by default, the higher one counts.
    pub fn priority(mut self, priority: i32) -> Self {
        self.refraction.priority = priority;
        self
    }

    /// Without reflection at its surface: everything is refracted, and total reflection ends a path.
    pub fn transmission_only(self, transmission_only: bool) -> Self {
        Self { transmission_only, ..self }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }

    /// With a name for messages.
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The refractive index.
    pub fn index(&self) -> &SpectralTable {
        &self.refraction.index
    }

    /// The transmission per metre.
    pub fn transmission(&self) -> &SpectralTable {
        &self.transmission
    }

    /// Adds what its constructor needs to what is saved.
    pub(super) fn save_into(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(saved
            .text("name", &self.name)
            .reference("index", writer.object(&self.refraction.index)?)
            .reference("external_index", writer.object(&self.refraction.external_index)?)
            .integer("priority", self.refraction.priority.into())
            .reference("transmission", writer.object(&self.transmission)?)
            .flag("transmission_only", self.transmission_only)
            .number("importance", self.importance))
    }
}

/// The attenuation [1/m] whose bin is that of the average transmission of the bin, as Raysect has it.
struct Attenuation(SpectralTable);

impl SpectralFunction for Attenuation {
    fn evaluate(&self, wavelength: f64) -> f64 {
        attenuation(self.0.function().evaluate(wavelength))
    }
    fn average(&self, min: f64, max: f64) -> f64 {
        attenuation(self.0.function().average(min, max))
    }
}

fn attenuation(transmission: f64) -> f64 {
    // A transmission of one must attenuate by exactly nothing, not by −0.
    if transmission == 1.0 { 0.0 } else { -transmission.ln() }
}

/// Reflectance for unpolarised light and the cosine of refraction, for the cosine of incidence and the indices on the
/// near side and on the far side; none for total reflection
/// (M. Born and E. Wolf, *Principles of Optics*, 7th ed., § 1.5.2).
///
/// Where indices or cosines are almost equal the textbook's differences of products lose their digits. Here the
/// difference is taken of the indices themselves: with r = n/n', (r cos θ)² − cos² θ' = r² − 1.
#[inline]
pub(crate) fn fresnel(cosine: f64, near: f64, far: f64) -> Option<(f64, f64)> {
    let ratio = near / far;
    let excess = (near - far) * (near + far) / (far * far);
    if excess == 0.0 {
        return Some((0.0, cosine));
    }
    let sine_squared = (1.0 - cosine) * (1.0 + cosine);
    let projected = ratio * cosine;
    // 1 − r² sin² θ: by the sine near the normal, by the cosine near grazing, where each is exact.
    let squared = if cosine > 0.5 {
        let sine = ratio * sine_squared.sqrt();
        (1.0 - sine) * (1.0 + sine)
    } else {
        projected * projected - excess
    };
    if squared <= 0.0 {
        return None;
    }
    let refracted = squared.sqrt();
    let sum = projected + refracted;
    let s = excess / (sum * sum);
    // The amplitudes are to each other as cos (θ + θ') to cos (θ − θ').
    let (along, across) = (cosine * refracted, ratio * sine_squared);
    let p = s * ((along - across) / (along + across));
    Some((0.5 * (s * s + p * p), refracted))
}

impl Material for Dielectric {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let at = path.context();
        let ratio = at.index_in / at.index_out;
        let cosine = hit.cosine();
        let Some((reflectance, refracted)) = fresnel(cosine, at.index_in, at.index_out) else {
            return if self.transmission_only {
                Scatter::Absorbed
            } else {
                Scatter::Continue { direction: hit.mirrored() }
            };
        };
        if !self.transmission_only && path.rng().probability(reflectance) {
            return Scatter::Continue { direction: hit.mirrored() };
        }
        // L/n² is kept: seen from the side of index_in, radiance from the other side counts (n_in / n_out)².
        path.scale(ratio * ratio);
        let n = hit.normal().as_vector();
        let direction = hit.direction * ratio + n * (ratio * cosine - refracted);
        Scatter::Continue { direction: direction.normalise_unchecked() }
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }

    fn facts(&self) -> Facts {
        Facts {
            importance: self.importance,
            disperses: self.refraction.disperses(),
            ..Facts::named(&self.name)
        }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        let width = slice.bin_width();
        for function in [&self.refraction.index, &self.refraction.external_index] {
            for (i, &value) in slice.table(function).iter().enumerate() {
                if !(value > 1e-3 && value.is_finite()) {
                    let min = slice.min + width * i as f64;
                    return Err(OpticalError::Index {
                        material: self.name.clone(),
                        value,
                        min,
                        max: min + width,
                    });
                }
            }
        }
        check_shares(slice, &self.transmission, "transmission per metre")
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.save_into(Saved::new("Dielectric"), writer)
    }
}

impl Medium for Dielectric {
    fn refraction(&self) -> Option<&Refraction> {
        Some(&self.refraction)
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        let table = at.at.slice.table(&self.attenuation);
        out.attenuation.iter_mut().zip(table).for_each(|(a, b)| *a += b);
    }

    fn majorant(&self, at: Context<'_>) -> f64 {
        at.slice.table(&self.attenuation).iter().fold(0.0, |a: f64, &b| a.max(b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reflectances_of_the_textbook() {
        let at = |degrees: f64, ratio: f64| fresnel(degrees.to_radians().cos(), ratio, 1.0).map(|f| f.0);
        let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-12;
        assert!(close(at(0.0, 1.0 / 1.5), 0.04) && close(at(0.0, 1.5), 0.04));
        assert!(close(at(56.309_932_474_020_215, 1.0 / 1.5), 0.073_964_497_041_420_1));
        assert!((at(60.0, 1.0 / 1.5).unwrap() - 0.089_186_712_802_212_7).abs() < 1e-14);
        assert!((at(80.0, 1.0 / 1.5).unwrap() - 0.387_704_354_691_472_6).abs() < 1e-14);
        assert_eq!(at(45.0, 1.0), Some(0.0));
        let critical = (1.0f64 / 1.5).asin();
        assert!(fresnel((critical * (1.0 + 1e-12)).cos(), 1.5, 1.0).is_none());
        assert!(fresnel((critical * (1.0 - 1e-12)).cos(), 1.5, 1.0).is_some());
    }

    #[test]
    fn full_transmission_attenuates_by_exactly_nothing() {
        assert_eq!((attenuation(1.0), attenuation(0.0)), (0.0, f64::INFINITY));
    }
}
