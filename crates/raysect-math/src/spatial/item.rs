use crate::MathError;

/// Coordinates beyond it are refused: differences of smaller ones are finite.
pub(super) const FARTHEST: f64 = f64::MAX / 2.0;

/// Something to be found by a [`KdTree`](super::KdTree): a number and a box with edges along the axes.
#[doc(alias("Item2D", "Item3D"))]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KdItem<const N: usize> {
    id: u32,
    lower: [f64; N],
    upper: [f64; N],
}

impl<const N: usize> KdItem<N> {
    /// The item of the given number, 0 … 2³¹ − 1, in the box between two corners, of any unit of length. Boxes may
    /// be flat.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a larger number, for coordinates that are NaN or beyond 8.98e307, and for a lower
    /// corner above the upper.
    pub fn new(id: u32, lower: impl Into<[f64; N]>, upper: impl Into<[f64; N]>) -> Result<Self, MathError> {
        let (lower, upper) = (lower.into(), upper.into());
        MathError::check(id <= i32::MAX as u32, f64::from(id), "id of an item", "", "0 … 2147483647")?;
        for axis in 0..N {
            for (value, name) in
                [(lower[axis], "lower corner of a box"), (upper[axis], "upper corner of a box")]
            {
                MathError::check(value.abs() <= FARTHEST, value, name, "", "-8.98e307 … 8.98e307")?;
            }
            let ordered = lower[axis] <= upper[axis];
            MathError::check(ordered, lower[axis], "lower corner of a box", "", "up to the upper corner")?;
        }
        Ok(Self { id, lower, upper })
    }

    /// Its number.
    #[inline]
    pub fn id(&self) -> u32 {
        self.id
    }

    /// Least coordinates of the box.
    #[inline]
    pub fn lower(&self) -> [f64; N] {
        self.lower
    }

    /// Greatest coordinates of the box.
    #[inline]
    pub fn upper(&self) -> [f64; N] {
        self.upper
    }

    /// True if the point lies in the box or on its surface.
    #[inline]
    pub fn contains(&self, point: impl Into<[f64; N]>) -> bool {
        let point = point.into();
        (0..N).all(|axis| self.lower[axis] <= point[axis] && point[axis] <= self.upper[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point2D;

    #[test]
    fn boxes_are_closed_and_may_be_flat() {
        let item = KdItem::new(7, [0.0, 1.0], [2.0, 1.0]).unwrap();
        assert_eq!((item.id(), item.lower(), item.upper()), (7, [0.0, 1.0], [2.0, 1.0]));
        for x in [-0.0, 1.0, 2.0] {
            assert!(item.contains(Point2D::new(x, 1.0)));
        }
        for p in [[-1e-300, 1.0], [2.1, 1.0], [1.0, 1.0 + f64::EPSILON], [f64::NAN, 1.0]] {
            assert!(!item.contains(p), "{p:?}");
        }
    }

    #[test]
    fn impossible_boxes_are_refused() {
        assert!(KdItem::new(i32::MAX as u32, [0.0], [0.0]).is_ok());
        for (id, lower, upper) in [
            (1 << 31, 0.0, 1.0),
            (0, 1.0, 0.0),
            (0, f64::NAN, 1.0),
            (0, 0.0, f64::NAN),
            (0, 0.0, f64::INFINITY),
            (0, -f64::MAX, 0.0),
        ] {
            let refused = KdItem::new(id, [lower], [upper]);
            assert!(matches!(refused, Err(MathError::OutOfRange { .. })), "{id} {lower} {upper}");
        }
    }
}
