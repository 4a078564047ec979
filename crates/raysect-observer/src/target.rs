use std::sync::Arc;

use raysect_core::Primitive;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter};
use raysect_math::sampling::uniforms;
use raysect_math::{
    AffineMatrix3D, Cone, Frame, MathError, Point3D, Rng, SphericalDiskSampler, SphericalRectangleSampler,
    SphericalTriangleSampler, Vector3D,
};

use crate::ObserverError;
use crate::target_shape::PlacedShape;

/// Something that a [`Targeted`](crate::Targeted) sensor aims at, in the observer's own space: directions towards it are
/// uniform in the solid angle that it fills, or nearly so.
#[derive(Debug, Clone, PartialEq)]
pub struct Target(Kind);

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Sphere { centre: Point3D, radius: f64 },
    Rectangle { corner: Point3D, edges: [Vector3D; 2] },
    Triangle { corners: [Point3D; 3] },
    Disk { centre: Point3D, normal: Vector3D, radius: f64 },
    Shape(PlacedShape),
}

/// Uniform directions towards a target from one point.
enum Aim {
    Sphere(Frame, Cone),
    Rectangle(SphericalRectangleSampler),
    Triangle(SphericalTriangleSampler),
    Disk(SphericalDiskSampler),
}

impl Target {
    /// A sphere of a centre and a radius [m]: a ball, or what bounds another shape.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a centre beyond 1e150 m, or a radius outside 1e-150 … 1e150 m.
    pub fn sphere(centre: Point3D, radius: f64) -> Result<Self, ObserverError> {
        let farthest = centre.max_abs();
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        let admitted = (1e-150..=1e150).contains(&radius);
        MathError::check(admitted, radius, "radius of a target", "m", "1e-150 … 1e150")?;
        Ok(Self(Kind::Sphere { centre, radius }))
    }

    /// A flat rectangle with a corner [m] and two edges that leave it at a right angle [m]: a port, a slit, a screen.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a corner or edge that is not finite or beyond 1e150 m, edges without length, and edges
    /// that are not perpendicular to within 1e-8.
    pub fn rectangle(corner: Point3D, edges: [Vector3D; 2]) -> Result<Self, ObserverError> {
        let farthest = corner.max_abs().max(edges[0].max_abs()).max(edges[1].max_abs());
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        let normal = edges[0].cross(edges[1]).normalise()?;
        // Seen from in front of its corner: what is wrong with the edges comes out here.
        let size = edges[0].length().max(edges[1].length());
        SphericalRectangleSampler::new(corner + normal * size, corner, edges)?;
        Ok(Self(Kind::Rectangle { corner, edges }))
    }

    /// A triangle between three corners [m], in either sense: a facet of something else.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a corner beyond 1e150 m, and corners in line.
    pub fn triangle(corners: [Point3D; 3]) -> Result<Self, ObserverError> {
        let farthest = corners.iter().fold(0.0, |most: f64, corner| most.max(corner.max_abs()));
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        let edges = [corners[0].vector_to(corners[1]), corners[0].vector_to(corners[2])];
        let normal = edges[0].cross(edges[1]).normalise()?;
        // Seen from in front of its middle: what is wrong with the corners comes out here.
        let middle = corners[0] + (edges[0] + edges[1]) / 3.0;
        let size = edges[0].length().max(edges[1].length());
        SphericalTriangleSampler::new(middle + normal * size, corners)?;
        Ok(Self(Kind::Triangle { corners }))
    }

    /// A flat disk around a centre [m], at right angles to a normal of any length, with a radius [m]: a round window, a
    /// pinhole. A direction towards it takes longer to draw than one towards a rectangle, see [`SphericalDiskSampler`].
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a centre beyond 1e150 m, a radius outside 1e-150 … 1e150 m, or a normal without
    /// direction.
    pub fn disk(centre: Point3D, normal: Vector3D, radius: f64) -> Result<Self, ObserverError> {
        Self::sphere(centre, radius)?;
        normal.normalise()?;
        Ok(Self(Kind::Disk { centre, normal, radius }))
    }

    /// A shape, with the map from its own space to that of the observer: what a bar, a plate or a tube fills is aimed at,
    /// not a ball around it.
    ///
    /// Convex shapes that draw samples of their own are aimed at by these
    /// ([`surface_sampling`](Primitive::surface_sampling)): spheres, cuboids, cylinders, cones and parabolas, and a user's
    /// own. Of others, and of all if the map is not a similarity, it is the bounding sphere.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a map without inverse, and as [`sphere`](Self::sphere) for the bounding sphere.
    pub fn shape(shape: &Arc<dyn Primitive>, to_observer: AffineMatrix3D) -> Result<Self, ObserverError> {
        let around = shape.bounding_sphere(&to_observer);
        let around = Self::sphere(around.centre, around.radius)?;
        Ok(PlacedShape::new(shape, to_observer)?.map_or(around, |placed| Self(Kind::Shape(placed))))
    }

    /// A direction from a point towards it. None from inside a sphere or another solid, or in the plane of what is flat.
    pub(crate) fn sample(&self, from: Point3D, rng: &mut Rng) -> Option<Vector3D> {
        match &self.0 {
            Kind::Shape(placed) => placed.sample(from, rng),
            _ => Some(self.aim(from)?.sample_at(uniforms(rng))),
        }
    }

    /// Density of [`sample`](Self::sample) [1/sr]; none where there are none.
    pub(crate) fn pdf(&self, from: Point3D, direction: Vector3D) -> Option<f64> {
        match &self.0 {
            Kind::Shape(placed) => placed.pdf(from, direction),
            _ => Some(self.aim(from)?.pdf(direction)),
        }
    }

    #[inline]
    fn aim(&self, from: Point3D) -> Option<Aim> {
        match self.0 {
            Kind::Sphere { centre, radius } => {
                let axis = from.vector_to(centre);
                let distance = axis.length();
                if distance <= radius {
                    return None;
                }
                Some(Aim::Sphere(Frame::from_z(axis.normalise().ok()?), Cone::of_sphere(radius, distance)))
            }
            Kind::Rectangle { corner, edges } => {
                SphericalRectangleSampler::new(from, corner, edges).ok().map(Aim::Rectangle)
            }
            Kind::Triangle { corners } => {
                SphericalTriangleSampler::new(from, corners).ok().map(Aim::Triangle)
            }
            Kind::Disk { centre, normal, radius } => {
                SphericalDiskSampler::new(from, centre, normal, radius).ok().map(Aim::Disk)
            }
            Kind::Shape(_) => None,
        }
    }

    /// Numbers that tell it from others: four of a sphere, nine of a rectangle, seven of a disk; nine of a triangle and
    /// their number of corners.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        match &self.0 {
            Kind::Sphere { centre, radius } => [&centre.to_array()[..], &[*radius]].concat(),
            Kind::Rectangle { corner, edges: [first, second] } => {
                [corner.to_array(), first.to_array(), second.to_array()].concat()
            }
            Kind::Triangle { corners: [a, b, c] } => {
                [&a.to_array()[..], &b.to_array(), &c.to_array(), &[3.0]].concat()
            }
            Kind::Disk { centre, normal, radius } => {
                [&centre.to_array()[..], &normal.to_array(), &[*radius]].concat()
            }
            Kind::Shape(placed) => placed.numbers(),
        }
    }

    /// From the numbers of what is no shape.
    fn from_numbers(numbers: &[f64]) -> Result<Self, ObserverError> {
        match *numbers {
            [x, y, z, radius] => Self::sphere(Point3D::new(x, y, z), radius),
            [x, y, z, a, b, c, radius] => Self::disk(Point3D::new(x, y, z), Vector3D::new(a, b, c), radius),
            [x, y, z, a, b, c, d, e, f] => {
                Self::rectangle(Point3D::new(x, y, z), [Vector3D::new(a, b, c), Vector3D::new(d, e, f)])
            }
            [x, y, z, a, b, c, d, e, f, 3.0] => {
                Self::triangle([Point3D::new(x, y, z), Point3D::new(a, b, c), Point3D::new(d, e, f)])
            }
            _ => {
                let count = numbers.len() as f64;
                let (name, range) =
                    ("numbers of a target", "4 of a sphere, 7 of a disk, 9 of a rectangle, 10 of a triangle");
                Err(MathError::OutOfRange { value: count, name, unit: "", range }.into())
            }
        }
    }

    /// Adds it to what is saved: its numbers, or a shape and its place.
    pub(crate) fn save(
        &self,
        name: &str,
        saved: Saved,
        writer: &mut SceneWriter,
    ) -> Result<Saved, SaveError> {
        match &self.0 {
            Kind::Shape(placed) => {
                let shape = writer.shared_object(&placed.shape)?;
                Ok(saved.reference(name, shape).transform(&place_of(name), &placed.to_sensor))
            }
            _ => Ok(saved.numbers(name, &self.numbers())),
        }
    }

    pub(crate) fn load(name: &str, entry: &Entry<'_>) -> Result<Self, MakeError> {
        if entry.has(&place_of(name)) {
            let shape = entry.object::<dyn Primitive>(name)?;
            return Ok(Self::shape(&shape, entry.transform(&place_of(name))?)?);
        }
        Ok(Self::from_numbers(&entry.numbers(name)?)?)
    }
}

/// What the place of a shape is called in files.
fn place_of(name: &str) -> String {
    format!("{name}_place")
}

impl Aim {
    /// The direction for two uniforms in (0, 1).
    #[inline]
    fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        match self {
            Self::Sphere(frame, cone) => frame.to_world(cone.sample_at(u)),
            Self::Rectangle(rectangle) => rectangle.sample_at(u),
            Self::Triangle(triangle) => triangle.sample_at(u),
            Self::Disk(disk) => disk.sample_at(u),
        }
    }

    /// Its density [1/sr]; the border of a cone is widened by what turning a direction there and back may move it.
    #[inline]
    fn pdf(&self, direction: Vector3D) -> f64 {
        match self {
            Self::Sphere(frame, cone) => {
                let v = frame.to_local(direction);
                let versine = if v.z > 0.0 { (v.x * v.x + v.y * v.y) / (1.0 + v.z) } else { 1.0 - v.z };
                let limit = cone.solid_angle() / std::f64::consts::TAU;
                let slack = 16.0 * f64::EPSILON;
                let inside = versine <= limit + slack * (limit + limit.sqrt() + slack);
                if inside { 1.0 / cone.solid_angle() } else { 0.0 }
            }
            Self::Rectangle(rectangle) => rectangle.pdf(direction),
            Self::Triangle(triangle) => triangle.pdf(direction),
            Self::Disk(disk) => disk.pdf(direction),
        }
    }
}

#[cfg(test)]
#[path = "target_tests.rs"]
mod tests;
