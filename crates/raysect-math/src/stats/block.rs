use super::Statistics;

/// Statistics of the means of blocks, for samples that are independent between blocks only.
///
/// Points of one Sobol block ([`Rng::sobol`](crate::Rng::sobol)) are spread on purpose: the variance between them says
/// nothing of the error of their mean. The means of blocks are independent of each other; the error is taken between
/// them.
///
/// ```
/// use raysect_math::BlockStatistics;
/// let mut statistics = BlockStatistics::new(2);
/// [1.0, 3.0, 2.0, 6.0, 5.0].iter().for_each(|&x| statistics.add(x));
/// let blocks = statistics.blocks();
/// assert_eq!((blocks.count(), blocks.mean(), blocks.error()), (2, 3.0, 1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockStatistics {
    size: u32,
    /// Samples of the block that is being filled, and their mean.
    current: Statistics,
    blocks: Statistics,
}

impl BlockStatistics {
    /// For blocks of so many samples; 0 is taken as 1.
    pub const fn new(size: u32) -> Self {
        let size = if size == 0 { 1 } else { size };
        Self { size, current: Statistics::new(), blocks: Statistics::new() }
    }

    /// Adds one sample. The samples of a block must follow one another.
    #[inline]
    pub fn add(&mut self, x: f64) {
        self.current.add(x);
        if self.current.count() == u64::from(self.size) {
            self.blocks.add(self.current.mean());
            self.current.clear();
        }
    }

    /// Adds the blocks of another set. Blocks that are not full are not merged: that of the other set is left out.
    pub fn merge(&mut self, other: &Self) {
        self.blocks.merge(&other.blocks);
    }

    /// Statistics of the means of the full blocks [unit of the samples]: count of blocks, mean, standard error of the
    /// mean. A block that is not full does not count.
    pub const fn blocks(&self) -> &Statistics {
        &self.blocks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merged_sets_have_all_full_blocks() {
        let of = |values: &[f64]| {
            let mut statistics = BlockStatistics::new(2);
            values.iter().for_each(|&x| statistics.add(x));
            statistics
        };
        let mut a = of(&[1.0, 3.0, 10.0]);
        a.merge(&of(&[5.0, 7.0, 20.0]));
        assert_eq!((a.blocks().count(), a.blocks().mean()), (2, 4.0));
        // The block that was begun before is filled: its mean is 13.
        a.add(16.0);
        assert_eq!((a.blocks().count(), a.blocks().mean()), (3, 7.0));
        assert_eq!(BlockStatistics::new(0), BlockStatistics::new(1));
    }

    #[test]
    fn one_block_has_no_error() {
        let mut statistics = BlockStatistics::new(3);
        [1.0, 2.0, 3.0].iter().for_each(|&x| statistics.add(x));
        assert_eq!(statistics.blocks().error(), f64::INFINITY);
    }
}
