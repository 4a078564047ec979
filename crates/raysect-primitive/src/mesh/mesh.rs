use std::sync::{Arc, OnceLock};

use fearless_simd::{Level, Simd, dispatch};
use raysect_core::accel::wide::{LeafTest, NO_ITEM, TreeRay, WideTree};
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface, SurfaceSample,
    SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D, Vector3D};

use super::areas::Areas;
use super::block::{Block, RayLanes, Triangles};
use super::search::{After, All, Nearest, Search, crossing};
use super::triangle::ShearedRay;
use super::{MeshBuilder, MeshData};

/// A surface of triangles.
///
/// Its triangles, its tree and its options are shared by all clones: a mesh that stands in many places is kept once.
/// Rays are tested in double precision and pass no edge unseen; vertices that single precision holds exactly are
/// stored so.
///
/// ```
/// use raysect_primitive::{Mesh, MeshData};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let data = MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
/// let mesh = Mesh::new(data)?;
/// assert!(mesh.is_closed());
/// # Ok::<(), raysect_primitive::MeshError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mesh(Arc<Shared>);

/// What clones share.
#[derive(Debug)]
struct Shared {
    data: MeshData,
    tree: WideTree,
    blocks: Blocks,
    smoothing: bool,
    closed: bool,
    level: Level,
    /// Made when a point is drawn first: only lamps need it.
    areas: OnceLock<Areas>,
}

/// The triangles in the order of the leaves.
#[derive(Debug)]
enum Blocks {
    Single(Vec<Block<f32>>),
    Double(Vec<Block<f64>>),
}

impl Blocks {
    fn new(data: &MeshData, tree: &WideTree) -> Self {
        fn all<T: Triangles>(data: &MeshData, tree: &WideTree) -> Option<Vec<T>> {
            let corners = |t: u32| (t != NO_ITEM).then(|| data.corners(t as usize).map(Point3D::to_array));
            tree.leaves().iter().map(|leaf| T::of(leaf.map(corners))).collect()
        }
        match all(data, tree) {
            Some(single) => Self::Single(single),
            // Double precision stores everything.
            None => Self::Double(all(data, tree).unwrap_or_default()),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Single(blocks) => size_of_val(blocks.as_slice()),
            Self::Double(blocks) => size_of_val(blocks.as_slice()),
        }
    }
}

impl Mesh {
    /// Of triangles, with smoothing where there are vertex normals, closed if the triangles close.
    ///
    /// # Errors
    /// As [`MeshBuilder::build`].
    pub fn new(data: MeshData) -> Result<Self, super::MeshError> {
        Self::builder(data).build()
    }

    /// Of triangles, with options.
    pub fn builder(data: MeshData) -> MeshBuilder {
        MeshBuilder::new(data)
    }

    pub(super) fn of(data: MeshData, smoothing: bool, closed: bool) -> Self {
        let boxes = data.triangle_boxes();
        let tree = WideTree::new(&boxes);
        let blocks = Blocks::new(&data, &tree);
        let (level, areas) = (Level::new(), OnceLock::new());
        Self(Arc::new(Shared { data, tree, blocks, smoothing, closed, level, areas }))
    }

    /// Vertices, triangles and normals.
    pub fn data(&self) -> &MeshData {
        &self.0.data
    }

    /// True if it encloses a volume.
    pub fn is_closed(&self) -> bool {
        self.0.closed
    }

    /// True if it is shaded with interpolated vertex normals.
    pub fn is_smooth(&self) -> bool {
        self.0.smoothing
    }

    /// Bytes that its data, its tree and its triangles take.
    pub fn bytes(&self) -> usize {
        let areas = self.0.areas.get().map_or(0, Areas::bytes);
        self.0.tree.bytes() + self.0.blocks.bytes() + self.0.data.bytes() + areas
    }

    fn areas(&self) -> &Areas {
        self.0.areas.get_or_init(|| Areas::new(&self.0.data))
    }

    /// Density of points of a triangle that are drawn from an area [1/m²]; 0 for one that cannot be seen: a closed mesh is
    /// seen from outside alone, a sheet from both sides.
    fn density(&self, triangle: u32, from: Point3D, area: f64) -> f64 {
        let [corner, ..] = self.0.data.corners(triangle as usize);
        let height = |normal: Normal3D| normal.dot(corner.vector_to(from));
        let normal = self.0.data.face_normal(triangle as usize);
        let seen = normal.is_some_and(|n| !self.0.closed || height(n) > 0.0);
        // Of so small a mesh the area is no number.
        let density = 1.0 / area;
        if seen && density.is_finite() { density } else { 0.0 }
    }

    /// Walks through the tree with a test made for the kind of triangles that are stored.
    #[inline]
    fn search<R>(&self, ray: &Ray, within: Interval, look: impl Look<Answer = R>) -> Option<R> {
        let shared = &*self.0;
        let tree_ray = shared.tree.prepare(ray, within)?;
        let sheared = ShearedRay::new(ray, tree_ray.start);
        let subject = Subject { tree: &shared.tree, tree_ray: &tree_ray, ray: &sheared, within };
        Some(match &shared.blocks {
            Blocks::Single(blocks) => dispatch!(shared.level, simd => look.look(simd, &subject, blocks)),
            Blocks::Double(blocks) => dispatch!(shared.level, simd => look.look(simd, &subject, blocks)),
        })
    }

    /// The point of a triangle at barycentric coordinates.
    fn point(&self, feature: &Feature) -> Point3D {
        let [a, b, c] = self.0.data.corners(feature.face as usize);
        let [v, w] = feature.uv;
        a + a.vector_to(b) * v + a.vector_to(c) * w
    }

    /// The normal to shade with there, if it is another one than that of the triangle.
    fn shading_normal(&self, feature: &Feature) -> Option<Normal3D> {
        if self.0.smoothing { self.corner_normal(feature).map(Normal3D::from) } else { None }
    }

    fn corner_normal(&self, feature: &Feature) -> Option<Vector3D> {
        let normals = self.0.data.corner_normals(feature.face as usize)?;
        let [v, w] = feature.uv;
        let [a, b, c] = normals.map(Normal3D::as_vector);
        (a * (1.0 - v - w) + b * v + c * w).normalise().ok()
    }
}

/// A ray on its way through a tree.
struct Subject<'a> {
    tree: &'a WideTree,
    tree_ray: &'a TreeRay,
    ray: &'a ShearedRay,
    within: Interval,
}

impl Subject<'_> {
    #[inline(always)]
    fn search<'a, T: Triangles, S: Simd>(&'a self, simd: S, blocks: &'a [T]) -> Search<'a, T, S> {
        Search { tree: self.tree, blocks, ray: self.ray, lanes: RayLanes::new(simd, self.ray) }
    }

    #[inline(always)]
    fn walk<S: Simd>(&self, simd: S, scratch: &mut Scratch, test: &mut impl LeafTest<S>) {
        let limit = self.tree_ray.limit(self.within.max);
        self.tree.walk(simd, self.tree_ray, limit, scratch.stack(), test);
    }
}

/// Something to look for along a ray.
trait Look {
    type Answer;
    fn look<T: Triangles, S: Simd>(self, simd: S, subject: &Subject<'_>, blocks: &[T]) -> Self::Answer;
}

struct LookForNearest<'a>(&'a mut Scratch);

impl Look for LookForNearest<'_> {
    type Answer = Option<Crossing>;

    #[inline(always)]
    fn look<T: Triangles, S: Simd>(self, simd: S, subject: &Subject<'_>, blocks: &[T]) -> Self::Answer {
        let (tree_ray, within) = (subject.tree_ray, subject.within);
        let mut test = Nearest { search: subject.search(simd, blocks), tree_ray, within, best: None };
        subject.walk(simd, self.0, &mut test);
        crossing(subject.ray, blocks, &test.best?)
    }
}

struct LookForAll<'a>(&'a mut Scratch, &'a mut Vec<Crossing>);

impl Look for LookForAll<'_> {
    type Answer = ();

    #[inline(always)]
    fn look<T: Triangles, S: Simd>(self, simd: S, subject: &Subject<'_>, blocks: &[T]) {
        let mut test = All { search: subject.search(simd, blocks), out: self.1 };
        subject.walk(simd, self.0, &mut test);
    }
}

struct LookAfter<'a> {
    scratch: &'a mut Scratch,
    near: &'a mut Vec<Crossing>,
    bound: f64,
}

impl Look for LookAfter<'_> {
    type Answer = Option<Crossing>;

    #[inline(always)]
    fn look<T: Triangles, S: Simd>(self, simd: S, subject: &Subject<'_>, blocks: &[T]) -> Self::Answer {
        let mut test = After {
            search: subject.search(simd, blocks),
            tree_ray: subject.tree_ray,
            bound: self.bound,
            max: subject.within.max,
            near: self.near,
            best: None,
        };
        subject.walk(simd, self.scratch, &mut test);
        crossing(subject.ray, blocks, &test.best?)
    }
}

/// Puts crossings into order; where rounding cannot tell which comes first, entries and exits alternate.
fn arrange(crossings: &mut [Crossing], tolerance: f64, alternate: bool) {
    crossings.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.feature.face.cmp(&b.feature.face)));
    if !alternate {
        return;
    }
    for at in 0..crossings.len() {
        let wanted = at % 2 == 1;
        let here = crossings[at].distance;
        let fitting = crossings[at..]
            .iter()
            .take_while(|c| c.distance - here <= tolerance)
            .position(|c| c.exiting == wanted);
        if let Some(later) = fitting {
            crossings[at..=at + later].rotate_right(1);
        }
    }
    // Places may have been exchanged, but not the order of the distances.
    for at in 1..crossings.len() {
        crossings[at].distance = crossings[at].distance.max(crossings[at - 1].distance);
    }
}

impl Primitive for Mesh {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let data = &self.0.data;
        let mut image = BoundingBox3D::around(
            data.triangles().iter().flatten().map(|&v| m.transform_point(data.vertices()[v as usize])),
        );
        let reach = self.0.tree.bounds();
        let local = reach.lower.max_abs().max(reach.upper.max_abs());
        for axis in 0..3 {
            let row = (0..3).map(|j| m.get(axis, j).abs()).sum::<f64>();
            image.pad_axis(axis, 8.0 * f64::EPSILON * (row * local + m.origin()[axis].abs()));
        }
        image
    }

    fn contains(&self, point: Point3D) -> bool {
        if !self.0.closed || !self.0.tree.bounds().contains(point) {
            return false;
        }
        // The next surface in some direction is left if the point is inside.
        let ray = Ray::new(point, Vector3D::new(0.537_299, 0.274_653, 0.797_427));
        self.hit(&ray, Interval::AHEAD, &mut Scratch::default())
            .is_some_and(|c| c.exiting || c.distance == 0.0)
    }

    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        let line = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        let before = out.len();
        self.search(ray, line, LookForAll(scratch, out));
        let found = &mut out[before..];
        let reach = self.0.tree.bounds().largest_extent() / ray.direction.length();
        arrange(found, 64.0 * f64::EPSILON * reach, self.0.closed);
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        self.search(ray, within, LookForNearest(scratch)).flatten()
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max: f64, scratch: &mut Scratch) -> Option<Crossing> {
        let mut near = scratch.take();
        let within = Interval::new(-left.bound, max.max(left.bound));
        let look = LookAfter { scratch, near: &mut near, bound: left.bound };
        let beyond = self.search(ray, within, look).flatten().filter(|c| c.distance <= max);
        // Of the crossings at the place of departure one is being left: the nearest of its kind. In a closed mesh
        // entries and exits alternate; a sheet is known by its triangle.
        near.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let closed = self.0.closed;
        let is_left =
            |c: &Crossing| if closed { c.exiting != left.inward } else { c.feature == left.feature };
        let known = near
            .iter()
            .enumerate()
            .filter(|(_, c)| is_left(c))
            .min_by(|a, b| a.1.distance.abs().total_cmp(&b.1.distance.abs()))
            .map(|(index, _)| index);
        let next = match known {
            Some(index) => near[index + 1..].iter().copied().find(|c| !closed || c.exiting == left.inward),
            None if closed => near.iter().copied().find(|c| c.exiting == left.inward),
            // Of a sheet that is left by its edge the neighbour answers.
            None => None,
        };
        let next = next.map(|c| Crossing { distance: c.distance.max(0.0), ..c });
        let next = next.filter(|c| c.distance <= max).or(beyond);
        // What has gone in comes out before it goes in again. If the line of the rounded origin passes by an edge instead,
        // inside and outside meet there, and the way ends where it begins.
        let skipped = closed && next.is_some_and(|c| c.exiting != left.inward);
        let passed_by = || {
            let others = near.iter().filter(|c| c.exiting == left.inward);
            let feature =
                others.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs())).map(|c| c.feature);
            Crossing { distance: 0.0, feature: feature.unwrap_or(left.feature), exiting: left.inward }
        };
        let next = if skipped { Some(passed_by()) } else { next };
        scratch.give_back(near);
        next
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let triangle = crossing.feature.face as usize;
        let data = &self.0.data;
        let [a, b, c] = data.corners(triangle);
        let towards_viewer = || {
            // A triangle without area is met by no ray; whatever may come here faces the ray.
            Normal3D::from(-ray.direction.normalise_unchecked())
        };
        let normal = data.face_normal(triangle).unwrap_or_else(towards_viewer);
        let size = a.max_abs().max(b.max_abs()).max(c.max_abs());
        Surface {
            point: self.point(&crossing.feature),
            normal,
            shading_normal: self.shading_normal(&crossing.feature).unwrap_or(normal),
            bound: 16.0 * f64::EPSILON * size,
        }
    }

    fn is_solid(&self) -> bool {
        self.0.closed
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    /// Uniform over all of the area that may face `from`; what faces away nevertheless gives nothing.
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let (face, uv, area) = self.areas().draw(from, !self.0.closed, u)?;
        let feature = Feature { face, uv, ..Feature::default() };
        let point = self.point(&feature);
        let density = self.density(face, from, area);
        let normal = self.0.data.face_normal(face as usize)?;
        let shading_normal = self.shading_normal(&feature);
        (density > 0.0).then_some(SurfaceSample { point, normal, shading_normal, feature, density })
    }

    fn surface_density(&self, from: Point3D, _: Point3D, feature: Feature) -> f64 {
        self.density(feature.face, from, self.areas().seen_from(from, !self.0.closed))
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let data = &self.0.data;
        let coordinates: Vec<f64> = data.vertices().iter().flat_map(|p| p.to_array()).collect();
        let numbers =
            |indices: &[[u32; 3]]| -> Vec<f64> { indices.iter().flatten().map(|&i| f64::from(i)).collect() };
        let saved = Saved::new("Mesh")
            .numbers("vertices", &coordinates)
            .numbers("triangles", &numbers(data.triangles()))
            .flag("smoothing", self.0.smoothing)
            .flag("closed", self.0.closed);
        Ok(match (data.vertex_normals(), data.normal_indices()) {
            (Some(normals), Some(indices)) => {
                let components: Vec<f64> = normals.iter().flat_map(|n| n.to_array()).collect();
                saved.numbers("normals", &components).numbers("normal_indices", &numbers(indices))
            }
            _ => saved,
        })
    }
}

#[cfg(test)]
#[path = "mesh_tests.rs"]
mod tests;
