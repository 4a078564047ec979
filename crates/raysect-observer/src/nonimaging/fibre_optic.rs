use std::f64::consts::PI;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::{disk, uniforms};
use raysect_math::{ConeCosineSampler, MathError, Point2D, Point3D, Rng, Vector3D};

use super::{Counting, counting_setting, etendue_of_cone};
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// The tip of an optical fibre: a disk across z that accepts light within a cone.
///
/// Its étendue is π r² π sin² θ. (Raysect counts the solid angle without its cosine, π r² 2π (1 − cos θ), for the
/// étendue, so that its radiance is too small by (1 + cos θ) / 2; the power is the same;
/// [`etendue_without_cosine`](Self::etendue_without_cosine) gives its numbers.)
///
/// ```
/// use raysect_observer::{FibreOptic, Sensor};
/// let fibre = FibreOptic::new(30.0, 1e-3)?;
/// assert!((fibre.sensor().etendue(0).unwrap() - 2.4674011002723394e-6).abs() < 1e-20);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type FibreOptic = Observer<Fibre>;

/// The sensor of a [`FibreOptic`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibre {
    acceptance: f64,
    radius: f64,
    cone: ConeCosineSampler,
    counting: Counting,
}

counting_setting!(Fibre);

impl Observer<Fibre> {
    /// With a half angle of acceptance [deg] and a radius [m].
    ///
    /// # Errors
    /// [`ObserverError::Math`] for an angle outside 1e-140 … 90 degrees or a radius outside 1e-150 … 1e150 m.
    #[doc(alias = "acceptance_angle")]
    pub fn new(acceptance: f64, radius: f64) -> Result<Self, ObserverError> {
        MathError::check((1e-150..=1e150).contains(&radius), radius, "radius", "m", "1e-150 … 1e150")?;
        let cone = ConeCosineSampler::new(acceptance)?;
        Ok(Self::with_sensor(Fibre { acceptance, radius, cone, counting: Counting::default() }))
    }
}

impl Fibre {
    /// Half angle of acceptance [deg].
    pub fn acceptance(&self) -> f64 {
        self.acceptance
    }

    /// Radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Area of the tip [m²].
    pub fn collection_area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Solid angle of acceptance [sr], without its cosine.
    pub fn solid_angle(&self) -> f64 {
        self.cone.solid_angle()
    }
}

impl Sensor for Fibre {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }

    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let p = disk::sample(uniforms(rng));
        let origin = Point3D::new(self.radius * p.x, self.radius * p.y, 0.0);
        Ray::new(origin, self.cone.sample_at(uniforms(rng)))
    }

    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.origin_pdf(pixel, origin)? * self.cone.pdf(direction))
    }

    fn origin_pdf(&self, _: usize, origin: Point3D) -> Option<f64> {
        let p = Point2D::new(origin.x / self.radius, origin.y / self.radius);
        Some(disk::pdf(p) / (self.radius * self.radius))
    }

    fn direction_pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.cone.pdf(direction))
    }

    /// 1 within the cone of acceptance, 0 outside.
    fn response(&self, _: usize, _: Point3D, direction: Vector3D) -> f64 {
        if self.cone.pdf(direction) > 0.0 { 1.0 } else { 0.0 }
    }

    fn etendue(&self, _: usize) -> Option<f64> {
        let counted =
            if self.counting.without_cosine { self.solid_angle() } else { etendue_of_cone(self.acceptance) };
        Some(self.collection_area() * counted)
    }

    fn description(&self) -> String {
        let counting = self.counting.describe();
        format!("{} of {:e} m and {:e} deg{counting}", self.kind(), self.radius, self.acceptance)
    }

    fn kind(&self) -> &'static str {
        "optical fibre"
    }
}

impl Storable for Fibre {
    const KIND: &'static str = "Fibre";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(self.counting.save(saved.number("acceptance", self.acceptance).number("radius", self.radius)))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let fibre = FibreOptic::new(entry.number("acceptance")?, entry.number("radius")?)?;
        Ok(Fibre { counting: Counting::load(entry)?, ..*fibre.sensor() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn the_etendue_is_that_of_the_cone() {
        for acceptance in [1e-6, 5.0, 30.0, 90.0] {
            let fibre = FibreOptic::new(acceptance, 0.005).unwrap();
            check_sensor(fibre.sensor(), 10_000, 1).unwrap();
        }
        let fibre = FibreOptic::new(20.0, 0.005).unwrap();
        assert!((fibre.sensor().etendue(0).unwrap() / 2.8863109923153077e-5 - 1.0).abs() < 1e-14);
        let half_space = FibreOptic::new(90.0, 1.0).unwrap();
        assert!((half_space.sensor().solid_angle() / (2.0 * PI) - 1.0).abs() < 1e-15);
        assert!((half_space.sensor().etendue(0).unwrap() / (PI * PI) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn outside_the_cone_it_sees_nothing() {
        let fibre = FibreOptic::new(20.0, 0.005).unwrap();
        let at = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            fibre.sensor().response(0, Point3D::ORIGIN, Vector3D::new(sin, 0.0, cos))
        };
        assert_eq!((at(19.99), at(20.01), at(180.0)), (1.0, 0.0, 0.0));
    }

    #[test]
    fn impossible_fibres_are_refused() {
        for (angle, radius) in [(0.0, 1.0), (90.1, 1.0), (f64::NAN, 1.0), (5.0, 0.0), (5.0, f64::INFINITY)] {
            assert!(FibreOptic::new(angle, radius).is_err());
        }
    }
}
