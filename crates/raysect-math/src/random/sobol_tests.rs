//! Generators of Sobol points: stratification, uniformity, bits, and errors between blocks.

use super::*;
use crate::{BlockStatistics, Statistics};

/// Points of one block, so many coordinates each.
fn block(sample: u64, count: u32, dimensions: usize) -> Vec<Vec<f64>> {
    let key = StreamKey { seed: 5, sample, ..StreamKey::default() };
    let point = |index| {
        let mut rng = Rng::sobol(key, index);
        (0..dimensions).map(|_| rng.uniform()).collect()
    };
    (0..count).map(point).collect()
}

/// True if each of 2^m equal rectangles, for all shapes with 2^a columns, has exactly one of 2^m points.
fn is_net(points: &[[f64; 2]], m: u32) -> bool {
    (0..=m).all(|a| {
        let mut seen = vec![false; points.len()];
        points.iter().all(|p| {
            let (column, row) =
                ((p[0] * f64::from(1 << a)) as usize, (p[1] * f64::from(1 << (m - a))) as usize);
            !std::mem::replace(&mut seen[(column << (m - a)) + row], true)
        })
    })
}

#[test]
fn the_first_two_dimensions_are_a_net() {
    for sample in 0..20 {
        let points: Vec<[f64; 2]> = block(sample, 256, 2).iter().map(|p| [p[0], p[1]]).collect();
        for m in [1, 4, 8] {
            assert!(is_net(&points[..1 << m], m), "block {sample}, {m}");
        }
        // The second quarter of them is a net too, and points at random are none.
        assert!(is_net(&points[64..128], 6));
        let mut rng = Rng::new(sample);
        let random: Vec<[f64; 2]> = (0..64).map(|_| [rng.uniform(), rng.uniform()]).collect();
        assert!(!is_net(&random, 6));
    }
}

#[test]
fn every_dimension_is_stratified_until_the_plain_generator_takes_over() {
    let stratified = |points: &[Vec<f64>], dimension: usize| {
        let mut seen = [false; 64];
        points.iter().all(|p| !std::mem::replace(&mut seen[(p[dimension] * 64.0) as usize], true))
    };
    let points = block(3, 64, 130);
    let all: Vec<bool> = (0..130).map(|d| stratified(&points, d)).collect();
    assert!(all[..128].iter().all(|s| *s));
    assert_eq!(all[128..], [false, false]);
}

#[test]
fn each_coordinate_is_uniform_over_the_blocks() {
    // Points 0 and 5 of 20 000 blocks in 64 bins: the low bits and the scrambling of one point by itself.
    for (index, dimension) in [(0, 0), (0, 1), (5, 0), (5, 1), (5, 40), (5, 127)] {
        let mut bins = [0.0; 64];
        for sample in 0..20_000 {
            let mut rng = Rng::sobol(StreamKey { sample, ..StreamKey::default() }, index);
            for _ in 0..dimension {
                rng.uniform();
            }
            let u = rng.uniform();
            assert!(u > 0.0 && u < 1.0);
            bins[(u * 64.0) as usize] += 1.0;
        }
        let mean = 20_000.0 / 64.0;
        let chi: f64 = bins.iter().map(|b: &f64| (b - mean).powi(2) / mean).sum();
        assert!(chi < 63.0 + 5.0 * 126f64.sqrt(), "point {index}, dimension {dimension}: {chi}");
    }
}

#[test]
fn the_bits_are_pinned() {
    let key = StreamKey { seed: 1, lane: 2, slice: 3, pixel: 4, sample: 5 };
    let bits = |index| {
        let mut rng = Rng::sobol(key, index);
        [rng.uniform().to_bits(), rng.uniform().to_bits()]
    };
    assert_eq!(bits(0), PINNED[0]);
    assert_eq!(bits(77), PINNED[1]);
    assert_eq!(bits(u32::MAX), PINNED[2]);
}

/// Computed by another program from the same definitions.
const PINNED: [[u64; 2]; 3] = [
    [4599607493498413394, 4604750389540956507],
    [4606142155720028677, 4606668201139684513],
    [4602914137510020037, 4604750389539502171],
];

#[test]
fn keys_name_unrelated_blocks() {
    let of = |key: StreamKey| {
        let mut rng = Rng::sobol(key, 9);
        [rng.uniform(), rng.uniform()]
    };
    let key = StreamKey { seed: 1, lane: 1, slice: 1, pixel: 1, sample: 1 };
    let others = [
        StreamKey { seed: 2, ..key },
        StreamKey { lane: 2, ..key },
        StreamKey { slice: 2, ..key },
        StreamKey { pixel: 2, ..key },
        StreamKey { sample: 2, ..key },
    ];
    for other in others {
        assert!(of(other).iter().zip(of(key)).all(|(a, b)| *a != b));
    }
    assert_eq!(of(key), of(key));
    // A stratum takes the place of the points.
    let stratum = Stratum { cell: [3, 1], bits: [2, 1] };
    let mut rng = Rng::sobol(key, 9).confined_to(stratum);
    assert!(rng.uniform() > 0.75 && rng.uniform() > 0.5);
}

/// A smooth function of six variables; its integral over the unit cube is 1.
fn product(rng: &mut Rng) -> f64 {
    (1..=6).map(|i| 1.0 + (rng.uniform() - 0.5) / f64::from(i)).product()
}

#[test]
fn errors_between_blocks_cover_and_naive_ones_are_several_times_too_large() {
    const POINTS: u32 = 256;
    const BLOCKS: u64 = 16;
    let (mut covered, mut z_squared, mut excess) = (0, Statistics::new(), Statistics::new());
    let experiments = 200;
    for pixel in 0..experiments {
        let mut between = BlockStatistics::new(POINTS);
        let mut naive = Statistics::new();
        for sample in 0..BLOCKS {
            for index in 0..POINTS {
                let mut rng = Rng::sobol(StreamKey { seed: 3, pixel, sample, ..StreamKey::default() }, index);
                let value = product(&mut rng);
                between.add(value);
                naive.add(value);
            }
        }
        let blocks = between.blocks();
        assert_eq!(blocks.count(), BLOCKS);
        let z = (blocks.mean() - 1.0) / blocks.error();
        // Student's t with 15 degrees of freedom: 95 % lie within 2.131.
        covered += u32::from(z.abs() < 2.131);
        z_squared.add(z * z);
        excess.add(naive.error() / blocks.error());
    }
    assert!((182..=198).contains(&covered), "{covered} of {experiments}");
    // The variance of that distribution is 15/13.
    assert!((z_squared.mean() - 15.0 / 13.0).abs() < 4.0 * z_squared.error(), "{z_squared}");
    assert!(excess.mean() > 5.0 && excess.error() < 0.05 * excess.mean(), "{excess}");
}

#[test]
fn errors_between_blocks_of_plain_numbers_are_the_naive_ones() {
    let mut ratio = Statistics::new();
    for seed in 0..50 {
        let mut rng = Rng::new(seed);
        let (mut between, mut naive) = (BlockStatistics::new(256), Statistics::new());
        for _ in 0..256 * 64 {
            let value = product(&mut rng);
            between.add(value);
            naive.add(value);
        }
        ratio.add((naive.error() / between.blocks().error()).powi(-2));
    }
    assert!((ratio.mean() - 1.0).abs() < 4.0 * ratio.error(), "{ratio}");
}
