//! Points on the faces of a cuboid, as a lamp is sampled from a point outside.

use raysect_math::{Point3D, SphericalRectangleSampler, Vector3D};

use super::Cuboid;

/// A cuboid is near if it is seen from within this many times its longest edge: over one farther off, cosine and square
/// of the distance change so little that places drawn evenly over the area do as well, and cost less.
pub(super) const NEAR: f64 = 0.4;

/// The faces of a cuboid that are seen from a point, and how points on them are drawn from there.
// It lives on the stack for the time of one question, on the way of every path: no place for a heap.
#[allow(clippy::large_enum_variant)]
pub(super) enum Faces {
    /// Far off: a face across each axis with the weight of its choice, which is the solid angle that it would subtend
    /// if it were small, and whether it is the upper one; then a place that is uniform over its area.
    Far { faces: [(f64, bool); 3], total: f64 },
    /// Near: directions that are uniform over the solid angle of all visible faces together.
    Near { faces: [Option<(SphericalRectangleSampler, bool)>; 3], total: f64 },
}

/// A point on a face.
pub(super) struct Place {
    pub(super) axis: usize,
    pub(super) upper: bool,
    pub(super) point: Point3D,
    /// Density [1/m²].
    pub(super) density: f64,
}

impl Faces {
    /// Of a cuboid seen from a point.
    #[inline]
    pub(super) fn of(cuboid: &Cuboid, from: Point3D) -> Self {
        let (at, low, high) = (from.to_array(), cuboid.lower().to_array(), cuboid.upper().to_array());
        let sides: [(bool, bool); 3] = std::array::from_fn(|a| (at[a] > high[a], at[a] < low[a]));
        // To the nearest point of the cuboid.
        let gap: [f64; 3] = std::array::from_fn(|a| (low[a] - at[a]).max(at[a] - high[a]).max(0.0));
        let squared = gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
        let near = if squared < cuboid.near { Self::near(cuboid, from, sides) } else { None };
        near.unwrap_or_else(|| Self::far(cuboid, at, sides))
    }

    fn far(cuboid: &Cuboid, from: [f64; 3], sides: [(bool, bool); 3]) -> Self {
        if sides.iter().filter(|s| s.0 || s.1).count() == 1 {
            // The only visible face needs no weight.
            let faces = sides.map(|(upper, lower)| (if upper || lower { 1.0 } else { 0.0 }, upper));
            return Self::Far { faces, total: 1.0 };
        }
        let (low, high) = (cuboid.lower().to_array(), cuboid.upper().to_array());
        let mut faces = [(0.0, false); 3];
        for (axis, (upper, lower)) in sides.into_iter().enumerate() {
            if upper || lower {
                let mut offset: [f64; 3] = std::array::from_fn(|a| from[a] - cuboid.centre[a]);
                offset[axis] = from[axis] - if upper { high[axis] } else { low[axis] };
                let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
                faces[axis] = (cuboid.areas[axis] * offset[axis].abs() / (squared * squared.sqrt()), upper);
            }
        }
        Self::Far { faces, total: faces[0].0 + faces[1].0 + faces[2].0 }
    }

    /// None where a solid angle is beyond what the sampler can tell: in the plane of a face, to rounding.
    #[inline(never)]
    fn near(cuboid: &Cuboid, from: Point3D, sides: [(bool, bool); 3]) -> Option<Self> {
        let extent = cuboid.lower().vector_to(cuboid.upper()).to_array();
        let mut faces = [None; 3];
        let mut total = 0.0;
        for (axis, (upper, lower)) in sides.into_iter().enumerate() {
            if !(upper || lower) || cuboid.areas[axis] == 0.0 {
                continue;
            }
            let mut corner = cuboid.lower().to_array();
            if upper {
                corner[axis] = cuboid.upper()[axis];
            }
            let edges = [(axis + 1) % 3, (axis + 2) % 3].map(|along| {
                let mut edge = [0.0; 3];
                edge[along] = extent[along];
                Vector3D::from(edge)
            });
            let sampler = SphericalRectangleSampler::new(from, corner.into(), edges).ok()?;
            total += sampler.solid_angle();
            faces[axis] = Some((sampler, upper));
        }
        (total > 0.0).then_some(Self::Near { faces, total })
    }

    /// Draws a point from three uniforms in (0, 1); none if no face is seen.
    #[inline]
    pub(super) fn sample(&self, cuboid: &Cuboid, from: Point3D, u: [f64; 3]) -> Option<Place> {
        let weights = self.weights();
        let mut rest = u[0] * self.total();
        let chosen = (0..3).filter(|&a| weights[a] > 0.0).find(|&a| {
            rest -= weights[a];
            rest <= 0.0
        });
        let axis = chosen.or_else(|| (0..3).rfind(|&a| weights[a] > 0.0))?;
        let (low, high) = (cuboid.lower().to_array(), cuboid.upper().to_array());
        let (upper, mut point) = match self {
            Self::Far { faces, .. } => {
                let mut point = [0.0; 3];
                for (i, u) in [((axis + 1) % 3, u[1]), ((axis + 2) % 3, u[2])] {
                    point[i] = low[i] + u * (high[i] - low[i]);
                }
                (faces[axis].1, point)
            }
            Self::Near { faces, .. } => {
                let (sampler, upper) = faces[axis].as_ref()?;
                let direction = sampler.sample_at([u[1], u[2]]);
                let plane = if *upper { high[axis] } else { low[axis] };
                let point = from + direction * ((plane - from[axis]) / direction.to_array()[axis]);
                let point = point.to_array();
                (*upper, std::array::from_fn(|a| point[a].clamp(low[a], high[a])))
            }
        };
        point[axis] = if upper { high[axis] } else { low[axis] };
        let point = Point3D::from(point);
        Some(Place { axis, upper, point, density: self.density(cuboid, from, point, axis, upper) })
    }

    /// Density [1/m²] with which a point of a face is drawn.
    #[inline]
    pub(super) fn density(
        &self,
        cuboid: &Cuboid,
        from: Point3D,
        point: Point3D,
        axis: usize,
        upper: bool,
    ) -> f64 {
        match self {
            Self::Far { faces, total } => {
                let (weight, visible_side) = faces[axis];
                if weight == 0.0 || upper != visible_side {
                    return 0.0;
                }
                weight / total / cuboid.areas[axis]
            }
            Self::Near { faces, total } => match faces[axis] {
                Some((_, visible_side)) if visible_side == upper => {
                    let to = from.vector_to(point);
                    let squared = to.length_squared();
                    to.to_array()[axis].abs() / (squared * squared.sqrt() * total)
                }
                _ => 0.0,
            },
        }
    }

    /// What the faces across each axis are chosen by.
    #[inline]
    fn weights(&self) -> [f64; 3] {
        match self {
            Self::Far { faces, .. } => [0, 1, 2].map(|a| faces[a].0),
            Self::Near { faces, .. } => {
                [0, 1, 2].map(|a| faces[a].as_ref().map_or(0.0, |(sampler, _)| sampler.solid_angle()))
            }
        }
    }

    fn total(&self) -> f64 {
        match self {
            Self::Far { total, .. } | Self::Near { total, .. } => *total,
        }
    }
}
