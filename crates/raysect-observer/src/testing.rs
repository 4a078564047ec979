//! The contract of [`Sensor`] as code, for our sensors and for users' own.

use raysect_math::{Rng, Statistics};

use crate::Sensor;

/// Tests that E\[response · cosine / pdf\] over a pixel's rays is its étendue, that its rays are finite and of unit
/// direction, and that sensors which look along one direction only say so.
///
/// # Errors
/// A sentence that says what is wrong, for which pixel, and by how much.
pub fn check_sensor<S: Sensor + ?Sized>(sensor: &S, samples: usize, seed: u64) -> Result<(), String> {
    let pixels = sensor.shape().pixels();
    if pixels == 0 {
        return Err("the sensor has no pixels".to_owned());
    }
    let mut rng = Rng::new(seed);
    for pixel in [0, pixels / 2, pixels - 1] {
        let mut weights = Statistics::new();
        for _ in 0..samples {
            let ray = sensor.sample_ray(pixel, &mut rng);
            if ray.check().is_err() || (ray.direction.length() - 1.0).abs() > 1e-12 {
                return Err(format!("pixel {pixel}: ray {ray:?}"));
            }
            let (origin, direction) = (ray.origin, ray.direction);
            let response = sensor.response(pixel, origin, direction);
            if !(response >= 0.0 && response.is_finite()) {
                return Err(format!("pixel {pixel}: response {response} for {ray:?}"));
            }
            if let Some(pdf) = sensor.pdf(pixel, origin, direction) {
                if !(pdf > 0.0 && pdf.is_finite()) {
                    return Err(format!("pixel {pixel}: density {pdf} of its own ray {ray:?}"));
                }
                weights.add(response * sensor.cosine(pixel, origin, direction) / pdf);
            }
        }
        let Some(etendue) = sensor.etendue(pixel) else {
            if weights.count() > 0 {
                return Err(format!("pixel {pixel}: rays have a density, but there is no étendue"));
            }
            continue;
        };
        if weights.count() > 0 && (weights.mean() - etendue).abs() > 5.0 * weights.error() + 1e-12 * etendue {
            return Err(format!(
                "pixel {pixel}: étendue {etendue} m² sr, but its rays weigh {weights} m² sr"
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FrameShape, PinholeCamera};
    use raysect_core::Ray;
    use raysect_math::{Point3D, Vector3D, sampling::hemisphere, sampling::uniforms};
    use std::f64::consts::PI;

    /// A square of 1 cm that looks into the half space, with a fault in its étendue.
    struct Square(f64);

    impl Sensor for Square {
        fn shape(&self) -> FrameShape {
            FrameShape::Single
        }
        fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
            let origin = Point3D::new(rng.range(0.0, 0.01), rng.range(0.0, 0.01), 0.0);
            Ray::new(origin, hemisphere::sample_uniform(uniforms(rng)))
        }
        fn pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
            Some(hemisphere::pdf_uniform(direction) / 1e-4)
        }
        fn etendue(&self, _: usize) -> Option<f64> {
            Some(PI * 1e-4 * self.0)
        }
    }

    #[test]
    fn right_sensors_pass_and_wrong_ones_do_not() {
        check_sensor(&Square(1.0), 100_000, 1).unwrap();
        assert!(check_sensor(&Square(1.02), 100_000, 1).is_err());
        check_sensor(PinholeCamera::new((7, 5), 60.0).unwrap().sensor(), 1000, 1).unwrap();
    }
}
