use std::f64::consts::TAU;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch,
    Surface, SurfaceSample, SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use crate::PrimitiveError;
use crate::chord::Chord;
use crate::revolution::{
    LOWER, Passage, SIDE, UPPER, ball_about_axis, chances, check_length, choose, disk_area, disk_reach,
    face_of, half_arc, piece_weight, rounded_box, sample_disk, turned,
};
use crate::select::{larger, smaller};
use crate::unit;

/// A cylinder about the z axis with flat ends at z = 0 and z = height.
///
/// Faces: 0 the side, 1 the end at z = 0, 2 the end at z = height.
///
/// ```
/// use raysect_core::{Interval, Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_primitive::Cylinder;
///
/// let rod = Cylinder::new(0.5, 3.0)?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, 5.0), -Vector3D::Z);
/// let hit = rod.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap();
/// assert_eq!((hit.distance, hit.feature.face), (2.0, 2));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    radius: f64,
    height: f64,
    /// One over the radius [1/m].
    inverse: f64,
    /// Heights of both ends [m].
    ends: [f64; 2],
}

/// What the faces differ in. It is looked up: which face is met cannot be foretold.
#[derive(Clone, Copy)]
struct Face {
    /// The ends between which it lies.
    lower: usize,
    upper: usize,
    /// 1 if its normal is across the axis, 0 if it is along it.
    across: f64,
    /// The component of its normal along the axis.
    up: f64,
    /// The least square of a distance from the axis, in radii, at which a point is on the face but for rounding.
    least: f64,
    /// The most by which a point is moved away from the axis.
    most: f64,
}

const FACES: [Face; 4] = {
    let side =
        Face { lower: 0, upper: 1, across: 1.0, up: 0.0, least: 1.0 - unit::NEAR, most: f64::INFINITY };
    let end = Face { lower: 0, upper: 0, across: 0.0, up: -1.0, least: 0.0, most: 1.0 };
    [side, end, Face { lower: 1, upper: 1, up: 1.0, ..end }, side]
};

impl Default for Cylinder {
    /// Radius 0.5 m, height 1 m.
    fn default() -> Self {
        Self::of(0.5, 1.0)
    }
}

/// Directions across the axis shorter than this are scaled up before they are squared.
const SHORT: f64 = 1e-140;
/// The factor by which they are scaled, 2⁶⁰⁰.
const STRETCH: f64 = f64::from_bits((1023 + 600) << 52);

impl Cylinder {
    /// Of a radius [m] and a height [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless both lie in 1e-100 … 1e100 m.
    pub fn new(radius: f64, height: f64) -> Result<Self, PrimitiveError> {
        check_length("cylinder", "radius", radius)?;
        check_length("cylinder", "height", height)?;
        Ok(Self::of(radius, height))
    }

    fn of(radius: f64, height: f64) -> Self {
        Self { radius, height, inverse: 1.0 / radius, ends: [0.0, height] }
    }

    /// The radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The height [m].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Volume, π r² h [m³].
    pub fn volume(&self) -> f64 {
        disk_area(self.radius) * self.height
    }

    /// Area of the side and both ends, 2 π r (r + h) [m²].
    pub fn surface_area(&self) -> f64 {
        TAU * self.radius * (self.radius + self.height)
    }

    #[inline]
    fn passage(&self, ray: &Ray) -> Passage {
        self.between_ends(self.side(ray), ray)
    }

    /// How deep a point lies within [m], negative outside: the surface is at least so far away.
    #[inline]
    pub(crate) fn depth(&self, p: Point3D) -> f64 {
        let ends = smaller(p.z, self.height - p.z);
        smaller(ends, self.radius - (p.x * p.x + p.y * p.y).sqrt())
    }

    /// What of a line is within.
    #[inline]
    pub(crate) fn chord(&self, ray: &Ray) -> Option<Chord> {
        self.between_ends(self.side(ray).that_meets()?, ray).chord()
    }

    #[inline]
    fn between_ends(&self, side: Passage, ray: &Ray) -> Passage {
        side.between_ends(self.height, ray)
    }

    /// Within the endless cylinder: a chord of a circle in the projection along the axis, symmetrical about the place
    /// of closest approach. Half its length comes from the moment about the axis, whose error does not grow with the
    /// distance along the line (E. Haines, J. Günther, T. Akenine-Möller, *Precision Improvements for Ray/Sphere
    /// Intersection*, Ray Tracing Gems, ch. 7).
    #[inline]
    fn side(&self, ray: &Ray) -> Passage {
        let (o, d) = (ray.origin, ray.direction);
        let squared = d.x * d.x + d.y * d.y;
        // With radii of 1e-100 … 1e100 m no product below can leave the range of numbers.
        if !(1e-80..=1e80).contains(&squared) {
            return self.scaled_side(ray);
        }
        let inverse = 1.0 / squared;
        let along = o.x * d.x + o.y * d.y;
        let moment = o.x * d.y - o.y * d.x;
        let discriminant = self.radius * self.radius * squared - moment * moment;
        let half = discriminant.max(0.0).sqrt();
        Passage::within_side((-along - half) * inverse, (half - along) * inverse, discriminant < 0.0)
    }

    /// For directions that are very short or very long across the axis.
    #[cold]
    fn scaled_side(&self, ray: &Ray) -> Passage {
        let (o, d) = (ray.origin, ray.direction);
        let longer = d.x.abs().max(d.y.abs());
        if longer < SHORT {
            return self.steep_side(ray, longer);
        }
        self.across(o, d.x, d.y, 1.0)
    }

    /// For lines that are all but parallel to the axis.
    fn steep_side(&self, ray: &Ray, longer: f64) -> Passage {
        let (o, d) = (ray.origin, ray.direction);
        if longer == 0.0 {
            let outside = (o.x * o.x + o.y * o.y).sqrt() > self.radius;
            return Passage::within_side(f64::NEG_INFINITY, f64::INFINITY, outside);
        }
        self.across(o, d.x * STRETCH, d.y * STRETCH, STRETCH)
    }

    /// The direction across the axis is made a unit vector first.
    fn across(&self, o: Point3D, dx: f64, dy: f64, stretch: f64) -> Passage {
        let inverse = 1.0 / (dx * dx + dy * dy).sqrt();
        let (dx, dy) = (dx * inverse, dy * inverse);
        let along = o.x * dx + o.y * dy;
        let miss = (o.x * dy - o.y * dx).abs();
        let squared = (self.radius - miss) * (self.radius + miss);
        let half = squared.max(0.0).sqrt();
        // One factor after the other: their product may overflow where the result does not.
        let distance = |across: f64| across * inverse * stretch;
        Passage::within_side(distance(-along - half), distance(half - along), squared < 0.0)
    }

    /// A point of any distance from the axis, moved onto the side.
    #[cold]
    fn onto_side(&self, x: f64, y: f64) -> (f64, f64) {
        let rho = (x * x + y * y).sqrt();
        if rho > 0.0 { (x / rho * self.radius, y / rho * self.radius) } else { (self.radius, 0.0) }
    }

    /// The probability with which each face is chosen by light sampling, and half the arc of the side that is seen.
    fn seen(&self, from: Point3D) -> ([f64; 3], f64) {
        let (r, h) = (self.radius, self.height);
        let away = from.x.hypot(from.y);
        let arc = half_arc(r, away);
        let side = if arc > 0.0 { piece_weight(2.0 * r * h, away - r, from.z - 0.5 * h) } else { 0.0 };
        let end = |height| piece_weight(disk_area(r), height, away);
        (chances([side, end(-from.z), end(from.z - h)]), arc)
    }
}

impl Primitive for Cylinder {
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Cylinder").number("radius", self.radius).number("height", self.height))
    }

    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        rounded_box(m, |axis| {
            let (reach, tip) = (self.radius * disk_reach(m, axis), self.height * m.get(axis, 2));
            (tip.min(0.0) - reach, tip.max(0.0) + reach)
        })
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                let half = 0.5 * self.height;
                ball_about_axis(m, scale, half, self.radius.hypot(half))
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, p: Point3D) -> bool {
        p.z >= 0.0 && p.z <= self.height && (p.x * p.x + p.y * p.y).sqrt() <= self.radius
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        out.extend(self.chord(ray).iter().flat_map(Chord::crossings));
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        self.between_ends(self.side(ray).that_meets()?, ray).first(within)
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        if !left.inward {
            return None;
        }
        self.passage(ray).exit_ahead(max_distance)
    }

    #[inline]
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let p = ray.point_at(crossing.distance);
        let face = crossing.feature.face as usize % FACES.len();
        let Face { lower, upper, across, up, least, most } = FACES[face];
        let (mut x, mut y) = (p.x, p.y);
        let (mut nx, mut ny) = (x * self.inverse, y * self.inverse);
        let mut squared = nx * nx + ny * ny;
        if squared < least || squared > 1.0 + unit::NEAR {
            (x, y) = self.onto_side(x, y);
            (nx, ny, squared) = (x * self.inverse, y * self.inverse, 1.0);
        }
        // Onto the side, or onto an end if it lies beside.
        let stretch = smaller(unit::stretch(squared), most);
        let (low, high) = (self.ends[lower], self.ends[upper]);
        let part = stretch * across;
        // The sum has no negative zero.
        let normal = Normal3D::new(nx * part + 0.0, ny * part + 0.0, up);
        Surface {
            point: Point3D::new(x * stretch, y * stretch, smaller(larger(low, p.z), high)),
            normal,
            shading_normal: normal,
            bound: 4.0 * f64::EPSILON * self.radius * across,
        }
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    /// Faces are chosen by the solid angle that they would subtend if they were small; on each, points are uniform
    /// over the part that is seen.
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let (chances, arc) = self.seen(from);
        let face = choose(&chances, u[0])?;
        let chance = chances[face as usize];
        match face {
            LOWER => return Some(sample_disk(self.radius, 0.0, face, chance, [u[1], u[2]])),
            UPPER => return Some(sample_disk(self.radius, self.height, face, chance, [u[1], u[2]])),
            _ => {}
        }
        let (nx, ny) = turned(from, 1.0, arc * (2.0 * u[1] - 1.0));
        Some(SurfaceSample {
            point: Point3D::new(nx * self.radius, ny * self.radius, u[2] * self.height),
            normal: Normal3D::new(nx, ny, 0.0),
            shading_normal: None,
            feature: face_of(SIDE),
            density: chance / (2.0 * arc * self.radius * self.height),
        })
    }

    fn surface_density(&self, from: Point3D, point: Point3D, feature: Feature) -> f64 {
        let (chances, arc) = self.seen(from);
        let Some(&chance) = chances.get(feature.face as usize) else { return 0.0 };
        if chance == 0.0 {
            return 0.0;
        }
        if feature.face != SIDE {
            return chance / disk_area(self.radius);
        }
        let squared = self.radius * self.radius;
        let seen = point.x * from.x + point.y * from.y >= squared * (1.0 - 8.0 * f64::EPSILON);
        if seen { chance / (2.0 * arc * self.radius * self.height) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
