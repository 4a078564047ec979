use std::f64::consts::{PI, TAU};

use raysect_core::save::{Entry, SaveError, Saved};

/// How directions count in an étendue: by their cosine, or all alike as Raysect has it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Counting {
    pub(crate) without_cosine: bool,
}

/// What files call it.
const NAME: &str = "etendue_without_cosine";

impl Counting {
    /// The half space [sr].
    pub(crate) fn half_space(self) -> f64 {
        if self.without_cosine { TAU } else { PI }
    }

    /// Words to be added to a description.
    pub(crate) fn describe(self) -> &'static str {
        if self.without_cosine { ", étendue without cosine" } else { "" }
    }

    pub(crate) fn save(self, saved: Saved) -> Saved {
        if self.without_cosine { saved.flag(NAME, true) } else { saved }
    }

    pub(crate) fn load(entry: &Entry<'_>) -> Result<Self, SaveError> {
        Ok(Self { without_cosine: entry.has(NAME) && entry.flag(NAME)? })
    }
}

/// The setting of sensors that look into a range of directions from an area.
macro_rules! counting_setting {
    ($sensor:ty) => {
        impl $crate::Observer<$sensor> {
            /// Takes area times solid angle, without the cosine, for the étendue, as Raysect does. Off by default.
            ///
            /// It is for comparisons with Raysect only. The power that is measured does not change. What is called a
            /// radiance is too small, half of the radiance for a sensor of the half space like a
            /// [`Pixel`](crate::Pixel) (Raysect weighs each of its rays by 0.5), (1 + cos θ) / 2 of it for a cone of half
            /// angle θ; and [`check_sensor`](crate::testing::check_sensor) refuses the sensor.
            #[doc(alias = "sensitivity")]
            pub fn etendue_without_cosine(mut self, without_cosine: bool) -> Self {
                self.sensor_mut().counting.without_cosine = without_cosine;
                self
            }
        }
    };
}
pub(crate) use counting_setting;
