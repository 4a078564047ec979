//! The structure of functions that are turned around the z axis: each edge in the half-plane becomes a part of a cone.

use super::super::AxisymmetricMapper;
use super::round::Pass;
use super::{Structured2D, Structured3D};
use crate::{Point3D, Vector3D, solve_quadratic};

/// By how much an edge is lengthened at both ends, in units of its length, for rounding: a break too many does no harm.
const SLACK: f64 = 1e-9;

impl<F: Structured2D> Structured3D for AxisymmetricMapper<F> {
    fn length_scale(&self) -> f64 {
        self.plane().length_scale()
    }

    /// Takes the time of as many quadratics as the function has edges.
    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        self.plane().each_edge(&mut |from, to| cross(from, to, origin, direction, out));
        let across = |x: f64, y: f64| Vector3D::new(x, y, 0.0);
        if let Some(pass) = Pass::new(across(origin.x, origin.y), across(direction.x, direction.y)) {
            pass.bend(self.length_scale(), out);
        }
    }
}

/// Adds the places where a line meets the surface that an edge from (r, z) to (r, z) sweeps out.
fn cross([r, z]: [f64; 2], to: [f64; 2], o: Point3D, d: Vector3D, out: &mut Vec<f64>) {
    let (dr, dz) = (to[0] - r, to[1] - z);
    let length = dr * dr + dz * dz;
    let mut add = |t: f64| {
        let at = o + d * t;
        let along = ((at.x.hypot(at.y) - r) * dr + (at.z - z) * dz) / length;
        if (-SLACK..=1.0 + SLACK).contains(&along) {
            out.push(t);
        }
    };
    if dz == 0.0 {
        if d.z != 0.0 {
            add((z - o.z) / d.z);
        }
        return;
    }
    // (r dz + dr (z' − z))² = dz² (x² + y²), in units of dz², with z' = o.z + t d.z.
    let slope = dr / dz;
    let (start, rate) = (r + slope * (o.z - z), slope * d.z);
    let a = d.x * d.x + d.y * d.y - rate * rate;
    let b = 2.0 * (o.x * d.x + o.y * d.y - start * rate);
    let c = o.x * o.x + o.y * o.y - start * start;
    solve_quadratic(a, b, c).iter().for_each(|&t| add(t));
}
