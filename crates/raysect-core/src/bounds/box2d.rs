use raysect_math::Point2D;

use crate::CoreError;

/// An axis-aligned rectangle, edges included; the default is the empty one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox2D {
    /// Corner of least coordinates [m].
    pub lower: Point2D,
    /// Corner of greatest coordinates [m].
    pub upper: Point2D,
}

impl Default for BoundingBox2D {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl BoundingBox2D {
    /// The rectangle that contains nothing and vanishes in unions.
    pub const EMPTY: Self = Self {
        lower: Point2D::new(f64::INFINITY, f64::INFINITY),
        upper: Point2D::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// From its corners [m].
    ///
    /// # Errors
    /// [`CoreError::InvertedBox`] if `lower` exceeds `upper` (or is NaN) along an axis.
    pub fn new(lower: Point2D, upper: Point2D) -> Result<Self, CoreError> {
        for (axis, (low, high)) in [(lower.x, upper.x), (lower.y, upper.y)].into_iter().enumerate() {
            if low > high || low.is_nan() || high.is_nan() {
                return Err(CoreError::InvertedBox { axis, lower: low, upper: high });
            }
        }
        Ok(Self { lower, upper })
    }

    /// True for points inside and on the edges.
    pub fn contains(&self, p: Point2D) -> bool {
        p.x >= self.lower.x && p.x <= self.upper.x && p.y >= self.lower.y && p.y <= self.upper.y
    }

    /// The smallest rectangle around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            lower: Point2D::new(self.lower.x.min(other.lower.x), self.lower.y.min(other.lower.y)),
            upper: Point2D::new(self.upper.x.max(other.upper.x), self.upper.y.max(other.upper.y)),
        }
    }

    /// Grows to include `point` with `padding` [m] around it.
    pub fn extend(&mut self, point: Point2D, padding: f64) {
        let (lower, upper) = (
            Point2D::new(point.x - padding, point.y - padding),
            Point2D::new(point.x + padding, point.y + padding),
        );
        *self = self.union(&Self { lower, upper });
    }

    /// Moves every edge outward by `padding` [m].
    pub fn pad(&mut self, padding: f64) {
        self.pad_axis(0, padding);
        self.pad_axis(1, padding);
    }

    /// Moves the two edges across `axis` outward by `padding` [m]; 0 is x, anything else y.
    pub fn pad_axis(&mut self, axis: usize, padding: f64) {
        if axis == 0 {
            self.lower.x -= padding;
            self.upper.x += padding;
        } else {
            self.lower.y -= padding;
            self.upper.y += padding;
        }
    }

    /// Size along `axis` [m]; 0 is x, anything else y.
    pub fn extent(&self, axis: usize) -> f64 {
        let size = if axis == 0 { self.upper.x - self.lower.x } else { self.upper.y - self.lower.y };
        size.max(0.0)
    }

    /// The axis of the greater extent, x of equals.
    pub fn largest_axis(&self) -> usize {
        usize::from(self.extent(1) > self.extent(0))
    }

    /// The greater extent [m].
    pub fn largest_extent(&self) -> f64 {
        self.extent(self.largest_axis())
    }

    /// Area [m²].
    #[doc(alias = "surface_area")]
    pub fn area(&self) -> f64 {
        self.extent(0) * self.extent(1)
    }

    /// The four corners, y varying fastest.
    pub fn vertices(&self) -> [Point2D; 4] {
        let (l, u) = (self.lower, self.upper);
        [l, Point2D::new(l.x, u.y), Point2D::new(u.x, l.y), u]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures() {
        let mut b = BoundingBox2D::new(Point2D::new(0.0, 1.0), Point2D::new(2.0, 4.0)).unwrap();
        assert_eq!((b.area(), b.largest_axis(), b.largest_extent()), (6.0, 1, 3.0));
        b.extend(Point2D::new(5.0, 2.0), 0.5);
        assert_eq!(b.upper, Point2D::new(5.5, 4.0));
        b.pad(1.0);
        assert!(b.contains(Point2D::new(-1.0, 5.0)) && !b.contains(Point2D::new(-1.1, 5.0)));
        assert_eq!(BoundingBox2D::EMPTY.area(), 0.0);
        assert!(BoundingBox2D::new(Point2D::new(0.0, 1.0), Point2D::new(0.0, 0.0)).is_err());
    }
}
