//! Negative controls: sensors with a mistake each, that the judge has to find.

use std::f64::consts::{FRAC_PI_2, PI};

use raysect::core::Ray;
use raysect::math::sampling::{hemisphere, uniforms};
use raysect::math::{Cone, Frame, Rng};
use raysect::observer::testing::check_sensor;
use raysect::observer::{FrameShape, Observer};
use raysect::prelude::*;

use crate::check::Demand;
use crate::readings::{Place, judge, read};
use crate::scenes::{ball_lamp, dome, tilted, world};

/// A pixel that claims a multiple of its étendue, as Raysect's does (2 π A).
struct Claims(f64);

impl Sensor for Claims {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }
    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let origin = Point3D::new(rng.range(-0.005, 0.005), rng.range(-0.005, 0.005), 0.0);
        Ray::new(origin, hemisphere::sample_cosine(uniforms(rng)))
    }
    fn pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        Some(hemisphere::pdf_cosine(direction) / 1e-4)
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        Some(self.0 * PI * 1e-4)
    }
}

#[test]
fn a_wrong_etendue_is_found_by_the_furnace_and_by_the_contract() {
    let reading =
        |factor| read(Observer::with_sensor(Claims(factor)), &world([dome()]), Place::default(), 200)[0];
    assert_eq!(judge(1.0, Demand::Exact, reading(1.0).radiance), Ok(()));
    assert!(judge(1.0, Demand::Exact, reading(2.0).radiance).is_err());
    assert!(judge(1.0, Demand::Exact, reading(1.0 + 1e-11).radiance).is_err());
    check_sensor(&Claims(1.0), 1000, 1).unwrap();
    assert!(check_sensor(&Claims(2.0), 1000, 1).is_err());
}

#[test]
fn a_cosine_of_a_pinhole_is_found_by_the_furnace() {
    let camera = PinholeCamera::new((3, 3), 70.0).unwrap().etendue(1e-9).unwrap().cosine_weighted(true);
    let reading = read(camera, &world([dome()]), Place::default(), 200)[0];
    assert!(judge(1.0, Demand::Mean, reading.radiance).is_err());
}

/// A pixel at a lamp of 10°, with Raysect's question about the horizon: asked of the direction for the density, and of the
/// lamp for the sample.
struct Horizon {
    elevation: f64,
    right: bool,
}

impl Horizon {
    fn cone(&self) -> (Frame, Cone) {
        (Frame::from_z(Vector3D::from(tilted(90.0 - self.elevation))), Cone::from_angle(10.0).unwrap())
    }
}

impl Sensor for Horizon {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }
    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let (frame, cone) = self.cone();
        let aimed = rng.uniform() < 0.9 && self.elevation > 10.0;
        let own = hemisphere::sample_cosine(uniforms(rng));
        Ray::new(Point3D::ORIGIN, if aimed { frame.to_world(cone.sample(rng)) } else { own })
    }
    fn pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        let (frame, cone) = self.cone();
        let high = (FRAC_PI_2 - direction.z.acos()).to_degrees() > 10.0;
        let asked = if self.right { self.elevation > 10.0 } else { high };
        let own = hemisphere::pdf_cosine(direction);
        let aimed = if asked { cone.pdf(frame.to_local(direction)) } else { own };
        Some((0.1 * own + 0.9 * aimed) / 1e-8)
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        Some(PI * 1e-8)
    }
}

#[test]
fn a_density_that_asks_the_direction_about_the_horizon_is_found_at_low_lamps() {
    let reading = |right| {
        let world = world([ball_lamp(5.0 * 10f64.to_radians().sin(), 5.0, 78.0)]);
        let observer = Observer::with_sensor(Horizon { elevation: 12.0, right });
        read(observer, &world, Place::default(), 200_000)[0].power
    };
    let power = PI * 1e-8 * 10f64.to_radians().sin().powi(2) * 78f64.to_radians().cos();
    assert_eq!(judge(power, Demand::Mean, reading(true)), Ok(()));
    let wrong = reading(false);
    println!("Raysect's density at 12°: {wrong:?} for {power}");
    assert!((wrong.value - power).abs() > 10.0 * wrong.error && wrong.value > 2.0 * power);
}
