mod sobol;
#[cfg(test)]
mod sobol_tests;

use rand_core::{Rng as _, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Names one stream of random numbers: one path of one observation.
///
/// Streams with different keys are unrelated, whichever field differs, and a key always gives the same
/// numbers: this is what makes an image independent of threads, passes and machines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct StreamKey {
    /// The user's seed.
    pub seed: u64,
    /// Independent set of samples (0 unless the work is split across machines).
    pub lane: u64,
    /// Spectral slice.
    pub slice: u64,
    /// Pixel.
    pub pixel: u64,
    /// Absolute number of the sample in its pixel.
    pub sample: u64,
}

/// A source of random numbers: PCG XSL 128/64 MCG (M. O'Neill, *PCG: A Family of Simple Fast Space-Efficient
/// Statistically Good Algorithms for Random Number Generation*, HMC-CS-2014-0905).
///
/// There is no global generator: a value is passed on explicitly.
///
/// ```
/// use raysect_math::Rng;
/// let (mut a, mut b) = (Rng::new(0), Rng::new(0));
/// assert_eq!(a.uniform(), b.uniform());
/// assert_ne!(Rng::new(0).uniform(), Rng::new(1).uniform());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rng {
    generator: Pcg64Mcg,
    /// Names the scrambling of Sobol points.
    scrambling: u64,
    next: Next,
}

/// Where the next uniforms come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    /// The generator.
    Plain,
    /// The generator, confined to a cell, on so many axes yet.
    Confined { stratum: Stratum, axes: u8 },
    /// Coordinates of a Sobol point from this dimension on.
    Sobol { index: u32, dimension: u8 },
}

/// A cell of the unit square cut into 2^bits equal columns and rows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Stratum {
    /// Column and row.
    pub cell: [u8; 2],
    /// Logarithms to base two of the numbers of columns and rows.
    pub bits: [u8; 2],
}

/// One step of SplitMix64's output function: a bijection that mixes every bit into every other
/// (G. Steele, D. Lea, C. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
#[inline]
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// A key as one number. A chain of bijections: keys that differ in one field only can never collide.
#[inline]
fn hash(key: StreamKey) -> u64 {
    let mut h = mix(key.seed.wrapping_add(GOLDEN));
    for field in [key.lane, key.slice, key.pixel, key.sample] {
        h = mix((h ^ field).wrapping_add(GOLDEN));
    }
    h
}

impl Rng {
    /// A generator for the given seed; every seed is good, 0 included.
    #[doc(alias = "seed")]
    pub fn new(seed: u64) -> Self {
        Self::keyed(StreamKey { seed, ..StreamKey::default() })
    }

    /// The generator of a keyed stream, at its beginning.
    #[inline]
    pub fn keyed(key: StreamKey) -> Self {
        Self::hashed(hash(key))
    }

    /// A point of a block of low-discrepancy points: its uniforms are the coordinates of point `index` of the Sobol
    /// sequence with Owen's scrambling, one after another. A sum over the 2^m points of a block from 0 on has a far
    /// smaller error than over as many random ones where the integrand is smooth.
    ///
    /// The key names the block: [`sample`](StreamKey::sample) is its number. Blocks are independent randomisations, and
    /// each point by itself is uniform in the unit cube. The points of one block depend on each other: an error must be
    /// taken between the means of blocks, as [`BlockStatistics`](crate::BlockStatistics) does; one over single points is
    /// several times off.
    ///
    /// The direction numbers, of 128 dimensions, are those of S. Joe and F. Y. Kuo (*Constructing Sobol sequences with
    /// better two-dimensional projections*, SIAM J. Sci. Comput. 30, 2008), the scrambling is by hashing (B. Burley,
    /// *Practical hash-based Owen scrambling*, JCGT 9(4), 2020). From the 129th uniform on, and for [`bits`](Self::bits),
    /// the plain generator of the block and the point takes over. The last 20 of 52 bits of a coordinate are its too.
    ///
    /// ```
    /// use raysect_math::{BlockStatistics, Rng, StreamKey};
    ///
    /// // The integral of xy over the unit square, 1/4, from 16 blocks of 64 points.
    /// let mut statistics = BlockStatistics::new(64);
    /// for sample in 0..16 {
    ///     for index in 0..64 {
    ///         let mut rng = Rng::sobol(StreamKey { seed: 1, sample, ..StreamKey::default() }, index);
    ///         statistics.add(rng.uniform() * rng.uniform());
    ///     }
    /// }
    /// let blocks = statistics.blocks();
    /// assert!((blocks.mean() - 0.25).abs() < 4.0 * blocks.error() && blocks.error() < 3e-4);
    /// ```
    pub fn sobol(block: StreamKey, index: u32) -> Self {
        let scrambling = hash(block);
        let plain = Self::hashed(mix((scrambling ^ u64::from(index)).wrapping_add(GOLDEN)));
        Self { scrambling, next: Next::Sobol { index, dimension: 0 }, ..plain }
    }

    /// The generator whose state is made of the hash of a key.
    #[inline]
    fn hashed(h: u64) -> Self {
        let low = mix(h.wrapping_add(GOLDEN)).to_le_bytes();
        let high = mix(h.wrapping_add(GOLDEN.wrapping_mul(2))).to_le_bytes();
        let mut state = [0; 16];
        state[..8].copy_from_slice(&low);
        state[8..].copy_from_slice(&high);
        Self { generator: Pcg64Mcg::from_seed(state), scrambling: 0, next: Next::Plain }
    }

    /// The same generator, but its next two uniforms lie in a cell of the unit square: for stratified sampling of
    /// what is drawn first. Uniforms of a cell drawn at random are uniform in the whole square. A Sobol point is given up.
    pub fn confined_to(self, stratum: Stratum) -> Self {
        Self { next: Next::Confined { stratum, axes: 2 }, ..self }
    }

    /// Sixty-four random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.generator.next_u64()
    }

    /// Uniform in the open interval (0, 1): one of 2⁵² values (k + ½) · 2⁻⁵², never 0 and never 1, so that
    /// logarithms and quotients of it are finite.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1u64 << 52) as f64;
        let mut bits = self.bits() >> 12;
        if self.next != Next::Plain {
            bits = self.place(bits);
        }
        (bits as f64 + 0.5) * STEP
    }

    /// The same 52 bits, moved down to make room for those of the stratum or of the Sobol point.
    #[cold]
    fn place(&mut self, bits: u64) -> u64 {
        match self.next {
            Next::Plain => bits,
            Next::Confined { stratum, axes } => {
                let axis = usize::from(2 - axes);
                self.next = if axes > 1 { Next::Confined { stratum, axes: axes - 1 } } else { Next::Plain };
                let taken = stratum.bits[axis];
                u64::from(stratum.cell[axis]) << (52 - taken) | bits >> taken
            }
            Next::Sobol { index, dimension } => {
                let last = usize::from(dimension) + 1 == sobol::DIMENSIONS;
                self.next = if last { Next::Plain } else { Next::Sobol { index, dimension: dimension + 1 } };
                let key = mix(self.scrambling ^ mix(u64::from(dimension).wrapping_add(GOLDEN)));
                u64::from(sobol::scrambled(index, dimension.into(), key)) << 20 | bits >> 32
            }
        }
    }

    /// Uniform in (`low`, `high`).
    #[inline]
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Normally distributed, by the transform of Box and Muller (1958); no second value is kept back.
    pub fn normal(&mut self, mean: f64, standard_deviation: f64) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        let angle = std::f64::consts::TAU * self.uniform();
        mean + standard_deviation * radius * angle.cos()
    }

    /// True with probability `p`: always for 1 or more, never for 0 or less.
    #[inline]
    pub fn probability(&mut self, p: f64) -> bool {
        self.uniform() < p
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_that_differ_anywhere_give_unrelated_streams() {
        let keys = |field: usize, value: u64| {
            let mut f = [7u64; 5];
            f[field] = value;
            StreamKey { seed: f[0], lane: f[1], slice: f[2], pixel: f[3], sample: f[4] }
        };
        for field in 0..5 {
            let n = 10_000;
            let draws: Vec<[f64; 2]> = (0..n)
                .map(|i| {
                    let mut rng = Rng::keyed(keys(field, i));
                    [rng.uniform() - 0.5, rng.uniform() - 0.5]
                })
                .collect();
            let correlation =
                |f: &dyn Fn(usize) -> f64| (0..n as usize - 1).map(f).sum::<f64>() * 12.0 / (n as f64 - 1.0);
            let bound = 4.0 / (n as f64).sqrt();
            assert!(correlation(&|i| draws[i][0] * draws[i + 1][0]).abs() < bound);
            assert!(correlation(&|i| draws[i][0] * draws[i][1]).abs() < bound);
            assert!(correlation(&|i| draws[i][1] * draws[i + 1][0]).abs() < bound);
        }
    }

    #[test]
    fn uniforms_stay_inside_the_open_interval_and_average_one_half() {
        let mut rng = Rng::new(3);
        let n = 1_000_000;
        let (mut sum, mut low, mut high) = (0.0, 1.0f64, 0.0f64);
        for _ in 0..n {
            let u = rng.uniform();
            sum += u;
            low = low.min(u);
            high = high.max(u);
        }
        assert!(low > 0.0 && high < 1.0);
        assert!((sum / n as f64 - 0.5).abs() < 4.0 / (12.0 * n as f64).sqrt());
    }

    #[test]
    fn the_first_two_uniforms_stay_in_their_cell() {
        let stratum = Stratum { cell: [5, 1], bits: [3, 2] };
        let (mut sum, n) = ([0.0; 3], 10_000);
        for seed in 0..n {
            let mut rng = Rng::new(seed).confined_to(stratum);
            let u = [rng.uniform(), rng.uniform(), rng.uniform()];
            assert!(u[0] > 0.625 && u[0] < 0.75 && u[1] > 0.25 && u[1] < 0.5, "{u:?}");
            sum.iter_mut().zip(u).for_each(|(s, u)| *s += u);
        }
        for (sum, (middle, width)) in sum.into_iter().zip([(0.6875, 0.125), (0.375, 0.25), (0.5, 1.0)]) {
            let sigma = width / (12.0 * n as f64).sqrt();
            assert!((sum / n as f64 - middle).abs() < 4.0 * sigma);
        }
        let last = Rng::new(1).confined_to(Stratum { cell: [255; 2], bits: [8; 2] }).uniform();
        assert!(last < 1.0);
    }

    #[test]
    fn normal_deviates_have_their_moments() {
        let mut rng = Rng::new(11);
        let n = 400_000;
        let x: Vec<f64> = (0..n).map(|_| rng.normal(2.0, 3.0)).collect();
        let mean = x.iter().sum::<f64>() / n as f64;
        let variance = x.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n as f64;
        assert!((mean - 2.0).abs() < 4.0 * 3.0 / (n as f64).sqrt());
        assert!((variance / 9.0 - 1.0).abs() < 4.0 * (2.0 / n as f64).sqrt());
    }
}
