use std::sync::Arc;

use super::field::{Field, found, function_on_mesh};
use super::triangles::{Triangles, structured_by_triangles};
use crate::function::{Function, Structured2D};
use crate::{MathError, Point2D};

/// A [`Function`] that is linear on each triangle of a mesh in a plane, between values at the vertices.
///
/// Where triangles share their edges it is continuous, and it never leaves the range of the three values around a point.
///
/// ```
/// use raysect_math::function::Function;
/// use raysect_math::{Interpolator2DMesh, Point2D};
/// let corner = |x: f64, y: f64| Point2D::new(x, y);
/// let square = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
/// let f = Interpolator2DMesh::new(square, vec![[0, 1, 2], [0, 2, 3]], vec![0.0, 1.0, 3.0, 2.0])?;
/// assert_eq!((f.evaluate((0.5, 0.25)), f.evaluate((0.0, 0.5))), (1.0, 1.0));
/// assert!(f.evaluate((1.1, 0.5)).is_nan() && f.checked((1.1, 0.5)).is_err());
/// // Other values on the same mesh, and a value outside.
/// let g = f.instance(vec![4.0; 4])?.with_default(0.0);
/// assert_eq!((g.evaluate((0.5, 0.25)), g.evaluate((1.1, 0.5))), (4.0, 0.0));
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolator2DMesh {
    triangles: Arc<Triangles>,
    field: Field,
}

impl Interpolator2DMesh {
    /// From vertices [m], triangles as numbers of vertices in either sense, and one value for each vertex. It is limited
    /// to the mesh; see [`with_default`](Self::with_default).
    ///
    /// # Errors
    /// [`MathError::MeshPart`] for vertices beyond 1e100 m, triangles without area or of vertices that are not there,
    /// and values that are not finite; [`MathError::ValueCount`] unless there is one value for each vertex.
    pub fn new(
        vertices: impl Into<Vec<Point2D>>,
        triangles: impl Into<Vec<[u32; 3]>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, MathError> {
        let triangles = Arc::new(Triangles::new(vertices.into(), triangles.into())?);
        let field = Field::new(values.into(), triangles.vertex_count(), "vertices")?;
        Ok(Self { triangles, field })
    }

    /// The same mesh, which is shared, with other values; limited to the mesh.
    ///
    /// # Errors
    /// [`MathError::ValueCount`] and [`MathError::MeshPart`] as in [`new`](Self::new).
    pub fn instance(&self, values: impl Into<Vec<f64>>) -> Result<Self, MathError> {
        let field = Field::new(values.into(), self.triangles.vertex_count(), "vertices")?;
        Ok(Self { triangles: Arc::clone(&self.triangles), field })
    }

    /// The same function, with a value outside of the mesh. A clone of it shares mesh and values.
    #[doc(alias("default_value", "limit"))]
    pub fn with_default(mut self, value: f64) -> Self {
        self.field.default = Some(value);
        self
    }

    #[inline]
    fn find(&self, at: (f64, f64)) -> Option<f64> {
        match self.triangles.find(at.0, at.1) {
            Some((triangle, [u, v, w])) => {
                let [a, b, c] = self.triangles.corners(triangle).map(|vertex| self.field.value(vertex));
                Some(a * u + b * v + c * w)
            }
            None => self.field.outside(&[at.0, at.1]),
        }
    }
}

function_on_mesh!(Interpolator2DMesh, (f64, f64));

structured_by_triangles!(Interpolator2DMesh);

#[cfg(test)]
mod tests {
    use super::super::sample_meshes::{Saved, close, grid, on_edges, turned};
    use super::*;

    #[test]
    fn values_agree_with_raysect() {
        let saved = Saved::read();
        let mesh = Interpolator2DMesh::new(
            saved.vertices.clone(),
            saved.triangles.clone(),
            saved.of_vertices.clone(),
        );
        let mesh = mesh.unwrap().with_default(-1.0);
        for [x, y, expected, _] in &saved.at {
            assert!(close(mesh.checked((*x, *y)).unwrap(), *expected), "{x} {y}");
        }
        // Negative control: values a millionth larger do not.
        let larger: Vec<f64> = saved.of_vertices.iter().map(|v| v * (1.0 + 1e-6)).collect();
        let other = mesh.instance(larger).unwrap().with_default(-1.0);
        assert!(
            saved.at.iter().any(|[x, y, expected, _]| !close(other.checked((*x, *y)).unwrap(), *expected))
        );
    }

    #[test]
    fn a_linear_function_comes_back_everywhere_and_on_every_edge() {
        let (vertices, triangles) = grid(220, -3.0);
        let vertices = turned(&vertices);
        let f = |p: Point2D| 2.0 + 3.0 * p.x - 5.0 * p.y;
        let values: Vec<f64> = vertices.iter().map(|&p| f(p)).collect();
        let mesh = Interpolator2DMesh::new(vertices.clone(), triangles.clone(), values).unwrap();
        for (point, _) in on_edges(&vertices, &triangles, 100_000) {
            let error = mesh.checked((point.x, point.y)).unwrap() - f(point);
            assert!(error.abs() < 1e-11, "{point:?} {error}");
        }
        for p in vertices {
            assert!((mesh.checked((p.x, p.y)).unwrap() - f(p)).abs() < 1e-11, "{p:?}");
        }
    }

    #[test]
    fn there_must_be_a_value_for_each_vertex() {
        let (vertices, triangles) = grid(2, 0.0);
        let mesh = Interpolator2DMesh::new(vertices, triangles, vec![0.0; 9]).unwrap();
        assert_eq!(
            mesh.instance(vec![0.0; 8]).unwrap_err(),
            MathError::ValueCount { given: 8, needed: 9, of: "vertices" }
        );
        assert!(mesh.checked((3.0, 0.0)).is_err());
    }
}
