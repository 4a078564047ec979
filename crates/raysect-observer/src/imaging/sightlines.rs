use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::uniforms;
use raysect_math::{ConeCosineSampler, Frame, MathError, Point3D, Rng, Vector3D};

use super::vector::triples;
use crate::{FrameShape, Observer, ObserverError, Sensor, etendue_of_cone};

/// Any number of lines of sight, each with its own origin, direction, acceptance and étendue: the channels of a
/// spectrometer, or a bolometer camera.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_observer::{Sightline, SightlineArray};
/// let fan = (0..16).map(|i| {
///     let direction = Vector3D::new(0.05 * f64::from(i), 0.0, 1.0);
///     Sightline::new(Point3D::ORIGIN, direction)?.acceptance(0.5)?.aperture(1e-6)
/// });
/// let array = SightlineArray::new(fan.collect::<Result<Vec<_>, _>>()?)?;
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type SightlineArray = Observer<Sightlines>;

/// One of the lines of a [`SightlineArray`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sightline {
    origin: Point3D,
    direction: Vector3D,
    /// Half angle [deg], 0 for a line.
    acceptance: f64,
    etendue: Option<f64>,
}

impl Sightline {
    /// From an origin [m] in a direction, without width.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for an origin that is not finite or a direction without length.
    pub fn new(origin: Point3D, direction: Vector3D) -> Result<Self, ObserverError> {
        let farthest = origin.max_abs();
        MathError::check(farthest.is_finite(), farthest, "coordinate of an origin", "m", "finite")?;
        let unit = (direction.length() - 1.0).abs() <= 4.0 * f64::EPSILON;
        let direction = if unit { direction } else { direction.normalise()? };
        Ok(Self { origin, direction, acceptance: 0.0, etendue: None })
    }

    /// With a cone of acceptance of a half angle [deg]; the cosine to its axis counts. 0 is a line.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it lies in 0 … 90 degrees and is 0 or more than 1e-140.
    pub fn acceptance(mut self, half_angle: f64) -> Result<Self, ObserverError> {
        let admitted = half_angle == 0.0 || (1e-140..=90.0).contains(&half_angle);
        MathError::check(admitted, half_angle, "acceptance", "deg", "0, or 1e-140 … 90")?;
        self.acceptance = half_angle;
        Ok(self)
    }

    /// With an étendue [m² sr], so that power can be measured.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is positive and finite.
    pub fn etendue(mut self, etendue: f64) -> Result<Self, ObserverError> {
        let admitted = etendue > 0.0 && etendue.is_finite();
        MathError::check(admitted, etendue, "étendue", "m² sr", "positive and finite")?;
        self.etendue = Some(etendue);
        Ok(self)
    }

    /// With the étendue A π sin² θ of a small aperture of an area [m²] before the cone of acceptance, which must have been
    /// given before.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless the étendue is positive and finite: a line has none.
    pub fn aperture(self, area: f64) -> Result<Self, ObserverError> {
        self.etendue(area * etendue_of_cone(self.acceptance))
    }
}

/// The sensor of a [`SightlineArray`].
#[derive(Debug, Clone, PartialEq)]
pub struct Sightlines {
    lines: Vec<Sightline>,
    /// The turned cone of each line that has one.
    cones: Vec<Option<(Frame, ConeCosineSampler)>>,
}

impl Observer<Sightlines> {
    /// Of these lines, each of which is a pixel.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for none or 2³² and more.
    pub fn new(lines: impl Into<Vec<Sightline>>) -> Result<Self, ObserverError> {
        Ok(Self::with_sensor(Sightlines::of(lines.into())?))
    }
}

impl Sightlines {
    fn of(lines: Vec<Sightline>) -> Result<Self, ObserverError> {
        super::raster::check_pixels(lines.len(), 1)?;
        let cone = |line: &Sightline| -> Result<Option<(Frame, ConeCosineSampler)>, MathError> {
            if line.acceptance == 0.0 {
                return Ok(None);
            }
            Ok(Some((Frame::from_z(line.direction), ConeCosineSampler::new(line.acceptance)?)))
        };
        let cones = lines.iter().map(cone).collect::<Result<_, _>>()?;
        Ok(Self { lines, cones })
    }

    /// The lines.
    pub fn lines(&self) -> &[Sightline] {
        &self.lines
    }
}

impl Sensor for Sightlines {
    fn shape(&self) -> FrameShape {
        FrameShape::Line(self.lines.len())
    }

    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let line = &self.lines[pixel];
        let direction = match &self.cones[pixel] {
            Some((frame, cone)) => frame.to_world(cone.sample_at(uniforms(rng))),
            None => line.direction,
        };
        Ray::new(line.origin, direction)
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn direction_pdf(&self, pixel: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        let (frame, _) = self.cones[pixel].as_ref()?;
        Some(density_in_cone(frame, self.lines[pixel].acceptance, direction))
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.lines.get(pixel)?.etendue
    }

    fn cosine(&self, pixel: usize, _: Point3D, direction: Vector3D) -> f64 {
        self.lines[pixel].direction.dot(direction).max(0.0)
    }

    fn description(&self) -> String {
        let numbers = self.lines.iter().flat_map(|l| {
            let ends = l.origin.to_array().into_iter().chain(l.direction.to_array());
            ends.chain([l.acceptance, l.etendue.unwrap_or(f64::NAN)])
        });
        format!("{} of {}, lines {:016x}", self.kind(), self.shape(), super::etendue::digest(numbers))
    }

    fn kind(&self) -> &'static str {
        "array of lines of sight"
    }
}

/// Density of a turned cone, whose border is widened by what turning a direction there and back may move it [rad].
fn density_in_cone(frame: &Frame, half_angle: f64, direction: Vector3D) -> f64 {
    let local = frame.to_local(direction);
    let angle = local.x.hypot(local.y).atan2(local.z);
    let limit = half_angle.to_radians();
    if local.z > 0.0 && angle <= limit + 16.0 * f64::EPSILON {
        let sin = limit.sin();
        local.z / (std::f64::consts::PI * sin * sin)
    } else {
        0.0
    }
}

impl Storable for Sightlines {
    const KIND: &'static str = "Sightlines";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let all = |of: fn(&Sightline) -> [f64; 3]| self.lines.iter().flat_map(of).collect::<Vec<f64>>();
        let one = |of: fn(&Sightline) -> f64| self.lines.iter().map(of).collect::<Vec<f64>>();
        Ok(saved
            .numbers("origins", &all(|l| l.origin.to_array()))
            .numbers("directions", &all(|l| l.direction.to_array()))
            .numbers("acceptances", &one(|l| l.acceptance))
            .numbers("etendues", &one(|l| l.etendue.unwrap_or(0.0))))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let origins = triples("origins", &entry.numbers("origins")?)?;
        let directions = triples("directions", &entry.numbers("directions")?)?;
        let (acceptances, etendues) = (entry.numbers("acceptances")?, entry.numbers("etendues")?);
        let expected = origins.len();
        let lengths = [directions.len(), acceptances.len(), etendues.len()];
        if let Some(&found) = lengths.iter().find(|&&n| n != expected) {
            return Err(ObserverError::PixelCount { what: "lines of sight", found, expected }.into());
        }
        let mut lines = Vec::with_capacity(expected);
        for (index, origin) in origins.into_iter().enumerate() {
            let line = Sightline::new(Point3D::from(origin), Vector3D::from(directions[index]))?;
            let line = line.acceptance(acceptances[index])?;
            lines.push(if etendues[index] == 0.0 { line } else { line.etendue(etendues[index])? });
        }
        Ok(Self::of(lines)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;
    use std::f64::consts::PI;

    fn three() -> SightlineArray {
        let line = |x: f64, direction| Sightline::new(Point3D::new(x, 0.0, 0.0), direction).unwrap();
        SightlineArray::new([
            line(0.0, Vector3D::new(0.0, 0.0, 2.0)),
            line(1.0, Vector3D::new(1.0, 1.0, 0.0)).acceptance(10.0).unwrap().aperture(1e-6).unwrap(),
            line(2.0, Vector3D::new(0.0, -1.0, 1.0)).acceptance(1e-9).unwrap().etendue(3e-9).unwrap(),
        ])
        .unwrap()
    }

    #[test]
    fn every_line_has_its_own_cone_and_etendue() {
        let array = three();
        let (sensor, mut rng) = (array.sensor(), Rng::new(1));
        check_sensor(sensor, 1000, 1).unwrap();
        assert_eq!(sensor.sample_ray(0, &mut rng), Ray::new(Point3D::ORIGIN, Vector3D::Z));
        assert_eq!((sensor.etendue(0), sensor.etendue(2)), (None, Some(3e-9)));
        let sin = 10f64.to_radians().sin();
        assert!((sensor.etendue(1).unwrap() / (1e-6 * PI * sin * sin) - 1.0).abs() < 1e-14);
        for (pixel, half_angle) in [(1, 10.0f64), (2, 1e-9)] {
            let mut widest = 0.0f64;
            for _ in 0..1000 {
                let ray = sensor.sample_ray(pixel, &mut rng);
                assert_eq!(ray.origin.x, pixel as f64);
                assert!(sensor.direction_pdf(pixel, ray.origin, ray.direction) > Some(0.0));
                let off = sensor.lines[pixel].direction.cross(ray.direction).length();
                widest = widest.max(off / half_angle.to_radians().sin());
            }
            assert!(widest > 0.99 && widest < 1.0 + 1e-4, "{widest}");
        }
    }

    #[test]
    fn impossible_lines_are_refused() {
        let line = Sightline::new(Point3D::ORIGIN, Vector3D::Z).unwrap();
        assert!(line.acceptance(90.5).is_err() && line.acceptance(-1.0).is_err());
        assert!(line.etendue(0.0).is_err() && line.aperture(1.0).is_err());
        assert!(Sightline::new(Point3D::ORIGIN, Vector3D::ZERO).is_err());
        assert!(Sightline::new(Point3D::new(f64::INFINITY, 0.0, 0.0), Vector3D::Z).is_err());
        assert!(SightlineArray::new([]).is_err());
    }
}
