use super::Statistics;
use crate::MathError;

/// [`Statistics`] for every cell of an array with one, two or three axes.
///
/// Cells are stored row by row (the last axis runs fastest) and addressed by their flat index.
///
/// ```
/// use raysect_math::StatisticsArray;
/// let mut frame = StatisticsArray::new(&[2, 3])?;
/// let cell = frame.index(&[1, 2])?;
/// frame.add(cell, 4.0);
/// assert_eq!((cell, frame.mean()), (5, &[0.0, 0.0, 0.0, 0.0, 0.0, 4.0][..]));
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[doc(alias = "StatsArray1D")]
#[doc(alias = "StatsArray2D")]
#[doc(alias = "StatsArray3D")]
#[derive(Debug, Clone, PartialEq)]
pub struct StatisticsArray {
    shape: Vec<usize>,
    count: Vec<u64>,
    mean: Vec<f64>,
    /// Sums of the squared deviations from the means.
    m2: Vec<f64>,
}

impl StatisticsArray {
    /// An array of cells without samples, with the given extents.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for fewer than one or more than three axes, an extent of 0, or more than 2⁴⁸
    /// cells.
    pub fn new(shape: &[usize]) -> Result<Self, MathError> {
        let axes = shape.len();
        MathError::check((1..=3).contains(&axes), axes as f64, "number of axes", "", "1 … 3")?;
        for &extent in shape {
            MathError::check(extent > 0, extent as f64, "extent of an axis", "cells", "1 or more")?;
        }
        // In 128 bits the product of three extents saturates far above the limit.
        let cells = shape.iter().fold(1u128, |product, &extent| product.saturating_mul(extent as u128));
        MathError::check(cells <= 1 << 48, cells as f64, "size of the array", "cells", "1 … 2⁴⁸")?;
        let cells = cells as usize;
        Ok(Self {
            shape: shape.to_vec(),
            count: vec![0; cells],
            mean: vec![0.0; cells],
            m2: vec![0.0; cells],
        })
    }

    /// Extents along the axes [cells].
    #[inline]
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Number of cells.
    #[inline]
    pub fn len(&self) -> usize {
        self.mean.len()
    }

    /// False: there is at least one cell.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.mean.is_empty()
    }

    /// The flat index of a cell from its position along each axis.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a position beyond the array, or a number of positions other than that of
    /// the axes.
    pub fn index(&self, position: &[usize]) -> Result<usize, MathError> {
        let (axes, given) = (self.shape.len(), position.len());
        MathError::check(axes == given, given as f64, "number of positions", "", "that of the axes")?;
        let mut index = 0;
        for (&at, &extent) in position.iter().zip(&self.shape) {
            MathError::check(at < extent, at as f64, "position in the array", "cells", "0 … extent − 1")?;
            index = index * extent + at;
        }
        Ok(index)
    }

    /// The statistics of a cell.
    ///
    /// # Panics
    /// For an index beyond the array, like the indexing of a slice; so do the other functions that take one.
    #[inline]
    pub fn cell(&self, index: usize) -> Statistics {
        Statistics { count: self.count[index], mean: self.mean[index], m2: self.m2[index] }
    }

    #[inline]
    fn set(&mut self, index: usize, cell: Statistics) {
        self.count[index] = cell.count;
        self.mean[index] = cell.mean;
        self.m2[index] = cell.m2;
    }

    /// Adds one sample to a cell.
    #[doc(alias = "add_sample")]
    #[inline]
    pub fn add(&mut self, index: usize, x: f64) {
        let mut cell = self.cell(index);
        cell.add(x);
        self.set(index, cell);
    }

    /// Adds the samples of another set to a cell.
    #[inline]
    pub fn merge_cell(&mut self, index: usize, other: &Statistics) {
        let mut cell = self.cell(index);
        cell.merge(other);
        self.set(index, cell);
    }

    /// Adds `n` samples with the given mean and unbiased variance to a cell.
    ///
    /// # Errors
    /// As [`Statistics::from_parts`]; the cell is then left as it was.
    pub fn combine_samples(
        &mut self,
        index: usize,
        mean: f64,
        variance: f64,
        n: u64,
    ) -> Result<(), MathError> {
        self.merge_cell(index, &Statistics::from_parts(n, mean, variance)?);
        Ok(())
    }

    /// Adds the samples of another array of the same shape, cell by cell.
    ///
    /// # Errors
    /// [`MathError::ShapeMismatch`]; the array is then left as it was.
    pub fn merge(&mut self, other: &Self) -> Result<(), MathError> {
        if self.shape != other.shape {
            return Err(MathError::ShapeMismatch { left: self.shape.clone(), right: other.shape.clone() });
        }
        (0..self.len()).for_each(|index| self.merge_cell(index, &other.cell(index)));
        Ok(())
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.count.fill(0);
        self.mean.fill(0.0);
        self.m2.fill(0.0);
    }

    /// Numbers of samples.
    #[doc(alias = "samples")]
    #[inline]
    pub fn counts(&self) -> &[u64] {
        &self.count
    }

    /// Means; 0 in cells without samples.
    #[inline]
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// Unbiased variances of one sample; infinite in cells with fewer than two samples.
    pub fn variances(&self) -> Vec<f64> {
        (0..self.len()).map(|index| self.cell(index).variance()).collect()
    }

    /// Standard errors of the means; infinite in cells with fewer than two samples.
    pub fn errors(&self) -> Vec<f64> {
        (0..self.len()).map(|index| self.cell(index).error()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn cells_are_stored_row_by_row() {
        let array = StatisticsArray::new(&[2, 3, 4]).unwrap();
        let mut expected = 0;
        for i in 0..2 {
            for j in 0..3 {
                for k in 0..4 {
                    assert_eq!(array.index(&[i, j, k]), Ok(expected));
                    expected += 1;
                }
            }
        }
        assert_eq!((array.len(), array.shape(), array.is_empty()), (24, &[2, 3, 4][..], false));
        for bad in [&[0, 0][..], &[0, 0, 0, 0], &[2, 0, 0], &[0, 3, 0], &[0, 0, 4]] {
            assert!(array.index(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn bad_shapes_are_refused() {
        for bad in [&[][..], &[1, 1, 1, 1], &[0], &[3, 0], &[1, 0, 1], &[usize::MAX; 3], &[1 << 25, 1 << 25]]
        {
            assert!(matches!(StatisticsArray::new(bad), Err(MathError::OutOfRange { .. })), "{bad:?}");
        }
        let message = StatisticsArray::new(&[3, 0]).unwrap_err().to_string();
        assert_eq!(message, "extent of an axis = 0 cells is outside its range 1 or more");
    }

    #[test]
    fn a_cell_keeps_the_statistics_of_its_own_samples() {
        let mut array = StatisticsArray::new(&[3]).unwrap();
        let mut alone = Statistics::new();
        for x in [1.0, 4.0, -2.5] {
            array.add(1, x);
            alone.add(x);
        }
        array.combine_samples(1, 3.0, 0.5, 1 << 33).unwrap();
        alone.merge(&Statistics::from_parts(1 << 33, 3.0, 0.5).unwrap());
        array.combine_samples(2, 7.0, 0.0, 1).unwrap();
        assert_eq!(array.cell(1), alone);
        assert_eq!(array.counts(), &[0, (1 << 33) + 3, 1]);
        assert_eq!(array.mean(), &[0.0, alone.mean(), 7.0]);
        assert_eq!(array.errors(), [f64::INFINITY, alone.error(), f64::INFINITY]);
        assert_eq!(array.variances(), [f64::INFINITY, alone.variance(), f64::INFINITY]);
        let before = array.clone();
        assert!(array.combine_samples(1, 3.0, -0.5, 10).is_err());
        assert_eq!(array, before);
        array.clear();
        assert_eq!(array, StatisticsArray::new(&[3]).unwrap());
    }

    #[test]
    fn other_shapes_are_not_merged() {
        let mut array = StatisticsArray::new(&[2, 3]).unwrap();
        for shape in [&[3, 2][..], &[6], &[2, 3, 1]] {
            let other = StatisticsArray::new(shape).unwrap();
            let expected = MathError::ShapeMismatch { left: vec![2, 3], right: shape.to_vec() };
            assert_eq!(array.merge(&other), Err(expected));
        }
        let error = array.merge(&StatisticsArray::new(&[6]).unwrap()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the arrays have the shapes [2, 3] and [6] [cells]: they must be equal"
        );
    }

    #[test]
    #[should_panic(expected = "out of bounds")]
    fn an_index_beyond_the_array_panics() {
        StatisticsArray::new(&[2, 2]).unwrap().add(4, 1.0);
    }

    proptest! {
        #[test]
        fn arrays_merge_like_their_cells(
            samples in prop::collection::vec((0..6usize, -1e3..1e3f64, any::<bool>()), 1..200),
        ) {
            let empty = StatisticsArray::new(&[2, 3]).unwrap();
            let (mut left, mut right, mut whole) = (empty.clone(), empty.clone(), empty);
            for (index, x, first) in samples {
                if first { left.add(index, x) } else { right.add(index, x) }
                whole.add(index, x);
            }
            left.merge(&right).unwrap();
            prop_assert_eq!(left.counts(), whole.counts());
            for i in 0..6 {
                prop_assert!((left.mean()[i] - whole.mean()[i]).abs() <= 1e-12 * 1e3);
                if whole.counts()[i] > 1 {
                    let (a, b) = (left.variances()[i], whole.variances()[i]);
                    prop_assert!((a - b).abs() <= 1e-12 * (b + 1e3 * b.sqrt() + 1e-6), "{} {}", a, b);
                } else {
                    prop_assert_eq!(left.errors()[i], f64::INFINITY);
                }
            }
        }
    }
}
