//! Uniform points in a triangle.

use super::draws;
use crate::{MathError, Point3D, Vector3D};

/// Barycentric coordinates (α, β, γ) of a uniform point: positive, with sum 1.
///
/// α = 1 − √u₀, β = u₁ √u₀, γ = (1 − u₁) √u₀
/// (G. Turk, *Generating Random Points in Triangles*, Graphics Gems, 1990).
#[doc(alias = "point_triangle")]
#[inline]
pub fn sample(u: [f64; 2]) -> [f64; 3] {
    let t = u[0].sqrt();
    // (1 − u₀) / (1 + √u₀) is 1 − √u₀ without cancellation.
    [(1.0 - u[0]) / (1.0 + t), u[1] * t, (1.0 - u[1]) * t]
}

/// Density of [`sample`] per unit of area in two of the three barycentric coordinates: 2 in the triangle,
/// 0 outside.
#[inline]
pub fn pdf([alpha, beta, gamma]: [f64; 3]) -> f64 {
    if alpha >= 0.0 && beta >= 0.0 && gamma >= 0.0 { 2.0 } else { 0.0 }
}

/// Uniform points on a triangle in space.
#[doc(alias = "TriangleSampler")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriangleSampler3D {
    vertices: [Point3D; 3],
    /// From the first vertex to the second and third [m].
    edges: [Vector3D; 2],
    normal: Vector3D,
    area: f64,
    /// By how much rounding may move a barycentric coordinate.
    slack: f64,
}

draws!(TriangleSampler3D -> Point3D);

impl TriangleSampler3D {
    /// The triangle between three vertices [m].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for three vertices on one line to within rounding, an area outside
    /// 1e-300 … 1e300 m², or a coordinate that is not finite.
    pub fn new(v1: Point3D, v2: Point3D, v3: Point3D) -> Result<Self, MathError> {
        let edges = [v1.vector_to(v2), v1.vector_to(v3)];
        let longest = edges[0].length().max(edges[1].length()).max(v2.distance_to(v3));
        let cross = edges[0].cross(edges[1]);
        let area = 0.5 * cross.length();
        let admitted = (1e-300..=1e300).contains(&area) && area > 4.0 * f64::EPSILON * longest * longest;
        let range = "1e-300 … 1e300, and above 4 ε times the longest side squared";
        MathError::check(admitted, area, "area of the triangle", "m²", range)?;
        let largest = v1.max_abs().max(v2.max_abs()).max(v3.max_abs());
        // A shift d of the point moves a barycentric coordinate by d over a height, at most d · longest / 2
        // area.
        let slack = 8.0 * f64::EPSILON * (1.0 + largest / area * longest);
        Ok(Self { vertices: [v1, v2, v3], edges, normal: cross.normalise()?, area, slack })
    }

    /// The three vertices [m].
    #[inline]
    pub fn vertices(&self) -> [Point3D; 3] {
        self.vertices
    }

    /// Area [m²].
    #[inline]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The point [m] for two uniforms in (0, 1); see [`sample`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Point3D {
        let [_, beta, gamma] = sample(u);
        self.vertices[0] + (self.edges[0] * beta + self.edges[1] * gamma)
    }

    /// Density [1/m²] at a point of the triangle's plane [m]: 1 / area in the triangle, 0 outside. Of a point
    /// beside the plane, its projection counts.
    #[inline]
    pub fn pdf(&self, point: Point3D) -> f64 {
        let w = self.vertices[0].vector_to(point);
        let twice = 2.0 * self.area;
        let beta = self.normal.dot(w.cross(self.edges[1])) / twice;
        let gamma = self.normal.dot(self.edges[0].cross(w)) / twice;
        let inside = beta >= -self.slack && gamma >= -self.slack && beta + gamma <= 1.0 + self.slack;
        if inside { 1.0 / self.area } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{Chart, extremes};
    use super::*;
    use crate::Rng;

    fn slanted() -> TriangleSampler3D {
        TriangleSampler3D::new(
            Point3D::new(1.0, -2.0, 0.5),
            Point3D::new(4.0, 0.0, 1.0),
            Point3D::new(0.0, 1.0, -2.0),
        )
        .unwrap()
    }

    /// Coordinates s = β + γ and γ / s: area is 2 A s ds dγ/s.
    fn chart(triangle: TriangleSampler3D) -> Chart<Point3D> {
        let [v1, v2, v3] = triangle.vertices();
        let (e1, e2) = (v1.vector_to(v2), v1.vector_to(v3));
        Chart {
            low: [0.0, 0.0],
            high: [1.0, 1.0],
            bins: [8, 8],
            place: Box::new(move |[s, g]| v1 + (e1 * (1.0 - g) + e2 * g) * s),
            coordinates: Box::new(move |p| {
                // Least squares in the plane: the normal equations of p − v1 = β e1 + γ e2.
                let w = v1.vector_to(p);
                let (a, b, c) = (e1.dot(e1), e1.dot(e2), e2.dot(e2));
                let (f, g) = (e1.dot(w), e2.dot(w));
                let (beta, gamma) = ((c * f - b * g) / (a * c - b * b), (a * g - b * f) / (a * c - b * b));
                [beta + gamma, gamma / (beta + gamma)]
            }),
            jacobian: Box::new(move |[s, _]| s * e1.cross(e2).length()),
        }
    }

    #[test]
    fn points_follow_their_density() {
        let triangle = slanted();
        let points = triangle.samples(200_000, &mut Rng::new(1));
        assert!((chart(triangle).integral(&|p| triangle.pdf(p)) - 1.0).abs() < 1e-12);
        assert!(chart(triangle).fits(&points, &|p| triangle.pdf(p)));
    }

    #[test]
    fn points_that_crowd_at_a_vertex_are_found_out() {
        let triangle = slanted();
        let mut rng = Rng::new(2);
        // Without the square root of the first uniform the points crowd at the first vertex.
        let crowded: Vec<Point3D> =
            (0..200_000).map(|_| triangle.sample_at([rng.uniform().powi(2), rng.uniform()])).collect();
        assert!(!chart(triangle).fits(&crowded, &|p| triangle.pdf(p)));
        let [v1, v2, v3] = triangle.vertices();
        let longer = TriangleSampler3D::new(v1, v2, v3 + v2.vector_to(v3) * 0.02).unwrap();
        let points = triangle.samples(200_000, &mut Rng::new(3));
        assert!(!chart(triangle).fits(&points, &|p| longer.pdf(p)));
    }

    #[test]
    fn the_ends_of_the_uniforms_stay_in_the_triangle() {
        let far = Vector3D::new(1e6, -3e6, 1e5);
        let [v1, v2, v3] = slanted().vertices();
        for triangle in [slanted(), TriangleSampler3D::new(v1 + far, v2 + far, v3 + far).unwrap()] {
            for u in extremes() {
                let coordinates = sample(u);
                assert!(coordinates.iter().all(|&c| c > 0.0), "{coordinates:?}");
                assert!((coordinates.iter().sum::<f64>() - 1.0).abs() <= 2.0 * f64::EPSILON);
                assert_eq!(pdf(coordinates), 2.0);
                let p = triangle.sample_at(u);
                assert!(p.is_finite() && triangle.pdf(p) == 1.0 / triangle.area(), "{u:?}");
            }
        }
    }

    #[test]
    fn outside_the_triangle_the_density_is_zero() {
        let triangle = slanted();
        let [v1, v2, v3] = triangle.vertices();
        for (from, to) in [(v1, v2), (v2, v3), (v3, v1)] {
            assert_eq!(triangle.pdf(to + from.vector_to(to) * 1e-9), 0.0);
            assert!(triangle.pdf(to) > 0.0);
        }
        assert_eq!(pdf([0.5, 0.6, -0.1]), 0.0);
        assert!((triangle.area() - 0.5 * 212.25f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn degenerate_triangles_are_refused() {
        let [a, b] = [Point3D::new(0.1, 0.2, 0.3), Point3D::new(1.1, -0.7, 0.9)];
        let between = a + a.vector_to(b) * 0.3;
        let bad = Point3D::new(f64::NAN, 0.0, 0.0);
        for (v1, v2, v3) in [(a, a, b), (a, b, a), (a, a, a), (a, b, between), (between, b, a), (a, b, bad)] {
            assert!(matches!(TriangleSampler3D::new(v1, v2, v3), Err(MathError::OutOfRange { .. })));
        }
    }
}
