use super::{Function, Structured1D};
use crate::MathError;

/// A function of one variable that is constant between edges and 0 outside: the layers of a profile.
///
/// An edge belongs to the layer above it, the last one to the last layer.
///
/// ```
/// use raysect_math::Point3D;
/// use raysect_math::function::{Function, Shells, spherical};
/// let shells = Shells::new(&[1.0, 1.5, 2.0], &[3.0, 4.0])?;
/// assert_eq!([0.5, 1.0, 1.5, 2.0, 2.5].map(|r| shells.evaluate(r)), [0.0, 3.0, 4.0, 4.0, 0.0]);
/// let ball = spherical(shells, Point3D::ORIGIN);
/// assert_eq!(ball.evaluate((0.0, 1.2, 0.0)), 3.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Shells {
    edges: Vec<f64>,
    values: Vec<f64>,
}

impl Shells {
    /// Of ascending edges, and of a value between each two.
    ///
    /// # Errors
    /// [`MathError::TooFewKnots`], [`MathError::KnotsNotAscending`], [`MathError::TableSize`] unless there is one edge more
    /// than values, [`MathError::TableNotFinite`].
    pub fn new(edges: &[f64], values: &[f64]) -> Result<Self, MathError> {
        super::interpolate::check_knots("r", edges)?;
        super::interpolate::check_values(&[edges.len() - 1], values)?;
        Ok(Self { edges: edges.to_vec(), values: values.to_vec() })
    }

    /// The edges.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// The value between each two edges.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

impl Function<f64> for Shells {
    type Value = f64;
    #[inline]
    fn evaluate(&self, x: f64) -> f64 {
        let below = self.edges.partition_point(|&edge| edge <= x);
        match below.checked_sub(1).and_then(|layer| self.values.get(layer)) {
            Some(value) => *value,
            None if x == self.edges[self.edges.len() - 1] => self.values[self.values.len() - 1],
            None if x.is_nan() => f64::NAN,
            None => 0.0,
        }
    }
}

impl Structured1D for Shells {
    /// The distance from the first to the last edge: nothing changes in between.
    fn length_scale(&self) -> f64 {
        self.edges[self.edges.len() - 1] - self.edges[0]
    }

    fn each_edge(&self, each: &mut dyn FnMut(f64)) {
        self.edges.iter().for_each(|&edge| each(edge));
    }

    fn is_stepped(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_have_their_values_up_to_the_edges() {
        let shells = Shells::new(&[-1.0, 0.0, 0.25], &[2.0, -3.0]).unwrap();
        let cases = [
            (f64::NEG_INFINITY, 0.0),
            ((-1.0f64).next_down(), 0.0),
            (-1.0, 2.0),
            ((-0.0f64).next_down(), 2.0),
            (0.0, -3.0),
            (0.25, -3.0),
            (0.25f64.next_up(), 0.0),
            (f64::INFINITY, 0.0),
        ];
        for (x, value) in cases {
            assert_eq!(shells.evaluate(x), value, "{x}");
        }
        assert!(shells.evaluate(f64::NAN).is_nan());
        assert_eq!((shells.edges(), shells.values()), (&[-1.0, 0.0, 0.25][..], &[2.0, -3.0][..]));
    }

    #[test]
    fn impossible_layers_are_refused() {
        let refused = |edges: &[f64], values: &[f64]| Shells::new(edges, values).unwrap_err();
        assert!(matches!(refused(&[1.0], &[]), MathError::TooFewKnots { count: 1, .. }));
        assert!(matches!(refused(&[1.0, 1.0], &[2.0]), MathError::KnotsNotAscending { index: 1, .. }));
        assert!(matches!(refused(&[1.0, 2.0], &[2.0, 3.0]), MathError::TableSize { count: 2, .. }));
        assert!(matches!(refused(&[1.0, 2.0], &[f64::NAN]), MathError::TableNotFinite { .. }));
        assert!(Shells::new(&[1.0, f64::INFINITY], &[2.0]).is_err());
    }
}
