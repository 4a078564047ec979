//! Crossings of rays with shapes that were recorded elsewhere, and ours of the same rays.
//!
//! A line of a file is a case: a shape, its place, rays with all their crossings in order, points and whether they lie
//! inside.

use std::io::BufRead;

use raysect::core::{Intersection, Node, Ray, World};
use raysect::math::{Normal3D, Point3D, Vector3D};
use serde_json::Value;

use crate::finding::Finding;
use crate::json::{array, field, flag, list, number, numbers, same_length, text};
use crate::recorded_shape;

/// How far distances may differ, in units of (distance + size of the shape).
const DISTANCE: f64 = 1e-9;
/// How far unit normals may differ.
const NORMAL: f64 = 1e-7;

/// One crossing as it was recorded.
struct Recorded {
    distance: f64,
    normal: Normal3D,
    exiting: bool,
}

/// One line of a file.
pub(crate) struct Case {
    pub(crate) id: String,
    world: World<()>,
    /// Radius of the bounding sphere \[m\].
    size: f64,
    rays: Vec<(Ray, Vec<Recorded>)>,
    points: Vec<(Point3D, bool)>,
}

/// Reads and compares a file line by line, and hands over what each case gives.
pub(crate) fn compare_all(file: impl BufRead, mut found: impl FnMut(Finding)) -> Result<(), String> {
    let mut cases = 0;
    for (number, line) in file.lines().enumerate() {
        let line = line.map_err(|e| format!("line {}: {e}", number + 1))?;
        if line.trim().is_empty() {
            continue;
        }
        let finding = Case::read(&line).and_then(|case| case.compare());
        found(finding.map_err(|e| format!("line {}: {e}", number + 1))?);
        cases += 1;
    }
    if cases == 0 { Err("line 1: there is no case".to_owned()) } else { Ok(()) }
}

impl Case {
    /// Reads a line.
    pub(crate) fn read(line: &str) -> Result<Self, String> {
        let value: Value = serde_json::from_str(line).map_err(|e| format!("no JSON: {e}"))?;
        let value = &value;
        let description = value.get("shape").unwrap_or(&Value::Null);
        if description.get("transform").is_some() {
            return Err("shape: transform: only operands have one here".to_owned());
        }
        let shape = field(value, "shape", recorded_shape::shape)?;
        let to_world = field(value, "transform", recorded_shape::transform)?;
        let size = shape.bounding_sphere(&to_world).radius;
        let mut world = World::new();
        world.add(Node::of(shape, ()).transform(to_world)).map_err(|e| e.to_string())?;

        let rays = field(value, "rays", |v| list(v, ray))?;
        let crossings = field(value, "crossings", |v| list(v, |v| list(v, recorded)))?;
        let points = field(value, "points", |v| list(v, numbers::<3>))?;
        let inside = field(value, "inside", |v| list(v, flag))?;
        same_length("rays", rays.len(), "crossings", crossings.len())?;
        same_length("points", points.len(), "inside", inside.len())?;
        if rays.is_empty() && points.is_empty() {
            return Err("rays: there is nothing to compare".to_owned());
        }
        Ok(Self {
            id: field(value, "id", text)?,
            world,
            size,
            rays: rays.into_iter().zip(crossings).collect(),
            points: points.into_iter().map(Point3D::from).zip(inside).collect(),
        })
    }

    /// Compares all rays and points. An error is a shape that cannot be asked.
    pub(crate) fn compare(self) -> Result<Finding, String> {
        let mut finding = Finding::new(&self.id);
        for (number, (ray, recorded)) in self.rays.iter().enumerate() {
            let ours = self.world.crossings(ray).map_err(|e| format!("rays: entry {number}: {e}"))?;
            self.compare_ray(number, &ours, recorded, &mut finding);
        }
        for (number, &(point, recorded)) in self.points.iter().enumerate() {
            let ours = !self.world.contains(point).map_err(|e| e.to_string())?.is_empty();
            finding.expect(ours == recorded, || {
                format!("point {number}: {}, recorded {}", side(ours), side(recorded))
            });
        }
        Ok(finding)
    }

    fn compare_ray(&self, ray: usize, ours: &[Intersection], recorded: &[Recorded], finding: &mut Finding) {
        finding.expect(ours.len() == recorded.len(), || {
            let distances = |all: Vec<f64>| format!("{} crossings {all:?}", all.len());
            let (o, r) = (
                ours.iter().map(Intersection::distance).collect(),
                recorded.iter().map(|r| r.distance).collect(),
            );
            format!("ray {ray}: {}, recorded {}", distances(o), distances(r))
        });
        if ours.len() != recorded.len() {
            return;
        }
        for (number, (ours, recorded)) in ours.iter().zip(recorded).enumerate() {
            let place = format!("ray {ray}, crossing {number}");
            let distance = ours.distance();
            let error = (distance - recorded.distance).abs() / (recorded.distance + self.size);
            finding.measure(error, DISTANCE, || {
                format!("{place}: distance {distance}, recorded {}", recorded.distance)
            });
            let error = (ours.normal().as_vector() - recorded.normal.as_vector()).length();
            finding.measure(error, NORMAL, || {
                format!("{place}: normal {:?}, recorded {:?}", ours.normal(), recorded.normal)
            });
            finding.expect(ours.exiting() == recorded.exiting, || {
                format!("{place}: {}, recorded {}", way(ours.exiting()), way(recorded.exiting))
            });
        }
    }
}

fn ray(value: &Value) -> Result<Ray, String> {
    let [ox, oy, oz, dx, dy, dz] = numbers(value)?;
    Ok(Ray::new(Point3D::new(ox, oy, oz), Vector3D::new(dx, dy, dz)))
}

/// `[distance, nx, ny, nz, exiting]`.
fn recorded(value: &Value) -> Result<Recorded, String> {
    let items: [Value; 5] = array(value, |v| Ok(v.clone()))?;
    let [distance, x, y, z] = [0, 1, 2, 3].map(|i| number(&items[i]));
    Ok(Recorded { distance: distance?, normal: Normal3D::new(x?, y?, z?), exiting: flag(&items[4])? })
}

fn side(inside: bool) -> &'static str {
    if inside { "inside" } else { "outside" }
}

fn way(exiting: bool) -> &'static str {
    if exiting { "exiting" } else { "entering" }
}
