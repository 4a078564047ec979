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
}

impl Default for Cuboid {
    /// From −0.5 m to 0.5 m along every axis.
    fn default() -> Self {
        Self { lower: Point3D::new(-0.5, -0.5, -0.5), upper: Point3D::new(0.5, 0.5, 0.5), sheet: None }
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
        Ok(Self { lower, upper, sheet })
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

    /// The common interval of the three slabs, possibly empty (`near > far`); none if the ray runs beside a slab.
    #[inline]
    fn passage(&self, ray: &Ray) -> Option<Passage> {
        let mut p = Passage { near: f64::NEG_INFINITY, far: f64::INFINITY, entry: 0, exit: 0 };
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let (low, high) = (self.lower[axis], self.upper[axis]);
            if d == 0.0 {
                if o < low || o > high || self.sheet == Some(axis) {
                    return None;
                }
                continue;
            }
            let forward = d > 0.0;
            let (first, last) =
                if forward { ((low - o) / d, (high - o) / d) } else { ((high - o) / d, (low - o) / d) };
            if first > p.near {
                (p.near, p.entry) = (first, face_number(axis, !forward));
            }
            if last < p.far {
                (p.far, p.exit) = (last, face_number(axis, forward));
            }
        }
        Some(p)
    }

    fn crossing(distance: f64, face: u32, exiting: bool) -> Crossing {
        Crossing { distance, feature: Feature { face, ..Feature::default() }, exiting }
    }

    /// A sheet is crossed once, and always by the face that looks at the ray.
    fn sheet_crossing(&self, axis: usize, ray: &Ray) -> Option<Crossing> {
        let p = self.passage(ray).filter(|p| p.near <= p.far)?;
        // The line meets the plane of the sheet within the other two slabs, so that is where it is hit.
        let t = (self.lower[axis] - ray.origin[axis]) / ray.direction[axis];
        (t >= p.near && t <= p.far)
            .then(|| Self::crossing(t, face_number(axis, ray.direction[axis] < 0.0), false))
    }

    /// Area [m²] and centre [m] of a face.
    fn face(&self, axis: usize, upper: bool) -> (f64, Point3D) {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let area = (self.upper[a] - self.lower[a]) * (self.upper[b] - self.lower[b]);
        let mut centre = Point3D::ORIGIN;
        for i in 0..3 {
            centre[i] = 0.5 * self.lower[i] + 0.5 * self.upper[i];
        }
        centre[axis] = if upper { self.upper[axis] } else { self.lower[axis] };
        (area, centre)
    }

    /// The face across each axis that is visible from a point, with the weight of its choice: the solid angle
    /// that it would subtend if it were small.
    fn visible(&self, from: Point3D) -> [(f64, bool); 3] {
        std::array::from_fn(|axis| {
            let upper = from[axis] > self.upper[axis];
            if !upper && from[axis] >= self.lower[axis] {
                return (0.0, upper);
            }
            let (area, centre) = self.face(axis, upper);
            let distance = from.distance_to(centre);
            (area * (from[axis] - centre[axis]).abs() / (distance * distance * distance), upper)
        })
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
        let mut point = ray.point_at(crossing.distance);
        for a in 0..3 {
            point[a] = point[a].clamp(self.lower[a], self.upper[a]);
        }
        point[axis] = if upper { self.upper[axis] } else { self.lower[axis] };
        let sign = if upper { 1.0 } else { -1.0 };
        let normal = match axis {
            0 => Normal3D::new(sign, 0.0, 0.0),
            1 => Normal3D::new(0.0, sign, 0.0),
            _ => Normal3D::new(0.0, 0.0, sign),
        };
        // The point lies in the plane of the face exactly.
        Surface { point, normal, shading_normal: normal, bound: 0.0 }
    }

    fn is_solid(&self) -> bool {
        self.sheet.is_none()
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let faces = self.visible(from);
        let total: f64 = faces.iter().map(|f| f.0).sum();
        let mut rest = u[0] * total;
        let chosen = (0..3).filter(|&a| faces[a].0 > 0.0).find(|&a| {
            rest -= faces[a].0;
            rest <= 0.0
        });
        let axis = chosen.or_else(|| (0..3).rfind(|&a| faces[a].0 > 0.0))?;
        let (weight, upper) = faces[axis];
        let (area, mut point) = self.face(axis, upper);
        for (i, u) in [((axis + 1) % 3, u[1]), ((axis + 2) % 3, u[2])] {
            point[i] = self.lower[i] + u * (self.upper[i] - self.lower[i]);
        }
        let sign = if upper { 1.0 } else { -1.0 };
        let normal = Normal3D::new(
            if axis == 0 { sign } else { 0.0 },
            if axis == 1 { sign } else { 0.0 },
            if axis == 2 { sign } else { 0.0 },
        );
        Some(SurfaceSample { point, normal, density: weight / total / area })
    }

    fn surface_density(&self, from: Point3D, _: Point3D, feature: Feature) -> f64 {
        let (axis, upper) = ((feature.face / 2) as usize, feature.face % 2 == 1);
        let faces = self.visible(from);
        let total: f64 = faces.iter().map(|f| f.0).sum();
        let (weight, visible_side) = faces[axis];
        if weight == 0.0 || upper != visible_side {
            return 0.0;
        }
        weight / total / self.face(axis, upper).0
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
