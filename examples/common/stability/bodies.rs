//! One solid of every kind, with what is known of it without the code under test.

use std::f64::consts::PI;
use std::sync::Arc;

use raysect::core::Primitive;
use raysect::math::{AffineMatrix3D, Point3D, Vector3D, rotate_x, translate};
use raysect::primitive::{
    BiConcave, BiConvex, Cone, Cuboid, Cylinder, Intersect, Meniscus, Mesh, MeshData, Operand, Parabola,
    Place, PlanoConcave, PlanoConvex, Sphere, Subtract, Torus, Union,
};

/// A shape that can be handed on.
pub(crate) type Shape = Arc<dyn Primitive>;

type Depth = dyn Fn(Point3D) -> f64 + Send + Sync;

/// A solid.
#[derive(Clone)]
pub(crate) struct Body {
    pub(crate) name: &'static str,
    pub(crate) shape: Shape,
    /// About its radius [m].
    pub(crate) size: f64,
    /// A point well inside [m].
    pub(crate) inside: Point3D,
    /// Volume [m³] and area [m²].
    pub(crate) volume: f64,
    pub(crate) area: f64,
    depth: Arc<Depth>,
}

impl Body {
    /// How deep a point lies inside, negative outside [m]: right in sign, never greater in size than the distance from
    /// the surface, and that distance itself near a smooth part of it.
    pub(crate) fn depth(&self, p: Point3D) -> f64 {
        (self.depth)(p.to_vector().to_array().map(|x| x / self.size).into()) * self.size
    }

    /// The gradient of the depth by differences, outward and of unit length; `None` near an edge.
    pub(crate) fn outward(&self, p: Point3D) -> Option<Vector3D> {
        let slope = |step: f64| {
            let h = step * self.size;
            let along = |e: Vector3D| (self.depth(p - e * h) - self.depth(p + e * h)) / (2.0 * h);
            Vector3D::new(along(Vector3D::X), along(Vector3D::Y), along(Vector3D::Z))
        };
        let (fine, coarse) = (slope(1e-5), slope(2e-5));
        ((fine - coarse).length() < 1e-7 && (fine.length() - 1.0).abs() < 1e-6)
            .then(|| fine.normalise_unchecked())
    }

    /// Another shape in its place.
    pub(crate) fn with_shape(&self, shape: impl Primitive) -> Self {
        Self { shape: Arc::new(shape), ..self.clone() }
    }
}

fn slabs(p: Point3D, low: [f64; 3], high: [f64; 3]) -> f64 {
    (0..3).map(|i| (p[i] - low[i]).min(high[i] - p[i])).fold(f64::INFINITY, f64::min)
}

fn ball(p: Point3D, z: f64, radius: f64) -> f64 {
    radius - Vector3D::new(p.x, p.y, p.z - z).length()
}

fn rod(p: Point3D, radius: f64, height: f64) -> f64 {
    (radius - p.x.hypot(p.y)).min(p.z).min(height - p.z)
}

const LOW: [f64; 3] = [-0.7, -0.5, -0.6];
const HIGH: [f64; 3] = [0.6, 0.8, 0.5];

/// Volume of a cap of a ball [m³] and its curved area [m²], of a radius of curvature and half the aperture.
fn cap(radius: f64, rim: f64) -> (f64, f64, f64) {
    let sag = radius - (radius * radius - rim * rim).sqrt();
    (PI * sag * sag * (3.0 * radius - sag) / 3.0, 2.0 * PI * radius * sag, sag)
}

/// All that a body needs to be told: its shape at a scale, a point inside, volume, area and depth at scale 1.
struct Plan {
    name: &'static str,
    make: fn(f64) -> Shape,
    inside: [f64; 3],
    volume: f64,
    area: f64,
    depth: Arc<Depth>,
}

fn plan(
    name: &'static str,
    make: fn(f64) -> Shape,
    inside: [f64; 3],
    [volume, area]: [f64; 2],
    depth: impl Fn(Point3D) -> f64 + Send + Sync + 'static,
) -> Plan {
    Plan { name, make, inside, volume, area, depth: Arc::new(depth) }
}

fn box_of(s: f64, low: [f64; 3], high: [f64; 3]) -> Cuboid {
    Cuboid::new(low.map(|x| x * s).into(), high.map(|x| x * s).into()).unwrap()
}

fn plain() -> Vec<Plan> {
    let [a, b, c] = [0, 1, 2].map(|i| HIGH[i] - LOW[i]);
    let slant = 0.6f64.hypot(1.1);
    let dish = PI * 0.6 / 6.0 * ((0.36f64 + 4.0).powf(1.5) - 0.216) + PI * 0.36;
    vec![
        plan(
            "sphere",
            |s| Arc::new(Sphere::new(s).unwrap()),
            [0.0; 3],
            [4.0 * PI / 3.0, 4.0 * PI],
            |p| ball(p, 0.0, 1.0),
        ),
        plan(
            "cuboid",
            |s| Arc::new(box_of(s, LOW, HIGH)),
            [0.0; 3],
            [a * b * c, 2.0 * (a * b + b * c + c * a)],
            |p| slabs(p, LOW, HIGH),
        ),
        plan(
            "cylinder",
            |s| Arc::new(Cylinder::new(0.5 * s, 1.2 * s).unwrap()),
            [0.0, 0.0, 0.6],
            [PI * 0.3, PI * 1.7],
            |p| rod(p, 0.5, 1.2),
        ),
        plan(
            "cone",
            |s| Arc::new(Cone::new(0.6 * s, 1.1 * s).unwrap()),
            [0.0, 0.0, 0.3],
            [PI * 0.36 * 1.1 / 3.0, PI * 0.6 * (0.6 + slant)],
            move |p| (((1.1 - p.z) * (0.6 / 1.1) - p.x.hypot(p.y)) * (1.1 / slant)).min(p.z),
        ),
        plan(
            "parabola",
            |s| Arc::new(Parabola::new(0.6 * s, s).unwrap()),
            [0.0, 0.0, 0.3],
            [PI * 0.18, dish],
            |p| {
                let squared = (p.x * p.x + p.y * p.y) / 0.36;
                ((1.0 - squared - p.z) / (1.0 + 4.0 * squared / 0.36).sqrt()).min(p.z)
            },
        ),
        plan(
            "torus",
            |s| Arc::new(Torus::new(s, 0.35 * s).unwrap()),
            [1.0, 0.0, 0.0],
            [2.0 * PI * PI * 0.35 * 0.35, 4.0 * PI * PI * 0.35],
            |p| 0.35 - (p.x.hypot(p.y) - 1.0).hypot(p.z),
        ),
    ]
}

/// A bracket, two bars at a right angle, as a mesh that is not convex.
pub(crate) fn bracket(s: f64) -> MeshData {
    let outline = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.4], [0.4, 0.4], [0.4, 1.0], [0.0, 1.0]];
    let corners = [0.0, 0.5].into_iter().flat_map(|z| outline.map(|[x, y]| [x * s, y * s, z * s]));
    let cap = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let floor = cap.into_iter().map(|[a, b, c]| [a, c, b]);
    let roof = cap.into_iter().map(|t| t.map(|i| i + 6));
    let walls = (0..6u32).flat_map(|i| {
        let j = (i + 1) % 6;
        [[i, j, j + 6], [i, j + 6, i + 6]]
    });
    MeshData::new(corners, floor.chain(roof).chain(walls)).unwrap()
}

fn meshes() -> Vec<Plan> {
    let ball = MeshData::icosphere(1, 1.0).unwrap();
    let health = ball.health();
    let planes: Vec<_> = (0..ball.triangle_count())
        .map(|t| {
            let [a, b, c] = ball.corners(t);
            let normal = a.vector_to(b).cross(a.vector_to(c)).normalise_unchecked();
            (normal, normal.dot(a.to_vector()))
        })
        .collect();
    vec![
        plan(
            "mesh cube",
            |s| Arc::new(Mesh::new(MeshData::cube(0.8 * s).unwrap()).unwrap()),
            [0.1, 0.2, 0.3],
            [4.096, 6.0 * 2.56],
            |p| slabs(p, [-0.8; 3], [0.8; 3]),
        ),
        plan(
            "mesh ball",
            |s| Arc::new(Mesh::new(MeshData::icosphere(1, s).unwrap()).unwrap()),
            [0.1, 0.2, 0.3],
            [health.volume().unwrap(), health.surface_area],
            move |p| planes.iter().map(|(n, d)| d - n.dot(p.to_vector())).fold(f64::INFINITY, f64::min),
        ),
        plan(
            "mesh bracket",
            |s| Arc::new(Mesh::new(bracket(s)).unwrap()),
            [0.2, 0.2, 0.2],
            [0.64 * 0.5, 2.0 * 0.64 + 4.0 * 0.5],
            |p| slabs(p, [0.0; 3], [1.0, 0.4, 0.5]).max(slabs(p, [0.0; 3], [0.4, 1.0, 0.5])),
        ),
    ]
}

fn composites() -> Vec<Plan> {
    fn bar(s: f64) -> Cylinder {
        Cylinder::new(0.3 * s, 4.0 * s).unwrap()
    }
    fn across(s: f64) -> Operand {
        bar(s).placed(rotate_x(90.0) * translate(0.0, 0.0, -2.0 * s))
    }
    fn upright(s: f64) -> Operand {
        bar(s).placed(translate(0.0, 0.0, -2.0 * s))
    }
    fn cube(s: f64) -> Cuboid {
        Cuboid::centred(2.0 * s, 2.0 * s, 2.0 * s).unwrap()
    }
    let (radius, pole) = (0.3, f64::NAN);
    let drill = PI * radius * radius * 2.0;
    vec![
        // A ball on a brick of the same width: half a ball of 1/2 above a cube of 1.
        plan(
            "union",
            |s| {
                let ball = Sphere::new(0.5 * s).unwrap().placed(translate(0.0, 0.0, 0.5 * s));
                Arc::new(Union::new(Cuboid::centred(s, s, s).unwrap(), ball).unwrap())
            },
            [0.0, 0.0, 0.3],
            [1.0 + PI / 12.0, 6.0 + PI / 4.0],
            |p| slabs(p, [-0.5; 3], [0.5; 3]).max(ball(p, 0.5, 0.5)),
        ),
        // Two balls about centres 2 · 0.4 apart: a lens of two caps of height 0.6.
        plan(
            "intersect",
            |s| {
                let ball = Sphere::new(s).unwrap();
                let (up, down) = (translate(0.0, 0.0, 0.4 * s), translate(0.0, 0.0, -0.4 * s));
                Arc::new(Intersect::new(ball.placed(up), ball.placed(down)).unwrap())
            },
            [0.0; 3],
            [2.0 * PI * 0.36 * (3.0 - 0.6) / 3.0, 4.0 * PI * 0.6],
            |p| ball(p, 0.4, 1.0).min(ball(p, -0.4, 1.0)),
        ),
        plan(
            "subtract",
            |s| Arc::new(Subtract::new(cube(s), upright(s)).unwrap()),
            [0.7, 0.0, 0.0],
            [8.0 - drill, 24.0 - 2.0 * PI * 0.09 + 2.0 * PI * 0.3 * 2.0],
            |p| slabs(p, [-1.0; 3], [1.0; 3]).min(p.x.hypot(p.y) - 0.3),
        ),
        plan(
            "drilled ball",
            |s| {
                let holes = Union::new(upright(s), across(s)).unwrap();
                Arc::new(Subtract::new(Sphere::new(s).unwrap(), holes).unwrap())
            },
            [0.7, 0.0, 0.0],
            [pole, pole],
            |p| ball(p, 0.0, 1.0).min(p.x.hypot(p.y) - 0.3).min(p.x.hypot(p.z) - 0.3),
        ),
    ]
}

fn lenses() -> Vec<Plan> {
    let barrel = |length: f64| PI * length;
    let ((v9, a9, s9), (v11, a11, s11)) = (cap(0.9, 0.5), cap(1.1, 0.5));
    let disk = PI * 0.25;
    vec![
        plan(
            "biconvex lens",
            |s| Arc::new(BiConvex::new(s, 0.4 * s, 0.9 * s, 1.1 * s).unwrap()),
            [0.0, 0.0, 0.2],
            [disk * (0.4 - s9 - s11) + v9 + v11, a9 + a11 + barrel(0.4 - s9 - s11)],
            |p| (0.5 - p.x.hypot(p.y)).min(ball(p, 0.4 - 0.9, 0.9)).min(ball(p, 1.1, 1.1)),
        ),
        plan(
            "biconcave lens",
            |s| Arc::new(BiConcave::new(s, 0.2 * s, 0.9 * s, 1.1 * s).unwrap()),
            [0.0, 0.0, 0.1],
            [disk * (0.2 + s9 + s11) - v9 - v11, a9 + a11 + barrel(0.2 + s9 + s11)],
            |p| {
                let within = (0.5 - p.x.hypot(p.y)).min(-ball(p, 0.2 + 0.9, 0.9)).min(-ball(p, -1.1, 1.1));
                within.min((p.z + 0.3).min(0.5 - p.z))
            },
        ),
        plan(
            "meniscus",
            |s| Arc::new(Meniscus::new(s, 0.2 * s, 0.9 * s, 1.1 * s).unwrap()),
            [0.0, 0.0, 0.1],
            [disk * (0.2 - s9 + s11) + v9 - v11, a9 + a11 + barrel(0.2 - s9 + s11)],
            |p| {
                let within = (0.5 - p.x.hypot(p.y)).min(ball(p, 0.2 - 0.9, 0.9)).min(-ball(p, -1.1, 1.1));
                within.min(p.z + 0.3)
            },
        ),
        plan(
            "plano-convex lens",
            |s| Arc::new(PlanoConvex::new(s, 0.4 * s, 0.9 * s).unwrap()),
            [0.0, 0.0, 0.2],
            [disk * (0.4 - s9) + v9, a9 + disk + barrel(0.4 - s9)],
            |p| (0.5 - p.x.hypot(p.y)).min(ball(p, 0.4 - 0.9, 0.9)).min(p.z),
        ),
        plan(
            "plano-concave lens",
            |s| Arc::new(PlanoConcave::new(s, 0.2 * s, 0.9 * s).unwrap()),
            [0.0, 0.0, 0.1],
            [disk * (0.2 + s9) - v9, a9 + disk + barrel(0.2 + s9)],
            |p| (0.5 - p.x.hypot(p.y)).min(-ball(p, 0.2 + 0.9, 0.9)).min(p.z).min(0.5 - p.z),
        ),
    ]
}

/// One body of every kind at a scale: about 1 in radius times that.
pub(crate) fn all(scale: f64) -> Vec<Body> {
    let plans = [plain(), meshes(), composites(), lenses()].into_iter().flatten();
    plans
        .map(|p| Body {
            name: p.name,
            shape: (p.make)(scale),
            size: scale,
            inside: p.inside.map(|x| x * scale).into(),
            volume: p.volume * scale.powi(3),
            area: p.area * scale.powi(2),
            depth: p.depth,
        })
        .collect()
}

/// The body of a name.
pub(crate) fn named(name: &str, scale: f64) -> Body {
    all(scale).into_iter().find(|b| b.name == name).unwrap()
}

/// A stretched, sheared or mirrored map from its columns.
pub(crate) fn map(x: [f64; 3], y: [f64; 3], z: [f64; 3]) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(x.into(), y.into(), z.into(), Point3D::ORIGIN)
}
