//! The contract of [`Sensor`] as code, for our sensors and for users' own.

use raysect_core::Ray;
use raysect_math::{Cone, Frame, Rng, Statistics, Vector3D};

use crate::Sensor;

/// Tests that E\[response · cosine / pdf\] over a pixel's rays is its étendue, that its rays are finite and of unit
/// direction, and that its densities agree: [`pdf`](Sensor::pdf) is the product of
/// [`origin_pdf`](Sensor::origin_pdf) and [`direction_pdf`](Sensor::direction_pdf) where there are all three, and the
/// directions of a sensor whose rays begin at one point are spread as it says. The first, the middle and the last pixel are
/// tested.
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
        check_pixel(sensor, pixel, samples, &mut rng).map_err(|fault| format!("pixel {pixel}: {fault}"))?;
    }
    Ok(())
}

fn check_pixel<S: Sensor + ?Sized>(
    sensor: &S,
    pixel: usize,
    samples: usize,
    rng: &mut Rng,
) -> Result<(), String> {
    let (mut weights, mut rays) = (Statistics::new(), Vec::with_capacity(samples));
    for _ in 0..samples {
        let ray = sensor.sample_ray(pixel, rng);
        if ray.check().is_err() || (ray.direction.length() - 1.0).abs() > 1e-12 {
            return Err(format!("ray {ray:?}"));
        }
        let (origin, direction) = (ray.origin, ray.direction);
        let response = sensor.response(pixel, origin, direction);
        if !(response >= 0.0 && response.is_finite()) {
            return Err(format!("response {response} for {ray:?}"));
        }
        check_densities(sensor, pixel, &ray)?;
        if let Some(pdf) = sensor.pdf(pixel, origin, direction) {
            weights.add(response * sensor.cosine(pixel, origin, direction) / pdf);
        }
        rays.push(ray);
    }
    if weights.count() == 0 {
        return check_spread(sensor, pixel, &rays, rng);
    }
    let Some(etendue) = sensor.etendue(pixel) else {
        return Err("rays have a density, but there is no étendue".to_owned());
    };
    if (weights.mean() - etendue).abs() > 5.0 * weights.error() + 1e-12 * etendue {
        return Err(format!("étendue {etendue} m² sr, but its rays weigh {weights} m² sr"));
    }
    Ok(())
}

/// The densities of a sensor's own ray are positive, and the product of two is the third.
fn check_densities<S: Sensor + ?Sized>(sensor: &S, pixel: usize, ray: &Ray) -> Result<(), String> {
    let all = sensor.pdf(pixel, ray.origin, ray.direction);
    let origins = sensor.origin_pdf(pixel, ray.origin);
    let directions = sensor.direction_pdf(pixel, ray.origin, ray.direction);
    for (name, density) in
        [("density", all), ("density of origins", origins), ("density of directions", directions)]
    {
        if density.is_some_and(|d| !(d > 0.0 && d.is_finite())) {
            return Err(format!("{name} {density:?} of its own ray {ray:?}"));
        }
    }
    if let (Some(all), Some(origins), Some(directions)) = (all, origins, directions)
        && (origins * directions - all).abs() > 1e-12 * all
    {
        return Err(format!("density {all}, but {origins} of origins times {directions} of directions"));
    }
    Ok(())
}

/// Rays that begin at one point: the density of their directions integrates to one over a cone around all of them, and if
/// there is none they are parallel or have no étendue that could be wrong.
fn check_spread<S: Sensor + ?Sized>(
    sensor: &S,
    pixel: usize,
    rays: &[Ray],
    rng: &mut Rng,
) -> Result<(), String> {
    let origin = rays[0].origin;
    if sensor.direction_pdf(pixel, origin, rays[0].direction).is_none() {
        return Ok(());
    }
    if let Some(other) = rays.iter().find(|ray| ray.origin != origin) {
        let (a, b) = (origin.to_array(), other.origin.to_array());
        return Err(format!("its rays begin at {a:?} and {b:?}, but origins have no density"));
    }
    let sum = rays.iter().fold(Vector3D::ZERO, |sum, ray| sum + ray.direction);
    let frame = Frame::from_z(sum.normalise().map_err(|e| e.to_string())?);
    let angle = |ray: &Ray| frame.z.cross(ray.direction).length().atan2(frame.z.dot(ray.direction));
    let widest = rays.iter().map(angle).fold(0.0, f64::max).to_degrees();
    let cone = Cone::from_angle((1.5 * widest).min(180.0)).map_err(|e| e.to_string())?;
    let mut integral = Statistics::new();
    for _ in 0..rays.len() {
        let direction = frame.to_world(cone.sample(rng));
        let density = sensor.direction_pdf(pixel, origin, direction).unwrap_or(f64::NAN);
        integral.add(density * cone.solid_angle());
    }
    let off = (integral.mean() - 1.0).abs();
    if off <= 5.0 * integral.error() + 1e-12 {
        return Ok(());
    }
    Err(format!("the density of its directions integrates to {integral}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FrameShape, PinholeCamera};
    use raysect_math::{Point3D, sampling::hemisphere, sampling::uniforms};
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

    /// Looks into a cone of 20° about z, and says that it is another.
    struct Torch(f64);

    impl Sensor for Torch {
        fn shape(&self) -> FrameShape {
            FrameShape::Single
        }
        fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
            Ray::new(Point3D::ORIGIN, Cone::from_angle(20.0).unwrap().sample(rng))
        }
        fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
            None
        }
        fn direction_pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
            Some(Cone::from_angle(self.0).unwrap().pdf(direction))
        }
        fn etendue(&self, _: usize) -> Option<f64> {
            None
        }
    }

    #[test]
    fn a_spread_of_directions_that_is_not_that_of_the_rays_is_found_out() {
        check_sensor(&Torch(20.0), 20_000, 1).unwrap();
        assert!(check_sensor(&Torch(19.5), 20_000, 1).is_err());
        // A wider cone with a density that is normalised over the narrow one.
        struct Wide(Torch);
        impl Sensor for Wide {
            fn shape(&self) -> FrameShape {
                FrameShape::Single
            }
            fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
                self.0.sample_ray(pixel, rng)
            }
            fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
                None
            }
            fn direction_pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
                self.0.direction_pdf(pixel, origin, direction).map(|d| 1.05 * d)
            }
            fn etendue(&self, _: usize) -> Option<f64> {
                None
            }
        }
        assert!(check_sensor(&Wide(Torch(20.0)), 20_000, 1).is_err());
    }

    #[test]
    fn densities_that_do_not_agree_are_found_out() {
        struct Uneven(Square);
        impl Sensor for Uneven {
            fn shape(&self) -> FrameShape {
                FrameShape::Single
            }
            fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
                self.0.sample_ray(pixel, rng)
            }
            fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
                self.0.pdf(pixel, origin, direction)
            }
            fn origin_pdf(&self, _: usize, _: Point3D) -> Option<f64> {
                Some(1e4)
            }
            fn direction_pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
                Some(hemisphere::pdf_cosine(direction))
            }
            fn etendue(&self, pixel: usize) -> Option<f64> {
                self.0.etendue(pixel)
            }
        }
        assert!(check_sensor(&Uneven(Square(1.0)), 1000, 1).unwrap_err().contains("times"));
    }
}
