use raysect_math::{Point3D, Vector3D};

use super::super::MeshData;
use super::nesting::windings;
use super::topology::Topology;
use super::{determinant, sum};

/// The parts of a mesh that hang together.
#[derive(Debug)]
pub(super) struct Shells {
    pub(super) list: Vec<Shell>,
    pub(super) misdirected: usize,
}

/// A part of a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shell {
    pub(super) is_closed: bool,
    /// Signed volume [m³]; means nothing for an open shell.
    pub(super) volume: f64,
    is_consistent: bool,
    /// A corner of the shell [m].
    point: Point3D,
}

impl Shells {
    pub(super) fn new(mesh: &MeshData, topology: &Topology) -> Self {
        let mut members = vec![Vec::new(); topology.shell_count];
        for (triangle, &shell) in topology.shell_of.iter().enumerate() {
            members[shell as usize].push(triangle);
        }
        let list: Vec<Shell> = members
            .iter()
            .zip(&topology.shell_flags)
            .map(|(triangles, flags)| Shell {
                is_closed: flags.is_closed,
                is_consistent: flags.is_consistent,
                volume: volume(mesh, triangles),
                point: mesh.corners(triangles[0])[0],
            })
            .collect();
        let misdirected = count_misdirected(mesh, topology, &list);
        Self { list, misdirected }
    }
}

/// Shells whose fronts look into matter: around the shell matter is where the others wind round a point.
fn count_misdirected(mesh: &MeshData, topology: &Topology, list: &[Shell]) -> usize {
    let bounds = |s: &Shell| s.is_closed && s.is_consistent && s.volume != 0.0;
    if list.len() == 1 {
        return usize::from(bounds(&list[0]) && list[0].volume < 0.0);
    }
    let points: Vec<Point3D> = list.iter().map(|s| s.point).collect();
    let around = windings(mesh, &topology.shell_of, &points);
    let wrong = |(s, winding): &(&Shell, i64)| bounds(s) && (*winding <= 0) != (s.volume > 0.0);
    list.iter().zip(around).filter(wrong).count()
}

/// Signed volume of the tetrahedra between the triangles and the first corner, by the divergence theorem [m³].
fn volume(mesh: &MeshData, triangles: &[usize]) -> f64 {
    let origin = mesh.corners(triangles[0])[0].to_vector() * 0.5;
    let half = |p: Point3D| p.to_vector() * 0.5 - origin;
    let corners = || triangles.iter().map(|&t| mesh.corners(t).map(half));
    let size = corners().flatten().map(Vector3D::max_abs).fold(0.0, f64::max);
    if size == 0.0 {
        return 0.0;
    }
    let unit = sum(corners().map(|t| determinant(t.map(|v| v / size)))) / 6.0;
    let size = 2.0 * size;
    unit * size * size * size
}
