use std::f64::consts::PI;

use raysect_math::{Normal3D, Point3D, Vector3D};

use super::line::Stretch;

/// The region that a spherical surface about the axis closes off: a ball, and all that lies beyond the plane through its
/// centre; a half-space if it is flat. Within a barrel no wider than the ball, it is convex.
///
/// Everything is counted from the vertex, in the form κ (x² + y² + ζ²) + 2 ζ ≤ 0 of optical ray tracing, which loses
/// no digits where a surface is all but flat (W. Welford, *Aberrations of Optical Systems*, 1986, § 4.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cap {
    /// Height of the vertex [m].
    vertex: f64,
    /// Outward along z: 1 up, −1 down.
    sign: f64,
    /// One over the radius [1/m]; 0 for a plane.
    curvature: f64,
    /// How far the vertex stands out from the rim [m].
    pub(super) sag: f64,
    /// Radius of the barrel [m].
    rim: f64,
}

/// Depth of a sphere's cap of a given radius at its rim, without cancellation.
pub(super) fn sagitta(radius: f64, rim: f64) -> f64 {
    let q = rim / radius;
    rim * q / (1.0 + ((1.0 - q) * (1.0 + q)).max(0.0).sqrt())
}

impl Cap {
    pub(super) fn spherical(vertex: f64, sign: f64, radius: f64, rim: f64) -> Self {
        Self { vertex, sign, curvature: 1.0 / radius, sag: sagitta(radius, rim), rim }
    }

    pub(super) fn flat(vertex: f64, sign: f64, rim: f64) -> Self {
        Self { vertex, sign, curvature: 0.0, sag: 0.0, rim }
    }

    /// Height of the circle in which it meets the barrel [m].
    pub(super) fn rim_height(&self) -> f64 {
        self.vertex - self.sign * self.sag
    }

    /// Volume between vertex and rim [m³].
    pub(super) fn volume(&self) -> f64 {
        PI * self.sag * (3.0 * self.rim * self.rim + self.sag * self.sag) / 6.0
    }

    /// Area from vertex to rim [m²].
    pub(super) fn area(&self) -> f64 {
        PI * (self.rim * self.rim + self.sag * self.sag)
    }

    /// True for points of the region; `strictly` without those on the surface.
    pub(super) fn contains(&self, p: Point3D, strictly: bool) -> bool {
        let height = self.sign * (p.z - self.vertex);
        let form = self.curvature * (p.x * p.x + p.y * p.y + height * height) + 2.0 * height;
        let within = if strictly { form < 0.0 } else { form <= 0.0 };
        within || self.curvature * height < -1.0
    }

    /// The part of a line in the region, as far as it lies in the barrel. `d` is a unit vector.
    #[inline]
    pub(super) fn stretch(&self, o: Point3D, d: Vector3D) -> Option<Stretch> {
        let (height, climb) = (self.sign * (o.z - self.vertex), self.sign * d.z);
        let across = o.x * d.x + o.y * d.y + height * climb;
        let b = self.curvature * across + climb;
        let c = self.curvature * (o.x * o.x + o.y * o.y + height * height) + 2.0 * height;
        if self.curvature == 0.0 {
            return Stretch::below(-0.5 * c, climb);
        }
        let discriminant = b * b - self.curvature * c;
        // Where the line passes the centre, unless the ball decides.
        let beyond = || Stretch::below(-1.0 / self.curvature - height, climb);
        if discriminant < 0.0 {
            return beyond();
        }
        let q = if b >= 0.0 { -b - discriminant.sqrt() } else { discriminant.sqrt() - b };
        let other = if q == 0.0 { 0.0 } else { c / q };
        let (first, last) = if b >= 0.0 { (q / self.curvature, other) } else { (other, q / self.curvature) };
        let outer = |t: f64| self.curvature * (height + t * climb) > -1.0;
        if climb == 0.0 {
            return if outer(0.0) { Some(Stretch { first, last }) } else { beyond() };
        }
        let plane = (-1.0 / self.curvature - height) / climb;
        let (open, closed) = if climb > 0.0 { (f64::NEG_INFINITY, plane) } else { (plane, f64::INFINITY) };
        let first = if outer(first) { first } else { open };
        let last = if outer(last) { last } else { closed };
        Some(Stretch { first, last })
    }

    /// The point of the surface nearest to a point beside it, and the normal out of the region.
    pub(super) fn snap(&self, p: Point3D) -> (Point3D, Normal3D) {
        let rho = p.x.hypot(p.y);
        let shrink = if rho > self.rim { self.rim / rho } else { 1.0 };
        let (x, y) = (p.x * shrink, p.y * shrink);
        let (slope_x, slope_y) = (self.curvature * x, self.curvature * y);
        let squared = slope_x * slope_x + slope_y * slope_y;
        let upright = (1.0 - squared).max(0.0).sqrt();
        if squared < 0.5 {
            let depth = (x * slope_x + y * slope_y) / (1.0 + upright);
            let normal = Vector3D::new(slope_x, slope_y, self.sign * upright).normalise_unchecked();
            return (Point3D::new(x, y, self.vertex - self.sign * depth), normal.into());
        }
        // Where the surface is steep, along the radius of the ball.
        let height = self.curvature * self.sign * (p.z - self.vertex) + 1.0;
        let normal = Vector3D::new(slope_x, slope_y, self.sign * height.max(0.0)).normalise_unchecked();
        let radius = 1.0 / self.curvature;
        let z = self.vertex - self.sign * (radius - self.sign * normal.z * radius);
        (Point3D::new(normal.x * radius, normal.y * radius, z), normal.into())
    }

    /// How far the surface reaches along a vector beyond the plane z = 0, if its farthest point lies within the rim.
    pub(super) fn reach(&self, w: Vector3D) -> Option<f64> {
        let (aside, along) = (w.x.hypot(w.y), self.sign * w.z);
        let length = aside.hypot(along);
        let stands_out = along > 0.0 && aside <= self.curvature * self.rim * length;
        // Radius × (length − along), without cancellation.
        let beside = || aside / self.curvature * (aside / (length + along));
        stands_out.then(|| w.z * self.vertex + if aside == 0.0 { 0.0 } else { beside() })
    }
}
