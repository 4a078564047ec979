//! What happens to a path, noted while it is followed.

mod event;
mod files;
mod hit;
mod logged_path;
mod vertex;

use raysect_core::{BoundingBox3D, Ray, SurfacePoint};
use raysect_math::{Normal3D, Point3D, Vector3D};

pub use event::PathEvent;
pub use hit::VertexHit;
pub use logged_path::LoggedPath;
pub use vertex::PathVertex;

use super::{Ledger, Path};
use crate::{Scatter, Scene};

/// The vertices of a path so far. A path that is not to be noted gets an empty log, which nobody looks at.
#[derive(Debug, Default)]
pub(super) struct PathLog {
    vertices: Vec<PathVertex>,
    /// What of the radiance of the path belongs to a vertex or a piece already.
    known: Vec<f64>,
    /// True if the surface of the last vertex emits.
    shines: bool,
}

impl PathLog {
    /// The path starts.
    pub(super) fn start(&mut self, path: &Path<'_>, origin: Point3D) {
        self.known = vec![0.0; path.radiance.len()];
        self.arrive(path, origin);
        self.leave(path, PathEvent::Started);
    }

    /// The path arrives at a place: what has been added to its radiance since the last one belongs to the way.
    pub(super) fn arrive(&mut self, path: &Path<'_>, point: Point3D) {
        let along = self.added(&path.radiance);
        let (before, after) = (path.throughput.clone(), path.throughput.clone());
        let (event, radiance) = (PathEvent::Lost, vec![0.0; along.len()]);
        self.vertices.push(PathVertex { point, hit: None, event, before, after, along, radiance });
        self.shines = false;
    }

    /// The path leaves the scene along a ray.
    pub(super) fn arrive_nowhere(&mut self, path: &Path<'_>, ray: &Ray) {
        let end = ray.max_distance.is_finite().then(|| ray.point_at(ray.max_distance));
        self.arrive(path, end.unwrap_or_else(|| outside(path.scene, ray)));
    }

    /// Says which surface is at the place of arrival.
    pub(super) fn meet_surface(&mut self, path: &Path<'_>, surface: &SurfacePoint) {
        let at = (surface.local_point, Some(surface.normal));
        self.meet(path, surface.instance, surface.exiting, at);
    }

    /// Says which volume scatters at the place of arrival.
    pub(super) fn meet_volume(&mut self, path: &Path<'_>, instance: u32, point: Point3D) {
        let to_local = &path.scene.instances[instance as usize].to_local;
        self.meet(path, instance, true, (to_local.transform_point(point), None));
    }

    fn meet(
        &mut self,
        path: &Path<'_>,
        instance: u32,
        inside: bool,
        (local_point, normal): (Point3D, Option<Normal3D>),
    ) {
        let placed = &path.scene.instances[instance as usize];
        let compiled = &path.scene.compiled;
        self.shines = compiled.facts[instance as usize].emits;
        if let Some(vertex) = self.vertices.last_mut() {
            vertex.hit = Some(VertexHit {
                node: placed.node,
                name: String::new(),
                shape: placed.primitive.kind(),
                material: compiled.names[instance as usize].clone(),
                inside,
                local_point,
                normal,
            });
        }
    }

    /// The path goes on from the place of arrival.
    pub(super) fn leave(&mut self, path: &Path<'_>, event: PathEvent) {
        let radiance = self.added(&path.radiance);
        if let Some(vertex) = self.vertices.last_mut() {
            vertex.event = event;
            vertex.after.copy_from_slice(&path.throughput);
            vertex.radiance = radiance;
        }
    }

    /// The path has ended at the place of arrival; `before` is what had become of all paths before it.
    pub(super) fn finish(mut self, path: &Path<'_>, before: &Ledger) -> LoggedPath {
        let now = &path.ledger;
        let event = match ending(before, now) {
            PathEvent::Absorbed if self.shines && self.known != path.radiance => PathEvent::Emitted,
            event => event,
        };
        self.leave(path, event);
        if let Some(vertex) = self.vertices.last_mut()
            && matches!(event, PathEvent::Absorbed | PathEvent::Emitted | PathEvent::Killed)
        {
            vertex.after.fill(0.0);
        }
        LoggedPath {
            vertices: self.vertices,
            radiance: path.radiance.clone(),
            range: (path.slice.min, path.slice.max),
            wavelength: path.waves.kept,
            depth: path.depth,
            rays: now.rays - before.rays,
            shadow_rays: now.shadow_rays - before.shadow_rays,
        }
    }

    /// What has been added to the radiance since this was asked last.
    fn added(&mut self, radiance: &[f64]) -> Vec<f64> {
        let added = radiance.iter().zip(&self.known).map(|(now, known)| now - known).collect();
        self.known.copy_from_slice(radiance);
        added
    }
}

impl PathEvent {
    /// How a path goes on along a direction. `chosen` is true if the direction was drawn from many, `through` if it leads
    /// to the other side.
    pub(super) fn of(scatter: Scatter, chosen: bool, through: bool) -> Self {
        match (scatter, chosen, through) {
            (Scatter::Absorbed, ..) => Self::Absorbed,
            (Scatter::PassThrough, ..) => Self::Passed,
            (Scatter::Continue { .. }, true, true) => Self::Transmitted,
            (Scatter::Continue { .. }, true, false) => Self::Reflected,
            (Scatter::Continue { .. }, false, true) => Self::Refracted,
            (Scatter::Continue { .. }, false, false) => Self::Mirrored,
        }
    }
}

/// How a path has ended, by what has become of the paths before it and with it.
fn ending(before: &Ledger, now: &Ledger) -> PathEvent {
    let ends = [
        (before.absorbed, now.absorbed, PathEvent::Absorbed),
        (before.escaped, now.escaped, PathEvent::Escaped),
        (before.killed, now.killed, PathEvent::Killed),
        (before.truncated, now.truncated, PathEvent::Truncated),
    ];
    ends.iter().find(|(before, now, _)| now > before).map_or(PathEvent::Lost, |(_, _, event)| *event)
}

/// A point along a ray outside of everything in the scene.
fn outside(scene: &Scene, ray: &Ray) -> Point3D {
    let mut all = BoundingBox3D::EMPTY;
    scene.instances.iter().for_each(|instance| all = all.union(&instance.bounds));
    let sphere = all.enclosing_sphere();
    let distance = ray.origin.distance_to(sphere.centre) + sphere.radius;
    let seen = if distance.is_finite() && distance > 0.0 { distance } else { 1.0 };
    ray.origin + Vector3D::normalise_unchecked(ray.direction) * seen
}
