use crate::MathError;

/// How a [`KdTree`](super::KdTree) is built. The defaults are those of Raysect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KdTreeSettings {
    /// Branches above a leaf, at most [`DEEPEST`](Self::DEEPEST); larger values are taken as that. 0 stands for
    /// 8 + 1.3 ln n of n items, rounded up.
    pub max_depth: u32,
    /// Nodes with so many items or fewer are not split. 0 is taken as 1.
    pub min_items: u32,
    /// Cost of testing an item, in units of a step from node to node. Values below 1 are taken as 1.
    pub hit_cost: f64,
    /// A split with nothing on one side is cheaper by this share of its hits, 0 … 1.
    pub empty_bonus: f64,
}

impl Default for KdTreeSettings {
    fn default() -> Self {
        Self { max_depth: 0, min_items: 1, hit_cost: 20.0, empty_bonus: 0.2 }
    }
}

impl KdTreeSettings {
    /// No tree is deeper, nor is a deeper one read.
    pub const DEEPEST: u32 = 256;

    pub(super) fn resolve(&self, items: usize) -> Result<Resolved, MathError> {
        let bonus = self.empty_bonus;
        MathError::check((0.0..=1.0).contains(&bonus), bonus, "empty bonus", "", "0 … 1")?;
        MathError::check(self.hit_cost.is_finite(), self.hit_cost, "hit cost", "", "finite")?;
        let max_depth = match self.max_depth {
            0 => (8.0 + 1.3 * (items.max(1) as f64).ln()).ceil() as i32,
            given => given.min(Self::DEEPEST) as i32,
        };
        let min_items = self.min_items.clamp(1, i32::MAX as u32) as i32;
        Ok(Resolved { max_depth, min_items, hit_cost: self.hit_cost.max(1.0), empty_bonus: bonus })
    }
}

/// The settings of a tree as they are stored with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Resolved {
    pub(super) max_depth: i32,
    pub(super) min_items: i32,
    pub(super) hit_cost: f64,
    pub(super) empty_bonus: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_automatic_depth_follows_the_number_of_items() {
        // 8, 8 + 1.3 · 2.303 = 10.99, 8 + 1.3 · 13.82 = 25.96
        for (items, depth) in [(0, 8), (1, 8), (10, 11), (1_000_000, 26)] {
            assert_eq!(KdTreeSettings::default().resolve(items).unwrap().max_depth, depth);
        }
    }

    #[test]
    fn settings_are_clamped_or_refused() {
        let odd = KdTreeSettings { max_depth: 1000, min_items: 0, hit_cost: -3.0, empty_bonus: 1.0 };
        let expected = Resolved { max_depth: 256, min_items: 1, hit_cost: 1.0, empty_bonus: 1.0 };
        assert_eq!(odd.resolve(5).unwrap(), expected);
        for empty_bonus in [-0.1, 1.1, f64::NAN] {
            assert!(KdTreeSettings { empty_bonus, ..odd }.resolve(5).is_err());
        }
        for hit_cost in [f64::NAN, f64::INFINITY] {
            assert!(KdTreeSettings { hit_cost, ..odd }.resolve(5).is_err());
        }
    }
}
