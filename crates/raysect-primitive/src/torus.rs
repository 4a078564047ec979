use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch,
    Surface, SurfaceSample, SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Bracket, MathError, Normal3D, Point3D, Vector3D};

use crate::{PrimitiveError, unit};

mod cubic;
mod exact;
mod quartic;
mod roots;
mod tube;
use tube::{Line, Span, Tube};

/// A ring: a tube about a circle in the plane z = 0.
///
/// Its axis is z. A tube as wide as the circle (`minor_radius` = `major_radius`) closes the hole to a point.
///
/// ```
/// use raysect_primitive::Torus;
/// let ring = Torus::new(1.0, 0.25)?;
/// assert!((ring.volume() / ring.surface_area() - 0.125).abs() < 1e-15);
/// assert!(Torus::new(1.0, 1.5).is_err());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    major_radius: f64,
    minor_radius: f64,
    /// One over the radius of the tube [1/m].
    inverse: f64,
    tube: Tube,
}

impl Default for Torus {
    /// Major radius 1 m, minor radius 0.5 m.
    fn default() -> Self {
        Self::of(1.0, 0.5)
    }
}

impl Torus {
    /// From the radius of the circle in the middle of the tube and the radius of the tube [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless the major radius lies in 1e-100 … 1e100 m, and the minor radius in
    /// 1e-9 … 1 times the major radius: a thinner tube would be as wide as the rounding of coordinates.
    pub fn new(major_radius: f64, minor_radius: f64) -> Result<Self, PrimitiveError> {
        let refuse = |source| PrimitiveError::Dimension { shape: "torus", source };
        let admitted = (1e-100..=1e100).contains(&major_radius);
        MathError::check(admitted, major_radius, "major_radius", "m", "1e-100 … 1e100 m").map_err(refuse)?;
        let admitted = minor_radius >= 1e-9 * major_radius && minor_radius <= major_radius;
        MathError::check(admitted, minor_radius, "minor_radius", "m", "1e-9 … 1 times major_radius")
            .map_err(refuse)?;
        Ok(Self::of(major_radius, minor_radius))
    }

    fn of(major_radius: f64, minor_radius: f64) -> Self {
        let tube = Tube::new(major_radius, minor_radius);
        Self { major_radius, minor_radius, inverse: 1.0 / minor_radius, tube }
    }

    /// The radius of the circle in the middle of the tube [m].
    pub fn major_radius(&self) -> f64 {
        self.major_radius
    }

    /// The radius of the tube [m].
    pub fn minor_radius(&self) -> f64 {
        self.minor_radius
    }

    /// The volume, 2 π² R r² [m³].
    pub fn volume(&self) -> f64 {
        0.5 * self.minor_radius * self.surface_area()
    }

    /// The area of the surface, 4 π² R r [m²].
    pub fn surface_area(&self) -> f64 {
        let circumferences = std::f64::consts::TAU * std::f64::consts::TAU;
        circumferences * self.major_radius * self.minor_radius
    }

    #[inline]
    fn crossing(&self, line: &Line, span: &Span, bracket: Bracket) -> Crossing {
        Self::crossing_at(self.tube.crossing(line, span, bracket), bracket.rising)
    }

    /// The first crossing in an interval, of all.
    fn hit_in_brackets(&self, line: &Line, span: &Span, within: Interval) -> Option<Crossing> {
        let brackets = self.tube.brackets(line, span);
        // A bracket that ends before the interval begins, or begins after it ends, need not be searched.
        let mut ahead = brackets
            .iter()
            .filter(|b| line.distance(b.high) >= within.min && line.distance(b.low) <= within.max);
        let first = ahead.find_map(|b| {
            let c = self.crossing(line, span, b);
            (c.distance >= within.min).then_some(c)
        });
        first.filter(|c| c.distance <= within.max)
    }

    #[inline]
    fn crossing_at(distance: f64, exiting: bool) -> Crossing {
        Crossing { distance, feature: Feature::default(), exiting }
    }

    /// Who goes inward leaves next, who goes outward enters next. If the line through the rounded origin is on the
    /// wrong side there, it has still to pass the crossing that is being left; unless that has vanished: then it has
    /// been left by less than rounding, and the answer is 0.
    fn next_in_brackets(&self, line: &Line, span: &Span, inward: bool) -> Option<Crossing> {
        let brackets = self.tube.brackets(line, span);
        let unpassed = brackets.iter().filter(|b| line.distance(b.high) > 0.0);
        let crossings = unpassed.map(|b| (b, self.crossing(line, span, b)));
        let mut ahead = crossings.skip_while(|(_, c)| c.distance <= 0.0);
        let first = ahead.next();
        let is_inside = first.is_some_and(|(b, _)| b.rising);
        if is_inside == inward {
            first.map(|(_, c)| c)
        } else if first.is_some_and(|(b, _)| self.tube.clings(line, &brackets, b)) {
            ahead.next().map(|(_, c)| c)
        } else {
            Some(Self::crossing_at(0.0, inward))
        }
    }
}

impl Primitive for Torus {
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Torus").number("major", self.major_radius).number("minor", self.minor_radius))
    }

    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        // The circle reaches R times the length of a row's x and y along that axis of the world, the tube r times the
        // length of the whole row.
        let centre = m.origin();
        let mut image = BoundingBox3D { lower: centre, upper: centre };
        for axis in 0..3 {
            let row = Vector3D::new(m.get(axis, 0), m.get(axis, 1), m.get(axis, 2));
            let reach = self.major_radius * Vector3D::new(row.x, row.y, 0.0).length()
                + self.minor_radius * row.length();
            let size = (self.major_radius + self.minor_radius) * row.length();
            image.pad_axis(axis, reach + 8.0 * f64::EPSILON * (size + centre[axis].abs()));
        }
        image
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                let radius = (self.major_radius + self.minor_radius) * scale * 1.000_000_001;
                BoundingSphere3D { centre: m.origin(), radius }
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, point: Point3D) -> bool {
        self.tube.depth(point.to_vector() * self.tube.scale).0 <= 0.0
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        let line = self.tube.line(ray);
        if let Some(span) = self.tube.span(&line) {
            let brackets = self.tube.brackets(&line, &span);
            out.extend(brackets.iter().map(|b| self.crossing(&line, &span, b)));
        }
    }

    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        let line = self.tube.line(ray);
        let span = self.tube.span(&line)?;
        match self.tube.clear_entry(&line, &span) {
            Some(distance) if distance >= within.min => {
                (distance <= within.max).then(|| Self::crossing_at(distance, false))
            }
            _ => self.hit_in_brackets(&line, &span, within),
        }
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        let line = self.tube.line(ray);
        let next = match self.tube.span(&line) {
            None => left.inward.then(|| Self::crossing_at(0.0, true)),
            Some(span) => match self.tube.clear_next(&line, &span, left.inward) {
                Some(next) => next.map(|distance| Self::crossing_at(distance, true)),
                None => self.next_in_brackets(&line, &span, left.inward),
            },
        };
        next.filter(|c| c.distance <= max_distance)
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let p = exact::point_at(ray.origin.to_vector(), ray.direction, crossing.distance);
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        // On the axis, which only a closed hole touches, any direction is as good.
        let (cosine, sine) = if rho > 0.0 { (p.x / rho, p.y / rho) } else { (1.0, 0.0) };
        let (out, up) = ((rho - self.major_radius) * self.inverse, p.z * self.inverse);
        let rough = Normal3D::new(out * cosine, out * sine, up);
        let stretch = unit::to_unit(rough.length_squared());
        let normal = rough * stretch;
        let (major, minor) = (self.major_radius, self.minor_radius);
        // Not a sum of two vectors, which would lose the azimuth in a closed hole.
        let circle = major + minor * (out * stretch);
        Surface {
            point: Point3D::new(circle * cosine, circle * sine, minor * normal.z),
            normal,
            shading_normal: normal,
            bound: 4.0 * f64::EPSILON * (major + minor),
        }
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    /// Uniform over the area; what faces away from `from` gives nothing.
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        // The area about the tube grows as θ + (r/R) sin θ, of which a share is looked up (Kepler's equation).
        let tau = std::f64::consts::TAU;
        let ratio = self.minor_radius / self.major_radius;
        let (phi, share) = (tau * u[0], tau * u[1]);
        let bracket = Bracket { low: 0.0, high: tau, rising: true };
        let theta = bracket.newton(0.0, |t| (t + ratio * t.sin() - share, 1.0 + ratio * t.cos()));
        let (up, out) = theta.sin_cos();
        let (sine, cosine) = phi.sin_cos();
        let circle = self.major_radius + self.minor_radius * out;
        let point = Point3D::new(circle * cosine, circle * sine, self.minor_radius * up);
        let normal = Normal3D::new(out * cosine, out * sine, up);
        let density = self.surface_density(from, point, Feature::default());
        (density > 0.0).then_some(SurfaceSample {
            point,
            normal,
            shading_normal: None,
            feature: Feature::default(),
            density,
        })
    }

    fn surface_density(&self, from: Point3D, point: Point3D, _: Feature) -> f64 {
        let (gradient, to) = (self.tube.gradient(point), point.vector_to(from));
        if gradient.dot(to) > 0.0 { 1.0 / self.surface_area() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
