//! The bins of a spectrum, and the tables of everything that depends on the wavelength.

use std::fmt;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, OnceLock};

use raysect_core::save::{SaveError, Saved, SceneObject, SceneWriter};

use crate::{OpticalError, SpectralFunction};

/// A spectral function shared by materials. Each slice of the spectrum keeps one table of its bin averages, found
/// without locks or hashing by the number that the function gets here.
///
/// Clones share function and table.
#[derive(Clone)]
pub struct SpectralTable {
    function: Arc<dyn SpectralFunction>,
    id: u32,
}

static NEXT_ID: AtomicU32 = AtomicU32::new(0);

impl SpectralTable {
    /// Shares a function.
    pub fn new(function: impl SpectralFunction) -> Self {
        Self { function: Arc::new(function), id: NEXT_ID.fetch_add(1, Ordering::Relaxed) }
    }

    /// The function.
    pub fn function(&self) -> &dyn SpectralFunction {
        &*self.function
    }
}

impl SceneObject for SpectralTable {
    const ROLE: &'static str = "function";

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        SpectralFunction::save(&self.function, writer)
    }
}

impl<F: SpectralFunction> From<F> for SpectralTable {
    fn from(function: F) -> Self {
        Self::new(function)
    }
}

impl fmt::Debug for SpectralTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SpectralTable {}", self.id)
    }
}

/// Bin averages of a function over a slice.
#[derive(Debug)]
pub struct Table {
    /// The average over each bin.
    pub bins: Box<[f64]>,
    /// The average over the slice.
    pub mean: f64,
}

/// Tables by number, in blocks that double in size: reached by two additions, grown without moving.
struct Tables([OnceLock<Box<[OnceLock<Table>]>>; 26]);

impl Tables {
    const FIRST: u32 = 64;

    fn get(&self, id: u32) -> &OnceLock<Table> {
        let shifted = id + Self::FIRST;
        let block = (31 - shifted.leading_zeros()) - Self::FIRST.trailing_zeros();
        let size = Self::FIRST << block;
        let cells = self.0[block as usize].get_or_init(|| (0..size).map(|_| OnceLock::new()).collect());
        &cells[(shifted - size) as usize]
    }
}

/// A contiguous group of bins that one ray carries.
pub struct Slice {
    /// Number of the slice among those of its observation.
    pub index: usize,
    /// Number of its first bin in the whole spectrum.
    pub offset: usize,
    /// How many bins it has.
    pub bins: usize,
    /// Its lower end [nm].
    pub min: f64,
    /// Its upper end [nm].
    pub max: f64,
    tables: Tables,
}

impl fmt::Debug for Slice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Slice {}: bins {} + {}, {} … {} nm",
            self.index, self.offset, self.bins, self.min, self.max
        )
    }
}

impl Slice {
    /// Width of a bin [nm].
    pub fn bin_width(&self) -> f64 {
        (self.max - self.min) / self.bins as f64
    }

    /// The bin averages of a function, computed at the first call.
    #[inline]
    pub fn table(&self, function: &SpectralTable) -> &[f64] {
        &self.full_table(function).bins
    }

    /// The average of a function over the whole slice.
    #[inline]
    pub fn mean(&self, function: &SpectralTable) -> f64 {
        self.full_table(function).mean
    }

    #[inline]
    fn full_table(&self, function: &SpectralTable) -> &Table {
        self.tables.get(function.id).get_or_init(|| {
            let bins: Box<[f64]> = function.function.sample(self.min, self.max, self.bins).into();
            let mean = bins.iter().sum::<f64>() / bins.len() as f64;
            Table { bins, mean }
        })
    }
}

/// The spectral range of an observation, its bins, and how many rays share them.
///
/// With one slice a ray carries all bins; with more, each slice is traced by rays of its own, as dispersion by the
/// mean index of a slice demands.
///
/// ```
/// use raysect_optical::Slicing;
/// let slices = Slicing::new(375.0, 740.0, 10, 4)?.slices();
/// assert_eq!(slices.iter().map(|s| s.bins).collect::<Vec<_>>(), [2, 3, 3, 2]);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[doc(alias = "SpectralSlice")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slicing {
    min: f64,
    max: f64,
    bins: usize,
    slices: usize,
}

impl Slicing {
    /// From the range [nm], the number of bins and the number of slices (Raysect's `spectral_rays`).
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] unless 0 < min < max, and 1 ≤ slices ≤ bins.
    pub fn new(min: f64, max: f64, bins: usize, slices: usize) -> Result<Self, OpticalError> {
        let wrong = |what| Err(OpticalError::Slicing { bins, slices, min, max, what });
        if !(min > 0.0 && max > min && max.is_finite()) {
            return wrong("wavelengths must be positive, finite and in ascending order");
        }
        if slices == 0 || slices > bins {
            return wrong("there must be at least one bin in every slice, and one slice");
        }
        Ok(Self { min, max, bins, slices })
    }

    /// Lower end [nm].
    pub fn min_wavelength(&self) -> f64 {
        self.min
    }

    /// Upper end [nm].
    pub fn max_wavelength(&self) -> f64 {
        self.max
    }

    /// Number of bins.
    pub fn bins(&self) -> usize {
        self.bins
    }

    /// Number of slices.
    pub fn slice_count(&self) -> usize {
        self.slices
    }

    /// Width of a bin [nm].
    pub fn bin_width(&self) -> f64 {
        (self.max - self.min) / self.bins as f64
    }

    /// Centre of each bin [nm].
    pub fn wavelengths(&self) -> Vec<f64> {
        (0..self.bins).map(|i| self.min + self.bin_width() * (i as f64 + 0.5)).collect()
    }

    /// The slices, with tables still empty. Their ends are the multiples of bins / slices, rounded half to even.
    pub fn slices(&self) -> Vec<Slice> {
        let width = self.bins as f64 / self.slices as f64;
        let end = |k: usize| (k as f64 * width).round_ties_even() as usize;
        let wavelength = |bin: usize| self.min + (self.max - self.min) * (bin as f64 / self.bins as f64);
        (0..self.slices)
            .map(|index| Slice {
                index,
                offset: end(index),
                bins: end(index + 1) - end(index),
                min: wavelength(end(index)),
                max: wavelength(end(index + 1)),
                tables: Tables(Default::default()),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_are_cut_as_raysect_cuts_them() {
        let cut = |bins, slices| {
            let all = Slicing::new(375.0, 740.0, bins, slices).unwrap().slices();
            all.iter().map(|s| s.bins).collect::<Vec<_>>()
        };
        assert_eq!(cut(5, 2), [2, 3]);
        assert_eq!(cut(7, 2), [4, 3]);
        assert_eq!(cut(15, 7), [2, 2, 2, 3, 2, 2, 2]);
        let all = Slicing::new(375.0, 740.0, 15, 7).unwrap().slices();
        assert!(all.windows(2).all(|w| w[0].max == w[1].min && w[0].offset + w[0].bins == w[1].offset));
        assert_eq!((all[0].min, all[6].max), (375.0, 740.0));
    }

    #[test]
    fn impossible_ranges_are_refused() {
        assert!(Slicing::new(0.0, 740.0, 15, 1).is_err());
        assert!(Slicing::new(740.0, 375.0, 15, 1).is_err());
        assert!(Slicing::new(375.0, 740.0, 0, 1).is_err());
        assert!(Slicing::new(375.0, 740.0, 3, 4).is_err());
        assert!(Slicing::new(375.0, f64::INFINITY, 3, 1).is_err());
    }

    #[test]
    fn tables_are_found_for_functions_made_before_and_after() {
        let before = SpectralTable::new(2.0);
        let slices = Slicing::new(400.0, 500.0, 4, 1).unwrap().slices();
        assert_eq!(slices[0].table(&before), [2.0; 4]);
        let later: Vec<SpectralTable> = (0..1000).map(|i| SpectralTable::new(i as f64)).collect();
        for (i, table) in later.iter().enumerate() {
            assert_eq!(slices[0].mean(table), i as f64);
        }
        assert_eq!(slices[0].table(&before), [2.0; 4]);
    }
}
