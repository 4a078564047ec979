//! A shape of one's own: a cushion, x⁴ + y⁴ + z⁴ = r⁴, tested against the contract and rendered: `custom_primitive.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/paint.rs"]
mod paint;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use clap::Parser;
use paint::paint;
use raysect::core::testing::check_primitive;
use raysect::core::{BoundingBox3D, Crossing, Feature, Ray, Scratch, Surface};
use raysect::math::solve_quartic;
use raysect::prelude::{
    AffineMatrix3D, Node, Normal3D, Point3D, Primitive, Vector3D, WithMaterial, rotate, schott, translate,
};

/// Tests a user's own shape against the contract of all shapes, and renders it.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

/// The points with x⁴ + y⁴ + z⁴ ≤ r⁴: between a ball and a cube.
#[derive(Clone, Copy)]
struct Cushion {
    radius: f64,
}

impl Cushion {
    /// (x⁴ + y⁴ + z⁴)/r⁴ − 1, and its gradient times r/4.
    fn level(&self, point: Point3D) -> (f64, Vector3D) {
        let p = point.to_vector() / self.radius;
        let cubes = Vector3D::new(p.x.powi(3), p.y.powi(3), p.z.powi(3));
        (p.dot(cubes) - 1.0, cubes)
    }
}

impl Primitive for Cushion {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        // How far it reaches along an axis of the world: Hölder's inequality with the exponents 4 and 4/3.
        let centre = m.origin();
        let mut image = BoundingBox3D { lower: centre, upper: centre };
        for axis in 0..3 {
            let row: f64 = (0..3).map(|column| m.get(axis, column).abs().powf(4.0 / 3.0)).sum();
            let reach = self.radius * row.powf(0.75);
            image.pad_axis(axis, reach + 16.0 * f64::EPSILON * (reach + centre[axis].abs()));
        }
        image
    }

    fn contains(&self, point: Point3D) -> bool {
        self.level(point).0 <= 0.0
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        // In units of the radius, and from the place nearest to the centre: no digits are lost for distant rays.
        let length = ray.direction.length();
        let d = ray.direction / length;
        let nearest = -ray.origin.to_vector().dot(d);
        let o = (ray.origin.to_vector() + d * nearest) / self.radius;
        let sum = |f: fn(f64, f64) -> f64| f(o.x, d.x) + f(o.y, d.y) + f(o.z, d.z);
        let roots = solve_quartic(
            sum(|_, d| d.powi(4)),
            4.0 * sum(|o, d| o * d.powi(3)),
            6.0 * sum(|o, d| o * o * d * d),
            4.0 * sum(|o, d| o.powi(3) * d),
            sum(|o, _| o.powi(4)) - 1.0,
        );
        // It is convex: there is a way in and a way out, or none.
        if let (Some(first), Some(last)) = (roots.first(), roots.last())
            && first < last
        {
            let at = |root: f64| (nearest + root * self.radius) / length;
            let crossing =
                |root, exiting| Crossing { distance: at(root), feature: Feature::default(), exiting };
            out.extend([crossing(*first, false), crossing(*last, true)]);
        }
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        // A step of Newton's method takes the rounding of the distance away.
        let mut point = ray.point_at(crossing.distance);
        for _ in 0..2 {
            let (level, gradient) = self.level(point);
            point = point - gradient * (0.25 * self.radius * level / gradient.length_squared());
        }
        let normal = Normal3D::from(self.level(point).1).normalise_unchecked();
        let bound = 16.0 * f64::EPSILON * self.radius;
        Surface { point, normal, shading_normal: normal, bound }
    }

    fn is_convex(&self) -> bool {
        true
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    for radius in [1e-9, 1.0, 1e9] {
        check_primitive(&Cushion { radius }, 10_000, 1)?;
    }
    if !arguments.shot.quiet {
        println!("a cushion keeps the contract of shapes");
    }

    let mut world = studio::studio()?;
    let cushions: [(f64, Node<_>); 3] = [
        (2.1, Cushion { radius: 0.8 }.material(paint(0.75, 0.15, 0.12)?)),
        (0.0, Cushion { radius: 0.8 }.material(schott("N-BK7")?)),
        (-2.1, Cushion { radius: 0.8 }.material(paint(0.1, 0.4, 0.75)?)),
    ];
    for (x, cushion) in cushions {
        world.add(cushion.transform(translate(x, 0.8, 0.0) * rotate(30.0, 0.0, 0.0)))?;
    }
    arguments.shot.take("custom_primitive", &world, shot::viewpoint(9.0, 0.7, 20.0), 41.0)?;
    Ok(())
}
