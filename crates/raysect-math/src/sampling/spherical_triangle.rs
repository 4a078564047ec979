//! Directions towards a triangle, uniform in solid angle.

use super::draws;
use crate::{MathError, Point3D, Vector3D};

/// Uniform directions over the solid angle that a triangle fills, seen from a point.
///
/// J. Arvo, *Stratified Sampling of Spherical Triangles*, SIGGRAPH 1995. The part of the triangle that holds a share
/// of the solid angle is found by the tangents of half its sides, not by cosines, so that small and far triangles keep
/// their digits.
///
/// ```
/// use raysect_math::{Point3D, SphericalTriangleSampler, Vector3D};
/// // The corner of a cube around the observer: an eighth of all directions.
/// let corners = [Point3D::new(1.0, 0.0, 0.0), Point3D::new(0.0, 1.0, 0.0), Point3D::new(0.0, 0.0, 1.0)];
/// let sampler = SphericalTriangleSampler::new(Point3D::ORIGIN, corners)?;
/// assert!((sampler.solid_angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// let v = sampler.sample_at([0.2, 0.9]);
/// assert_eq!(sampler.pdf(v), 1.0 / sampler.solid_angle());
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalTriangleSampler {
    /// Unit vectors to the first and second corner.
    corners: [Vector3D; 2],
    /// Unit vector at right angles to the first corner, towards the third.
    side: Vector3D,
    /// Unit normals of the three planes through the observer and an edge, inwards.
    normals: [Vector3D; 3],
    /// Unit normal of the triangle's plane, away from the observer: it tells a direction from its opposite.
    plane: Vector3D,
    /// Angle at the first corner [rad].
    angle: f64,
    /// Tangent of half the side from the first corner to the second.
    half_side: f64,
    solid_angle: f64,
    /// By how much rounding may take a sample across the border [rad].
    slack: f64,
}

draws!(SphericalTriangleSampler -> Vector3D);

impl SphericalTriangleSampler {
    /// The triangle between three corners [m], in either sense, seen from the observer [m].
    ///
    /// # Errors
    /// [`MathError::NoDirection`] if the observer is at a corner or in line with two,
    /// [`MathError::OutOfRange`] if it is in the plane of the triangle, or for a solid angle below 1e-290 sr.
    pub fn new(observer: Point3D, corners: [Point3D; 3]) -> Result<Self, MathError> {
        let mut v = corners.map(|p| observer.vector_to(p));
        let scale = v.iter().map(|v| v.max_abs()).fold(0.0, f64::max);
        // Differences of the corners are free of the observer's rounding.
        let mut edges =
            [corners[0].vector_to(corners[1]), corners[0].vector_to(corners[2])].map(|e| e / scale);
        v = v.map(|v| v / scale);
        let mut volume = v[0].dot(edges[0].cross(edges[1]));
        let admitted = volume.abs() > 0.0 && volume.is_finite();
        let name = "volume between observer and triangle over the cube of the largest distance";
        MathError::check(admitted, volume, name, "", "other than 0")?;
        if volume < 0.0 {
            v.swap(1, 2);
            edges.swap(0, 1);
            volume = -volume;
        }
        let length = v.map(|v| v.length());
        let (a, b) = (v[0].normalise()?, v[1].normalise()?);
        let opposite = length[0] * length[1] * length[2]
            + v[0].dot(v[1]) * length[2]
            + v[1].dot(v[2]) * length[0]
            + v[2].dot(v[0]) * length[1];
        // A. Van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng. 30, 1983.
        let solid_angle = 2.0 * volume.atan2(opposite);
        let admitted = (1e-290..=std::f64::consts::TAU).contains(&solid_angle);
        MathError::check(admitted, solid_angle, "solid angle of the triangle", "sr", "1e-290 … 2 π")?;
        let [first, second] = edges.map(|edge| v[0].cross(edge));
        let third = v[1].cross(edges[1] - edges[0]);
        let normals = [first.normalise()?, third.normalise()?, -second.normalise()?];
        // Of nearly a half space, arcs from the second corner go nearly half around: their ends must tell the way.
        let reach = if opposite < 0.0 { normals[2].dot(b).max(1e-9) } else { 1.0 };
        Ok(Self {
            corners: [a, b],
            side: second.cross(a).normalise()?,
            normals,
            plane: edges[0].cross(edges[1]).normalise()?,
            angle: (volume * length[0]).atan2(first.dot(second)),
            half_side: first.length() / (length[0] * length[1] + v[0].dot(v[1])),
            solid_angle,
            slack: 16.0 * f64::EPSILON / reach,
        })
    }

    /// Solid angle [sr], right to a few roundings for every triangle whose corners lie within 90° of each other.
    #[inline]
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }

    /// The unit vector for two uniforms in (0, 1): the first cuts the triangle by an arc through the second corner, the
    /// second gives the place on the arc.
    ///
    /// With side c and angle A, a triangle of excess E has tan b/2 = sin E/2 / (tan c/2 sin(A − E/2)) (I. Todhunter,
    /// *Spherical Trigonometry*, 1886, § 103, solved for the other side).
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        let half_excess = 0.5 * u[0] * self.solid_angle;
        let [a, b] = self.corners;
        // b/2 = atan(p / q); cos b and sin b without the angle.
        let (p, q) = (half_excess.sin(), self.half_side * (self.angle - half_excess).sin().max(0.0));
        let squares = p * p + q * q;
        let end =
            if squares > 0.0 { (a * ((q - p) * (q + p)) + self.side * (2.0 * p * q)) / squares } else { a };
        // Uniform in 1 − cos along the arc from b, as in a cap around b.
        let away = end - b;
        let versine = u[1] * (0.5 * away.length_squared()).min(2.0);
        let along = away - b * b.dot(away);
        let Ok(along) = along.normalise() else { return b };
        let v = b * (1.0 - versine) + along * (versine * (2.0 - versine)).sqrt();
        v.normalise_unchecked()
    }

    /// Density [1/sr] at a unit vector: 1 / solid angle towards the triangle, 0 elsewhere.
    ///
    /// The border is widened by a few roundings of the direction.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        let inside = self.normals.iter().chain([&self.plane]).all(|n| n.dot(direction) >= -self.slack);
        if inside { 1.0 / self.solid_angle } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
