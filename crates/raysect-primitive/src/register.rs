use raysect_core::Primitive;
use raysect_core::save::{Entry, MakeError, Registry};
use raysect_math::Normal3D;

use crate::{
    BiConcave, BiConvex, Cone, Cuboid, Cylinder, Intersect, Meniscus, Mesh, MeshData, Operand, Parabola,
    Place, PlanoConcave, PlanoConvex, Sphere, Subtract, Torus, Union,
};

/// Teaches a registry how the shapes of this crate are made of what a file says.
///
/// ```
/// let mut registry = raysect_core::save::Registry::new();
/// raysect_primitive::register(&mut registry);
/// ```
pub fn register(registry: &mut Registry) {
    registry.primitive("Cuboid", |entry| {
        Ok(Cuboid::new(entry.array("lower")?.into(), entry.array("upper")?.into())?)
    });
    registry.primitive("Sphere", |entry| Ok(Sphere::new(entry.number("radius")?)?));
    registry
        .primitive("Cylinder", |entry| Ok(Cylinder::new(entry.number("radius")?, entry.number("height")?)?));
    registry.primitive("Cone", |entry| Ok(Cone::new(entry.number("radius")?, entry.number("height")?)?));
    registry
        .primitive("Parabola", |entry| Ok(Parabola::new(entry.number("radius")?, entry.number("height")?)?));
    registry.primitive("Torus", |entry| Ok(Torus::new(entry.number("major")?, entry.number("minor")?)?));
    registry.primitive("Union", |entry| Ok(Union::new(operand(entry, "a")?, operand(entry, "b")?)?));
    registry.primitive("Intersect", |entry| Ok(Intersect::new(operand(entry, "a")?, operand(entry, "b")?)?));
    registry.primitive("Subtract", |entry| Ok(Subtract::new(operand(entry, "a")?, operand(entry, "b")?)?));
    registry.primitive("Mesh", mesh);
    register_lenses(registry);
}

fn register_lenses(registry: &mut Registry) {
    registry.primitive("BiConvex", |entry| {
        let [diameter, thickness, front, back] = two_curvatures(entry)?;
        Ok(BiConvex::new(diameter, thickness, front, back)?)
    });
    registry.primitive("BiConcave", |entry| {
        let [diameter, thickness, front, back] = two_curvatures(entry)?;
        Ok(BiConcave::new(diameter, thickness, front, back)?)
    });
    registry.primitive("Meniscus", |entry| {
        let [diameter, thickness, front, back] = two_curvatures(entry)?;
        Ok(Meniscus::new(diameter, thickness, front, back)?)
    });
    registry.primitive("PlanoConvex", |entry| {
        let [diameter, thickness, curvature] = one_curvature(entry)?;
        Ok(PlanoConvex::new(diameter, thickness, curvature)?)
    });
    registry.primitive("PlanoConcave", |entry| {
        let [diameter, thickness, curvature] = one_curvature(entry)?;
        Ok(PlanoConcave::new(diameter, thickness, curvature)?)
    });
}

fn one_curvature(entry: &Entry<'_>) -> Result<[f64; 3], MakeError> {
    Ok([entry.number("diameter")?, entry.number("centre_thickness")?, entry.number("curvature")?])
}

fn two_curvatures(entry: &Entry<'_>) -> Result<[f64; 4], MakeError> {
    Ok([
        entry.number("diameter")?,
        entry.number("centre_thickness")?,
        entry.number("front_curvature")?,
        entry.number("back_curvature")?,
    ])
}

fn operand(entry: &Entry<'_>, which: &str) -> Result<Operand, MakeError> {
    let shape = entry.object::<dyn Primitive>(which)?;
    Ok(shape.placed(entry.transform(&format!("{which}_transform"))?))
}

/// Numbers, three by three.
fn triples(entry: &Entry<'_>, name: &str) -> Result<Vec<[f64; 3]>, MakeError> {
    let numbers = entry.numbers(name)?;
    let (triples, rest) = numbers.as_chunks::<3>();
    if rest.is_empty() {
        Ok(triples.to_vec())
    } else {
        Err(format!("{} numbers in '{name}': not three by three", numbers.len()).into())
    }
}

fn indices(entry: &Entry<'_>, name: &str) -> Result<Vec<[u32; 3]>, MakeError> {
    let index = |x: f64| {
        let near = x as u32;
        if f64::from(near) == x {
            Ok(near)
        } else {
            Err(format!("{x} in '{name}' is not the number of a vertex"))
        }
    };
    let mut all = Vec::new();
    for [a, b, c] in triples(entry, name)? {
        all.push([index(a)?, index(b)?, index(c)?]);
    }
    Ok(all)
}

fn mesh(entry: &Entry<'_>) -> Result<Mesh, MakeError> {
    let mut data = MeshData::new(triples(entry, "vertices")?, indices(entry, "triangles")?)?;
    if entry.has("normals") {
        let normals = triples(entry, "normals")?.into_iter().map(Normal3D::from);
        data = data.with_normals(normals, indices(entry, "normal_indices")?)?;
    }
    let builder = Mesh::builder(data).smoothing(entry.flag("smoothing")?);
    Ok(builder.closed(entry.flag("closed")?).build()?)
}
