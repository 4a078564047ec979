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
    LOWER, NearTip, Passage, SIDE, ball_about_axis, chances, check_aspect, check_length, choose, disk_area,
    disk_reach, face_of, flat_normal, half_arc, piece_weight, roots, rounded_box, sample_disk, tip_ball,
    turned, within_disk,
};
use crate::select::{larger, smaller};

/// A solid paraboloid of revolution about the z axis with its base at z = 0 and its vertex at z = height:
/// 0 ≤ z ≤ h (1 − ρ²/r²).
///
/// Its focus lies r²/(4 h) below the vertex. Faces: 0 the curved side, 1 the base.
///
/// ```
/// use raysect_core::{Interval, Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_primitive::Parabola;
///
/// let dish = Parabola::new(1.0, 0.5)?;
/// let ray = Ray::new(Point3D::new(0.5, 0.0, 4.0), -Vector3D::Z);
/// let hit = dish.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap();
/// assert_eq!((hit.distance, hit.feature.face), (4.0 - 0.375, 0));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[doc(alias = "Paraboloid")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parabola {
    radius: f64,
    height: f64,
    /// The latus rectum r²/h [m]: ρ² = `latus` · w at a depth w below the vertex.
    latus: f64,
}

impl Default for Parabola {
    /// Radius 0.5 m, height 1 m.
    fn default() -> Self {
        Self::of(0.5, 1.0)
    }
}

/// What is seen of a paraboloid from a point.
struct View {
    /// The probability with which each face is chosen.
    chances: [f64; 3],
    /// The radii between which rings of the side are seen at least in part [m].
    inner: f64,
    outer: f64,
    /// Area of the side within these radii, over 2π [m²].
    rings: f64,
}

impl Parabola {
    /// Of the radius of its base [m] and its height [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless both lie in 1e-100 … 1e100 m and their ratio in 1e-50 … 1e50.
    pub fn new(radius: f64, height: f64) -> Result<Self, PrimitiveError> {
        check_length("parabola", "radius", radius)?;
        check_length("parabola", "height", height)?;
        check_aspect("parabola", radius, height)?;
        Ok(Self::of(radius, height))
    }

    fn of(radius: f64, height: f64) -> Self {
        Self { radius, height, latus: radius * (radius / height) }
    }

    /// The radius of the base [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The height [m].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Volume, π r² h / 2 [m³].
    pub fn volume(&self) -> f64 {
        0.5 * disk_area(self.radius) * self.height
    }

    /// Area of the side and the base, π r² + π p²/6 ((1 + 4 r²/p²)^(3/2) − 1) with p = r²/h [m²].
    pub fn surface_area(&self) -> f64 {
        disk_area(self.radius) + TAU * self.ring_area(self.excess(self.radius))
    }

    /// (1 + 4 ρ²/p²)^(3/2) − 1, to rounding for flat shapes too: what the area of the side grows with.
    #[inline]
    fn excess(&self, rho: f64) -> f64 {
        let q = 2.0 * rho / self.latus;
        (1.5 * (q * q).ln_1p()).exp_m1()
    }

    /// Area [m²] over 2π of the rings between two radii, from the difference of their [`excess`](Self::excess).
    #[inline]
    fn ring_area(&self, excess: f64) -> f64 {
        self.latus * (self.latus / 12.0 * excess)
    }

    #[inline]
    fn passage(&self, ray: &Ray) -> Passage {
        let near = NearTip::new(ray, self.height);
        near.above_base(self.side(&near))
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

    /// Within the endless paraboloid ρ² ≤ p w, with w counted downwards from the vertex.
    ///
    /// The discriminant is that of the parabola which the plane through the line and parallel to the axis cuts out:
    /// p² dw²/4 + p d·v − m², where v and m are the components across and along the axis of the moment of the line
    /// about the vertex (by Lagrange's identity from the textbook form). None of its terms grows with the distance of
    /// the origin.
    #[inline]
    fn side(&self, near: &NearTip) -> Passage {
        let d = near.direction;
        let (x, y, w, dw) = (near.x, near.y, near.depth, -d.z);
        let fall = 0.5 * self.latus * dw;
        let a = d.x * d.x + d.y * d.y;
        let b = x * d.x + y * d.y - fall;
        let c = x * x + y * y - self.latus * w;
        let m = x * d.y - y * d.x;
        let (vx, vy) = (w * d.x - dw * x, w * d.y - dw * y);
        let discriminant = fall * fall + self.latus * (d.x * vx + d.y * vy) - m * m;
        match roots(a, b, c, discriminant) {
            Some((p, q)) => Passage::within_side(smaller(p, q), larger(p, q), discriminant < 0.0),
            None => Passage::within_side(0.0, 0.0, true),
        }
    }

    /// What is seen from a point outside.
    ///
    /// The contour is the section with the polar plane of the point. Seen along the axis it is a circle about the
    /// point; the side is seen within it.
    fn view(&self, from: Point3D) -> View {
        let (r, h) = (self.radius, self.height);
        let away = from.x.hypot(from.y);
        let under = self.latus * (h - from.z);
        let squared = away * away - under;
        let base = piece_weight(disk_area(r), -from.z, away);
        let mut view = View { chances: [0.0; 3], inner: 0.0, outer: 0.0, rings: 0.0 };
        let mut side = 0.0;
        if squared > 0.0 {
            let circle = squared.sqrt();
            view.inner = if under > 0.0 { under / (away + circle) } else { 0.0 };
            view.outer = r.min(away + circle);
            view.rings = self.ring_area(self.excess(view.outer) - self.excess(view.inner));
            if view.inner < view.outer && view.rings > 0.0 {
                let above = (from.z - 0.5 * h).max(0.0);
                let distance = away.hypot(from.z - 0.5 * h);
                let silhouette = 4.0 / 3.0 * r * h * (away / distance) + disk_area(r) * (above / distance);
                side = silhouette / distance / distance;
            }
        }
        view.chances = chances([side, base, 0.0]);
        view
    }

    /// Half the arc of the ring of radius `rho` that is seen from a point.
    #[inline]
    fn ring_arc(&self, from: Point3D, rho: f64) -> f64 {
        let away = from.x.hypot(from.y);
        half_arc(rho * rho + self.latus * (self.height - from.z), 2.0 * rho * away)
    }

    /// The normal of the side, along the gradient (2x, 2y, p).
    #[inline]
    fn side_normal(&self, x: f64, y: f64) -> Normal3D {
        let scale = 1.0 / self.radius;
        Normal3D::new(x * scale, y * scale, 0.5 * self.latus * scale).normalise_unchecked()
    }
}

impl Primitive for Parabola {
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Parabola").number("radius", self.radius).number("height", self.height))
    }

    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        // The most of `across` ρ + `tip` (1 − ρ²/r²) over 0 ≤ ρ ≤ r, with `across` counted at the rim.
        let most = |across: f64, tip: f64| {
            if 2.0 * tip > across { tip + across * (across / (4.0 * tip)) } else { across }
        };
        rounded_box(m, |axis| {
            let (across, tip) = (self.radius * disk_reach(m, axis), self.height * m.get(axis, 2));
            (-most(across, -tip), most(across, tip))
        })
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                // Distances from a point of the axis are greatest at the vertex or the rim.
                let (z, radius) = tip_ball(self.radius, self.height);
                ball_about_axis(m, scale, z, radius)
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, p: Point3D) -> bool {
        p.z >= 0.0 && p.x * p.x + p.y * p.y <= self.latus * (self.height - p.z)
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
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let z = p.z.clamp(0.0, self.height);
        let (point, bound) = if 2.0 * rho <= self.latus {
            // Flatter than 45°: moved along the axis.
            let (x, y) = within_disk(p.x, p.y, self.radius);
            let w = (x * x + y * y) / self.latus;
            (Point3D::new(x, y, (self.height - w).max(0.0)), 4.0 * f64::EPSILON * self.height)
        } else {
            // Steeper: moved towards the axis.
            let wide = (self.latus * (self.height - z)).sqrt();
            (Point3D::new(p.x / rho * wide, p.y / rho * wide, z), 4.0 * f64::EPSILON * wide)
        };
        let normal = self.side_normal(point.x, point.y);
        Surface { point, normal, shading_normal: normal, bound }
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }

    /// The side is chosen by its silhouette, the base by the solid angle that it would subtend if it were small. On
    /// the base points are uniform; on the side a ring is chosen by its whole area, then a point uniformly on the arc
    /// of it that is seen.
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let view = self.view(from);
        let face = choose(&view.chances, u[0])?;
        let chance = view.chances[face as usize];
        if face == LOWER {
            return Some(sample_disk(self.radius, 0.0, face, chance, [u[1], u[2]]));
        }
        let (inner, outer) = (self.excess(view.inner), self.excess(view.outer));
        let excess = inner + u[2] * (outer - inner);
        let rho = 0.5 * self.latus * (excess.ln_1p() / 1.5).exp_m1().sqrt();
        let rho = rho.clamp(view.inner, view.outer);
        let arc = self.ring_arc(from, rho);
        if arc == 0.0 {
            return None;
        }
        let (x, y) = turned(from, rho, arc * (2.0 * u[1] - 1.0));
        let fraction = rho / self.radius;
        Some(SurfaceSample {
            point: Point3D::new(x, y, self.height * (1.0 - fraction * fraction)),
            normal: self.side_normal(x, y),
            shading_normal: None,
            feature: face_of(SIDE),
            density: chance / (2.0 * arc * view.rings),
        })
    }

    fn surface_density(&self, from: Point3D, point: Point3D, feature: Feature) -> f64 {
        let view = self.view(from);
        let Some(&chance) = view.chances.get(feature.face as usize) else { return 0.0 };
        if chance == 0.0 {
            return 0.0;
        }
        if feature.face != SIDE {
            return chance / disk_area(self.radius);
        }
        let rho = point.x.hypot(point.y);
        let arc = self.ring_arc(from, rho);
        // Above the tangent plane.
        let (out, under) = (2.0 * (point.x * from.x + point.y * from.y), self.latus * (self.height - from.z));
        let rounding = 8.0 * f64::EPSILON * (out.abs() + rho * rho + under.abs());
        let seen = out - rho * rho - under >= -rounding;
        if seen && arc > 0.0 { chance / (2.0 * arc * view.rings) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
