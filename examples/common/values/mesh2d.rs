//! Functions on a mesh of triangles in the plane, with one value outside.

use raysect::math::function::Function;
use raysect::math::{Discrete2DMesh, Interpolator2DMesh, MathError, Point2D};

use super::grid::numbers_of;
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{array, field, index, list, number, numbers};

/// What the section is made of, and what is compared.
const KNOWN: [&str; 8] =
    ["vertices", "triangles", "vertex_data", "triangle_data", "outside_value", "at", "linear", "discrete"];

/// Compares values of vertices, interpolated, and values of triangles.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let (content, tolerance) = (section.content, section.one_tolerance()?);
    let vertices: Vec<Point2D> =
        field(content, "vertices", |v| list(v, |v| numbers(v).map(|[x, y]| Point2D::new(x, y))))?;
    let triangles = field(content, "triangles", |v| list(v, |v| array::<u32, 3>(v, index)))?;
    let outside = field(content, "outside_value", number)?;
    let at = field(content, "at", |v| list(v, numbers::<2>))?;
    let text = |e: MathError| e.to_string();

    let (by_vertex, by_triangle) =
        (numbers_of(content, "vertex_data")?, numbers_of(content, "triangle_data")?);
    let linear =
        Interpolator2DMesh::new(&*vertices, &*triangles, by_vertex).map_err(text)?.with_default(outside);
    let discrete =
        Discrete2DMesh::new(&*vertices, &*triangles, by_triangle).map_err(text)?.with_default(outside);
    let linear: Result<Vec<f64>, _> = at.iter().map(|&[x, y]| linear.checked((x, y))).collect();
    let discrete: Result<Vec<f64>, _> = at.iter().map(|&[x, y]| discrete.checked((x, y))).collect();
    for (name, ours) in [("linear", linear), ("discrete", discrete)] {
        let mut finding = section.finding(name);
        compare_group(&mut finding, name, &ours.map_err(text)?, &numbers_of(content, name)?, tolerance)?;
        report.findings.push(finding);
    }
    section.skip_others(content, &KNOWN, report);
    Ok(())
}
