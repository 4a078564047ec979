//! Media of unknown structure, which are asked at places of their own.

use raysect_core::Ray;

use super::part::Part;
use super::room::LineRoom;
use crate::path::Path;
use crate::path::media::MediaList;
use crate::{Coefficients, Structure};

/// A place where a medium of unknown structure is asked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) distance: f64,
    pub(super) weight: f64,
    pub(super) instance: u32,
    /// Which part of what fills the instance.
    pub(super) part: u32,
}

impl Path<'_> {
    /// Chooses where the media of unknown structure are asked, with the length that each place stands for.
    pub(super) fn place_samples(
        &mut self,
        media: &MediaList,
        ray: &Ray,
        distance: f64,
        samples: &mut Vec<Sample>,
    ) {
        let mut rng = self.rng.clone();
        self.each_part(media, |Part { instance, number, .. }, structure| {
            let scale = {
                let to_local = &self.scene.instances[instance as usize].to_local;
                to_local.transform_vector(ray.direction).length()
            };
            let local = distance * scale;
            match structure {
                Structure::Unknown { step } => {
                    let steps = (local / step).ceil().max(1.0);
                    let width = distance / steps;
                    let place = |i: usize, u: f64| Sample {
                        distance: (i as f64 + u) * width,
                        weight: width,
                        instance,
                        part: number,
                    };
                    samples.extend((0..steps as usize).map(|i| place(i, rng.uniform())));
                }
                Structure::Trapezium { step, points } => {
                    let steps = (f64::from(points) - 1.0).max((local / step).floor()).max(1.0);
                    let width = distance / steps;
                    samples.extend((0..=steps as usize).map(|i| {
                        let end = i == 0 || i == steps as usize;
                        let weight = if end { 0.5 * width } else { width };
                        Sample { distance: (i as f64 * width).min(distance), weight, instance, part: number }
                    }));
                }
                Structure::Homogeneous | Structure::Smooth { .. } => {}
            }
        });
        self.rng = rng;
    }

    /// Adds the emission of a medium of unknown structure at one place, seen through what lies before it.
    pub(super) fn take_sample(&mut self, room: &mut LineRoom, ray: &Ray, number: usize) {
        let Sample { distance, weight, instance, part } = room.samples[number];
        let Some(medium) = self.medium(instance) else { return };
        let mut emission = std::mem::take(&mut self.emitted);
        let mut attenuation = std::mem::take(&mut self.attenuation);
        let mut scattering = std::mem::take(&mut self.scattering);
        emission.fill(0.0);
        let mut out = Coefficients {
            emission: &mut emission,
            attenuation: &mut attenuation,
            scattering: &mut scattering,
        };
        Part::whole(instance, medium).each(&mut |found, _| {
            if found.number == part {
                self.ask_part(found, ray, distance, &mut out);
            }
        });
        for (i, emission) in emission.iter().enumerate() {
            room.sum.light[i] += weight * emission * (-room.sum.depth[i]).exp();
        }
        (self.emitted, self.attenuation, self.scattering) = (emission, attenuation, scattering);
    }
}
