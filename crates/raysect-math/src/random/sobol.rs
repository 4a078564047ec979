//! Points of the Sobol sequence with Owen's scrambling.

/// So many dimensions have direction numbers.
pub(super) const DIMENSIONS: usize = 128;

/// Bits of a coordinate.
const BITS: usize = 32;

/// Direction numbers of each dimension, the highest bit first.
static DIRECTIONS: [[u32; BITS]; DIMENSIONS] = directions(include_bytes!("../../data/sobol_directions.txt"));

/// The direction numbers of all dimensions from the rows `dimension s a m…` of the data file: S. Joe and F. Y. Kuo,
/// *Constructing Sobol sequences with better two-dimensional projections*, SIAM J. Sci. Comput. 30, 2008.
const fn directions(text: &[u8]) -> [[u32; BITS]; DIMENSIONS] {
    let mut all = [[0; BITS]; DIMENSIONS];
    let mut bit = 0;
    while bit < BITS {
        all[0][bit] = 1 << (BITS - 1 - bit);
        bit += 1;
    }
    let (mut dimension, mut at) = (1, 0);
    while dimension < DIMENSIONS {
        while text[at] == b'#' {
            while text[at] != b'\n' {
                at += 1;
            }
            at += 1;
        }
        let (number, degree, polynomial);
        (number, at) = next_number(text, at);
        assert!(number as usize == dimension + 1, "a dimension is missing");
        (degree, at) = next_number(text, at);
        (polynomial, at) = next_number(text, at);
        let mut first = [0; BITS];
        let mut bit = 0;
        while bit < degree as usize {
            (first[bit], at) = next_number(text, at);
            bit += 1;
        }
        all[dimension] = recurrence(first, degree as usize, polynomial);
        dimension += 1;
    }
    all
}

/// A decimal number and where the text goes on after it and the character behind it.
const fn next_number(text: &[u8], mut at: usize) -> (u32, usize) {
    let mut number = 0;
    while text[at].is_ascii_digit() {
        number = 10 * number + (text[at] - b'0') as u32;
        at += 1;
    }
    (number, at + 1)
}

/// All direction numbers of a dimension from the first ones (Joe and Kuo, equations 2 and 3).
const fn recurrence(first: [u32; BITS], degree: usize, polynomial: u32) -> [u32; BITS] {
    let mut v = [0; BITS];
    let mut k = 0;
    while k < BITS {
        if k < degree {
            v[k] = first[k] << (BITS - 1 - k);
        } else {
            v[k] = v[k - degree] ^ (v[k - degree] >> degree);
            let mut j = 1;
            while j < degree {
                if (polynomial >> (degree - 1 - j)) & 1 == 1 {
                    v[k] ^= v[k - j];
                }
                j += 1;
            }
        }
        k += 1;
    }
    v
}

/// A coordinate of a point, scaled by 2³².
fn coordinate(mut index: u32, dimension: usize) -> u32 {
    let (row, mut x) = (&DIRECTIONS[dimension], 0);
    while index != 0 {
        x ^= row[index.trailing_zeros() as usize];
        index &= index - 1;
    }
    x
}

/// Owen's scrambling by hashing: each bit is flipped by what a hash makes of those above it (B. Burley, *Practical
/// hash-based Owen scrambling*, JCGT 9(4), 2020, section 3, after S. Laine and T. Karras, *Stratified sampling for
/// stochastic transparency*, 2011; constants by N. Vegdahl, *Building a better LK hash*, 2021).
fn scramble(x: u32, key: u64) -> u32 {
    let (offset, factor) = (key as u32, (key >> 32) as u32 | 1);
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(offset).wrapping_mul(factor);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// A coordinate of a point, scrambled by a key of 64 random bits, scaled by 2³².
pub(super) fn scrambled(index: u32, dimension: usize, key: u64) -> u32 {
    scramble(coordinate(index, dimension), key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_those_of_another_implementation() {
        // SciPy 1.x, scipy.stats.qmc.Sobol(128, scramble=False, bits=32).
        let dimensions = [0, 1, 2, 3, 63, 127];
        for (index, expected) in [
            (11, [3489660928, 2952790016, 3489660928, 268435456, 268435456, 805306368]),
            (540, [943718400, 415236096, 2227175424, 2906652672, 1916796928, 2336227328]),
        ] {
            assert_eq!(dimensions.map(|dimension| coordinate(index, dimension)), expected);
        }
    }

    #[test]
    fn scrambling_keeps_elementary_intervals_together() {
        // What two numbers have in common at the top, and no more, they have in common afterwards.
        for (i, key) in [1u64, 0x0123_4567_89ab_cdef, u64::MAX, 0].into_iter().enumerate() {
            for bit in 0..32 {
                let x = 0x9e37_79b9u32.rotate_left(i as u32 * 7);
                let y = x ^ (1 << bit);
                let difference = scramble(x, key) ^ scramble(y, key);
                assert_eq!(difference.leading_zeros(), 31 - bit);
            }
        }
    }
}
