use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use crate::material::{Context, Facts, Material, Scatter, SurfaceHit};
use crate::{OpticalError, Path, SpectralTable, colour};

/// A surface that emits in a pattern of cubes of two radiances, fixed to the space of the shape.
///
/// The cube from (0, 0, 0) to (w, w, w) has the second spectrum, its neighbours the first.
#[derive(Debug, Clone)]
pub struct Checkerboard {
    width: f64,
    spectra: [(SpectralTable, f64); 2],
    importance: f64,
}

impl Checkerboard {
    /// Of cubes of a width [m], in D65 white at radiances of 0.25 and 0.5 [W/m²/sr/nm] as in Raysect.
    ///
    /// # Errors
    /// [`OpticalError::Math`] unless the width is positive and finite.
    pub fn new(width: f64) -> Result<Self, OpticalError> {
        MathError::check(width > 0.0 && width.is_finite(), width, "width", "m", "positive and finite")?;
        let white = SpectralTable::new(colour::d65_white());
        Ok(Self { width, spectra: [(white.clone(), 0.25), (white, 0.5)], importance: 1.0 })
    }

    /// With other spectra [W/m²/sr/nm] and their scales.
    pub fn spectra(
        self,
        first: (impl Into<SpectralTable>, f64),
        second: (impl Into<SpectralTable>, f64),
    ) -> Self {
        Self { spectra: [(first.0.into(), first.1), (second.0.into(), second.1)], ..self }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }

    /// True in the cubes of the second spectrum. Coordinates are rounded to 1e-9 of the width, so that a face in
    /// the plane between two layers of cubes lies in one of them throughout.
    fn is_second(&self, p: [f64; 3]) -> bool {
        let odd = |x: f64| {
            let cell = (x / self.width * 1e9).round() * 1e-9;
            (cell.abs().floor() as i64 % 2 == 1) != (cell < 0.0)
        };
        !p.into_iter().fold(false, |flip, x| flip != odd(x))
    }
}

impl Material for Checkerboard {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        let (spectrum, scale) =
            &self.spectra[usize::from(self.is_second(hit.surface.local_point.to_array()))];
        for (out, radiance) in out.iter_mut().zip(at.slice.table(spectrum)) {
            *out = radiance * scale;
        }
        true
    }

    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts { importance: self.importance, ..Facts::emitter("Checkerboard").without_index() }
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let [(first, first_scale), (second, second_scale)] = &self.spectra;
        Ok(Saved::new("Checkerboard")
            .number("width", self.width)
            .reference("first", writer.object(first)?)
            .number("first_scale", *first_scale)
            .reference("second", writer.object(second)?)
            .number("second_scale", *second_scale)
            .number("importance", self.importance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubes_alternate_through_the_origin() {
        let c = Checkerboard::new(0.5).unwrap();
        assert!(c.is_second([0.1, 0.1, 0.1]));
        assert!(!c.is_second([-0.1, 0.1, 0.1]) && !c.is_second([0.6, 0.1, 0.1]));
        assert!(
            c.is_second([-0.1, -0.1, 0.1]) && c.is_second([0.6, 0.6, 0.1]) && c.is_second([1.1, 0.1, 0.1])
        );
        assert!(c.is_second([0.1, 0.1, -1e-12]) && c.is_second([0.1, 0.1, 1.0 - 1e-12]));
        assert!(Checkerboard::new(0.0).is_err());
    }
}
