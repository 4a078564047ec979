use std::sync::Arc;

use super::field::{Field, found, function_on_mesh};
use super::triangles::{Triangles, structured_by_triangles};
use crate::function::{Function, Structured2D};
use crate::{MathError, Point2D};

/// A [`Function`] that is constant on each triangle of a mesh in a plane.
///
/// Where triangles overlap, or at the edge between two, one of them gives the value: the same one each time.
///
/// ```
/// use raysect_math::function::{Arg, Function};
/// use raysect_math::{Discrete2DMesh, Point2D};
/// let corner = |x: f64, y: f64| Point2D::new(x, y);
/// let square = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
/// let f = Discrete2DMesh::new(square, vec![[0, 1, 2], [0, 2, 3]], vec![5.0, 7.0])?;
/// assert_eq!((f.evaluate((0.9, 0.1)), f.evaluate((0.1, 0.9))), (5.0, 7.0));
/// assert!(f.evaluate((1.1, 0.5)).is_nan() && f.checked((1.1, 0.5)).is_err());
/// let f = f.with_default(-1.0);
/// assert_eq!((2.0 * Arg::X + f).evaluate((1.5, 0.5)), 2.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Discrete2DMesh {
    triangles: Arc<Triangles>,
    field: Field,
}

impl Discrete2DMesh {
    /// From vertices [m], triangles as numbers of vertices in either sense, and one value for each triangle. It is
    /// limited to the mesh; see [`with_default`](Self::with_default).
    ///
    /// # Errors
    /// [`MathError::MeshPart`] for vertices beyond 1e100 m, triangles without area or of vertices that are not there,
    /// and values that are not finite; [`MathError::ValueCount`] unless there is one value for each triangle.
    pub fn new(
        vertices: impl Into<Vec<Point2D>>,
        triangles: impl Into<Vec<[u32; 3]>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, MathError> {
        let triangles = Arc::new(Triangles::new(vertices.into(), triangles.into())?);
        let field = Field::new(values.into(), triangles.len(), "triangles")?;
        Ok(Self { triangles, field })
    }

    /// The same mesh, which is shared, with other values; limited to the mesh.
    ///
    /// # Errors
    /// [`MathError::ValueCount`] and [`MathError::MeshPart`] as in [`new`](Self::new).
    pub fn instance(&self, values: impl Into<Vec<f64>>) -> Result<Self, MathError> {
        let field = Field::new(values.into(), self.triangles.len(), "triangles")?;
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
            Some((triangle, _)) => Some(self.field.value(triangle)),
            None => self.field.outside(&[at.0, at.1]),
        }
    }
}

function_on_mesh!(Discrete2DMesh, (f64, f64));

structured_by_triangles!(Discrete2DMesh);

#[cfg(test)]
mod tests {
    use super::super::sample_meshes::{Saved, close, grid, on_edges, turned};
    use super::*;

    #[test]
    fn values_agree_with_raysect() {
        let saved = Saved::read();
        let mesh =
            Discrete2DMesh::new(saved.vertices.clone(), saved.triangles.clone(), saved.of_triangles.clone());
        let mesh = mesh.unwrap().with_default(-1.0);
        for [x, y, _, expected] in &saved.at {
            assert_eq!(mesh.checked((*x, *y)).unwrap(), *expected, "{x} {y}");
        }
        // Negative control: values in another order do not.
        let mut turned = saved.of_triangles.clone();
        turned.rotate_left(1);
        let other = mesh.instance(turned).unwrap().with_default(-1.0);
        assert!(
            saved.at.iter().any(|[x, y, _, expected]| !close(other.checked((*x, *y)).unwrap(), *expected))
        );
    }

    #[test]
    fn no_point_on_an_edge_or_vertex_is_lost() {
        let (vertices, triangles) = grid(220, 1000.0);
        let vertices = turned(&vertices);
        let values: Vec<f64> = (0..triangles.len()).map(|i| i as f64).collect();
        assert!(triangles.len() > 90_000);
        let mesh = Discrete2DMesh::new(vertices.clone(), triangles.clone(), values).unwrap();
        let mut found = 0;
        for (point, triangle) in on_edges(&vertices, &triangles, 100_000) {
            let value = mesh.checked((point.x, point.y));
            // The triangle itself or one that shares a vertex with it.
            let neighbour = triangles[value.unwrap() as usize];
            assert!(neighbour.iter().any(|v| triangles[triangle].contains(v)), "{point:?}");
            found += 1;
        }
        assert_eq!(found, 100_000);
        for p in vertices {
            assert!(mesh.checked((p.x, p.y)).is_ok(), "{p:?}");
        }
    }

    #[test]
    fn either_sense_and_slivers_are_found() {
        let p = Point2D::new;
        let vertices = vec![p(0.0, 0.0), p(1.0, 0.0), p(0.5, 1e-12), p(0.5, -1.0)];
        let mesh = Discrete2DMesh::new(vertices, vec![[0, 1, 2], [0, 1, 3]], vec![1.0, 2.0]).unwrap();
        assert_eq!(mesh.checked((0.5, 5e-13)).unwrap(), 1.0);
        assert_eq!(mesh.checked((0.5, -0.5)).unwrap(), 2.0);
        assert!(mesh.checked((0.5, 2e-12)).is_err() && mesh.checked((0.25, 6e-13)).is_err());
    }

    #[test]
    fn instances_share_the_mesh_and_nan_is_nowhere() {
        let (vertices, triangles) = grid(3, 0.0);
        let count = triangles.len();
        let first = Discrete2DMesh::new(vertices, triangles, vec![1.0; count]).unwrap();
        let second = first.instance(vec![2.0; count]).unwrap().with_default(9.0);
        assert!(Arc::ptr_eq(&first.triangles, &second.triangles));
        assert_eq!((first.checked((0.5, 0.5)), second.checked((0.5, 0.5))), (Ok(1.0), Ok(2.0)));
        assert_eq!(second.checked((f64::INFINITY, 0.5)), Ok(9.0));
        assert!(second.checked((f64::NAN, 0.5)).is_err() && second.checked((0.5, f64::NAN)).is_err());
        let message = first.checked((-1.0, 0.5)).unwrap_err().to_string();
        assert_eq!(message, "[-1.0, 0.5] m lies outside of the mesh, and the function is limited to it");
    }

    #[test]
    fn what_is_wrong_is_named() {
        let p = Point2D::new;
        let vertices = vec![p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0), p(2.0, 0.0)];
        let new = |triangles: Vec<[u32; 3]>, values: Vec<f64>| {
            Discrete2DMesh::new(vertices.clone(), triangles, values)
        };
        let text = |r: Result<Discrete2DMesh, MathError>| r.unwrap_err().to_string();
        assert_eq!(
            text(new(vec![[0, 1, 2], [0, 1, 3]], vec![1.0; 2])),
            "triangle 1 of the mesh: its vertices lie on one line"
        );
        assert_eq!(
            text(new(vec![[0, 1, 4]], vec![1.0])),
            "triangle 0 of the mesh: there is no vertex 4 among 4"
        );
        assert_eq!(
            text(new(vec![[0, 1, 2]], vec![1.0; 2])),
            "2 values for 1 triangles: there must be as many"
        );
        assert_eq!(text(new(vec![[0, 1, 2]], vec![f64::NAN])), "value 0 of the mesh: NaN is not finite");
        let far = Discrete2DMesh::new(vec![p(f64::NAN, 0.0)], vec![], vec![]);
        assert_eq!(text(far), "vertex 0 of the mesh: (NaN, 0) is beyond 1e100 m or not finite");
    }
}
