use crate::Point2D;
use crate::error_free::{two_product, two_sum};

/// Twice the area of a triangle, positive if its corners go anticlockwise; the sign is exact, 0 included.
///
/// Where rounding could reach the sign, the area is summed without any (J. R. Shewchuk, *Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates*, Discrete & Computational Geometry 18, 1997).
/// Coordinates must be such that products of their differences lie in the range of [`two_product`], or vanish.
pub(crate) fn orientation(a: Point2D, b: Point2D, c: Point2D) -> f64 {
    let (u, v) = (c.vector_to(a), c.vector_to(b));
    let (left, right) = (u.x * v.y, u.y * v.x);
    // Section 4.1 of the paper: (3 + 16 ε) ε with ε half of ours.
    if (left - right).abs() > 4.0 * f64::EPSILON * (left.abs() + right.abs()) {
        return left - right;
    }
    let [ux, uy] = [two_sum(a.x, -c.x), two_sum(a.y, -c.y)];
    let [vx, vy] = [two_sum(b.x, -c.x), two_sum(b.y, -c.y)];
    let mut sum = Expansion::default();
    for (p, q, sign) in [(ux, vy, 1.0), (uy, vx, -1.0)] {
        for x in [p.0, p.1] {
            for y in [q.0, q.1] {
                let (product, error) = two_product(x, y);
                sum.add(sign * error);
                sum.add(sign * product);
            }
        }
    }
    sum.leading()
}

/// An exact sum of up to sixteen numbers: terms without overlap, of rising size.
#[derive(Default)]
struct Expansion {
    terms: [f64; 16],
    count: usize,
}

impl Expansion {
    /// The paper's `GROW-EXPANSION`.
    fn add(&mut self, number: f64) {
        let mut carried = number;
        for term in &mut self.terms[..self.count] {
            (carried, *term) = two_sum(carried, *term);
        }
        self.terms[self.count] = carried;
        self.count += 1;
    }

    /// The largest term that is not 0, which has the sign of the sum.
    fn leading(&self) -> f64 {
        self.terms[..self.count].iter().rev().copied().find(|&t| t != 0.0).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// In integers, for coordinates in units of 2⁻⁵³ below 16.
    fn exact([a, b, c]: [Point2D; 3]) -> i128 {
        let whole = |x: f64| (x * 2f64.powi(53)) as i128;
        let (ax, ay) = (whole(a.x) - whole(c.x), whole(a.y) - whole(c.y));
        let (bx, by) = (whole(b.x) - whole(c.x), whole(b.y) - whole(c.y));
        ax * by - ay * bx
    }

    #[test]
    fn signs_are_exact_where_plain_arithmetic_is_not() {
        // Shewchuk's own example: points a few roundings from a line.
        let (b, c) = (Point2D::new(12.0, 12.0), Point2D::new(15.0, 15.0));
        let mut wrong = 0;
        for i in 0..64 {
            for j in 0..64 {
                let step = 2f64.powi(-53);
                let a = Point2D::new(0.5 + f64::from(i) * step, 0.5 + f64::from(j) * step);
                let sign = orientation(a, b, c);
                assert_eq!(sign.partial_cmp(&0.0), exact([a, b, c]).partial_cmp(&0), "{i} {j}");
                let plain = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
                wrong += usize::from(plain.partial_cmp(&0.0) != sign.partial_cmp(&0.0));
            }
        }
        assert!(wrong > 500, "{wrong}");
    }

    proptest! {
        #[test]
        fn corners_can_be_taken_in_any_order(p in prop::array::uniform6(-4.0..4.0f64), t in 0.0..1.0f64) {
            let (a, b) = (Point2D::new(p[0], p[1]), Point2D::new(p[2], p[3]));
            let c = a + a.vector_to(b) * t;
            let sign = |a, b, c| orientation(a, b, c).partial_cmp(&0.0);
            prop_assert_eq!(sign(a, b, c), sign(b, c, a));
            prop_assert_eq!(sign(a, b, c), sign(b, a, c).map(std::cmp::Ordering::reverse));
        }
    }
}
