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
}

/// Points below a shell's surface from which is told what lies around it: several, of which the majority counts.
const WITNESSES: usize = 7;
/// Their depth as a share of the size of their triangle: neighbours that touch lie on the other side.
const DEPTH: f64 = 1e-6;
/// Weights of the corners for a point of a triangle that lies on no line of symmetry.
const WEIGHTS: [f64; 3] = [0.421, 0.313, 0.266];

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
            })
            .collect();
        let misdirected = count_misdirected(mesh, topology, &list, &members);
        Self { list, misdirected }
    }
}

/// Shells whose fronts look into matter: around the shell matter is where the others wind round its points.
fn count_misdirected(mesh: &MeshData, topology: &Topology, list: &[Shell], members: &[Vec<usize>]) -> usize {
    let bounds = |s: &Shell| s.is_closed && s.is_consistent && s.volume != 0.0;
    if list.len() == 1 {
        return usize::from(bounds(&list[0]) && list[0].volume < 0.0);
    }
    let mut witnesses = Vec::new();
    for (shell, triangles) in members.iter().enumerate() {
        let count = triangles.len().min(WITNESSES);
        let chosen = (0..count).map(|k| triangles[k * triangles.len() / count]);
        let depth = DEPTH * list[shell].volume.signum();
        witnesses.extend(chosen.map(|triangle| (shell, enclosed_point(mesh, triangle, depth))));
    }
    let around = windings(mesh, &topology.shell_of, &witnesses);
    let mut of_shells = vec![Vec::new(); list.len()];
    witnesses.iter().zip(around).for_each(|(&(shell, _), winding)| of_shells[shell].push(winding));
    let median = |mut windings: Vec<i64>| {
        windings.sort_unstable();
        windings[windings.len() / 2]
    };
    let wrong = |(s, winding): &(&Shell, i64)| bounds(s) && (*winding <= 0) != (s.volume > 0.0);
    list.iter().zip(of_shells.into_iter().map(median)).filter(wrong).count()
}

/// A point behind a triangle, at a depth in units of its size.
fn enclosed_point(mesh: &MeshData, triangle: usize, depth: f64) -> Point3D {
    let corners = mesh.corners(triangle);
    let weighted = |axis: usize| (0..3).map(|k| WEIGHTS[k] * corners[k][axis]).sum();
    let point = Point3D::new(weighted(0), weighted(1), weighted(2));
    match mesh.face_normal(triangle) {
        Some(normal) => point - normal * (depth * mesh.triangle_area(triangle).sqrt()),
        None => point,
    }
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
