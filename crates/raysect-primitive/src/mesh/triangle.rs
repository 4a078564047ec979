//! Where a ray meets a triangle, so that nothing leaks between neighbours.

use raysect_core::Ray;

use crate::select::{larger, smaller};

/// A ray turned into the third axis of a space of its own (S. Woop, C. Benthin, I. Wald, *Watertight Ray/Triangle
/// Intersection*, JCGT 2(1), 2013).
///
/// The corners of a triangle are computed in that space from the vertex and the ray alone, so that neighbours have
/// the same corners there, and on which side of a common edge the ray passes is decided without error: where the
/// rounded difference of two products is 0 the products are taken apart, and a ray that runs exactly through an edge
/// is taken to pass a trifle beside it, the same trifle for every triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShearedRay {
    pub(super) origin: [f64; 3],
    /// Which axes become the first, second and third.
    pub(super) axes: [usize; 3],
    pub(super) shear: [f64; 3],
    /// Distance of `origin` along the ray.
    pub(super) start: f64,
}

/// A ray and a triangle that meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    /// Distance along the ray, in units of the direction's length.
    pub(super) distance: f64,
    /// Barycentric coordinates of the second and the third corner.
    pub(super) uv: [f64; 2],
    /// True if the ray comes from behind.
    pub(super) from_behind: bool,
}

impl ShearedRay {
    /// Of a ray whose computations begin at the distance `start`.
    #[inline]
    pub(super) fn new(ray: &Ray, start: f64) -> Self {
        let d = ray.direction.to_array();
        let mut third = usize::from(d[1].abs() > d[0].abs());
        if d[2].abs() > d[third].abs() {
            third = 2;
        }
        let (mut first, mut second) = ((third + 1) % 3, (third + 2) % 3);
        if d[third] < 0.0 {
            std::mem::swap(&mut first, &mut second);
        }
        let shear = [d[first] / d[third], d[second] / d[third], 1.0 / d[third]];
        Self { origin: ray.point_at(start).to_array(), axes: [first, second, third], shear, start }
    }

    /// A vertex in the space of the ray: across it, and the distance along it.
    #[inline(always)]
    fn corner(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|a| p[a] - self.origin[a]);
        [x - self.shear[0] * z, y - self.shear[1] * z, self.shear[2] * z]
    }

    /// Where the line of the ray meets a triangle; the oracle of the vectorised test, and the same to the bit.
    pub(super) fn meet(&self, corners: [[f64; 3]; 3]) -> Option<Meeting> {
        let [a, b, c] = corners.map(|p| self.corner(p));
        let edges = [edge(c, b), edge(a, c), edge(b, a)];
        let side = |edge: f64, from: [f64; 3], to: [f64; 3]| {
            if edge != 0.0 { edge > 0.0 } else { passes_left(from, to) }
        };
        let sides = [side(edges[0], c, b), side(edges[1], a, c), side(edges[2], b, a)];
        if sides[0] != sides[1] || sides[1] != sides[2] {
            return None;
        }
        let total = edges[0] + edges[1] + edges[2];
        if total == 0.0 {
            // Seen from the side: the areas are there, but too small for their digits.
            let distance = self.start + (a[2] + b[2] + c[2]) / 3.0;
            return Some(Meeting { distance, uv: [1.0 / 3.0; 2], from_behind: !sides[0] });
        }
        let distance = (edges[0] * a[2] + edges[1] * b[2] + edges[2] * c[2]) / total;
        // Rounding must not carry it beyond the corners of a triangle that is almost parallel to the ray.
        let low = smaller(smaller(a[2], b[2]), c[2]);
        let high = larger(larger(a[2], b[2]), c[2]);
        Some(Meeting {
            distance: self.start + larger(smaller(distance, high), low),
            uv: [edges[1] / total, edges[2] / total],
            from_behind: !sides[0],
        })
    }
}

/// Twice the area of the triangle of the ray and an edge. Its sign is never wrong, but it may be 0 where the area is
/// not: products are rounded monotonically.
#[inline(always)]
fn edge(from: [f64; 3], to: [f64; 3]) -> f64 {
    from[0] * to[1] - from[1] * to[0]
}

/// The product of two numbers without error, as a sum of two (T. J. Dekker, *A floating-point technique for extending
/// the available precision*, Numerische Mathematik 18, 1971).
fn product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        let t = 134_217_729.0 * x;
        let high = t - (t - x);
        (high, x - high)
    };
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

/// On which side of an edge the ray passes, where [`edge`] cannot tell.
#[cold]
fn passes_left(from: [f64; 3], to: [f64; 3]) -> bool {
    // Both products are equal when rounded: what decides is what rounding took away.
    let difference = product(from[0], to[1]).1 - product(from[1], to[0]).1;
    if difference != 0.0 {
        return difference > 0.0;
    }
    // The ray meets the line of the edge. It is moved by an infinitely small step along the second axis, and by a
    // still smaller one along the first (H. Edelsbrunner, E. Mücke, *Simulation of Simplicity*, ACM TOG 9(1), 1990).
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    if dx != 0.0 { dx > 0.0 } else { dy < 0.0 }
}

#[cfg(test)]
#[path = "triangle_tests.rs"]
mod tests;
