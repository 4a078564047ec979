//! How bright lights are beside each other, in the bins that a path carries.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::sync::{Arc, Mutex, PoisonError};

use raysect_core::{Candidate, Ray, Scratch};
use raysect_math::{Rng, Vector3D};

use super::Light;
use crate::{Context, Scene, Slice, SurfaceHit};

/// From so many places around it a light is looked at.
const SIGHTS: u32 = 16;
/// From so far, in radii of its bounding sphere.
const DISTANCE: f64 = 3.0;
/// No light is taken to be dimmer than this share of the brightest: a few sights may have missed what it sends out.
const DIMMEST: f64 = 0.02;

/// What has been found for each range of bins: of every light its radiance, in units of the largest.
#[derive(Debug, Default)]
pub(crate) struct Brightness(Mutex<BTreeMap<[u64; 3], Arc<[f64]>>>);

impl Brightness {
    /// The brightness of each light in the bins of a slice; it is looked for once.
    pub(crate) fn of(&self, scene: &Scene, lights: &[Light], slice: &Slice) -> Arc<[f64]> {
        if lights.len() < 2 {
            return lights.iter().map(|_| 1.0).collect();
        }
        let key = [slice.min.to_bits(), slice.max.to_bits(), slice.bins as u64];
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(key).or_insert_with(|| compare(scene, lights, slice)).clone()
    }
}

fn compare(scene: &Scene, lights: &[Light], slice: &Slice) -> Arc<[f64]> {
    let radiances: Vec<f64> = lights.iter().map(|light| mean_radiance(scene, light, slice)).collect();
    let most = radiances.iter().copied().fold(0.0, f64::max);
    radiances.iter().map(|radiance| if most > 0.0 { (radiance / most).max(DIMMEST) } else { 1.0 }).collect()
}

/// The mean over the bins of what a light sends out, from all around.
fn mean_radiance(scene: &Scene, light: &Light, slice: &Slice) -> f64 {
    let material = scene.instances[light.instance as usize].attached.material();
    let (mut rng, mut scratch, mut bins) = (Rng::new(0), Scratch::default(), vec![0.0; slice.bins]);
    let middle = 0.5 * (slice.min + slice.max);
    let context = Context { slice, index_in: 1.0, index_out: 1.0, wavelength: middle };
    let mut sum = 0.0;
    for sight in 0..SIGHTS {
        let from = light.sphere.centre + spiral(sight) * (DISTANCE * light.sphere.radius);
        let Some(drawn) = light.sample(scene, from, 0, &mut rng) else { continue };
        let direction = drawn.direction;
        let hit = drawn.hit.or_else(|| {
            let ray = Ray::new(from, direction);
            let crossing = scene.hit_instance(light.instance, &ray, None, f64::INFINITY, &mut scratch)?;
            let surface = scene.finish(&ray, &Candidate { instance: light.instance, crossing });
            Some(SurfaceHit { surface, direction })
        });
        if hit.is_some_and(|hit| material.emit(&hit, context, &mut bins)) {
            sum += bins.iter().filter(|radiance| radiance.is_finite() && **radiance > 0.0).sum::<f64>();
        }
    }
    sum / f64::from(SIGHTS)
}

/// Directions that are spread over the sphere (R. Swinbank and R. J. Purser, *Fibonacci grids*, Q. J. R. Meteorol. Soc.
/// 132, 2006).
fn spiral(number: u32) -> Vector3D {
    let z = 1.0 - (2.0 * f64::from(number) + 1.0) / f64::from(SIGHTS);
    let (sine, angle) = (((1.0 - z) * (1.0 + z)).sqrt(), f64::from(number) * PI * (3.0 - 5f64.sqrt()) % TAU);
    Vector3D::new(sine * angle.cos(), sine * angle.sin(), z)
}
