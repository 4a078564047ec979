mod faces;

use faces::Faces;
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface, SurfaceSample,
    SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use crate::PrimitiveError;

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
    lower: Point3D,
    upper: Point3D,
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

/// Where a line runs through the slabs of a cuboid, and by which faces it comes and goes.
struct Passage {
    near: f64,
    far: f64,
    entry: u32,
    exit: u32,
}

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
        Self { lower, upper, sheet, centre, areas, near: longest * longest }
    }

    /// Of given extents along the axes, centred on the origin [m].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn centred(x: f64, y: f64, z: f64) -> Result<Self, PrimitiveError> {
        Self::new(Point3D::new(-0.5 * x, -0.5 * y, -0.5 * z), Point3D::new(0.5 * x, 0.5 * y, 0.5 * z))
    }

    /// The corner of least coordinates [m].
    pub fn lower(&self) -> Point3D {
        self.lower
    }

    /// The corner of greatest coordinates [m].
    pub fn upper(&self) -> Point3D {
        self.upper
    }

    /// True if one extent is zero.
    pub fn is_sheet(&self) -> bool {
        self.sheet.is_some()
    }

    /// The outward unit normal of a face.
    #[inline]
    fn normal(axis: usize, upper: bool) -> Normal3D {
        let sign = if upper { 1.0 } else { -1.0 };
        match axis {
            0 => Normal3D::new(sign, 0.0, 0.0),
            1 => Normal3D::new(0.0, sign, 0.0),
            _ => Normal3D::new(0.0, 0.0, sign),
        }
    }

    /// The common interval of the three slabs, possibly empty (`near > far`); none if the ray runs beside a slab.
    #[inline]
    fn passage(&self, ray: &Ray) -> Option<Passage> {
        let p = Passage { near: f64::NEG_INFINITY, far: f64::INFINITY, entry: 0, exit: 0 };
        let (o, d, low, high) = (ray.origin, ray.direction, self.lower, self.upper);
        let p = self.clip(p, 0, [o.x, d.x, low.x, high.x])?;
        let p = self.clip(p, 1, [o.y, d.y, low.y, high.y])?;
        self.clip(p, 2, [o.z, d.z, low.z, high.z])
    }

    /// What is left of a passage between the faces `low` and `high` across an axis.
    #[inline(always)]
    fn clip(&self, p: Passage, axis: usize, [o, d, low, high]: [f64; 4]) -> Option<Passage> {
        if d == 0.0 {
            let beside = o < low || o > high || self.sheet == Some(axis);
            return (!beside).then_some(p);
        }
        // Selections and no branches: which way lines run cannot be foretold.
        let forward = d > 0.0;
        let (nearer, farther) = if forward { (low, high) } else { (high, low) };
        let (first, last) = ((nearer - o) / d, (farther - o) / d);
        let (later, sooner) = (first > p.near, last < p.far);
        Some(Passage {
            near: if later { first } else { p.near },
            entry: if later { face_number(axis, !forward) } else { p.entry },
            far: if sooner { last } else { p.far },
            exit: if sooner { face_number(axis, forward) } else { p.exit },
        })
    }

    fn crossing(distance: f64, face: u32, exiting: bool) -> Crossing {
        Crossing { distance, feature: Feature { face, ..Feature::default() }, exiting }
    }

    /// A sheet is crossed once, and always by the face that looks at the ray.
    #[inline]
    fn sheet_crossing(&self, axis: usize, ray: &Ray) -> Option<Crossing> {
        let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
        if d[axis] == 0.0 {
            return None;
        }
        let t = (self.lower.to_array()[axis] - o[axis]) / d[axis];
        let (x, y, z) = (o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]);
        let (low, high) = (self.lower, self.upper);
        // The coordinate across the sheet is met by construction, whatever rounding makes of it here.
        let within = (axis == 0 || (x >= low.x && x <= high.x))
            && (axis == 1 || (y >= low.y && y <= high.y))
            && (axis == 2 || (z >= low.z && z <= high.z));
        within.then(|| Self::crossing(t, face_number(axis, d[axis] < 0.0), false))
    }
}

impl Primitive for Cuboid {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        BoundingBox3D { lower: self.lower, upper: self.upper }.transformed(m)
    }

    fn contains(&self, point: Point3D) -> bool {
        self.sheet.is_none() && (0..3).all(|a| point[a] >= self.lower[a] && point[a] <= self.upper[a])
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        if let Some(axis) = self.sheet {
            out.extend(self.sheet_crossing(axis, ray));
        } else if let Some(p) = self.passage(ray).filter(|p| p.near <= p.far) {
            out.extend([Self::crossing(p.near, p.entry, false), Self::crossing(p.far, p.exit, true)]);
        }
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        if let Some(axis) = self.sheet {
            return self.sheet_crossing(axis, ray).filter(|c| within.contains(c.distance));
        }
        let p = self.passage(ray).filter(|p| p.near <= p.far)?;
        if within.contains(p.near) {
            return Some(Self::crossing(p.near, p.entry, false));
        }
        within.contains(p.far).then(|| Self::crossing(p.far, p.exit, true))
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        if !left.inward || self.sheet.is_some() {
            return None;
        }
        // A ray that goes inward has entered: it leaves by the nearest far side, however rounding has placed it.
        let p = self.passage(ray)?;
        let far = p.far.max(0.0);
        (far <= max_distance).then(|| Self::crossing(far, p.exit, true))
    }

    #[inline]
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let (axis, upper) = ((crossing.feature.face / 2) as usize, crossing.feature.face % 2 == 1);
        let (low, high) = (self.lower, self.upper);
        let p = ray.point_at(crossing.distance);
        let mut point = [p.x.clamp(low.x, high.x), p.y.clamp(low.y, high.y), p.z.clamp(low.z, high.z)];
        point[axis % 3] = if upper { high.to_array()[axis % 3] } else { low.to_array()[axis % 3] };
        let normal = Self::normal(axis, upper);
        // The point lies in the plane of the face exactly.
        Surface { point: point.into(), normal, shading_normal: normal, bound: 0.0 }
    }

    fn is_solid(&self) -> bool {
        self.sheet.is_none()
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("Cuboid").numbers("lower", &self.lower.to_array());
        Ok(saved.numbers("upper", &self.upper.to_array()))
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
