use std::f64::consts::PI;

use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface,
};
use raysect_math::{AffineMatrix3D, MathError, Normal3D, Point3D, Vector3D};

use super::LensFace;
use super::cap::{Cap, sagitta};
use super::line::{Line, Stretch};
use crate::PrimitiveError;
use crate::revolution::{ball_about_axis, check_length, disk_reach, rounded_box};

/// The form of one side of a lens, with its radius of curvature [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    Flat,
    Convex(f64),
    Concave(f64),
}

/// One side of a lens: the region of its cap is kept if it is convex or flat, and taken away if it is concave.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    cap: Cap,
    hollow: bool,
}

impl Form {
    fn radius(self) -> Option<f64> {
        match self {
            Self::Flat => None,
            Self::Convex(radius) | Self::Concave(radius) => Some(radius),
        }
    }

    /// Height of the vertex above the rim, as seen from outside [m].
    fn standing_out(self, rim: f64) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Convex(radius) => sagitta(radius, rim),
            Self::Concave(radius) => -sagitta(radius, rim),
        }
    }

    fn side(self, vertex: f64, outward: f64, rim: f64) -> Side {
        match self {
            Self::Flat => Side { cap: Cap::flat(vertex, outward, rim), hollow: false },
            Self::Convex(radius) => Side { cap: Cap::spherical(vertex, outward, radius, rim), hollow: false },
            Self::Concave(radius) => {
                Side { cap: Cap::spherical(vertex, -outward, radius, rim), hollow: true }
            }
        }
    }
}

/// What is within the barrel and between two surfaces: the lens behind all lenses.
///
/// A line runs through the endless barrel in one stretch; convex and flat sides cut it short, concave ones take a piece
/// out. The faces are known by construction, and no auxiliary surface is ever crossed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Body {
    pub(super) diameter: f64,
    pub(super) centre_thickness: f64,
    pub(super) edge_thickness: f64,
    rim: f64,
    front: Side,
    back: Side,
    /// Greatest distance of a surface point from the origin, about [m].
    size: f64,
}

impl Body {
    pub(super) fn new(
        shape: &'static str,
        diameter: f64,
        centre_thickness: f64,
        front: Form,
        back: Form,
    ) -> Result<Self, PrimitiveError> {
        check_length(shape, "diameter", diameter)?;
        check_length(shape, "centre thickness", centre_thickness)?;
        let rim = 0.5 * diameter;
        for (name, form) in [("front curvature", front), ("back curvature", back)] {
            if let Some(radius) = form.radius() {
                check_length(shape, name, radius)?;
                MathError::check(radius >= rim, radius, name, "m", "half the diameter or more")
                    .map_err(|source| PrimitiveError::Dimension { shape, source })?;
            }
        }
        let (of_front, of_back) = (front.standing_out(rim), back.standing_out(rim));
        let edge = centre_thickness - of_front - of_back;
        // A sharp edge is admitted, whichever way its thickness is rounded.
        let rounding = 8.0 * f64::EPSILON * (centre_thickness + of_front.abs() + of_back.abs());
        let edge_thickness = if edge.abs() <= rounding { 0.0 } else { edge };
        MathError::check(edge_thickness >= 0.0, edge, "edge thickness", "m", "0 m or more")
            .map_err(|source| PrimitiveError::Dimension { shape, source })?;
        Ok(Self {
            diameter,
            centre_thickness,
            edge_thickness,
            rim,
            front: front.side(centre_thickness, 1.0, rim),
            back: back.side(0.0, -1.0, rim),
            size: rim + centre_thickness + of_front.abs() + of_back.abs(),
        })
    }

    /// Depth of the cap of the front side [m].
    pub(super) fn front_sag(&self) -> f64 {
        self.front.cap.sag
    }

    /// Depth of the cap of the back side [m].
    pub(super) fn back_sag(&self) -> f64 {
        self.back.cap.sag
    }

    pub(super) fn volume(&self) -> f64 {
        let of = |side: &Side| if side.hollow { -side.cap.volume() } else { side.cap.volume() };
        PI * self.rim * self.rim * self.edge_thickness + of(&self.front) + of(&self.back)
    }

    pub(super) fn surface_area(&self) -> f64 {
        PI * self.diameter * self.edge_thickness + self.front.cap.area() + self.back.cap.area()
    }

    fn sides(&self) -> [(Side, LensFace); 2] {
        [(self.front, LensFace::Front), (self.back, LensFace::Back)]
    }

    fn on_side(&self, side: &Side, p: Point3D) -> (Point3D, Normal3D) {
        let (point, normal) = side.cap.snap(p);
        (point, if side.hollow { Normal3D::from(-normal.as_vector()) } else { normal })
    }

    fn on_barrel(&self, p: Point3D) -> (Point3D, Normal3D) {
        let normal = Vector3D::new(p.x, p.y, 0.0).normalise_unchecked();
        let z = p
            .z
            .clamp(self.back.cap.rim_height(), self.front.cap.rim_height().max(self.back.cap.rim_height()));
        (Point3D::new(normal.x * self.rim, normal.y * self.rim, z), normal.into())
    }

    /// Within the endless cylinder about the axis: the chord from the distance of closest approach, as for a sphere.
    /// `d` is a unit vector.
    #[inline]
    fn barrel(&self, o: Point3D, d: Vector3D) -> Option<Stretch> {
        let squared = d.x * d.x + d.y * d.y;
        if squared < 1e-280 {
            let inside = o.x.hypot(o.y) <= self.rim;
            return inside.then_some(Stretch { first: f64::NEG_INFINITY, last: f64::INFINITY });
        }
        let inverse = 1.0 / squared.sqrt();
        let (x, y) = (d.x * inverse, d.y * inverse);
        let miss = (o.x * y - o.y * x).abs();
        if miss > self.rim {
            return None;
        }
        let half = ((self.rim - miss) * (self.rim + miss)).sqrt();
        let closest = -(o.x * x + o.y * y);
        Some(Stretch { first: (closest - half) * inverse, last: (closest + half) * inverse })
    }

    /// The line from near the lens, with the distance of that place and the length of the direction.
    #[inline]
    fn line(&self, ray: &Ray) -> (Option<Line>, f64, f64) {
        let speed = ray.direction.length();
        let d = ray.direction * (1.0 / speed);
        let middle = Point3D::new(0.0, 0.0, 0.5 * self.centre_thickness);
        let ahead = ray.origin.vector_to(middle).dot(d);
        (self.passage(ray.origin + d * ahead, d), ahead, speed)
    }

    #[inline]
    fn passage(&self, o: Point3D, d: Vector3D) -> Option<Line> {
        let mut line = Line::within_barrel(self.barrel(o, d)?);
        for (side, face) in self.sides() {
            match side.cap.stretch(o, d) {
                Some(part) if side.hollow => line.hollow_out(part, face),
                Some(part) => line.keep(part, face),
                None if side.hollow => {}
                None => return None,
            }
        }
        Some(line)
    }
}

impl Primitive for Body {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let farthest = |w: Vector3D, around: f64| {
            let of = |side: &Side| {
                let at_rim = w.z * side.cap.rim_height() + around;
                let within = if side.hollow { None } else { side.cap.reach(w) };
                within.unwrap_or(at_rim).max(at_rim)
            };
            of(&self.front).max(of(&self.back))
        };
        rounded_box(m, |axis| {
            let w = Vector3D::new(m.get(axis, 0), m.get(axis, 1), m.get(axis, 2));
            let around = self.rim * disk_reach(m, axis);
            (-farthest(-w, around), farthest(w, around))
        })
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        let around_box = self.bounding_box(m).enclosing_sphere();
        let Some(scale) = m.similarity_scale() else { return around_box };
        // About the middle of the heights, out to the rims and vertices.
        let heights = [self.front.cap.rim_height(), self.centre_thickness, self.back.cap.rim_height(), 0.0];
        let low = heights.into_iter().fold(f64::INFINITY, f64::min);
        let high = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let middle = 0.5 * (low + high);
        let rims = [heights[0], heights[2]].map(|z| self.rim.hypot(z - middle));
        let ball = ball_about_axis(m, scale, middle, rims[0].max(rims[1]).max(high - middle));
        if ball.radius < around_box.radius { ball } else { around_box }
    }

    fn contains(&self, point: Point3D) -> bool {
        point.x.hypot(point.y) <= self.rim
            && [self.front, self.back].iter().all(|s| s.cap.contains(point, s.hollow) != s.hollow)
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        if let (Some(line), ahead, speed) = self.line(ray) {
            out.extend(line.crossings(|t| (t + ahead) / speed).iter());
        }
    }

    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        let (line, ahead, speed) = self.line(ray);
        line?.crossings(|t| (t + ahead) / speed).iter().find(|c| within.contains(c.distance))
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        let (line, ahead, speed) = self.line(ray);
        let scale = |t: f64| (t + ahead) / speed;
        if self.is_convex() {
            // A ray that goes inward has entered: it leaves by the nearest far side, however rounding has placed it.
            let line = line.filter(|_| left.inward)?;
            // A line that rounding has placed beside the lens leaves it where it touches it.
            let touches = line.entry.0 > line.exit.0;
            let distance = if touches { 0.0 } else { scale(line.exit.0).max(0.0) };
            let feature = Feature { face: line.exit.1 as u32, ..Feature::default() };
            return (distance <= max_distance).then_some(Crossing { distance, feature, exiting: true });
        }
        let line = line?;
        let all = line.crossings(scale);
        let steepness = |c: &Crossing| self.surface(ray, c).normal.dot(ray.direction).abs();
        let departed = left.left_among(all.iter(), steepness);
        let next = match departed {
            Some(index) => all.iter().nth(index + 1),
            None => all.iter().find(|c| c.distance > 0.0),
        };
        let next = match next {
            Some(crossing) if crossing.exiting == left.inward => next,
            None if !left.inward => next,
            _ => line.leave_at_once(left, scale).or(next),
        };
        let next = next.map(|c| Crossing { distance: c.distance.max(0.0), ..c });
        next.filter(|c| c.distance <= max_distance)
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let p = ray.point_at(crossing.distance);
        let (point, normal) = match LensFace::of(&crossing.feature) {
            Some(LensFace::Front) => self.on_side(&self.front, p),
            Some(LensFace::Back) => self.on_side(&self.back, p),
            _ => self.on_barrel(p),
        };
        Surface { point, normal, shading_normal: normal, bound: 8.0 * f64::EPSILON * self.size }
    }

    fn is_convex(&self) -> bool {
        !self.front.hollow && !self.back.hollow
    }
}
