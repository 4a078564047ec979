//! Where in a pixel its samples lie.

use raysect_math::{Rng, Stratum, StreamKey};

use crate::frame::BLOCK;

/// Logarithms to base two of the numbers of columns and rows of a pixel; two samples of a block in every cell.
const BITS: [u8; 2] = [(BLOCK / 2).ilog2().div_ceil(2) as u8, ((BLOCK / 2).ilog2() / 2) as u8];

/// Stands where a stream names its slice: the cells are the same for all of them.
const EVERY_SLICE: u64 = u64::MAX;

/// The cell of the first two uniforms of a sample.
///
/// Samples come in pairs, and the pairs of a block visit all cells, in the order of a (0, 2)-sequence (I. M. Sobol',
/// *USSR Comput. Math. Math. Phys.* 7(4), 1967), so that also a part of a block is spread evenly. A random shift of
/// the digits makes every pair uniform in the whole pixel. The two samples of a pair are independent in the same
/// cell: their difference tells the variance within it (W. G. Cochran, *Sampling Techniques*, 3rd ed., § 5A.12).
#[derive(Debug, Default)]
pub(crate) struct Strata {
    block: Option<(u64, usize, u64)>,
    shift: [u8; 2],
}

impl Strata {
    /// The cell of a sample, by its number in its pixel.
    pub(crate) fn of(&mut self, seed: u64, lane: u64, pixel: usize, sample: u64) -> Stratum {
        let block = (lane, pixel, sample / BLOCK);
        if self.block != Some(block) {
            self.block = Some(block);
            let key = StreamKey { seed, lane, slice: EVERY_SLICE, pixel: pixel as u64, sample: block.2 };
            let bits = Rng::keyed(key).bits().to_le_bytes();
            self.shift = [0, 1].map(|axis| bits[axis] & ((1 << BITS[axis]) - 1));
        }
        let cell = cell_of((sample % BLOCK / 2) as u32);
        Stratum { cell: [0, 1].map(|axis| cell[axis] ^ self.shift[axis]), bits: BITS }
    }
}

/// The cell of a pair in the unshifted order: the leading digits of the first two Sobol' coordinates.
fn cell_of(pair: u32) -> [u8; 2] {
    let mut second = 0u32;
    let (mut direction, mut rest) = (1u32 << 31, pair);
    while rest > 0 {
        if rest & 1 == 1 {
            second ^= direction;
        }
        direction ^= direction >> 1;
        rest >>= 1;
    }
    let leading = |x: u32, axis: usize| x.checked_shr(32 - u32::from(BITS[axis])).unwrap_or(0) as u8;
    [leading(pair.reverse_bits(), 0), leading(second, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_block_visits_every_cell_twice() {
        let mut strata = Strata::default();
        let cells: Vec<[u8; 2]> = (0..BLOCK).map(|s| strata.of(1, 0, 7, 3 * BLOCK + s).cell).collect();
        assert!(cells.chunks(2).all(|pair| pair[0] == pair[1]));
        let distinct: BTreeSet<[u8; 2]> = cells.iter().copied().collect();
        assert_eq!(distinct.len() as u64, BLOCK / 2);
        assert!(distinct.iter().all(|c| c[0] >> BITS[0] == 0 && c[1] >> BITS[1] == 0));
        // The first half of the block falls into every second cell only, and the first quarter is spread as well.
        let columns: BTreeSet<u8> = cells[..BLOCK as usize / 4].iter().map(|c| c[0] / 2).collect();
        assert_eq!(columns.len(), 1 << (BITS[0] - 1));
    }

    #[test]
    fn every_pair_is_uniform_over_the_pixel() {
        let mut strata = Strata::default();
        let (blocks, cells) = (20_000u64, (BLOCK / 2) as usize);
        for pair in [0, BLOCK / 2 - 1] {
            let mut counts = vec![0f64; cells];
            for block in 0..blocks {
                let cell = strata.of(5, 0, 1, block * BLOCK + 2 * pair).cell;
                counts[usize::from(cell[0]) << BITS[1] | usize::from(cell[1])] += 1.0;
            }
            let expected = blocks as f64 / cells as f64;
            let chi: f64 = counts.iter().map(|c| (c - expected).powi(2) / expected).sum();
            let freedom = cells as f64 - 1.0;
            assert!((chi - freedom).abs() < 4.0 * (2.0 * freedom).sqrt(), "χ² = {chi} of {freedom}");
        }
    }

    #[test]
    fn asking_out_of_order_changes_nothing() {
        let (mut forward, mut jumping) = (Strata::default(), Strata::default());
        let first: Vec<_> = (0..200).map(|s| forward.of(3, 1, 2, s)).collect();
        for s in [150, 3, 199, 64, 0] {
            jumping.of(3, 1, 9, s);
            assert_eq!(jumping.of(3, 1, 2, s), first[s as usize]);
        }
    }
}
