use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::{MathError, integrate};

use super::{SpectralFunction, numerical_integral};
use crate::{OpticalError, SpectralTable};

/// The constants of the SI of 2019, which are exact: Planck's [J s], the speed of light [m/s], Boltzmann's [J/K].
const PLANCK: f64 = 6.626_070_15e-34;
const LIGHT: f64 = 299_792_458.0;
const BOLTZMANN: f64 = 1.380_649e-23;
/// h c / k [nm K].
const SECOND_RADIATION: f64 = PLANCK * LIGHT / BOLTZMANN * 1e9;
/// Beyond this the factor exp(−x) is zero in double precision.
const LARGEST: f64 = 745.0;

/// The spectral radiance of a black or grey body [W/m²/sr/nm] (M. Planck, *Ann. Phys.* 309, 553, 1901).
///
/// Averages over bins are integrals of Planck's law, to 1e-12 for a constant emissivity and to 1e-10 otherwise; the range
/// may begin at 0 and end at infinity.
///
/// ```
/// use raysect_optical::{BlackBody, SpectralFunction};
/// let sun = BlackBody::new(5778.0)?;
/// assert!((sun.evaluate(500.0) - 26375.6698666).abs() < 1e-6);
/// let room = BlackBody::new(300.0)?.integrate(0.0, f64::INFINITY);     // σ T⁴ / π
/// assert!((room - 146.199835115).abs() < 1e-8);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BlackBody {
    temperature: f64,
    emissivity: SpectralTable,
    scale: f64,
}

impl BlackBody {
    /// From a temperature [K].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless it is positive and at most 1e60 K.
    pub fn new(temperature: f64) -> Result<Self, OpticalError> {
        let admitted = temperature > 0.0 && temperature <= 1e60;
        MathError::check(admitted, temperature, "temperature", "K", "positive, at most 1e60")?;
        Ok(Self { temperature, emissivity: 1.0.into(), scale: 1.0 })
    }

    /// With an emissivity, 0 … 1 for a passive body, as a function of the wavelength. Its values are taken as they are.
    pub fn emissivity(self, emissivity: impl Into<SpectralTable>) -> Self {
        Self { emissivity: emissivity.into(), ..self }
    }

    /// With every value multiplied by a factor.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless it is positive and finite.
    pub fn scaled(self, factor: f64) -> Result<Self, OpticalError> {
        let admitted = factor > 0.0 && factor.is_finite();
        MathError::check(admitted, factor, "scale of a black body", "", "positive and finite")?;
        Ok(Self { scale: self.scale * factor, ..self })
    }

    /// The temperature [K].
    pub fn temperature(&self) -> f64 {
        self.temperature
    }

    /// Planck's law [W/m²/sr/nm]: 2 c (k T)⁵ / (h c)⁴ x⁵ / (exp x − 1), with x = h c / (λ k T).
    fn radiance(&self, wavelength: f64) -> f64 {
        let x = SECOND_RADIATION / (wavelength * self.temperature);
        if x.is_nan() || x > LARGEST {
            return 0.0;
        }
        let kt = BOLTZMANN * self.temperature;
        2e-9 * LIGHT * kt * (kt / (PLANCK * LIGHT)).powi(4) * x.powi(4) * bose(x)
    }

    /// Integral of Planck's law [W/m²/sr] from `min` to `max` [nm], 0 ≤ min ≤ max ≤ ∞: 2 (k T)⁴ / (h³ c²) times the
    /// integral of x³ / (exp x − 1).
    fn band(&self, min: f64, max: f64) -> f64 {
        let scaled = SECOND_RADIATION / self.temperature;
        let low = scaled / max;
        // The difference of two close numbers x would lose the digits that a narrow bin has.
        let width = if min > 0.0 && max.is_finite() {
            scaled * ((max - min) / min / max)
        } else {
            scaled / min - low
        };
        if width.is_nan() || low > LARGEST {
            return 0.0;
        }
        // What lies more than 60 above is less than 1e-20 of the rest.
        let (integral, _) =
            integrate(&|s| (low + s).powi(2) * bose(low + s), 0.0, width.min(60.0), 2.0, 1e-13);
        let kt = BOLTZMANN * self.temperature;
        2.0 * kt * (kt / (PLANCK * LIGHT)).powi(3) * LIGHT * integral
    }
}

/// x / (exp x − 1).
fn bose(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x / x.exp_m1() }
}

impl SpectralFunction for BlackBody {
    fn evaluate(&self, wavelength: f64) -> f64 {
        self.scale * self.emissivity.function().evaluate(wavelength) * self.radiance(wavelength)
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        if max < min {
            return -self.integrate(max, min);
        }
        let emissivity = self.emissivity.function();
        let resolution = emissivity.resolution();
        if resolution == f64::INFINITY {
            // No structure at all: a constant.
            return self.scale * emissivity.evaluate(max) * self.band(min.max(0.0), max);
        }
        let product = |wavelength: f64| emissivity.evaluate(wavelength) * self.radiance(wavelength);
        // Quadrature is blind to some kinks, so that it has to stop at each.
        let mut edges = vec![min];
        edges.extend(emissivity.knots().iter().filter(|knot| (min..max).contains(knot)));
        edges.push(max);
        let pieces = edges.windows(2).map(|w| numerical_integral(&product, w[0], w[1], resolution));
        self.scale * pieces.sum::<f64>()
    }

    fn resolution(&self) -> f64 {
        self.emissivity.function().resolution().min(1.0)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("BlackBody")
            .number("temperature", self.temperature)
            .reference("emissivity", writer.object(&self.emissivity)?)
            .number("scale", self.scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::InterpolatedSf;

    fn close(value: f64, expected: f64, tolerance: f64) {
        assert!((value / expected - 1.0).abs() < tolerance, "{value} {expected}");
    }

    #[test]
    fn radiances_in_40_digit_arithmetic() {
        let sun = BlackBody::new(5778.0).unwrap();
        close(sun.evaluate(500.0), 26375.669866614797, 1e-14);
        close(sun.integrate(375.0, 785.0), 9553929.525046756, 1e-13);
        close(BlackBody::new(300.0).unwrap().integrate(0.0, f64::INFINITY), 146.19983511519598, 1e-13);
    }

    #[test]
    fn neither_short_nor_long_wavelengths_overflow() {
        let body = BlackBody::new(300.0).unwrap();
        for wavelength in [0.0, 1e-300, 1e-5, 50.0] {
            assert_eq!(body.evaluate(wavelength), 0.0, "{wavelength}");
        }
        assert_eq!(body.integrate(1e-200, 40.0), 0.0);
        // Rayleigh and Jeans: 2 c k T / λ⁴.
        let far: f64 = 1e15;
        let classical = 2.0 * LIGHT * BOLTZMANN * 300.0 * 1e36 / far.powi(4) * 1e-9;
        close(body.evaluate(far), classical, 1e-7);
        assert!(body.evaluate(1e100) >= 0.0 && body.evaluate(f64::MAX) == 0.0);
        let hot = BlackBody::new(1e12).unwrap();
        assert!(hot.evaluate(1e-6).is_finite() && hot.integrate(1e-9, 1e9).is_finite());
    }

    #[test]
    fn bins_of_any_width_are_integrals_of_the_law() {
        for temperature in [40.0, 300.0, 3000.0, 5778.0, 1e6] {
            let body = BlackBody::new(temperature).unwrap();
            for (low, high) in [(375.0, 740.0), (589.0, 589.6), (589.0, 589.000_001), (100.0, 1e5)] {
                let fine = integrate(&|w| body.radiance(w), low, high, (high - low) / 64.0, 1e-13).0;
                let band = body.integrate(low, high);
                assert!((band - fine).abs() <= 1e-11 * fine, "{temperature} {low} {high}: {band} {fine}");
            }
        }
    }

    #[test]
    fn an_emissivity_is_weighed_by_the_law() {
        let body = BlackBody::new(3000.0).unwrap();
        let grey = body.clone().emissivity(0.7).scaled(2.0).unwrap();
        close(grey.integrate(375.0, 740.0), 1.4 * body.integrate(375.0, 740.0), 1e-14);
        let step = InterpolatedSf::new([400.0, 500.0, 500.001, 600.0], [0.2, 0.2, 0.9, 0.9]).unwrap();
        let painted = body.clone().emissivity(step);
        let middle =
            integrate(&|w| (0.2 + 0.7 * (w - 500.0) / 0.001) * body.radiance(w), 500.0, 500.001, 1e-3, 1e-12);
        let exact = 0.2 * body.integrate(375.0, 500.0) + middle.0 + 0.9 * body.integrate(500.001, 740.0);
        close(painted.integrate(375.0, 740.0), exact, 1e-10);
    }

    #[test]
    fn impossible_scales_are_refused() {
        for factor in [0.0, -0.5, f64::NAN, f64::INFINITY] {
            let refused = BlackBody::new(300.0).unwrap().scaled(factor).unwrap_err().to_string();
            assert!(
                refused.contains(&format!("{factor}")) && refused.contains("scale of a black body"),
                "{refused}"
            );
            assert!(refused.contains("positive and finite"), "{refused}");
        }
    }

    #[test]
    fn impossible_temperatures_are_refused() {
        for temperature in [0.0, -3.0, f64::NAN, f64::INFINITY] {
            assert!(BlackBody::new(temperature).is_err(), "{temperature}");
        }
    }
}
