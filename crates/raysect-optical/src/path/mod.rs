//! The path integrator: follows one path through a scene and adds up what it sees.

mod collision;
mod dispersion;
mod ledger;
mod line;
mod log;
mod media;
mod scatter;
mod settings;

use std::sync::Arc;

use raysect_core::{Leaving, Ray, Scratch};
use raysect_math::{Point3D, Rng, Vector3D};

pub use dispersion::Dispersion;
use dispersion::Wavelengths;
pub use ledger::{LEDGER_NUMBERS, Ledger};
use line::LineRoom;
use log::PathLog;
pub use log::{LoggedPath, PathEvent, PathVertex, VertexHit};
use media::{Coincident, MediaList};
pub use settings::{LightSampling, PathSettings};

use crate::illumination::{Vertex, light_density};
use crate::{Context, Scatter, Scene, Slice, SurfaceHit};

/// A surface may be passed straight through this often in a row before a path is given up as caught between
/// transparent surfaces.
const PASSES: u32 = 100_000;

/// So many scatterings that leave no choice of a direction are not played for.
const SPECULAR: u32 = 32;

/// One path through a scene, against the light, and the room that it needs: made once per worker and reused.
///
/// A path carries a throughput, which surfaces and media reduce, and adds throughput × emission to its radiance
/// wherever it meets some (J. Kajiya, *The rendering equation*, SIGGRAPH 1986). Emission that can be found both by
/// light sampling and by chance is weighted by how likely each was (E. Veach and L. Guibas, *Optimally Combining
/// Sampling Techniques for Monte Carlo Rendering*, SIGGRAPH 1995).
#[derive(Debug)]
pub struct Path<'a> {
    scene: &'a Scene,
    slice: &'a Slice,
    settings: &'a PathSettings,
    rng: Rng,
    scratch: Scratch,
    /// Of each light beside the others.
    brightness: Arc<[f64]>,
    ledger: Ledger,
    throughput: Vec<f64>,
    radiance: Vec<f64>,
    /// The scattering function, the emission and the attenuation of the moment, bin by bin.
    reflected: Vec<f64>,
    emitted: Vec<f64>,
    attenuation: Vec<f64>,
    /// Scattering by media, bin by bin.
    scattering: Vec<f64>,
    line: LineRoom,
    media: MediaList,
    /// The media whose boxes hold the last origin of a path: cameras send many rays from one place.
    start: Option<(Point3D, MediaList)>,
    /// Refractive indices before and behind the surface of the moment.
    indices: (f64, f64),
    /// Other refracting surfaces at the place of the moment.
    coincident: Coincident,
    /// How much more often than by its surfaces alone the path was sent where it goes: at the last scattering, and
    /// by all of them together.
    favour: f64,
    carried: f64,
    depth: u32,
    leaving: Option<Leaving>,
    /// The last place of scattering, and the density of the direction chosen there; none for a delta.
    vertex: Vertex,
    density: Option<f64>,
    waves: Wavelengths,
}

impl<'a> Path<'a> {
    /// Room for paths through a scene that carry the bins of a slice.
    pub fn new(scene: &'a Scene, slice: &'a Slice, settings: &'a PathSettings) -> Self {
        let zeros = || vec![0.0; slice.bins];
        Self {
            scene,
            slice,
            settings,
            rng: Rng::new(0),
            scratch: Scratch::default(),
            brightness: scene.compiled.brightness.of(scene, &scene.compiled.lights, slice),
            ledger: Ledger::default(),
            throughput: zeros(),
            radiance: zeros(),
            reflected: zeros(),
            emitted: zeros(),
            attenuation: zeros(),
            scattering: zeros(),
            line: LineRoom::default(),
            media: MediaList::default(),
            start: None,
            indices: (1.0, 1.0),
            favour: 1.0,
            carried: 1.0,
            depth: 0,
            leaving: None,
            vertex: Vertex { point: Point3D::ORIGIN, instance: None },
            coincident: Coincident::default(),
            density: None,
            waves: Wavelengths::new(
                scene.compiled.any_dispersion && settings.dispersion == Dispersion::Sampled,
            ),
        }
    }

    /// Follows a path from a ray, whose direction may have any length, with the given random numbers. The answer is
    /// the radiance that arrives at the origin of the ray [W/m²/sr/nm], one value a bin.
    pub fn follow(&mut self, ray: &Ray, rng: Rng) -> &[f64] {
        self.rng = rng;
        self.depth = 0;
        self.run::<false>(ray, &mut PathLog::default());
        self.count_collected();
        &self.radiance
    }

    /// Follows a path as [`follow`](Self::follow) does, with the same bits, and notes all that happens to it.
    pub fn follow_logged(&mut self, ray: &Ray, rng: Rng) -> LoggedPath {
        self.rng = rng;
        self.depth = 0;
        let (before, mut log) = (self.ledger, PathLog::default());
        self.run::<true>(ray, &mut log);
        self.count_collected();
        log.finish(self, &before)
    }

    /// The radiance of the path last followed, one value a bin.
    pub fn radiance(&self) -> &[f64] {
        &self.radiance
    }

    /// What has become of the paths followed so far.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The random numbers of the path.
    #[inline]
    pub fn rng(&mut self) -> &mut Rng {
        &mut self.rng
    }

    /// What part of the light is still on its way, bin by bin; a material multiplies it by what it reflects.
    #[inline]
    pub fn throughput(&mut self) -> &mut [f64] {
        &mut self.throughput
    }

    /// Multiplies the throughput of all bins by a factor.
    #[inline]
    pub fn scale(&mut self, factor: f64) {
        self.throughput.iter_mut().for_each(|t| *t *= factor);
    }

    /// How often the path has been scattered.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// The slice of the spectrum that the path carries.
    pub fn slice(&self) -> &'a Slice {
        self.slice
    }

    /// What is known at the surface of the moment.
    #[inline]
    pub fn context(&self) -> Context<'a> {
        Context {
            slice: self.slice,
            index_in: self.indices.0,
            index_out: self.indices.1,
            wavelength: self.waves.kept.unwrap_or(0.5 * (self.slice.min + self.slice.max)),
        }
    }

    /// The radiance that arrives along another ray, into `out`: for the rare material that must look elsewhere.
    /// It follows one more path, as deep in the recursion as this one, with room of its own; where that would be too deep it
    /// is counted as cut off.
    pub fn trace(&mut self, ray: &Ray, out: &mut [f64]) {
        let mut other = Path::new(self.scene, self.slice, self.settings);
        other.rng = Rng::new(self.rng.bits());
        other.depth = self.depth + 1;
        if other.depth < self.settings.max_depth {
            other.run::<false>(ray, &mut PathLog::default());
            other.count_collected();
        } else {
            other.ledger.paths += 1;
            other.ledger.truncated += 1;
            other.ledger.truncated_throughput += self.mean_throughput();
        }
        out.copy_from_slice(&other.radiance);
        self.ledger.add_numbers(&other.ledger.to_numbers());
    }

    /// Notes whether the path at its end has brought light.
    #[inline]
    fn count_collected(&mut self) {
        self.ledger.collected += u64::from(self.radiance.iter().any(|r| *r != 0.0));
    }

    fn mean_throughput(&self) -> f64 {
        self.throughput.iter().sum::<f64>() / self.throughput.len() as f64
    }

    /// Follows a path to its end. What happens to it goes into the log if it is `LOGGED`, and costs nothing otherwise.
    fn run<const LOGGED: bool>(&mut self, ray: &Ray, log: &mut PathLog) {
        self.throughput.fill(1.0);
        self.radiance.fill(0.0);
        self.ledger.paths += 1;
        self.leaving = None;
        self.density = None;
        self.waves.restart();
        self.vertex = Vertex { point: ray.origin, instance: None };
        self.indices = (1.0, 1.0);
        let length = ray.direction.length();
        let end = ray.max_distance * length;
        let mut ray = Ray::new(ray.origin, ray.direction * (1.0 / length)).with_max_distance(end);
        self.surround(&ray);
        self.carried = 1.0;
        if LOGGED {
            log.start(self, ray.origin);
        }
        let (mut passes, mut pieces) = (0, end.is_finite());
        loop {
            self.ledger.rays += 1;
            let hit = self.scene.hit(&ray, self.leaving.as_ref(), &mut self.scratch);
            if !self.media.is_empty() {
                let distance = hit.map_or(ray.max_distance, |h| h.crossing.distance);
                let turbid = self.is_turbid(&self.media);
                self.cross_media(&ray, distance, turbid);
                if turbid && let Some(flight) = self.free_flight(&ray, distance) {
                    if LOGGED {
                        log.arrive(self, ray.point_at(flight));
                    }
                    let Some((direction, scatterer)) = self.scatter_in_volume(&ray, flight) else {
                        self.ledger.absorbed += 1;
                        return;
                    };
                    if LOGGED {
                        log.meet_volume(self, scatterer, ray.point_at(flight));
                    }
                    (self.leaving, passes, pieces) = (None, 0, false);
                    self.depth += 1;
                    if !self.survives() {
                        return;
                    }
                    if LOGGED {
                        log.leave(self, PathEvent::Scattered);
                    }
                    ray = Ray::new(ray.point_at(flight), direction);
                    continue;
                }
            }
            let Some(hit) = hit else {
                // Volumes are closed: a ray that leaves one without a surface has lost its way.
                let lost = !self.media.is_empty() && ray.max_distance.is_infinite();
                *(if lost { &mut self.ledger.lost } else { &mut self.ledger.escaped }) += 1;
                if LOGGED {
                    log.arrive_nowhere(self, &ray);
                }
                return;
            };
            let at = SurfaceHit { surface: self.scene.finish(&ray, &hit), direction: ray.direction };
            let surface = &at.surface;
            if LOGGED {
                log.arrive(self, surface.point);
                log.meet_surface(self, surface);
            }
            let scatter = if self.enter_interface(&at) { self.meet(&at) } else { Scatter::PassThrough };
            let direction = match scatter {
                Scatter::Absorbed => {
                    self.ledger.absorbed += 1;
                    return;
                }
                Scatter::PassThrough => {
                    passes += 1;
                    ray.direction
                }
                Scatter::Continue { direction } => {
                    passes = 0;
                    self.vertex = Vertex { point: surface.point, instance: Some(surface.instance) };
                    self.depth += 1;
                    if !self.survives() {
                        return;
                    }
                    direction
                }
            };
            if passes > PASSES {
                self.ledger.lost += 1;
                return;
            }
            if LOGGED {
                let chosen = self.density.is_some();
                log.leave(self, PathEvent::of(scatter, chosen, at.leads_through(direction)));
            }
            Leaving::renew(&mut self.leaving, surface, ray.direction, direction);
            if self.scene.compiled.any_medium && at.leads_through(direction) {
                self.change_medium(surface);
            }
            // A ray that ends somewhere ends there also behind a transparent surface, but not round a corner.
            pieces &= matches!(scatter, Scatter::PassThrough);
            let rest = if pieces { ray.max_distance - surface.distance } else { f64::INFINITY };
            ray = Ray::new(surface.point, direction).with_max_distance(rest);
        }
    }

    /// Collects what a surface emits, then asks its material how to go on.
    fn meet(&mut self, at: &SurfaceHit) -> Scatter {
        let scene = self.scene;
        let facts = &scene.compiled.facts[at.surface.instance as usize];
        let material = scene.instances[at.surface.instance as usize].attached.material();
        if facts.emits && material.emit(at, self.context(), &mut self.emitted) {
            let weight = match (facts.light, self.density) {
                (Some(light), Some(density)) if self.settings.light_sampling == LightSampling::Lights => {
                    let other = light_density(
                        scene,
                        &self.brightness,
                        light,
                        &self.vertex,
                        at.direction,
                        &at.surface,
                    );
                    heuristic(density, other)
                }
                _ => 1.0,
            };
            let emitted = self.throughput.iter().zip(&self.emitted);
            self.radiance.iter_mut().zip(emitted).for_each(|(r, (t, e))| *r += t * e * weight);
        }
        let before = self.density.take();
        self.favour = 1.0;
        let scatter = material.surface(at, self);
        if scatter == Scatter::PassThrough && facts.transparent {
            // Straight on through a null surface the last real vertex still counts. A surface that lets pass without
            // being transparent stops shadow rays: what is found behind it has been found by chance alone.
            self.density = before;
        }
        scatter
    }

    /// Ends paths that carry little any more, in fair play: the survivors carry the share of the dead
    /// (J. Arvo and D. Kirk, *Particle Transport and Image Synthesis*, SIGGRAPH 1990). What counts is what the
    /// surfaces have left of the light, not how often paths were aimed the same way. Also ends paths that are too
    /// deep, which is not fair and therefore reported.
    #[inline(always)]
    fn survives(&mut self) -> bool {
        let largest = self.brightest();
        if largest <= 0.0 {
            self.ledger.absorbed += 1;
            return false;
        }
        if self.depth >= self.settings.max_depth {
            self.ledger.truncated += 1;
            self.ledger.truncated_throughput += self.mean_throughput();
            return false;
        }
        self.carried *= self.favour;
        let (threshold, left) = (self.settings.roulette_threshold, largest * self.carried);
        // Mirrors and clear interfaces leave a path no choice: a dim reading through dark glass stays without noise.
        let chosen = self.density.is_some() || self.depth > SPECULAR;
        if chosen && left < threshold {
            if !self.rng.probability(left / threshold) {
                self.ledger.killed += 1;
                return false;
            }
            self.scale(threshold / left);
        }
        true
    }
}

/// The power heuristic of two techniques that both draw one sample (Veach and Guibas 1995, § 3.4), without the
/// overflow of squared densities.
#[inline]
fn heuristic(mine: f64, other: f64) -> f64 {
    let ratio = other / mine;
    1.0 / (1.0 + ratio * ratio)
}

/// A direction as the integrator wants it: exactly along `direction`, of unit length.
#[inline]
fn unit(direction: Vector3D) -> Vector3D {
    direction.normalise_unchecked()
}
