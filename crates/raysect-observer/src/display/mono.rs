use raysect_core::save::{Entry, MakeError, Saved};
use raysect_math::MathError;

use super::ColourMap;
use crate::ObserverError;

/// How the values of a channel are shown: what is black, what is white, and the colours in between.
///
/// A value v has the brightness ((v − black) / (white − black))^(1/γ), cut at 0 and 1. Without a white point, white
/// is the value that a share of the pixels does not exceed.
///
/// ```
/// use raysect_observer::{ColourMap, MonoDisplay};
/// let display = MonoDisplay::new().gamma(1.0)?.white_point(4.0)?.colours(ColourMap::Inferno);
/// assert_eq!(display.brightness(&[0.0, 1.0, 5.0]), [0.0, 0.25, 1.0]);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MonoDisplay {
    black: f64,
    white: White,
    gamma: f64,
    colours: ColourMap,
}

/// Which value is shown as white.
#[derive(Debug, Clone, Copy, PartialEq)]
enum White {
    /// The one that this share of the pixels does not exceed.
    Automatic(f64),
    /// This one.
    Fixed(f64),
}

impl Default for MonoDisplay {
    fn default() -> Self {
        Self::new()
    }
}

impl MonoDisplay {
    /// In grey, with black at 0, automatic exposure in which no pixel is saturated, and a gamma of 2.2.
    pub fn new() -> Self {
        Self { black: 0.0, white: White::Automatic(1.0), gamma: 2.2, colours: ColourMap::Grey }
    }

    /// With the value that is shown as black.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is finite and below a white point that has been given.
    #[doc(alias = "display_black_point")]
    pub fn black_point(mut self, black: f64) -> Result<Self, ObserverError> {
        let below = !matches!(self.white, White::Fixed(white) if black >= white);
        let admitted = black.is_finite() && below;
        MathError::check(admitted, black, "black point", "", "finite and below the white point")?;
        self.black = black;
        Ok(self)
    }

    /// With the value that is shown as white, instead of automatic exposure.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is finite and above the black point.
    #[doc(alias("display_white_point", "display_auto_exposure"))]
    pub fn white_point(mut self, white: f64) -> Result<Self, ObserverError> {
        let admitted = white.is_finite() && white > self.black;
        MathError::check(admitted, white, "white point", "", "finite and above the black point")?;
        self.white = White::Fixed(white);
        Ok(self)
    }

    /// With automatic exposure in which this share of the pixels is not saturated.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a share outside 0 … 1, or 0.
    #[doc(alias = "display_unsaturated_fraction")]
    pub fn unsaturated_fraction(mut self, fraction: f64) -> Result<Self, ObserverError> {
        self.white = White::Automatic(check_fraction(fraction)?);
        Ok(self)
    }

    /// With another gamma; 1 is linear.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is positive and finite.
    #[doc(alias = "display_gamma")]
    pub fn gamma(mut self, gamma: f64) -> Result<Self, ObserverError> {
        let admitted = gamma > 0.0 && gamma.is_finite();
        MathError::check(admitted, gamma, "gamma", "", "positive and finite")?;
        self.gamma = gamma;
        Ok(self)
    }

    /// In other colours.
    pub fn colours(self, colours: ColourMap) -> Self {
        Self { colours, ..self }
    }

    /// The colours.
    pub fn colour_map(&self) -> ColourMap {
        self.colours
    }

    /// The values that are black and white in a picture of these. Values that are not finite have no say; if none
    /// lies above black, white is one above it.
    pub fn range(&self, values: &[f64]) -> (f64, f64) {
        let white = match self.white {
            White::Fixed(white) => white,
            White::Automatic(fraction) => match unsaturated_value(values, fraction) {
                Some(white) if white > self.black => white,
                _ => (self.black + 1.0).max(self.black.next_up()),
            },
        };
        (self.black, white)
    }

    /// The same with fixed ends, which [`range`](Self::range) has found.
    #[cfg(feature = "plot")]
    pub(crate) fn between(self, black: f64, white: f64) -> Self {
        Self { black, white: White::Fixed(white), ..self }
    }

    /// The brightness of each value, 0 … 1; NaN for those that are not finite.
    pub fn brightness(&self, values: &[f64]) -> Vec<f64> {
        let (black, white) = self.range(values);
        let level = |v: f64| {
            if !v.is_finite() {
                return f64::NAN;
            }
            let linear = ((v.clamp(black, white) - black) / (white - black)).min(1.0);
            if self.gamma == 1.0 { linear } else { linear.powf(1.0 / self.gamma) }
        };
        values.iter().map(|&v| level(v)).collect()
    }

    /// The picture as 8-bit sRGB values, three for each value; middle grey for those that are not finite.
    pub fn to_srgb(&self, values: &[f64]) -> Vec<u8> {
        self.brightness(values).into_iter().flat_map(|b| self.colours.colour(b)).collect()
    }

    /// Its settings as fields of a pipeline.
    pub(crate) fn save(&self, saved: Saved) -> Saved {
        let saved = saved.number("black_point", self.black).number("gamma", self.gamma);
        let saved = saved.text("colours", self.colours.name());
        match self.white {
            White::Automatic(fraction) => saved.number("unsaturated_fraction", fraction),
            White::Fixed(white) => saved.number("white_point", white),
        }
    }

    pub(crate) fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let colours = entry.choice("colours", &ColourMap::ALL)?;
        let display = Self::new().colours(colours).gamma(entry.number("gamma")?)?;
        let display = display.black_point(entry.number("black_point")?)?;
        Ok(if entry.has("white_point") {
            display.white_point(entry.number("white_point")?)?
        } else {
            display.unsaturated_fraction(entry.number("unsaturated_fraction")?)?
        })
    }
}

/// A share of pixels, if it is one.
pub(crate) fn check_fraction(fraction: f64) -> Result<f64, ObserverError> {
    let admitted = fraction > 0.0 && fraction <= 1.0;
    MathError::check(admitted, fraction, "unsaturated fraction", "", "0 … 1, without 0")?;
    Ok(fraction)
}

/// The value that a share of the finite values does not exceed: number ⌊n · fraction⌋ in ascending order, or the
/// largest. None without finite values.
pub(crate) fn unsaturated_value(values: &[f64], fraction: f64) -> Option<f64> {
    let mut finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let last = finite.len().checked_sub(1)?;
    let place = ((finite.len() as f64 * fraction) as usize).min(last);
    Some(*finite.select_nth_unstable_by(place, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100, 99 … 1, and one that is not known.
    fn values() -> Vec<f64> {
        (1..=100).rev().map(f64::from).chain([f64::NAN]).collect()
    }

    #[test]
    fn white_is_the_percentile_that_was_asked_for() {
        let white = |fraction| MonoDisplay::new().unsaturated_fraction(fraction).unwrap().range(&values()).1;
        assert_eq!([white(1.0), white(0.95), white(0.5), white(0.001)], [100.0, 96.0, 51.0, 1.0]);
        let saturated = |fraction| values().iter().filter(|v| **v > white(fraction)).count();
        assert_eq!([saturated(1.0), saturated(0.95), saturated(0.5)], [0, 4, 49]);
    }

    #[test]
    fn brightness_runs_from_black_to_white_by_gamma() {
        let display = MonoDisplay::new().black_point(2.0).unwrap().white_point(10.0).unwrap();
        let shown = display.gamma(2.0).unwrap().brightness(&[-1.0, 2.0, 4.0, 10.0, 50.0, f64::INFINITY]);
        assert_eq!(shown[..5], [0.0, 0.0, 0.5, 1.0, 1.0]);
        assert!(shown[5].is_nan());
        let default = MonoDisplay::new().brightness(&[0.5, 1.0]);
        assert_eq!(default, [0.5f64.powf(1.0 / 2.2), 1.0]);
        assert_ne!(MonoDisplay::new().gamma(1.0).unwrap().brightness(&[0.5, 1.0]), default);
    }

    #[test]
    fn pictures_without_anything_bright_are_black() {
        for values in [&[][..], &[0.0, 0.0], &[f64::NAN], &[-1.0, -2.0]] {
            let display = MonoDisplay::new();
            assert_eq!(display.range(values), (0.0, 1.0));
            assert!(display.brightness(values).iter().all(|b| *b == 0.0 || b.is_nan()));
        }
        // Also where one more is too little to be told apart.
        let far = MonoDisplay::new().black_point(1e300).unwrap().brightness(&[1e300]);
        assert_eq!(far, [0.0]);
    }

    #[test]
    fn impossible_settings_are_refused() {
        let display = MonoDisplay::new();
        assert!(display.gamma(0.0).is_err() && display.gamma(f64::NAN).is_err());
        assert!(display.unsaturated_fraction(0.0).is_err() && display.unsaturated_fraction(1.1).is_err());
        assert!(display.white_point(0.0).is_err() && display.white_point(f64::INFINITY).is_err());
        assert!(display.black_point(f64::NAN).is_err());
        assert!(display.white_point(1.0).unwrap().black_point(1.0).is_err());
        let message = display.gamma(-1.0).unwrap_err().to_string();
        assert!(message.contains("gamma") && message.contains("-1"), "{message}");
    }
}
