use std::f64::consts::{PI, TAU};

use raysect_core::save::{SaveError, Saved, SceneObject, SceneWriter, short_name};
use raysect_math::{Frame, MathError, Rng, Vector3D};

use crate::OpticalError;

/// How a medium distributes what it scatters over directions.
///
/// Both vectors are unit vectors in which the path goes, before and after: a path that goes straight on has a cosine
/// of 1 between them. By symmetry light, which goes the other way, is turned by the same angle.
pub trait PhaseFunction: Send + Sync {
    /// Draws a direction.
    fn sample(&self, incoming: Vector3D, rng: &mut Rng) -> Vector3D;

    /// Density of [`sample`](Self::sample) [1/sr], which is the phase function itself: it integrates to one.
    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D) -> f64;

    /// What a file needs to know to make it again; see [`raysect_core::save`].
    ///
    /// # Errors
    /// [`SaveError::NotSaved`] by default.
    fn save(&self, _writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let kind = short_name(std::any::type_name::<Self>()).to_owned();
        Err(SaveError::NotSaved { role: "phase function", kind })
    }
}

impl SceneObject for dyn PhaseFunction {
    const ROLE: &'static str = "phase";

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        PhaseFunction::save(self, writer)
    }
}

/// The phase function of L. Henyey and J. Greenstein, *Diffuse radiation in the galaxy*, ApJ 93, 70 (1941):
/// p = (1 − g²) / (4π (1 + g² − 2 g cos θ)^³ᐟ²), where g is the mean of cos θ.
///
/// ```
/// use raysect_math::Vector3D;
/// use raysect_optical::{HenyeyGreenstein, PhaseFunction};
/// let forward = HenyeyGreenstein::new(0.8)?;
/// assert!(forward.pdf(Vector3D::Z, Vector3D::Z) > 100.0 * forward.pdf(Vector3D::Z, -Vector3D::Z));
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HenyeyGreenstein {
    asymmetry: f64,
}

impl HenyeyGreenstein {
    /// Of an asymmetry g, −1 … 1 without the ends; 0 scatters evenly.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] beyond.
    pub fn new(asymmetry: f64) -> Result<Self, OpticalError> {
        MathError::check(asymmetry.abs() < 1.0, asymmetry, "asymmetry", "", "−1 … 1, without the ends")?;
        Ok(Self { asymmetry })
    }

    /// Even in all directions.
    pub fn isotropic() -> Self {
        Self { asymmetry: 0.0 }
    }

    /// The mean cosine of the angle of scattering.
    pub fn asymmetry(&self) -> f64 {
        self.asymmetry
    }
}

impl PhaseFunction for HenyeyGreenstein {
    fn sample(&self, incoming: Vector3D, rng: &mut Rng) -> Vector3D {
        let (g, u) = (self.asymmetry, rng.uniform());
        // The inverse of the cumulative distribution, (1 + g² − ((1 − g²) / (1 + g s))²) / 2g, multiplied out so that
        // nothing is lost as g → 0.
        let s = 2.0 * u - 1.0;
        let x = 1.0 + g * s;
        let cosine = (s + 0.5 * g * (s * s + 3.0) + g * g * (s - 0.5 * g * (1.0 - s * s))) / (x * x);
        turn(incoming, cosine.clamp(-1.0, 1.0), rng)
    }

    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D) -> f64 {
        let g = self.asymmetry;
        let base = 1.0 + g * g - 2.0 * g * incoming.dot(outgoing);
        (1.0 - g * g) / (4.0 * PI * base * base.sqrt())
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("HenyeyGreenstein").number("asymmetry", self.asymmetry))
    }
}

/// Scattering by particles much smaller than the wavelength, unpolarised: p = 3 (1 + cos² θ) / 16π
/// (Lord Rayleigh 1871; S. Chandrasekhar, *Radiative Transfer*, 1960, § 16).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rayleigh;

impl PhaseFunction for Rayleigh {
    fn sample(&self, incoming: Vector3D, rng: &mut Rng) -> Vector3D {
        // c³ + 3 c = 8 u − 4 has one real root (J. Frisvad, *Importance sampling the Rayleigh phase function*, JOSA A
        // 28, 2436, 2011).
        let q = 4.0 * rng.uniform() - 2.0;
        let root = (q + (1.0 + q * q).sqrt()).cbrt();
        turn(incoming, (root - 1.0 / root).clamp(-1.0, 1.0), rng)
    }

    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D) -> f64 {
        let cosine = incoming.dot(outgoing);
        3.0 * (1.0 + cosine * cosine) / (16.0 * PI)
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Rayleigh"))
    }
}

/// A direction at an angle of known cosine to another, at a random angle about it.
fn turn(axis: Vector3D, cosine: f64, rng: &mut Rng) -> Vector3D {
    let (sine, angle) = (((1.0 - cosine) * (1.0 + cosine)).sqrt(), TAU * rng.uniform());
    let local = Vector3D::new(sine * angle.cos(), sine * angle.sin(), cosine);
    Frame::from_z(axis).to_world(local).normalise_unchecked()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of the cosine, sampled and by the density.
    fn moments(phase: &dyn PhaseFunction) -> ([f64; 3], [f64; 3]) {
        let (axis, n) = (Vector3D::new(0.6, 0.0, -0.8), 400_000);
        let (mut rng, mut sampled) = (Rng::new(4), [0.0; 3]);
        for _ in 0..n {
            let cosine = axis.dot(phase.sample(axis, &mut rng));
            (0..3).for_each(|k| sampled[k] += cosine.powi(k as i32) / n as f64);
        }
        let expected = [0, 1, 2].map(|k| {
            let along = |c: f64| {
                let side = Vector3D::new(0.0, (1.0 - c * c).sqrt(), 0.0);
                TAU * c.powi(k) * phase.pdf(axis, axis * c + side)
            };
            raysect_math::integrate(&along, -1.0, 1.0, 0.01, 1e-12).0
        });
        (sampled, expected)
    }

    #[test]
    fn samples_follow_the_densities_which_integrate_to_one() {
        let lobes = [-0.9, -0.3, 0.0, 1e-9, 1e-3, 0.5, 0.95].map(|g| HenyeyGreenstein::new(g).unwrap());
        for lobe in lobes {
            let (sampled, expected) = moments(&lobe);
            assert!((expected[0] - 1.0).abs() < 1e-9 && (expected[1] - lobe.asymmetry()).abs() < 1e-9);
            assert!((1..3).all(|k| (sampled[k] - expected[k]).abs() < 4.0 / 400_000f64.sqrt()), "{lobe:?}");
        }
        let (sampled, expected) = moments(&Rayleigh);
        assert!((expected[0] - 1.0).abs() < 1e-9 && (expected[2] - 0.4).abs() < 1e-9);
        assert!((1..3).all(|k| (sampled[k] - expected[k]).abs() < 4.0 / 400_000f64.sqrt()));
    }

    #[test]
    fn the_ends_of_the_range_are_refused() {
        assert!(HenyeyGreenstein::new(1.0).is_err() && HenyeyGreenstein::new(f64::NAN).is_err());
    }
}
