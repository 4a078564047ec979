use std::f64::consts::PI;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch,
    Surface, SurfaceSample, SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use crate::PrimitiveError;
use crate::chord::Chord;
use crate::revolution::{
    LOWER, NearTip, Passage, SIDE, ball_about_axis, chances, check_aspect, check_length, choose, disk_area,
    disk_reach, face_of, flat_normal, half_arc, piece_weight, roots, rounded_box, sample_disk, tip_ball,
    turned, within_disk,
};
use crate::select::{larger, smaller};

/// A cone about the z axis with its base at z = 0 and its apex at z = height.
///
/// Faces: 0 the side, 1 the base. At the apex itself the normal is the z axis, or that of the side which the ray
/// passes if the axis would point the wrong way.
///
/// ```
/// use raysect_core::{Interval, Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_primitive::Cone;
///
/// let cone = Cone::new(1.0, 2.0)?;
/// let ray = Ray::new(Point3D::new(-3.0, 0.0, 1.0), Vector3D::X);
/// let hit = cone.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap();
/// assert_eq!((hit.distance, hit.feature.face), (2.5, 0));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    radius: f64,
    height: f64,
    /// Length of a generator [m].
    slant: f64,
    /// Radius over height: the tangent of half the angle of opening.
    slope: f64,
    /// Sine and cosine of half the angle of opening.
    sine: f64,
    cosine: f64,
}

impl Default for Cone {
    /// Radius 0.5 m, height 1 m.
    fn default() -> Self {
        Self::of(0.5, 1.0)
    }
}

impl Cone {
    /// Of the radius of its base [m] and its height [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless both lie in 1e-100 … 1e100 m and their ratio in 1e-50 … 1e50.
    pub fn new(radius: f64, height: f64) -> Result<Self, PrimitiveError> {
        check_length("cone", "radius", radius)?;
        check_length("cone", "height", height)?;
        check_aspect("cone", radius, height)?;
        Ok(Self::of(radius, height))
    }

    fn of(radius: f64, height: f64) -> Self {
        let slant = radius.hypot(height);
        Self { radius, height, slant, slope: radius / height, sine: radius / slant, cosine: height / slant }
    }

    /// The radius of the base [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The height [m].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Volume, π r² h / 3 [m³].
    pub fn volume(&self) -> f64 {
        disk_area(self.radius) * self.height / 3.0
    }

    /// Area of the side and the base, π r (r + √(r² + h²)) [m²].
    pub fn surface_area(&self) -> f64 {
        PI * self.radius * (self.radius + self.slant)
    }

    #[inline]
    fn passage(&self, ray: &Ray) -> Passage {
        let near = NearTip::new(ray, self.height);
        near.above_base(self.side(&near))
    }

    /// How deep a point lies within [m], negative outside: the surface is at least so far away.
    #[inline]
    pub(crate) fn depth(&self, p: Point3D) -> f64 {
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        smaller(p.z, (self.height - p.z) * self.sine - rho * self.cosine)
    }

    /// As [`passage`](Self::passage), unless the line is outside of the side for all its length.
    #[inline]
    fn passage_that_meets(&self, ray: &Ray) -> Option<Passage> {
        let near = NearTip::new(ray, self.height);
        Some(near.above_base(self.side(&near).that_meets()?))
    }

    /// What of a line is within.
    #[inline]
    pub(crate) fn chord(&self, ray: &Ray) -> Option<Chord> {
        self.passage_that_meets(ray)?.chord()
    }

    /// Within the endless cone below the apex, ρ ≤ k w with w counted downwards from the apex.
    ///
    /// The discriminant is k² |v|² − m², where (v, m) are the components across and along the axis of the moment of
    /// the line about the apex (D. Eberly, *Intersection of a Line and a Cone*, Geometric Tools, 2000, for the cases;
    /// this form follows from Lagrange's identity). Nothing in it cancels, even for lines through the apex.
    #[inline]
    fn side(&self, near: &NearTip) -> Passage {
        let d = near.direction;
        let (x, y, w, dw) = (near.x, near.y, near.depth, -d.z);
        let (kw, kdw) = (self.slope * w, self.slope * dw);
        let a = d.x * d.x + d.y * d.y - kdw * kdw;
        let b = x * d.x + y * d.y - kw * kdw;
        let c = x * x + y * y - kw * kw;
        let (vx, vy) = (kw * d.x - kdw * x, kw * d.y - kdw * y);
        let m = x * d.y - y * d.x;
        let discriminant = vx * vx + vy * vy - m * m;
        if a < 0.0 {
            // Steeper than the side: one end of the line is inside, the lower one of this cone.
            let (p, q) = roots(a, b, c, discriminant).unwrap_or((0.0, 0.0));
            return if dw > 0.0 {
                Passage::within_side(larger(p, q), f64::INFINITY, false)
            } else {
                Passage::within_side(f64::NEG_INFINITY, smaller(p, q), false)
            };
        }
        let Some((p, q)) = roots(a, b, c, discriminant) else {
            return Passage::within_side(0.0, 0.0, true);
        };
        // The middle of the chord lies below the apex, not above it in the other half of the double cone.
        let below = d.x * vx + d.y * vy > 0.0;
        Passage::within_side(smaller(p, q), larger(p, q), !below || discriminant < 0.0)
    }

    /// The probability with which each face is chosen by light sampling, and half the arc of the side that is seen:
    /// every generator is seen whole or not at all.
    fn seen(&self, from: Point3D) -> ([f64; 3], f64) {
        let (r, h) = (self.radius, self.height);
        let away = from.x.hypot(from.y);
        let arc = half_arc(self.slope * (h - from.z), away);
        // Seen from the middle of the nearest generator, by area.
        let (dr, dz) = (away - 2.0 / 3.0 * r, from.z - h / 3.0);
        let above = self.cosine * away - self.sine * (h - from.z);
        let side = if arc > 0.0 {
            piece_weight(r * self.slant, above, self.sine * dr - self.cosine * dz)
        } else {
            0.0
        };
        (chances([side, piece_weight(disk_area(r), -from.z, away), 0.0]), arc)
    }

    /// The normal of the side at the azimuth of (x, y).
    #[inline]
    fn normal_towards(&self, x: f64, y: f64) -> Normal3D {
        let rho = (x * x + y * y).sqrt();
        if rho > 0.0 {
            Normal3D::new(self.cosine * (x / rho), self.cosine * (y / rho), self.sine)
        } else {
            Normal3D::new(0.0, 0.0, 1.0)
        }
    }

    /// Where rounding hides the azimuth of a crossing, so close to the apex, it is taken from the ray, so that the
    /// normal looks the right way.
    #[cold]
    fn normal_near_apex(&self, ray: &Ray, crossing: &Crossing, rho: f64) -> Option<Normal3D> {
        let d = ray.direction;
        let rounding =
            16.0 * f64::EPSILON * (self.slant + ray.origin.max_abs() + crossing.distance.abs() * d.max_abs());
        let sign = if crossing.exiting { 1.0 } else { -1.0 };
        (rho <= rounding).then(|| self.normal_towards(sign * d.x, sign * d.y))
    }
}

impl Primitive for Cone {
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Cone").number("radius", self.radius).number("height", self.height))
    }

    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        rounded_box(m, |axis| {
            let (reach, tip) = (self.radius * disk_reach(m, axis), self.height * m.get(axis, 2));
            (tip.min(-reach), tip.max(reach))
        })
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                let (z, radius) = tip_ball(self.radius, self.height);
                ball_about_axis(m, scale, z, radius)
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, p: Point3D) -> bool {
        p.z >= 0.0 && (p.x * p.x + p.y * p.y).sqrt() <= self.slope * (self.height - p.z)
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        out.extend(self.chord(ray).iter().flat_map(Chord::crossings));
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        self.passage_that_meets(ray)?.first(within)
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
        if crossing.feature.face == LOWER {
            let (x, y) = within_disk(p.x, p.y, self.radius);
            let normal = flat_normal(LOWER);
            return Surface { point: Point3D::new(x, y, 0.0), normal, shading_normal: normal, bound: 0.0 };
        }
        // The foot of the perpendicular on the generator, by its distance from the apex.
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let down = (rho * self.sine + (self.height - p.z) * self.cosine).clamp(0.0, self.slant);
        let wide = if rho > 0.0 { down * self.sine / rho } else { 0.0 };
        let z = (self.height - down * self.cosine).max(0.0);
        let normal = self.normal_towards(p.x, p.y);
        let normal = if (normal.dot(ray.direction) > 0.0) == crossing.exiting {
            normal
        } else {
            self.normal_near_apex(ray, crossing, rho).unwrap_or(normal)
        };
        Surface {
            point: Point3D::new(p.x * wide, p.y * wide, z),
            normal,
            shading_normal: normal,
            bound: 8.0 * f64::EPSILON * self.radius * self.cosine,
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
        if face == LOWER {
            return Some(sample_disk(self.radius, 0.0, face, chance, [u[1], u[2]]));
        }
        let down = u[2].sqrt();
        let (x, y) = turned(from, 1.0, arc * (2.0 * u[1] - 1.0));
        let rho = self.radius * down;
        Some(SurfaceSample {
            point: Point3D::new(rho * x, rho * y, self.height * (1.0 - down)),
            normal: self.normal_towards(x, y),
            shading_normal: None,
            feature: face_of(SIDE),
            density: chance / (arc * self.radius * self.slant),
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
        // Above the tangent plane, which passes through the apex.
        let n = self.normal_towards(point.x, point.y);
        let (out, down) = (n.x * from.x + n.y * from.y, n.z * (self.height - from.z));
        let seen = out - down >= -8.0 * f64::EPSILON * (out.abs() + down.abs());
        if seen { chance / (arc * self.radius * self.slant) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
