use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{MathError, Point3D, Rng, Vector3D};

use crate::{FrameShape, Observer, ObserverError, Sensor};

/// One line of sight, from its origin along z.
///
/// ```
/// use raysect_observer::SightLine;
/// let line = SightLine::new().etendue(1e-9)?.pixel_samples(1000);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type SightLine = Observer<Line>;

/// The sensor of a [`SightLine`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Line {
    etendue: Option<f64>,
}

impl Observer<Line> {
    /// Along z.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self::with_sensor(Line::default())
    }

    /// With an étendue [m² sr], so that power can be measured.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is positive and finite.
    #[doc(alias = "sensitivity")]
    pub fn etendue(mut self, etendue: f64) -> Result<Self, ObserverError> {
        let admitted = etendue > 0.0 && etendue.is_finite();
        MathError::check(admitted, etendue, "étendue", "m² sr", "positive and finite")?;
        self.sensor_mut().etendue = Some(etendue);
        Ok(self)
    }
}

impl Sensor for Line {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }

    fn sample_ray(&self, _: usize, _: &mut Rng) -> Ray {
        Ray::new(Point3D::ORIGIN, Vector3D::Z)
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn etendue(&self, _: usize) -> Option<f64> {
        self.etendue
    }

    fn description(&self) -> String {
        format!("{}, étendue {:?}", self.kind(), self.etendue)
    }

    fn kind(&self) -> &'static str {
        "line of sight"
    }
}

impl Storable for Line {
    const KIND: &'static str = "Line";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(match self.etendue {
            Some(etendue) => saved.number("etendue", etendue),
            None => saved,
        })
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let line = SightLine::new();
        let line = if entry.has("etendue") { line.etendue(entry.number("etendue")?)? } else { line };
        Ok(*line.sensor())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn all_rays_are_the_line() {
        let line = SightLine::new().etendue(2e-9).unwrap();
        check_sensor(line.sensor(), 100, 1).unwrap();
        let ray = line.sensor().sample_ray(0, &mut Rng::new(1));
        assert_eq!((ray.origin, ray.direction), (Point3D::ORIGIN, Vector3D::Z));
        assert_eq!((line.sensor().etendue(0), SightLine::new().sensor().etendue(0)), (Some(2e-9), None));
        assert!(SightLine::new().etendue(0.0).is_err() && SightLine::new().etendue(f64::NAN).is_err());
    }
}
