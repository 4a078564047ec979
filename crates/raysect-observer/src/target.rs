use raysect_math::{Cone, Frame, MathError, Point3D, SphericalRectangleSampler, Vector3D};

use crate::ObserverError;

/// Something that a [`Targeted`](crate::Targeted) sensor aims at, in the observer's own space: directions towards it are
/// uniform in the solid angle that it fills.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target(Kind);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Sphere { centre: Point3D, radius: f64 },
    Rectangle { corner: Point3D, edges: [Vector3D; 2] },
}

/// Directions towards a target from one point.
pub(crate) enum Aim {
    Sphere(Frame, Cone),
    Rectangle(SphericalRectangleSampler),
}

impl Target {
    /// A sphere of a centre and a radius [m]: a ball, or what bounds another shape.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a centre beyond 1e150 m, or a radius outside 1e-150 … 1e150 m.
    pub fn sphere(centre: Point3D, radius: f64) -> Result<Self, ObserverError> {
        let farthest = centre.max_abs();
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        let admitted = (1e-150..=1e150).contains(&radius);
        MathError::check(admitted, radius, "radius of a target", "m", "1e-150 … 1e150")?;
        Ok(Self(Kind::Sphere { centre, radius }))
    }

    /// A flat rectangle with a corner [m] and two edges that leave it at a right angle [m]: a port, a slit, a screen.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a corner or edge that is not finite or beyond 1e150 m, edges without length, and edges
    /// that are not perpendicular to within 1e-8.
    pub fn rectangle(corner: Point3D, edges: [Vector3D; 2]) -> Result<Self, ObserverError> {
        let farthest = corner.max_abs().max(edges[0].max_abs()).max(edges[1].max_abs());
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        let normal = edges[0].cross(edges[1]).normalise()?;
        // Seen from in front of its corner: what is wrong with the edges comes out here.
        let size = edges[0].length().max(edges[1].length());
        SphericalRectangleSampler::new(corner + normal * size, corner, edges)?;
        Ok(Self(Kind::Rectangle { corner, edges }))
    }

    /// How it is aimed at from a point. From inside a sphere, or in the plane of a rectangle, not at all.
    #[inline]
    pub(crate) fn aim(&self, from: Point3D) -> Option<Aim> {
        match *self {
            Self(Kind::Sphere { centre, radius }) => {
                let axis = from.vector_to(centre);
                let distance = axis.length();
                if distance <= radius {
                    return None;
                }
                Some(Aim::Sphere(Frame::from_z(axis.normalise().ok()?), Cone::of_sphere(radius, distance)))
            }
            Self(Kind::Rectangle { corner, edges }) => {
                SphericalRectangleSampler::new(from, corner, edges).ok().map(Aim::Rectangle)
            }
        }
    }

    /// Four numbers of a sphere, nine of a rectangle.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        match self {
            Self(Kind::Sphere { centre, radius }) => [&centre.to_array()[..], &[*radius]].concat(),
            Self(Kind::Rectangle { corner, edges: [first, second] }) => {
                [corner.to_array(), first.to_array(), second.to_array()].concat()
            }
        }
    }

    /// From such numbers.
    pub(crate) fn from_numbers(numbers: &[f64]) -> Result<Self, ObserverError> {
        match *numbers {
            [x, y, z, radius] => Self::sphere(Point3D::new(x, y, z), radius),
            [x, y, z, a, b, c, d, e, f] => {
                Self::rectangle(Point3D::new(x, y, z), [Vector3D::new(a, b, c), Vector3D::new(d, e, f)])
            }
            _ => {
                let count = numbers.len() as f64;
                let (name, range) = ("numbers of a target", "4 of a sphere, 9 of a rectangle");
                Err(MathError::OutOfRange { value: count, name, unit: "", range }.into())
            }
        }
    }
}

impl Aim {
    /// The direction for two uniforms in (0, 1).
    #[inline]
    pub(crate) fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        match self {
            Self::Sphere(frame, cone) => frame.to_world(cone.sample_at(u)),
            Self::Rectangle(rectangle) => rectangle.sample_at(u),
        }
    }

    /// Its density [1/sr]; the border of a cone is widened by what turning a direction there and back may move it.
    #[inline]
    pub(crate) fn pdf(&self, direction: Vector3D) -> f64 {
        match self {
            Self::Sphere(frame, cone) => {
                let v = frame.to_local(direction);
                let versine = if v.z > 0.0 { (v.x * v.x + v.y * v.y) / (1.0 + v.z) } else { 1.0 - v.z };
                let limit = cone.solid_angle() / std::f64::consts::TAU;
                let slack = 16.0 * f64::EPSILON;
                let inside = versine <= limit + slack * (limit + limit.sqrt() + slack);
                if inside { 1.0 / cone.solid_angle() } else { 0.0 }
            }
            Self::Rectangle(rectangle) => rectangle.pdf(direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::Rng;
    use raysect_math::sampling::uniforms;

    #[test]
    fn directions_meet_the_target_and_have_a_density() {
        let mut rng = Rng::new(1);
        let ball = Target::sphere(Point3D::new(1.0, 2.0, 3.0), 0.5).unwrap();
        let port = Target::rectangle(Point3D::new(1.0, 0.0, 2.0), [Vector3D::X, Vector3D::Y * 0.1]).unwrap();
        for target in [ball, port] {
            let aim = target.aim(Point3D::ORIGIN).unwrap();
            for _ in 0..1000 {
                let d = aim.sample_at(uniforms(&mut rng));
                assert!(aim.pdf(d) > 0.0 && aim.pdf(-d) == 0.0);
            }
            assert_eq!(Target::from_numbers(&target.numbers()).unwrap(), target);
        }
        assert!(ball.aim(Point3D::new(1.0, 2.1, 3.0)).is_none());
        assert!(port.aim(Point3D::new(0.0, 5.0, 2.0)).is_none());
    }

    #[test]
    fn impossible_targets_are_refused() {
        assert!(Target::sphere(Point3D::ORIGIN, 0.0).is_err());
        assert!(Target::sphere(Point3D::new(f64::NAN, 0.0, 0.0), 1.0).is_err());
        for edges in [
            [Vector3D::X, Vector3D::X],
            [Vector3D::X, Vector3D::ZERO],
            [Vector3D::X, Vector3D::new(1.0, 1.0, 0.0)],
        ] {
            assert!(Target::rectangle(Point3D::ORIGIN, edges).is_err());
        }
        assert!(Target::from_numbers(&[1.0; 5]).is_err());
    }
}
