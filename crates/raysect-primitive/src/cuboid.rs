mod faces;

use faces::Faces;
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface, SurfaceSample,
    SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use crate::PrimitiveError;
use crate::chord::Chord;
use crate::select::{larger, smaller};

/// A box with its edges along the axes.
///
/// With one extent of zero it is a two-sided sheet: it is hit from both sides, contains nothing, and is the thin
/// wall of many a scene.
///
/// ```
/// use raysect_math::Point3D;
/// use raysect_primitive::Cuboid;
/// let wall = Cuboid::new(Point3D::new(-1.0, -1.0, 0.0), Point3D::new(1.0, 1.0, 0.0))?;
/// assert!(wall.is_sheet());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[doc(alias = "Box")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// Of least and of greatest coordinates [m].
    corners: [Point3D; 2],
    /// The lower, the upper and again the lower coordinate of each axis: the first two in the order in which a line
    /// meets them that goes up, the last two for one that goes down [m].
    planes: [[f64; 3]; 3],
    sheet: Option<usize>,
    centre: [f64; 3],
    /// Of a face across each axis [m²].
    areas: [f64; 3],
    /// Square of the distance within which it is near, for what samples it as a lamp [m²].
    near: f64,
}

impl Default for Cuboid {
    /// From −0.5 m to 0.5 m along every axis.
    fn default() -> Self {
        Self::of(Point3D::new(-0.5, -0.5, -0.5), Point3D::new(0.5, 0.5, 0.5), None)
    }
}

/// Outward unit normals of the faces.
const NORMALS: [Normal3D; 6] = [
    Normal3D::new(-1.0, 0.0, 0.0),
    Normal3D::new(1.0, 0.0, 0.0),
    Normal3D::new(0.0, -1.0, 0.0),
    Normal3D::new(0.0, 1.0, 0.0),
    Normal3D::new(0.0, 0.0, -1.0),
    Normal3D::new(0.0, 0.0, 1.0),
];

/// Number of a face: twice the axis, plus one for the upper side.
#[inline]
fn face_number(axis: usize, upper: bool) -> u32 {
    2 * axis as u32 + u32::from(upper)
}

impl Cuboid {
    /// From its corners of least and greatest coordinates [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Corners`] if a coordinate is not finite, `lower` exceeds `upper`, or more than one extent
    /// is zero.
    pub fn new(lower: Point3D, upper: Point3D) -> Result<Self, PrimitiveError> {
        let wrong =
            |what| Err(PrimitiveError::Corners { lower: lower.to_array(), upper: upper.to_array(), what });
        if !lower.is_finite() || !upper.is_finite() || !lower.vector_to(upper).is_finite() {
            return wrong("coordinates and extents must be finite");
        }
        if (0..3).any(|a| lower[a] > upper[a]) {
            return wrong("the lower corner lies above the upper one");
        }
        let mut flat = (0..3).filter(|&a| lower[a] == upper[a]);
        let sheet = flat.next();
        if flat.next().is_some() {
            return wrong("two extents of zero leave no surface");
        }
        Ok(Self::of(lower, upper, sheet))
    }

    fn of(lower: Point3D, upper: Point3D, sheet: Option<usize>) -> Self {
        let extent = lower.vector_to(upper);
        let centre = [0, 1, 2].map(|a| 0.5 * lower[a] + 0.5 * upper[a]);
        let areas = [extent.y * extent.z, extent.z * extent.x, extent.x * extent.y];
        let longest = faces::NEAR * extent.max_abs();
        let planes = [0, 1, 2].map(|a| [lower[a], upper[a], lower[a]]);
        Self { corners: [lower, upper], planes, sheet, centre, areas, near: longest * longest }
    }

    /// Of given extents along the axes, centred on the origin [m].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn centred(x: f64, y: f64, z: f64) -> Result<Self, PrimitiveError> {
        Self::new(Point3D::new(-0.5 * x, -0.5 * y, -0.5 * z), Point3D::new(0.5 * x, 0.5 * y, 0.5 * z))
    }

    /// The corner of least coordinates [m].
    #[inline]
    pub fn lower(&self) -> Point3D {
        self.corners[0]
    }

    /// The corner of greatest coordinates [m].
    #[inline]
    pub fn upper(&self) -> Point3D {
        self.corners[1]
    }

    /// True if one extent is zero.
    pub fn is_sheet(&self) -> bool {
        self.sheet.is_some()
    }

    /// The outward unit normal of a face.
    #[inline]
    fn normal(axis: usize, upper: bool) -> Normal3D {
        NORMALS[(face_number(axis, upper) % 6) as usize]
    }

    /// How deep a point lies within [m], negative outside: the surface is at least so far away.
    #[inline]
    pub(crate) fn depth(&self, p: Point3D) -> f64 {
        let (low, high) = (self.lower(), self.upper());
        let between = |axis: usize| smaller(p[axis] - low[axis], high[axis] - p[axis]);
        smaller(smaller(between(0), between(1)), between(2))
    }

    /// What of a line is within a cuboid that is no sheet.
    #[inline]
    pub(crate) fn chord(&self, ray: &Ray) -> Option<Chord> {
        self.passage(ray).filter(|p| p.near <= p.far)
    }

    /// The common interval of the three slabs, possibly empty (`near > far`); none if the ray runs beside a slab.
    ///
    /// The slabs do not wait for each other, and look-ups and selections take the place of branches: which way lines run
    /// cannot be foretold. Of faces at equal distance that of the first axis counts.
    #[inline]
    fn passage(&self, ray: &Ray) -> Option<Chord> {
        let (o, d) = (ray.origin, ray.direction);
        let (near_x, far_x) = Self::within_slab(o.x, d.x, &self.planes[0])?;
        let (near_y, far_y) = Self::within_slab(o.y, d.y, &self.planes[1])?;
        let (near_z, far_z) = Self::within_slab(o.z, d.z, &self.planes[2])?;
        let (near_xy, far_xy) = (larger(near_x, near_y), smaller(far_x, far_y));
        let axis = |y: bool, z: bool| (2 * u32::from(z)).max(u32::from(y));
        let (came, goes) = (axis(near_y > near_x, near_z > near_xy), axis(far_y < far_x, far_z < far_xy));
        let backward = u32::from(d.x < 0.0) | (u32::from(d.y < 0.0) << 1) | (u32::from(d.z < 0.0) << 2);
        Some(Chord {
            near: larger(near_xy, near_z),
            far: smaller(far_xy, far_z),
            entry: 2 * came + ((backward >> came) & 1),
            exit: 2 * goes + (!(backward >> goes) & 1),
        })
    }

    /// Where a line is between two coordinates of an axis.
    #[inline(always)]
    fn within_slab(o: f64, d: f64, planes: &[f64; 3]) -> Option<(f64, f64)> {
        if d == 0.0 {
            return (o >= planes[0] && o <= planes[1]).then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        let first = usize::from(d < 0.0);
        Some(((planes[first] - o) / d, (planes[first + 1] - o) / d))
    }

    /// A sheet is crossed once, and always by the face that looks at the ray.
    #[inline]
    fn sheet_crossing(&self, axis: usize, ray: &Ray) -> Option<Crossing> {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        if d[axis] == 0.0 {
            return None;
        }
        let t = (self.lower().to_array()[axis] - o[axis]) / d[axis];
        let (x, y, z) = (o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]);
        let (low, high) = (self.lower(), self.upper());
        // The coordinate across the sheet is met by construction, whatever rounding makes of it here.
        let within = (axis == 0 || (x >= low.x && x <= high.x))
            && (axis == 1 || (y >= low.y && y <= high.y))
            && (axis == 2 || (z >= low.z && z <= high.z));
        within.then(|| Chord::crossing(t, face_number(axis, d[axis] < 0.0), false))
    }
}

impl Primitive for Cuboid {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        BoundingBox3D { lower: self.lower(), upper: self.upper() }.transformed(m)
    }

    fn contains(&self, point: Point3D) -> bool {
        self.sheet.is_none() && (0..3).all(|a| point[a] >= self.lower()[a] && point[a] <= self.upper()[a])
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        if let Some(axis) = self.sheet {
            out.extend(self.sheet_crossing(axis, ray));
        } else {
            out.extend(self.chord(ray).iter().flat_map(Chord::crossings));
        }
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        if let Some(axis) = self.sheet {
            return self.sheet_crossing(axis, ray).filter(|c| within.contains(c.distance));
        }
        self.chord(ray)?.first(within)
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        if !left.inward || self.sheet.is_some() {
            return None;
        }
        // A ray that goes inward has entered: it leaves by the nearest far side, however rounding has placed it.
        let p = self.passage(ray)?;
        let far = p.far.max(0.0);
        (far <= max_distance).then(|| Chord::crossing(far, p.exit, true))
    }

    #[inline]
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let face = crossing.feature.face % 6;
        let p = ray.point_at(crossing.distance);
        // Between corners, which are one on the face itself. They are looked up: which face is met cannot be foretold.
        let between = |axis: usize, p: f64| {
            let [on_lower, on_upper] = [face == face_number(axis, false), face == face_number(axis, true)];
            let (low, high) =
                (self.corners[usize::from(on_upper)][axis], self.corners[usize::from(!on_lower)][axis]);
            smaller(larger(low, p), high)
        };
        let point = Point3D::new(between(0, p.x), between(1, p.y), between(2, p.z));
        let normal = NORMALS[face as usize];
        // The point lies in the plane of the face exactly.
        Surface { point, normal, shading_normal: normal, bound: 0.0 }
    }

    fn is_solid(&self) -> bool {
        self.sheet.is_none()
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("Cuboid").numbers("lower", &self.lower().to_array());
        Ok(saved.numbers("upper", &self.upper().to_array()))
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let place = Faces::of(self, from).sample(self, from, u)?;
        let feature = Feature { face: face_number(place.axis, place.upper), ..Feature::default() };
        let normal = Self::normal(place.axis, place.upper);
        Some(SurfaceSample {
            point: place.point,
            normal,
            shading_normal: None,
            feature,
            density: place.density,
        })
    }

    fn surface_density(&self, from: Point3D, point: Point3D, feature: Feature) -> f64 {
        let (axis, upper) = ((feature.face / 2) as usize, feature.face % 2 == 1);
        Faces::of(self, from).density(self, from, point, axis, upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_core::testing::check_primitive;
    use raysect_math::Vector3D;

    fn first(c: &Cuboid, o: [f64; 3], d: [f64; 3]) -> Option<f64> {
        let ray = Ray::new(o.into(), d.into());
        c.hit(&ray, Interval::AHEAD, &mut Scratch::default()).map(|h| h.distance)
    }

    #[test]
    fn keeps_the_contract() {
        for scale in [1e-9, 1.0, 1e9] {
            let c = Cuboid::new(
                Point3D::new(-0.2 * scale, 0.1 * scale, 0.0),
                Point3D::new(scale, 0.3 * scale, 2.0 * scale),
            );
            check_primitive(&c.unwrap(), 4000, 2).unwrap();
        }
        check_primitive(&Cuboid::default(), 4000, 3).unwrap();
        check_primitive(&Cuboid::centred(1.0, 0.0, 2.0).unwrap(), 4000, 4).unwrap();
    }

    #[test]
    fn rays_along_faces_and_edges_hit() {
        let c = Cuboid::centred(2.0, 2.0, 2.0).unwrap();
        assert_eq!(first(&c, [1.0, 0.0, -5.0], [0.0, 0.0, 1.0]), Some(4.0));
        assert_eq!(first(&c, [1.0, 1.0, -5.0], [-0.0, 0.0, 1.0]), Some(4.0));
        assert_eq!(first(&c, [1.0, 1.0, -5.0], [-1e-310, 0.0, 1.0]), Some(4.0));
        assert_eq!(first(&c, [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]), Some(1.0));
        assert_eq!(first(&c, [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]), None);
    }

    #[test]
    fn a_sheet_has_two_sides_and_no_inside() {
        let sheet = Cuboid::centred(2.0, 2.0, 0.0).unwrap();
        for z in [-3.0, 3.0] {
            let ray = Ray::new(Point3D::new(0.5, 0.5, z), Vector3D::new(0.0, 0.0, -z));
            let mut all = Vec::new();
            sheet.crossings(&ray, &mut Scratch::default(), &mut all);
            assert_eq!((all.len(), all[0].distance, all[0].exiting), (1, 1.0, false));
            assert!(sheet.surface(&ray, &all[0]).normal.dot(ray.direction) < 0.0);
        }
        assert!(!sheet.contains(Point3D::ORIGIN) && !sheet.is_solid());
        assert_eq!(first(&sheet, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn impossible_corners_are_refused() {
        let o = Point3D::ORIGIN;
        for upper in [[-1.0, 1.0, 1.0], [0.0, 0.0, 1.0], [f64::NAN, 1.0, 1.0], [f64::INFINITY, 1.0, 1.0]] {
            assert!(Cuboid::new(o, upper.into()).is_err(), "{upper:?}");
        }
    }

    #[test]
    fn nothing_is_chosen_from_inside() {
        let c = Cuboid::default();
        assert!(c.sample_surface(Point3D::ORIGIN, [0.5; 3]).is_none());
    }
}
