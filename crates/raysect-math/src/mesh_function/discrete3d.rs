use std::sync::Arc;

use super::field::{Field, found, function_on_mesh};
use super::tetrahedra::Tetrahedra;
use crate::function::{Function, Structured3D};
use crate::{MathError, Point3D, Vector3D};

/// A [`Function`] that is constant on each tetrahedron of a mesh in space.
///
/// Where tetrahedra overlap, or at the face between two, one of them gives the value: the same one each time.
///
/// ```
/// use raysect_math::function::Function;
/// use raysect_math::{Discrete3DMesh, Point3D};
/// let vertices =
///     vec![Point3D::ORIGIN, Point3D::new(1.0, 0.0, 0.0), Point3D::new(0.0, 1.0, 0.0), Point3D::new(0.0, 0.0, 1.0)];
/// let f = Discrete3DMesh::new(vertices, vec![[0, 1, 2, 3]], vec![5.0])?;
/// assert_eq!(f.evaluate((0.2, 0.2, 0.2)), 5.0);
/// assert!(f.evaluate((0.4, 0.4, 0.4)).is_nan() && f.checked((0.4, 0.4, 0.4)).is_err());
/// assert_eq!(f.with_default(0.0).evaluate((0.4, 0.4, 0.4)), 0.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Discrete3DMesh {
    tetrahedra: Arc<Tetrahedra>,
    field: Field,
}

impl Discrete3DMesh {
    /// From vertices [m], tetrahedra as numbers of vertices in any order, and one value for each tetrahedron. It is
    /// limited to the mesh; see [`with_default`](Self::with_default).
    ///
    /// # Errors
    /// [`MathError::MeshPart`] for vertices beyond 1e100 m, tetrahedra without volume or of vertices that are not there,
    /// and values that are not finite; [`MathError::ValueCount`] unless there is one value for each tetrahedron.
    pub fn new(
        vertices: impl Into<Vec<Point3D>>,
        tetrahedra: impl Into<Vec<[u32; 4]>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, MathError> {
        let tetrahedra = Arc::new(Tetrahedra::new(vertices.into(), tetrahedra.into())?);
        let field = Field::new(values.into(), tetrahedra.len(), "tetrahedra")?;
        Ok(Self { tetrahedra, field })
    }

    /// The same mesh, which is shared, with other values; limited to the mesh.
    ///
    /// # Errors
    /// [`MathError::ValueCount`] and [`MathError::MeshPart`] as in [`new`](Self::new).
    pub fn instance(&self, values: impl Into<Vec<f64>>) -> Result<Self, MathError> {
        let field = Field::new(values.into(), self.tetrahedra.len(), "tetrahedra")?;
        Ok(Self { tetrahedra: Arc::clone(&self.tetrahedra), field })
    }

    /// The same function, with a value outside of the mesh. A clone of it shares mesh and values.
    #[doc(alias("default_value", "limit"))]
    pub fn with_default(mut self, value: f64) -> Self {
        self.field.default = Some(value);
        self
    }

    #[inline]
    fn find(&self, at: (f64, f64, f64)) -> Option<f64> {
        match self.tetrahedra.find(Point3D::new(at.0, at.1, at.2)) {
            Some(tetrahedron) => Some(self.field.value(tetrahedron)),
            None => self.field.outside(&[at.0, at.1, at.2]),
        }
    }
}

function_on_mesh!(Discrete3DMesh, (f64, f64, f64));

impl Structured3D for Discrete3DMesh {
    /// The shortest height of a tetrahedron.
    fn length_scale(&self) -> f64 {
        self.tetrahedra.shortest_height()
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        self.tetrahedra.add_breaks(origin, direction, out);
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample_meshes::cubes;
    use super::*;
    use crate::{Rng, rotate};

    #[test]
    fn no_point_on_a_face_an_edge_or_a_vertex_is_lost() {
        let (vertices, tetrahedra) = cubes(26, 100.0);
        // Points on a slanted border are rounded off it.
        let turn = rotate(20.0, 30.0, 40.0);
        let vertices: Vec<Point3D> = vertices.into_iter().map(|p| turn * p).collect();
        assert!(tetrahedra.len() > 100_000);
        let values: Vec<f64> = (0..tetrahedra.len()).map(|i| i as f64).collect();
        let mesh = Discrete3DMesh::new(vertices.clone(), tetrahedra.clone(), values).unwrap();
        let mut rng = Rng::new(1);
        for i in 0..100_000 {
            let [a, b, c, d] = tetrahedra[i % tetrahedra.len()].map(|v| vertices[v as usize]);
            let (s, t) = (rng.uniform(), rng.uniform());
            let on_edge = a + a.vector_to(b) * s;
            let on_face = on_edge + on_edge.vector_to(c) * t;
            let within = on_face + on_face.vector_to(d) * rng.range(0.01, 0.99);
            for p in [on_edge, on_face] {
                let found = tetrahedra[mesh.checked((p.x, p.y, p.z)).unwrap() as usize];
                assert!(found.iter().any(|v| tetrahedra[i % tetrahedra.len()].contains(v)), "{p:?}");
            }
            // Negative control of the places: inside, it is the tetrahedron itself.
            assert_eq!(mesh.checked((within.x, within.y, within.z)), Ok((i % tetrahedra.len()) as f64));
        }
        for p in vertices {
            assert!(mesh.checked((p.x, p.y, p.z)).is_ok(), "{p:?}");
        }
        let outside = turn * Point3D::new(99.999_999, 100.5, 100.5);
        assert!(mesh.checked((outside.x, outside.y, outside.z)).is_err());
    }

    #[test]
    fn instances_share_the_mesh_and_what_is_wrong_is_named() {
        let (vertices, tetrahedra) = cubes(1, 0.0);
        let count = tetrahedra.len();
        let first = Discrete3DMesh::new(vertices.clone(), tetrahedra, vec![1.0; count]).unwrap();
        let second = first.instance(vec![2.0; count]).unwrap().with_default(-1.0);
        assert!(Arc::ptr_eq(&first.tetrahedra, &second.tetrahedra));
        assert_eq!((first.checked((0.5, 0.4, 0.3)), second.checked((0.5, 0.4, 0.3))), (Ok(1.0), Ok(2.0)));
        assert_eq!(second.checked((0.5, 0.4, 3.0)), Ok(-1.0));
        assert!(second.checked((0.5, f64::NAN, 3.0)).is_err());
        let text = |tetrahedra: Vec<[u32; 4]>| {
            Discrete3DMesh::new(vertices.clone(), tetrahedra, vec![1.0]).unwrap_err().to_string()
        };
        assert_eq!(text(vec![[0, 1, 2, 9]]), "tetrahedron 0 of the mesh: there is no vertex 9 among 8");
        assert_eq!(text(vec![[0, 1, 2, 2]]), "tetrahedron 0 of the mesh: its vertices lie in one plane");
    }
}
