use std::fmt;

use raysect_core::BoundingBox3D;
use raysect_math::Vector3D;

use self::shells::Shells;
use self::topology::Topology;
use super::MeshData;

mod nesting;
mod shells;
mod topology;

/// What is known about the soundness of a mesh.
///
/// Vertices at equal coordinates count as one place, so that a soup of triangles is judged by its shape. Places, not
/// vertices, make an edge the same edge.
///
/// ```
/// use raysect_primitive::MeshData;
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let solid = MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?.health();
/// assert!(solid.is_solid());
/// assert!((solid.volume().unwrap() - 1.0 / 6.0).abs() < 1e-16);
/// let open = MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3]])?.health();
/// assert_eq!((open.is_watertight(), open.boundary_edges), (false, 3));
/// # Ok::<(), raysect_primitive::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshHealth {
    /// How many triangles there are.
    pub triangles: usize,
    /// How many vertices there are, used or not.
    pub vertices: usize,
    /// Vertices of no triangle.
    pub unused_vertices: usize,
    /// Vertices at the coordinates of an earlier one; [`MeshData::weld`] makes them one.
    pub unmerged_vertices: usize,
    /// Triangles without area.
    pub degenerate_triangles: usize,
    /// Triangles with the three places of an earlier one, in any order.
    pub duplicate_triangles: usize,
    /// Edges of one triangle only.
    pub boundary_edges: usize,
    /// Edges of three triangles or more.
    pub non_manifold_edges: usize,
    /// Edges of an odd number of triangles: where the surface ends. Boundary edges are among them.
    pub odd_edges: usize,
    /// Edges at which fronts meet backs: not run through as often one way as the other.
    pub inconsistent_edges: usize,
    /// Places at which the surface touches itself in a point: several fans of triangles meet there.
    pub touching_vertices: usize,
    /// Parts of the surface that hang together by edges.
    pub shells: usize,
    /// Shells without an odd edge.
    pub closed_shells: usize,
    /// Closed, consistent shells whose fronts look into the solid: inside out, or, within another shell, not.
    pub misdirected_shells: usize,
    /// The smallest box around all triangles [m].
    pub bounding_box: BoundingBox3D,
    /// Area of all triangles [m²].
    pub surface_area: f64,
    /// Signed volume by the divergence theorem [m³], of a mesh that has one.
    signed_volume: f64,
}

impl MeshHealth {
    /// Of a mesh; `O(n log n)` in the number of triangles.
    pub fn of(mesh: &MeshData) -> Self {
        let topology = Topology::new(mesh);
        let shells = Shells::new(mesh, &topology);
        let used = topology.used_vertices;
        Self {
            triangles: mesh.triangle_count(),
            vertices: mesh.vertex_count(),
            unused_vertices: mesh.vertex_count() - used,
            unmerged_vertices: used - topology.used_places,
            degenerate_triangles: (0..mesh.triangle_count()).filter(|&t| mesh.is_degenerate(t)).count(),
            duplicate_triangles: topology.duplicates,
            boundary_edges: topology.boundary_edges,
            non_manifold_edges: topology.non_manifold_edges,
            odd_edges: topology.odd_edges,
            inconsistent_edges: topology.inconsistent_edges,
            touching_vertices: topology.touching_places,
            shells: shells.list.len(),
            closed_shells: shells.list.iter().filter(|s| s.is_closed).count(),
            misdirected_shells: shells.misdirected,
            bounding_box: mesh.bounding_box(),
            surface_area: sum((0..mesh.triangle_count()).map(|t| mesh.triangle_area(t))),
            signed_volume: sum(shells.list.iter().map(|s| s.volume)),
        }
    }

    /// True if every edge belongs to an even number of triangles: nothing leaks through.
    pub fn is_watertight(&self) -> bool {
        self.odd_edges == 0
    }

    /// True if the surface is a sheet everywhere: at most two triangles at an edge, one fan at a place.
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_edges == 0 && self.touching_vertices == 0
    }

    /// True if fronts meet fronts at every edge.
    pub fn is_consistently_oriented(&self) -> bool {
        self.inconsistent_edges == 0
    }

    /// True if fronts look away from the solid; false for meshes that bound none.
    pub fn is_outward(&self) -> bool {
        self.is_watertight() && self.is_consistently_oriented() && self.misdirected_shells == 0
    }

    /// True if the mesh bounds a solid as light needs it: watertight, consistent, outward, nothing twice.
    pub fn is_solid(&self) -> bool {
        self.is_outward() && self.duplicate_triangles == 0
    }

    /// Volume [m³] by the divergence theorem, negative if fronts look inward; `None` unless the mesh is watertight and
    /// consistently oriented.
    pub fn volume(&self) -> Option<f64> {
        (self.is_watertight() && self.is_consistently_oriented()).then_some(self.signed_volume)
    }
}

impl MeshData {
    /// Whether the mesh is closed, oriented and sound, with counts of what is not.
    pub fn health(&self) -> MeshHealth {
        MeshHealth::of(self)
    }
}

impl fmt::Display for MeshHealth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let yes = |holds| if holds { "yes" } else { "no" };
        writeln!(f, "triangles             {}", self.triangles)?;
        writeln!(f, "vertices              {}", self.vertices)?;
        writeln!(f, "watertight            {}", yes(self.is_watertight()))?;
        writeln!(f, "manifold              {}", yes(self.is_manifold()))?;
        writeln!(f, "consistently oriented {}", yes(self.is_consistently_oriented()))?;
        writeln!(f, "outward               {}", yes(self.is_outward()))?;
        writeln!(f, "shells, closed        {}, {}", self.shells, self.closed_shells)?;
        let faults = [
            ("boundary edges", self.boundary_edges),
            ("non-manifold edges", self.non_manifold_edges),
            ("inconsistent edges", self.inconsistent_edges),
            ("misdirected shells", self.misdirected_shells),
            ("degenerate triangles", self.degenerate_triangles),
            ("duplicate triangles", self.duplicate_triangles),
            ("touching vertices", self.touching_vertices),
            ("unmerged vertices", self.unmerged_vertices),
            ("unused vertices", self.unused_vertices),
        ];
        for (name, count) in faults.into_iter().filter(|&(_, count)| count > 0) {
            writeln!(f, "{name:<21} {count}")?;
        }
        let [a, b] = [self.bounding_box.lower, self.bounding_box.upper];
        writeln!(f, "from                  ({}, {}, {}) m", a.x, a.y, a.z)?;
        writeln!(f, "to                    ({}, {}, {}) m", b.x, b.y, b.z)?;
        write!(f, "area                  {} m²", self.surface_area)?;
        match self.volume() {
            Some(volume) => write!(f, "\nvolume                {volume} m³"),
            None => Ok(()),
        }
    }
}

/// Sum with carried rounding error (A. Neumaier, *Rundungsfehleranalyse einiger Verfahren zur Summation endlicher
/// Summen*, 1974).
fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut carried) = (0.0, 0.0);
    for value in values {
        let next: f64 = sum + value;
        carried += if f64::abs(sum) >= f64::abs(value) { (sum - next) + value } else { (value - next) + sum };
        sum = next;
    }
    // An overflow leaves no error to carry.
    if sum.is_finite() { sum + carried } else { sum }
}

/// Six times the signed volume of the tetrahedron above a triangle.
fn determinant([a, b, c]: [Vector3D; 3]) -> f64 {
    a.dot(b.cross(c))
}

#[cfg(test)]
#[path = "health_tests.rs"]
mod tests;
