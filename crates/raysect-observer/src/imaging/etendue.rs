use raysect_core::save::{Entry, MakeError, Saved};
use raysect_math::MathError;

use crate::ObserverError;

/// Where the étendue of the pixels of a camera without an extended aperture comes from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum PixelEtendue {
    Unknown,
    /// The same for all [m² sr].
    Uniform(f64),
    /// By a small aperture [m²].
    Aperture(f64),
    /// One for each [m² sr].
    Map(Vec<f64>),
}

impl PixelEtendue {
    /// Refuses what no étendue of so many pixels is.
    pub(crate) fn checked(self, pixels: usize) -> Result<Self, ObserverError> {
        match &self {
            Self::Unknown => {}
            &Self::Uniform(value) => {
                let admitted = value > 0.0 && value.is_finite();
                MathError::check(admitted, value, "étendue", "m² sr", "positive and finite")?;
            }
            &Self::Aperture(area) => {
                let admitted = area > 0.0 && area.is_finite();
                MathError::check(admitted, area, "aperture", "m²", "positive and finite")?;
            }
            Self::Map(map) => {
                if map.len() != pixels {
                    let (what, found) = ("étendue map", map.len());
                    return Err(ObserverError::PixelCount { what, found, expected: pixels });
                }
                for &value in map {
                    let admitted = value >= 0.0 && value.is_finite();
                    MathError::check(admitted, value, "étendue", "m² sr", "0 or more and finite")?;
                }
            }
        }
        Ok(self)
    }

    /// That of a pixel [m² sr]; `projected` tells ∫ cos θ dΩ over the pixel [sr].
    #[inline]
    pub(crate) fn of(&self, pixel: usize, projected: impl Fn() -> f64) -> Option<f64> {
        match self {
            Self::Unknown => None,
            Self::Uniform(etendue) => Some(*etendue),
            Self::Aperture(area) => Some(area * projected()),
            Self::Map(map) => map.get(pixel).copied(),
        }
    }

    /// In words that differ if the numbers do.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Map(map) => format!("map {:016x}", digest(map.iter().copied())),
            known => format!("{known:?}"),
        }
    }

    pub(crate) fn save(&self, saved: Saved) -> Saved {
        match self {
            Self::Unknown => saved,
            Self::Uniform(etendue) => saved.number("etendue", *etendue),
            Self::Aperture(area) => saved.number("aperture", *area),
            Self::Map(map) => saved.numbers("etendue_map", map),
        }
    }

    /// Of a file. An aperture is read for cameras that can have one; what is left over is refused by the reader.
    pub(crate) fn load(entry: &Entry<'_>, pixels: usize, can_have_aperture: bool) -> Result<Self, MakeError> {
        let etendue = if entry.has("etendue") {
            Self::Uniform(entry.number("etendue")?)
        } else if can_have_aperture && entry.has("aperture") {
            Self::Aperture(entry.number("aperture")?)
        } else if entry.has("etendue_map") {
            Self::Map(entry.numbers("etendue_map")?)
        } else {
            Self::Unknown
        };
        Ok(etendue.checked(pixels)?)
    }
}

/// Tells lists of numbers apart by their bits.
pub(crate) fn digest(numbers: impl IntoIterator<Item = f64>) -> u64 {
    numbers.into_iter().fold(0u64, |d, x| (d.rotate_left(5) ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3))
}

/// The settings of cameras whose étendue must be given: `etendue` and `etendue_map`.
macro_rules! etendue_settings {
    ($sensor:ty) => {
        impl $crate::Observer<$sensor> {
            /// With the same étendue for every pixel [m² sr], so that power can be measured.
            ///
            /// # Errors
            /// [`ObserverError::Math`](crate::ObserverError::Math) unless it is positive and finite.
            #[doc(alias = "sensitivity")]
            pub fn etendue(mut self, etendue: f64) -> Result<Self, $crate::ObserverError> {
                let pixels = $crate::Sensor::shape(self.sensor()).pixels();
                self.sensor_mut().etendue =
                    $crate::imaging::etendue::PixelEtendue::Uniform(etendue).checked(pixels)?;
                Ok(self)
            }

            /// With the étendue of each pixel from a calibration [m² sr], row by row.
            ///
            /// # Errors
            /// [`ObserverError::PixelCount`](crate::ObserverError::PixelCount) for a wrong number of values,
            /// [`ObserverError::Math`](crate::ObserverError::Math) for one that is negative or not finite.
            pub fn etendue_map(mut self, map: Vec<f64>) -> Result<Self, $crate::ObserverError> {
                let pixels = $crate::Sensor::shape(self.sensor()).pixels();
                self.sensor_mut().etendue =
                    $crate::imaging::etendue::PixelEtendue::Map(map).checked(pixels)?;
                Ok(self)
            }
        }
    };
}
pub(crate) use etendue_settings;
