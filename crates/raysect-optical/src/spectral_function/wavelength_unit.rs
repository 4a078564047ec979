/// The unit in which a file gives its wavelengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WavelengthUnit {
    /// 1 nm.
    #[default]
    Nanometre,
    /// 1000 nm.
    Micrometre,
    /// 0.1 nm.
    Angstrom,
}

impl WavelengthUnit {
    /// A wavelength of this unit in nanometres.
    pub fn to_nanometres(self, wavelength: f64) -> f64 {
        match self {
            Self::Nanometre => wavelength,
            Self::Micrometre => wavelength * 1e3,
            Self::Angstrom => wavelength / 10.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_the_same_place_in_every_unit() {
        assert_eq!(WavelengthUnit::Nanometre.to_nanometres(546.1), 546.1);
        assert_eq!(WavelengthUnit::Micrometre.to_nanometres(0.5461), 546.1);
        assert_eq!(WavelengthUnit::Angstrom.to_nanometres(5461.0), 546.1);
    }
}
