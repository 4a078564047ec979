//! Refraction by wavelength: bins that share a path are each as bright as if they were alone.

use std::sync::Arc;

use raysect::core::Node;
use raysect::math::{Point3D, Vector3D};
use raysect::optical::{
    Context, Dielectric, Dispersion, Facts, IndexUse, InterpolatedSf, Lambert, LightSampling, Material,
    Medium, Optics, Path, PathSettings, Ray, RoughConductor, RoughDielectric, SampledSpectrum, Scatter,
    Sellmeier, SurfaceHit, UniformSurfaceEmitter, WithMaterial, World,
};
use raysect::primitive::{Cuboid, Sphere};

use crate::scenes::{ball, cuboid, dome, world};

/// A ball of heavy flint before a lamp with edges, seen from the other side.
fn flint_ball() -> World {
    let flint = Sellmeier::new([1.73759695, 0.313747346, 1.89878101], [0.013188707, 0.0623068142, 155.23629]);
    let glass = Dielectric::new(flint.unwrap(), 1.0).unwrap();
    let node: Node<Optics> = Sphere::new(1.0).unwrap().material(glass);
    let lamp = Cuboid::new(Point3D::new(-0.5, -1.4, 3.0), Point3D::new(0.5, -1.016, 3.0)).unwrap();
    world([node, lamp.material(UniformSurfaceEmitter::new(1.0, 1.0))])
}

#[test]
fn a_wide_bin_is_the_average_of_narrow_ones_where_wavelengths_are_sampled() {
    let world = flint_ball();
    let (origin, direction) = (Point3D::new(0.0, 0.5, -5.0), Vector3D::Z);
    let ray = Ray::new(origin, direction).spectrum(380.0, 740.0, 1);
    let settings = |d| PathSettings::default().dispersion(d);
    let sampled = ray.clone().settings(settings(Dispersion::Sampled)).sample(&world, 20_000).unwrap();
    let mean = ray.clone().settings(settings(Dispersion::Mean)).sample(&world, 2000).unwrap();
    let (mut fine, mut variance) = (0.0, 0.0);
    for i in 0..360 {
        let (low, high) = (380.0 + f64::from(i), 381.0 + f64::from(i));
        let narrow = ray.clone().spectrum(low, high, 1).settings(settings(Dispersion::Mean)).seed(i as u64);
        let found = narrow.sample(&world, 200).unwrap();
        fine += found.mean.samples()[0] / 360.0;
        variance += (found.error[0] / 360.0).powi(2);
    }
    let z = |found: &SampledSpectrum| {
        (found.mean.samples()[0] - fine) / (found.error[0].powi(2) + variance).sqrt()
    };
    assert!(sampled.error[0] < 0.02 * fine, "{sampled:?}");
    assert!(z(&sampled).abs() < 4.0, "{} {fine}", sampled.mean.samples()[0]);
    assert!(z(&mean).abs() > 10.0, "{} {fine}", mean.mean.samples()[0]);
}

#[test]
fn bins_that_are_dispersed_together_are_right_each() {
    let world = flint_ball();
    let ray = Ray::new(Point3D::new(0.0, 0.5, -5.0), Vector3D::Z).spectrum(380.0, 740.0, 6);
    let together = ray.sample(&world, 60_000).unwrap();
    for bin in 0..6 {
        let (low, high) = (380.0 + 60.0 * bin as f64, 440.0 + 60.0 * bin as f64);
        let alone = ray.clone().spectrum(low, high, 1).seed(9).sample(&world, 10_000).unwrap();
        let (a, b) = (together.mean.samples()[bin], alone.mean.samples()[0]);
        let error = together.error[bin].hypot(alone.error[0]);
        assert!((a - b).abs() <= 4.0 * error, "bin {bin}: {a} and {b} ± {error}");
    }
}

const BINS: usize = 6;
/// Into how many a bin is cut to be traced alone.
const PARTS: usize = 20;
const RANGE: (f64, f64) = (400.0, 700.0);

/// An index from 1.3 to 1.8: all that glasses do, and more, in one spectrum.
fn strong() -> InterpolatedSf {
    InterpolatedSf::new([300.0, 800.0], [1.1333333333333333, 1.9666666666666666]).unwrap()
}

fn ground(roughness: f64) -> RoughDielectric {
    RoughDielectric::new(strong(), 1.0, roughness).unwrap()
}

/// The same surface under other facts.
struct Claiming<M>(M, IndexUse);

impl<M: Material> Material for Claiming<M> {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.0.emit(hit, at, out)
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        self.0.surface(hit, path)
    }
    fn medium(&self) -> Option<&dyn Medium> {
        self.0.medium()
    }
    fn facts(&self) -> Facts {
        Facts { index_use: self.1, ..self.0.facts() }
    }
}

/// A value and its standard error for each bin.
type Bins = Vec<(f64, f64)>;

/// What a ray reads in six bins that share paths.
fn together(world: &World, ray: &Ray, samples: u64) -> Bins {
    let found = ray.clone().spectrum(RANGE.0, RANGE.1, BINS).sample(world, samples).unwrap();
    found.mean.samples().iter().copied().zip(found.error).collect()
}

/// The same of bins of which each is cut in twenty, traced alone by their mean index.
fn alone(world: &World, ray: &Ray, settings: PathSettings, samples: u64) -> Bins {
    let width = (RANGE.1 - RANGE.0) / (BINS * PARTS) as f64;
    let settings = settings.dispersion(Dispersion::Mean);
    let bin = |bin: usize| {
        let (mut sum, mut variance) = (0.0, 0.0);
        for part in bin * PARTS..(bin + 1) * PARTS {
            let low = RANGE.0 + width * part as f64;
            let narrow = ray.clone().spectrum(low, low + width, 1).settings(settings.clone());
            let found = narrow.seed(part as u64 + 5).sample(world, samples / PARTS as u64).unwrap();
            sum += found.mean.samples()[0] / PARTS as f64;
            variance += (found.error[0] / PARTS as f64).powi(2);
        }
        (sum, variance.sqrt())
    };
    (0..BINS).map(bin).collect()
}

/// The largest difference in units of the errors of both.
fn largest_score(one: &Bins, other: &Bins) -> f64 {
    let scores = one.iter().zip(other).map(|((a, e), (b, f))| ((a - b) / e.hypot(*f)).abs());
    scores.fold(0.0, f64::max)
}

/// Asserts that all bins are right, to so many per cent of the brightest.
#[track_caller]
fn assert_right(case: &str, world: &World, ray: &Ray, samples: u64, percent: f64) -> Bins {
    let settings = PathSettings::default();
    let (all, each) = (together(world, ray, samples), alone(world, ray, settings, samples));
    let brightest = all.iter().fold(0.0, |most: f64, (mean, _)| most.max(*mean));
    let error = all.iter().map(|(_, error)| 100.0 * error / brightest).fold(0.0, f64::max);
    let score = largest_score(&all, &each);
    println!("{case}: {score:.2} standard errors, of {error:.2} %");
    assert!(error < percent, "{case}: {error}");
    assert!(score < 4.5, "{case}: {all:?} {each:?}");
    all
}

/// A ball before a lamp with an edge that dispersion moves across the view.
fn ball_before_edge(material: impl Material) -> World {
    let lamp = Cuboid::new(Point3D::new(-0.5, -1.4, 3.0), Point3D::new(0.5, -0.6, 3.0)).unwrap();
    let lamp = lamp.material(UniformSurfaceEmitter::new(1.0, 1.0).importance(0.0));
    world([Sphere::new(1.0).unwrap().material(material), lamp])
}

fn high() -> Ray {
    Ray::new(Point3D::new(0.0, 0.5, -5.0), Vector3D::Z)
}

#[test]
fn ground_glass_carries_all_bins_and_each_is_right() {
    for roughness in [0.02, 0.1, 0.4] {
        let world = ball_before_edge(ground(roughness));
        assert_right(&format!("roughness {roughness}"), &world, &high(), 100_000, 2.0);
    }
}

#[test]
fn bins_carried_together_have_smaller_errors_than_one_kept() {
    for (roughness, gain) in [(0.02, 1.1), (0.1, 1.8), (0.4, 2.0)] {
        let all = together(&ball_before_edge(ground(roughness)), &high(), 60_000);
        let kept = Claiming(ground(roughness), IndexUse::One);
        let kept = together(&ball_before_edge(kept), &high(), 60_000);
        assert!(largest_score(&all, &kept) < 4.0, "{roughness}: {all:?} {kept:?}");
        let ratio = all.iter().zip(&kept).map(|((_, e), (_, f))| f / e).sum::<f64>() / BINS as f64;
        println!("roughness {roughness}: errors {ratio:.2} times as large");
        assert!(ratio > gain, "{roughness}: {ratio}");
    }
}

#[test]
fn smooth_glass_that_claims_to_be_asked_for_each_bin_is_found_wrong() {
    let smooth = || Dielectric::new(strong(), 1.0).unwrap().importance(0.0);
    let right = together(&ball_before_edge(smooth()), &high(), 20_000);
    let wrong = together(&ball_before_edge(Claiming(smooth(), IndexUse::EachBin)), &high(), 20_000);
    assert!(largest_score(&right, &wrong) > 20.0, "{right:?} {wrong:?}");
}

/// A pool of a rough surface: glass above things that stand in it.
fn pool(roughness: f64, things: impl IntoIterator<Item = Node<Optics>>) -> World {
    let glass = cuboid([-4.0, -4.0, -3.0], [4.0, 4.0, 0.0]).material(ground(roughness));
    world([glass, dome()].into_iter().chain(things))
}

fn from_above() -> Ray {
    Ray::new(Point3D::new(0.0, 0.0, 2.0), Vector3D::new(0.05, 0.0, -1.0))
}

#[test]
fn surfaces_in_dispersing_glass_see_the_index_of_each_bin() {
    // Metal that reflects less the higher the index around it.
    let metal = |rough: bool| -> Arc<dyn Material> {
        if rough {
            Arc::new(RoughConductor::new(1.5, 1.0, 0.3).unwrap())
        } else {
            Arc::new(raysect::optical::Conductor::new(1.5, 1.0))
        }
    };
    for rough in [true, false] {
        let floor = cuboid([-3.0, -3.0, -2.0], [3.0, 3.0, -1.0]).material(metal(rough));
        let world = pool(0.2, [floor]);
        assert_right(&format!("metal, rough: {rough}"), &world, &from_above(), 100_000, 2.0);
        // Bins that all see one index would not pass.
        let claiming = Claiming(metal(rough), IndexUse::None);
        let floor = cuboid([-3.0, -3.0, -2.0], [3.0, 3.0, -1.0]).material(claiming);
        let wrong = together(&pool(0.2, [floor]), &from_above(), 100_000);
        let right = alone(&world, &from_above(), PathSettings::default(), 100_000);
        assert!(largest_score(&wrong, &right) > 6.0, "{wrong:?} {right:?}");
    }
}

/// Of radiance one in vacuum: in a medium it emits n² as much (Kirchhoff and Clausius).
struct BlackBody;

impl Material for BlackBody {
    fn emit(&self, _: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        out.fill(at.index_in * at.index_in);
        true
    }
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }
    fn facts(&self) -> Facts {
        Facts { importance: 1.0, ..Facts::emitter("black body") }
    }
}

#[test]
fn lamps_in_dispersing_glass_are_told_the_index_of_each_bin() {
    // A white floor under a black body in the pool: found by light sampling and by chance alike.
    let floor = || cuboid([-3.0, -3.0, -2.0], [3.0, 3.0, -1.0]).material(Lambert::new(0.9));
    let world = pool(0.2, [floor(), ball([1.2, 0.0, -0.6], 0.2, BlackBody)]);
    let looked = assert_right("black body", &world, &from_above(), 100_000, 2.0);
    let chance = from_above().settings(PathSettings::default().light_sampling(LightSampling::Off));
    let chance = together(&world, &chance, 300_000);
    assert!(largest_score(&looked, &chance) < 4.5, "{looked:?} {chance:?}");
}
