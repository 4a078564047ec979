//! Surfaces that scatter into a range of directions, against the contract of a [`Bsdf`], with surfaces that break it.

use std::f64::consts::FRAC_1_PI;

use raysect_math::{Rng, Vector3D};
use raysect_optical::testing::{BsdfTest, check_bsdf};
use raysect_optical::{Bsdf, Context, Lambert, Masking, RoughConductor, RoughDielectric, Slice, Slicing};

fn slice(bins: usize) -> Slice {
    Slicing::new(500.0, 600.0, bins, 1).unwrap().slices().remove(0)
}

/// A direction at an angle [deg] to the normal.
fn at_angle(degrees: f64) -> Vector3D {
    let (x, z) = degrees.to_radians().sin_cos();
    Vector3D::new(0.8 * x, 0.6 * x, z)
}

fn judge(bsdf: &dyn Bsdf, degrees: f64, indices: (f64, f64)) -> Result<Vec<f64>, String> {
    let slice = slice(1);
    let at = Context { slice: &slice, index_in: indices.0, index_out: indices.1, wavelength: 550.0 };
    check_bsdf(bsdf, &BsdfTest { at, incoming: at_angle(degrees), reciprocal: true, seed: 7 })
}

/// The albedo of a surface that keeps the contract.
#[track_caller]
fn albedo(bsdf: &dyn Bsdf, degrees: f64, indices: (f64, f64)) -> f64 {
    judge(bsdf, degrees, indices).unwrap_or_else(|what| panic!("{degrees} deg, {indices:?}: {what}"))[0]
}

#[test]
fn every_bin_has_its_own_albedo() {
    let slice = slice(2);
    let at = Context { slice: &slice, index_in: 1.0, index_out: 1.0, wavelength: 550.0 };
    let test = BsdfTest { at, incoming: at_angle(30.0), reciprocal: true, seed: 3 };
    let found = check_bsdf(&Lambert::new(|wavelength: f64| wavelength / 1000.0), &test).unwrap();
    assert!((found[0] - 0.525).abs() < 1e-6 && (found[1] - 0.575).abs() < 1e-6, "{found:?}");
}

#[test]
fn a_lambert_surface_keeps_the_contract() {
    for degrees in [0.0, 50.0, 89.0] {
        assert!((albedo(&Lambert::new(0.7), degrees, (1.0, 1.0)) - 0.7).abs() < 1e-6);
    }
}

/// Without extinction of its own kind a metal of index 0 reflects everything.
fn lossless(roughness: f64, masking: Masking) -> RoughConductor {
    RoughConductor::new(0.0, 1.0, roughness).unwrap().masking(masking)
}

#[test]
fn lossless_rough_metal_returns_what_is_scattered_once() {
    let cases = [
        (0.1, 0.0, 0.988_298_921_906_500_8),
        (0.3, 0.0, 0.877_361_776_596_812_7),
        (0.3, 70.0, 0.806_167_117_088_083_2),
        (0.6, 45.0, 0.602_148_765_766_418_7),
        (1.0, 0.0, 0.306_851_668_307_957_96),
    ];
    for (roughness, degrees, expected) in cases {
        let found = albedo(&lossless(roughness, Masking::Separable), degrees, (1.0, 1.0));
        println!("{roughness} {degrees}: {found} {expected}");
        assert!((found - expected).abs() < 2e-5, "{roughness} {degrees}: {found} {expected}");
        let correlated = albedo(&lossless(roughness, Masking::HeightCorrelated), degrees, (1.0, 1.0));
        // Along the normal nothing is masked from one of the two directions, and both kinds are one.
        let right = if degrees == 0.0 { correlated == found } else { correlated > found + 1e-3 };
        assert!(right && correlated < 1.0, "{roughness} {degrees}: {correlated} {found}");
    }
}

#[test]
fn rough_metals_keep_the_contract_at_grazing_incidence_and_in_water() {
    for degrees in [30.0, 80.0, 89.0] {
        for index in [1.0, 1.33] {
            let metal = RoughConductor::new(|w: f64| w / 500.0, 3.0, 0.2).unwrap();
            albedo(&metal, degrees, (index, index));
        }
    }
}

#[test]
fn rough_glass_keeps_the_contract_from_both_sides() {
    // By quadrature over the facets, of what each reflects and refracts to its proper side, masked from there.
    for (roughness, degrees, near, far, expected) in ROUGH_GLASS {
        let glass = RoughDielectric::new(1.5, 1.0, roughness).unwrap();
        let found = albedo(&glass, degrees, (near, far));
        println!("{roughness} {degrees} {near} {far}: {found} {expected}");
        assert!((found - expected).abs() < 1e-4, "{roughness} {degrees} {near} {far}: {found} {expected}");
        let correlated = albedo(&glass.masking(Masking::HeightCorrelated), degrees, (near, far));
        assert!(correlated >= found - 1e-9 && correlated <= 1.0, "{correlated}");
    }
}

/// Roughness, angle [deg], indices before and behind, albedo.
const ROUGH_GLASS: [(f64, f64, f64, f64, f64); 7] = [
    (0.1, 0.0, 1.0, 1.5, 0.998_836),
    (0.3, 30.0, 1.0, 1.5, 0.982_704),
    (0.3, 70.0, 1.0, 1.5, 0.917_636),
    (0.3, 30.0, 1.5, 1.0, 0.870_057),
    (0.5, 60.0, 1.5, 1.0, 0.642_701),
    (1.0, 45.0, 1.0, 1.5, 0.779_230),
    (0.2, 80.0, 1.33, 1.5, 0.898_790),
];

/// Surfaces with a mistake each.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// The cosine of the outgoing direction is forgotten.
    NoCosine,
    /// The density of another roughness is claimed.
    OtherDensity,
    /// The density is that of the facets.
    FacetDensity,
    /// The density is right but for its scale.
    DensityTooLarge,
    /// Only the way out is masked.
    HalfMasking,
    /// Nothing is masked.
    NoMasking,
    /// Nothing is shared out at grazing incidence.
    GrazingNan,
    /// Radiance is kept at refraction.
    NoSquaredIndex,
}

/// A rough surface, possibly wrong.
struct Wrong<B>(B, Fault);

fn one_masking(roughness: f64, v: Vector3D) -> f64 {
    let tangent = roughness * v.x.hypot(v.y) / v.z.abs();
    2.0 / (1.0 + (1.0 + tangent * tangent).sqrt())
}

const ROUGHNESS: f64 = 0.4;

impl<B: Bsdf> Bsdf for Wrong<B> {
    fn sample(&self, incoming: Vector3D, at: Context<'_>, rng: &mut Rng) -> Vector3D {
        self.0.sample(incoming, at, rng)
    }

    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>) -> f64 {
        let right = self.0.pdf(incoming, outgoing, at);
        let m = (incoming + outgoing).normalise().unwrap_or(Vector3D::Z);
        match self.1 {
            Fault::OtherDensity => lossless(0.5, Masking::Separable).pdf(incoming, outgoing, at),
            Fault::FacetDensity => right * 4.0 * incoming.dot(m).abs(),
            Fault::DensityTooLarge => 1.01 * right,
            _ => right,
        }
    }

    fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]) {
        self.0.evaluate(incoming, outgoing, at, out);
        let factor = match self.1 {
            Fault::NoCosine => 1.0 / outgoing.z.abs().max(1e-3),
            Fault::HalfMasking => 1.0 / one_masking(ROUGHNESS, incoming),
            Fault::NoMasking => 1.0 / one_masking(ROUGHNESS, incoming) / one_masking(ROUGHNESS, outgoing),
            Fault::GrazingNan if incoming.z < 1e-10 => f64::NAN,
            Fault::NoSquaredIndex if outgoing.z < 0.0 => (at.index_out / at.index_in).powi(2),
            _ => 1.0,
        };
        // Grazing directions are not the fault of these, but of one.
        let factor = if factor.is_infinite() { 1.0 } else { factor };
        out.iter_mut().for_each(|f| *f *= factor);
    }
}

#[track_caller]
fn refused(bsdf: &dyn Bsdf, degrees: f64, indices: (f64, f64), because: &str) {
    let what = judge(bsdf, degrees, indices).expect_err("a wrong surface must be refused");
    println!("{what}");
    assert!(what.contains(because), "{what}");
}

#[test]
fn wrong_rough_surfaces_are_refused() {
    let metal = |fault| Wrong(lossless(ROUGHNESS, Masking::Separable), fault);
    let glass = |fault| Wrong(RoughDielectric::new(1.5, 1.0, ROUGHNESS).unwrap(), fault);
    let air = (1.0, 1.0);
    albedo(&metal(Fault::None), 75.0, air);
    albedo(&glass(Fault::None), 40.0, (1.0, 1.5));
    refused(&metal(Fault::NoCosine), 40.0, air, "not reciprocal");
    refused(&metal(Fault::HalfMasking), 40.0, air, "not reciprocal");
    refused(&metal(Fault::NoMasking), 75.0, air, "of what arrives");
    refused(&metal(Fault::OtherDensity), 40.0, air, "not of the density");
    refused(&metal(Fault::FacetDensity), 40.0, air, "integrates to");
    refused(&metal(Fault::DensityTooLarge), 40.0, air, "integrates to");
    refused(&metal(Fault::GrazingNan), 40.0, air, "evaluate gives NaN");
    refused(&glass(Fault::NoSquaredIndex), 40.0, (1.0, 1.5), "not reciprocal");
    refused(&glass(Fault::NoSquaredIndex), 40.0, (1.5, 1.0), "not reciprocal");
}

#[test]
fn a_bright_diffuse_surface_is_refused() {
    struct Bright;
    impl Bsdf for Bright {
        fn sample(&self, incoming: Vector3D, at: Context<'_>, rng: &mut Rng) -> Vector3D {
            Lambert::default().sample(incoming, at, rng)
        }
        fn pdf(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>) -> f64 {
            outgoing.z.max(0.0) * FRAC_1_PI
        }
        fn evaluate(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>, out: &mut [f64]) {
            out.fill(outgoing.z.max(0.0) * FRAC_1_PI * 1.01);
        }
    }
    refused(&Bright, 20.0, (1.0, 1.0), "of what arrives");
}
