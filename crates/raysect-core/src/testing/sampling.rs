//! What a shape says of its own samples, against the rays that meet it.

use raysect_math::{Rng, Vector3D};

use crate::{BoundingBox3D, Crossing, Interval, Primitive, Ray, Scratch, Surface, SurfaceSampling};

/// Sampled points lie on the surface, sampled directions meet it, and the densities integrate to one.
pub(super) fn check_sampling(
    shape: &dyn Primitive,
    bounds: &BoundingBox3D,
    rng: &mut Rng,
    count: usize,
) -> Result<(), String> {
    let sphere = bounds.enclosing_sphere();
    let from = sphere.centre + Vector3D::new(0.48, -0.64, 0.6) * (2.5 * sphere.radius);
    let mut scratch = Scratch::default();
    let mut first_hit = |direction: Vector3D| {
        let ray = Ray::new(from, direction);
        let hit = shape.hit(&ray, Interval::AHEAD, &mut scratch)?;
        Some((hit, shape.surface(&ray, &hit)))
    };
    // Points of a shape that is not convex may be chosen behind others: all that lie in a direction count.
    let (mut scratch_of_all, mut crossings) = (Scratch::default(), Vec::new());
    let counted = if shape.is_convex() { 1 } else { usize::MAX };
    let mut hits_along = |direction: Vector3D| -> Vec<(Crossing, Surface)> {
        let ray = Ray::new(from, direction);
        crossings.clear();
        shape.crossings(&ray, &mut scratch_of_all, &mut crossings);
        let ahead = crossings.iter().filter(|c| c.distance >= 0.0).take(counted);
        ahead.map(|c| (*c, shape.surface(&ray, c))).collect()
    };
    // The density of a direction integrates to one over the sphere of directions about `from`.
    let cone = (sphere.radius / from.distance_to(sphere.centre)).min(1.0);
    let cosine = (1.0 - cone * cone).sqrt();
    let axis = from.vector_to(sphere.centre).normalise_unchecked();
    let turn = |rng: &mut Rng| {
        let z = rng.range(cosine, 1.0);
        let (phi, r) = (rng.range(0.0, std::f64::consts::TAU), (1.0 - z * z).sqrt());
        let Ok(x) = axis.orthogonal() else { return axis };
        x * (r * phi.cos()) + axis.cross(x) * (r * phi.sin()) + axis * z
    };
    let kind = shape.surface_sampling();
    if kind == SurfaceSampling::None {
        return Ok(());
    }
    let density_along = |direction: Vector3D, hits: &[(Crossing, Surface)]| -> f64 {
        let of_point = |(hit, surface): &(Crossing, Surface)| {
            let cosine = surface.normal.dot(direction).abs();
            let squared = from.vector_to(surface.point).length_squared();
            shape.surface_density(from, surface.point, hit.feature) * squared / cosine
        };
        match kind {
            SurfaceSampling::SolidAngle if hits.is_empty() => 0.0,
            SurfaceSampling::SolidAngle => shape.direction_density(from, direction),
            _ => hits.iter().map(of_point).sum(),
        }
    };
    let (mut sum, mut squares, mut met, mut refused) = (0.0, 0.0, 0, 0);
    let solid_angle = std::f64::consts::TAU * (1.0 - cosine);
    let tries = 20_000.max(count);
    for _ in 0..tries {
        let direction = turn(rng);
        let hits = hits_along(direction);
        met += usize::from(!hits.is_empty());
        // A shape that is not convex may refuse draws; they count with their probability.
        let u = [rng.uniform(), rng.uniform(), rng.uniform()];
        let refuses =
            !shape.is_convex() && kind == SurfaceSampling::Area && shape.sample_surface(from, u).is_none();
        refused += usize::from(refuses);
        let x = density_along(direction, &hits) * solid_angle + f64::from(u8::from(refuses));
        sum += x;
        squares += x * x;
    }
    let n = tries as f64;
    let (mean, error) = (sum / n, ((squares / n - (sum / n).powi(2)).max(0.0) / n).sqrt());
    // A shape that hardly any direction meets is too thin to judge in this way.
    if met > 50 && ((mean - 1.0).abs() > 5.0 * error + 1e-9 || refused == tries) {
        return Err(format!(
            "the sampling density integrates to {mean} ± {error}, {refused} of {tries} draws refused"
        ));
    }
    for _ in 0..count {
        let u = [rng.uniform(), rng.uniform(), rng.uniform()];
        let (direction, claimed, computed) = match kind {
            SurfaceSampling::SolidAngle => {
                let Some(s) = shape.sample_direction(from, [u[0], u[1]]) else { continue };
                (s.direction, s.density, shape.direction_density(from, s.direction))
            }
            _ => {
                let Some(s) = shape.sample_surface(from, u) else { continue };
                let direction = from.vector_to(s.point).normalise_unchecked();
                let Some((hit, surface)) = first_hit(direction) else {
                    return Err(format!("sampled point {:?} is not on the surface", s.point));
                };
                if surface.point.distance_to(s.point) > 1e-9 * sphere.radius && shape.is_convex() {
                    return Err(format!(
                        "sampled point {:?} is hidden: first hit {:?}",
                        s.point, surface.point
                    ));
                }
                (direction, s.density, shape.surface_density(from, s.point, hit.feature))
            }
        };
        if (claimed / computed - 1.0).abs() > 1e-6 {
            return Err(format!(
                "sampled with density {claimed}, reported as {computed} along {direction:?}"
            ));
        }
    }
    Ok(())
}
