//! Settings of materials that make no sense are refused when they are observed, by value and limit.

use std::sync::Arc;

use raysect_math::{AffineMatrix3D, Point3D, Rng, Vector3D};
use raysect_optical::{
    Add, AnisotropicSurfaceEmitter, Blend, Checkerboard, Dielectric, Facts, HomogeneousVolumeEmitter,
    InhomogeneousVolumeEmitter, InterpolatedSf, Lambert, Material, Path, ProfileVolume, Ray, Roughen,
    Scatter, SurfaceHit, UniformSurfaceEmitter, UniformVolume, UnitySurfaceEmitter, VolumeTransform,
    WithMaterial, World,
};
use raysect_primitive::Sphere;

/// What a ray of some bins says of a ball of a material; nothing if it is traced.
fn refusal(material: Arc<dyn Material>, (min, max, bins): (f64, f64, usize)) -> Option<String> {
    let mut world = World::new();
    world.add(Sphere::new(1.0).unwrap().material(material)).unwrap();
    world.add(Sphere::new(9.0).unwrap().material(UnitySurfaceEmitter::new())).unwrap();
    let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z).spectrum(min, max, bins);
    ray.trace(&world).err().map(|error| error.to_string())
}

const BINS: (f64, f64, usize) = (400.0, 700.0, 3);

/// A material of a user.
struct Own(f64);

impl Material for Own {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }
    fn facts(&self) -> Facts {
        Facts { importance: self.0, ..Facts::named("own") }
    }
}

/// Everything that has an importance.
fn important(importance: f64) -> Vec<Arc<dyn Material>> {
    let volume = || UniformVolume::emitter(1.0).importance(importance);
    let lamp: Arc<dyn Material> = Arc::new(UniformSurfaceEmitter::new(1.0, 1.0).importance(importance));
    let grey: Arc<dyn Material> = Arc::new(Lambert::new(0.5));
    let glass = Dielectric::new(1.5, 1.0).unwrap().importance(importance);
    let shared: Arc<dyn Material> = Arc::new(volume());
    vec![
        Arc::new(Own(importance)),
        lamp.clone(),
        Arc::new(UnitySurfaceEmitter::new().importance(importance)),
        Arc::new(Checkerboard::new(0.1).unwrap().importance(importance)),
        Arc::new(AnisotropicSurfaceEmitter::new(|_, _, _, bins| bins.fill(1.0)).importance(importance)),
        Arc::new(HomogeneousVolumeEmitter::new(|_, _, _| {}).importance(importance)),
        Arc::new(InhomogeneousVolumeEmitter::jittered(0.1, |_, _, _, _| {}).unwrap().importance(importance)),
        Arc::new(volume()),
        Arc::new(ProfileVolume::new(volume(), |_| 1.0, 1.0, 1.0).unwrap()),
        Arc::new(VolumeTransform::new(shared, AffineMatrix3D::IDENTITY).unwrap()),
        Arc::new(glass),
        Arc::new(Add::new(grey.clone(), lamp.clone())),
        Arc::new(Blend::new(lamp.clone(), grey, 0.3).unwrap()),
        Arc::new(Roughen::new(lamp, 0.2).unwrap()),
    ]
}

#[test]
fn an_importance_is_finite_and_not_negative() {
    for importance in [-1.0, -1e-300, f64::INFINITY, f64::NAN] {
        for material in important(importance) {
            let name = material.facts().name;
            let message = refusal(material, BINS).unwrap_or_else(|| panic!("{name} of {importance}"));
            for part in ["importance of a material", &format!("{importance}"), "finite and not negative"] {
                assert!(message.contains(part), "{name}: {message}");
            }
        }
    }
    for importance in [0.0, -0.0, 1e-300, 1.0, 1e300] {
        for material in important(importance) {
            let name = material.facts().name;
            assert_eq!(refusal(material, BINS), None, "{name} of {importance}");
        }
    }
}

#[test]
fn a_reflectivity_lies_between_nothing_and_all() {
    for reflectivity in [-0.1, 1.1, 1.000_001, f64::INFINITY, f64::NAN] {
        let message = refusal(Arc::new(Lambert::new(reflectivity)), BINS).unwrap();
        assert!(
            message.contains("reflectivity of a diffuse surface") && message.contains("0 … 1"),
            "{message}"
        );
        assert!(message.contains(&format!("{reflectivity}")), "{message}");
    }
    // Only where it is looked at.
    let slope = InterpolatedSf::new([400.0, 600.0, 601.0], [0.5, 0.9, 1.2]).unwrap();
    assert_eq!(refusal(Arc::new(Lambert::new(slope.clone())), (400.0, 600.0, 5)), None);
    assert!(refusal(Arc::new(Lambert::new(slope)), (400.0, 700.0, 5)).is_some());
    for reflectivity in [0.0, 1.0] {
        assert_eq!(refusal(Arc::new(Lambert::new(reflectivity)), BINS), None);
    }
}

#[test]
fn averages_of_ones_are_not_refused_for_their_rounding() {
    let mut rng = Rng::new(1);
    for _ in 0..200 {
        let mut at = rng.range(150.0, 350.0);
        let wavelengths: Vec<f64> = (0..400)
            .map(|_| {
                at += rng.range(0.01, 10.0);
                at
            })
            .collect();
        let ones = InterpolatedSf::new(wavelengths.clone(), vec![1.0; 400]).unwrap();
        // Narrow bins about a knot.
        let width = 10f64.powf(rng.range(-6.0, 2.0));
        let (min, max) = (wavelengths[200] - 0.3 * width, wavelengths[200] + 0.9 * width);
        let bins = (min, max, 3);
        assert_eq!(refusal(Arc::new(Lambert::new(ones.clone())), bins), None, "{bins:?}");
        assert_eq!(refusal(Arc::new(Dielectric::new(1.5, ones).unwrap()), bins), None, "{bins:?}");
    }
}
