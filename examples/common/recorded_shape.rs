//! Shapes as recorded crossings describe them.

use std::sync::Arc;

use raysect::core::Primitive;
use raysect::math::{AffineMatrix3D, Point3D};
use raysect::primitive::{
    BiConcave, BiConvex, Cone, Cuboid, Cylinder, Intersect, Meniscus, Mesh, MeshData, Operand, Parabola,
    Place, PlanoConcave, PlanoConvex, Sphere, Subtract, Torus, Union,
};
use serde_json::Value;

use crate::json::{array, field, index, list, number, numbers, text};

type Shape = Arc<dyn Primitive>;

/// Builds what an object with a `kind` and the arguments of its constructor describes.
pub(crate) fn shape(value: &Value) -> Result<Shape, String> {
    let kind = field(value, "kind", text)?;
    let length = |key: &str| field(value, key, number);
    let lens = || Ok::<_, String>([length("diameter")?, length("center_thickness")?]);
    match kind.as_str() {
        "sphere" => built(Sphere::new(length("radius")?)),
        "box" => {
            let corner = |key| field(value, key, numbers::<3>).map(Point3D::from);
            built(Cuboid::new(corner("lower")?, corner("upper")?))
        }
        "cylinder" => built(Cylinder::new(length("radius")?, length("height")?)),
        "cone" => built(Cone::new(length("radius")?, length("height")?)),
        "parabola" => built(Parabola::new(length("radius")?, length("height")?)),
        "torus" => built(Torus::new(length("major_radius")?, length("minor_radius")?)),
        "union" => operands(value).and_then(|(a, b)| built(Union::new(a, b))),
        "intersect" => operands(value).and_then(|(a, b)| built(Intersect::new(a, b))),
        "subtract" => operands(value).and_then(|(a, b)| built(Subtract::new(a, b))),
        "biconvex" | "biconcave" | "meniscus" => {
            let ([d, t], f, b) = (lens()?, length("front_curvature")?, length("back_curvature")?);
            match kind.as_str() {
                "biconvex" => built(BiConvex::new(d, t, f, b)),
                "biconcave" => built(BiConcave::new(d, t, f, b)),
                _ => built(Meniscus::new(d, t, f, b)),
            }
        }
        "planoconvex" => lens().and_then(|[d, t]| built(PlanoConvex::new(d, t, length("curvature")?))),
        "planoconcave" => lens().and_then(|[d, t]| built(PlanoConcave::new(d, t, length("curvature")?))),
        "mesh" => mesh(value),
        other => Err(format!("kind: there is no shape '{other}'")),
    }
}

/// A row-major 4×4 matrix.
pub(crate) fn transform(value: &Value) -> Result<AffineMatrix3D, String> {
    AffineMatrix3D::from_row_major(numbers(value)?).map_err(|e| e.to_string())
}

fn built<P: Primitive, E: std::fmt::Display>(shape: Result<P, E>) -> Result<Shape, String> {
    shape.map(|shape| Arc::new(shape) as Shape).map_err(|e| e.to_string())
}

fn operands(value: &Value) -> Result<(Operand, Operand), String> {
    Ok((field(value, "a", operand)?, field(value, "b", operand)?))
}

/// An operand stays where it is if it has no `transform`.
fn operand(value: &Value) -> Result<Operand, String> {
    let place = match value.get("transform") {
        Some(_) => field(value, "transform", transform)?,
        None => AffineMatrix3D::IDENTITY,
    };
    Ok(shape(value)?.placed(place))
}

/// A closed mesh with flat triangles.
fn mesh(value: &Value) -> Result<Shape, String> {
    let vertices = field(value, "vertices", |v| list(v, numbers::<3>))?;
    let triangles = field(value, "triangles", |v| list(v, |t| array::<_, 3>(t, index)))?;
    let data = MeshData::new(vertices, triangles).map_err(|e| e.to_string())?;
    built(Mesh::builder(data).smoothing(false).closed(true).build())
}
