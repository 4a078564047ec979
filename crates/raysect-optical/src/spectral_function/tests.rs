//! What holds for functions of every kind.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::*;
use crate::Spectrum;

/// One of each kind, with structure of different widths.
fn functions() -> Vec<(&'static str, Box<dyn SpectralFunction>)> {
    let table = InterpolatedSf::new([410.0, 433.0, 500.0, 500.5, 610.0], [0.2, 1.0, 0.7, 0.1, 0.9]).unwrap();
    let closure = |wavelength: f64| 2.0 + (wavelength / 30.0).sin();
    let narrow = |wavelength: f64| 0.01 + 1.0 / (1.0 + ((wavelength - 480.0) / 0.3).powi(2));
    let sellmeier =
        Sellmeier::new([1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653])
            .unwrap();
    let spectrum = Spectrum::from_samples(390.0, 640.0, vec![0.3, 0.0, 2.0, 1.0]).unwrap();
    vec![
        ("constant", Box::new(0.7)),
        ("table", Box::new(table.clone())),
        ("normalised table", Box::new(table.clone().normalised().unwrap())),
        ("closure", Box::new(closure)),
        ("numerically integrated", Box::new(NumericallyIntegratedSf::new(narrow, 0.3).unwrap())),
        ("sellmeier", Box::new(sellmeier)),
        ("wide line", Box::new(GaussianLine::new(512.0, 40.0, 3.0).unwrap())),
        ("narrow line", Box::new(GaussianLine::new(512.0, 0.05, 3.0).unwrap())),
        ("top hat", Box::new(TopHat::new(440.0, 520.0, 1.5).unwrap())),
        ("black body", Box::new(BlackBody::new(3000.0).unwrap().scaled(1e-3).unwrap())),
        ("grey body", Box::new(BlackBody::new(5778.0).unwrap().emissivity(table.clone()))),
        ("spectrum", Box::new(spectrum)),
        ("shared", Box::new(Arc::new(table) as Arc<dyn SpectralFunction>)),
    ]
}

/// Averages of cells, weighed by their widths.
fn sum_of_parts(function: &dyn SpectralFunction, edges: &[f64]) -> f64 {
    edges.windows(2).map(|w| function.average(w[0], w[1]) * (w[1] - w[0])).sum()
}

/// The midpoint rule on a grid that is fine against the structure.
fn brute_force(function: &dyn SpectralFunction, min: f64, max: f64) -> f64 {
    let cells = (300.0 * (max - min) / function.resolution()).max(40_000.0).ceil() as usize;
    let width = (max - min) / cells as f64;
    (0..cells).map(|i| function.evaluate(min + width * (i as f64 + 0.5))).sum::<f64>() / cells as f64
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn parts_of_any_split_add_up_to_the_whole(
        mut edges in prop::collection::vec(350.0..750.0f64, 2..9)
    ) {
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        prop_assume!(edges.len() > 1);
        for (name, function) in functions() {
            let whole = function.integrate(edges[0], edges[edges.len() - 1]);
            let parts = sum_of_parts(&*function, &edges);
            // What is lost of a part is relative to the part; the table's prefix sums to their total.
            prop_assert!((parts - whole).abs() <= 2e-9 * whole.abs() + 1e-11, "{name} {edges:?}: {parts} {whole}");
        }
    }

    #[test]
    fn averages_are_those_of_brute_force(min in 350.0..700.0f64, width in 1.0..60.0f64) {
        for (name, function) in functions() {
            let (average, expected) = (function.average(min, min + width), brute_force(&*function, min, min + width));
            // A jump is off by one cell of the grid at most.
            let jump = if matches!(name, "top hat" | "spectrum") { 2.0 / 40_000.0 } else { 0.0 };
            prop_assert!(
                (average - expected).abs() <= 2e-5 * expected.abs() + jump + 1e-9,
                "{name} {min} + {width}: {average} {expected}"
            );
        }
    }
}

#[test]
fn bins_are_averages_between_their_edges() {
    for (name, function) in functions() {
        let bins = function.sample(375.0, 740.0, 7);
        let width = 365.0 / 7.0;
        for (i, bin) in bins.iter().enumerate() {
            let (low, high) = (375.0 + width * i as f64, 375.0 + width * (i + 1) as f64);
            let average = function.average(low, high);
            assert!((bin - average).abs() <= 1e-9 * average.abs() + 1e-13, "{name} {i}: {bin} {average}");
        }
        assert_eq!(function.average(533.0, 533.0), function.evaluate(533.0), "{name}");
    }
}

#[test]
fn limits_may_be_given_in_either_order() {
    for (name, function) in functions() {
        let (there, back) = (function.integrate(420.0, 603.0), function.integrate(603.0, 420.0));
        assert!((there + back).abs() <= 1e-12 * there.abs(), "{name}: {there} {back}");
    }
}

#[test]
fn more_cells_than_one_quadrature_admits_lose_nothing() {
    let sharp = |wavelength: f64| (-0.5 * ((wavelength - 500.003) / 1e-3).powi(2)).exp();
    let exact = 1e-3 * std::f64::consts::TAU.sqrt();
    let stated = NumericallyIntegratedSf::new(sharp, 1e-3).unwrap();
    assert!((stated.integrate(450.0, 550.0) / exact - 1.0).abs() < 1e-9);
}
