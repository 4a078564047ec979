//! The structure of functions on grids: they have corners at the planes and lines of their knots.

use super::super::{Interpolator2DArray, Interpolator3DArray};
use super::{Structured2D, Structured3D};
use crate::{Point3D, Vector3D};

fn shortest(all: impl IntoIterator<Item = Vec<f64>>) -> f64 {
    let steps = |knots: Vec<f64>| knots.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
    all.into_iter().map(steps).fold(f64::INFINITY, f64::min)
}

impl Structured3D for Interpolator3DArray {
    /// The smallest distance of two knots.
    fn length_scale(&self) -> f64 {
        shortest(self.planes())
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        let (from, along) = (origin.to_array(), direction.to_array());
        for (axis, planes) in self.planes().into_iter().enumerate() {
            if along[axis] != 0.0 {
                out.extend(planes.iter().map(|plane| (plane - from[axis]) / along[axis]));
            }
        }
    }
}

impl Structured2D for Interpolator2DArray {
    /// The smallest distance of two knots.
    fn length_scale(&self) -> f64 {
        shortest(self.lines())
    }

    fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
        let [x, y] = self.lines();
        let (left, right, low, high) = (x[0], x[x.len() - 1], y[0], y[y.len() - 1]);
        x.iter().for_each(|&x| each([x, low], [x, high]));
        y.iter().for_each(|&y| each([left, y], [right, y]));
    }
}
