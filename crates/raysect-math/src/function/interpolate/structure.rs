//! The structure of functions on grids: they have corners at the planes, lines and places of their knots.

use super::super::{Structured1D, Structured2D, Structured3D};
use super::{Interpolator1DArray, Interpolator2DArray, Interpolator3DArray};
use crate::{Point3D, Vector3D};

/// What lines without an end are cut to [units of the table]: beyond everything, with room to square it.
const ENDLESS: f64 = 1e150;

impl Structured1D for Interpolator1DArray {
    /// The smallest distance of two knots.
    fn length_scale(&self) -> f64 {
        self.axis().shortest_step()
    }

    fn each_edge(&self, each: &mut dyn FnMut(f64)) {
        self.axis().borders().for_each(each);
    }
}

impl Structured3D for Interpolator3DArray {
    /// The smallest distance of two knots.
    fn length_scale(&self) -> f64 {
        self.axes().iter().map(|axis| axis.shortest_step()).fold(f64::INFINITY, f64::min)
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        for (number, axis) in self.axes().into_iter().enumerate() {
            let (from, along) = (origin[number], direction[number]);
            if along != 0.0 {
                out.extend(axis.borders().map(|plane| (plane - from) / along));
            }
        }
    }
}

impl Structured2D for Interpolator2DArray {
    /// The smallest distance of two knots.
    fn length_scale(&self) -> f64 {
        self.axes().iter().map(|axis| axis.shortest_step()).fold(f64::INFINITY, f64::min)
    }

    fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
        let [x, y] = self.axes();
        let ends = [x, y].map(|axis| axis.reach()).map(|(a, b)| (a.max(-ENDLESS), b.min(ENDLESS)));
        let [(left, right), (low, high)] = ends;
        x.borders().for_each(|x| each([x, low], [x, high]));
        y.borders().for_each(|y| each([left, y], [right, y]));
    }
}
