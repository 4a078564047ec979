//! The media of the two materials of a sum or a blend, in the same volume.

use raysect_core::Ray;

use super::buffers::with_buffer;
use super::parts::Parts;
use crate::material::{Coefficients, Medium, MediumPoint, Refraction, Structure};
use crate::{Context, OpticalError};

/// The structure of two media together; none if no rule can solve both at once.
pub(super) fn combined(first: Structure, second: Structure) -> Option<Structure> {
    use Structure::{Homogeneous, Smooth, Unknown};
    match (first, second) {
        (Homogeneous, other @ (Homogeneous | Smooth { .. })) | (other @ Smooth { .. }, Homogeneous) => {
            Some(other)
        }
        (Smooth { length_scale: a }, Smooth { length_scale: b }) => Some(Smooth { length_scale: a.min(b) }),
        (Unknown { step: a }, Unknown { step: b }) => Some(Unknown { step: a.min(b) }),
        (a, b) => (a == b).then_some(a),
    }
}

impl Parts {
    /// Both media, if there are two, with their shares.
    fn media(&self) -> Option<[(f64, &dyn Medium); 2]> {
        let (first, second) = (self.first.medium()?, self.second.medium()?);
        Some([(self.shares[0], first), (self.shares[1], second)])
    }

    /// Refuses media that no rule can solve together.
    pub(super) fn check_media(&self) -> Result<(), OpticalError> {
        let combined = self.media().map(|[a, b]| combined(a.1.structure(), b.1.structure()));
        match combined {
            Some(None) => Err(OpticalError::Modifier {
                what: "their volumes are integrated by different rules; declare a length scale for both",
            }),
            _ => Ok(()),
        }
    }
}

/// Asked for only where both parts have a medium.
impl Medium for Parts {
    fn refraction(&self) -> Option<&Refraction> {
        self.media()?.into_iter().find_map(|(_, medium)| medium.refraction())
    }

    fn structure(&self) -> Structure {
        let both = self.media().and_then(|[a, b]| combined(a.1.structure(), b.1.structure()));
        both.unwrap_or_default()
    }

    fn breakpoints(&self, ray: &Ray, out: &mut Vec<f64>) {
        self.media().into_iter().flatten().for_each(|(_, medium)| medium.breakpoints(ray, out));
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        for (share, medium) in self.media().into_iter().flatten() {
            if share == 1.0 {
                medium.coefficients(at, out);
            } else {
                add_share(share, medium, at, out);
            }
        }
    }

    fn parts(&self) -> Option<[(f64, &dyn Medium); 2]> {
        self.media()
    }

    fn majorant(&self, at: Context<'_>) -> f64 {
        self.media().into_iter().flatten().map(|(share, medium)| share * medium.majorant(at)).sum()
    }
}

/// Adds a share of the coefficients of a medium.
fn add_share(share: f64, medium: &dyn Medium, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
    let bins = out.emission.len();
    with_buffer(3 * bins, |room| {
        room.fill(0.0);
        let (emission, rest) = room.split_at_mut(bins);
        let (attenuation, scattering) = rest.split_at_mut(bins);
        medium.coefficients(
            at,
            &mut Coefficients {
                emission: &mut *emission,
                attenuation: &mut *attenuation,
                scattering: &mut *scattering,
            },
        );
        let add = |to: &mut [f64], from: &[f64]| to.iter_mut().zip(from).for_each(|(t, f)| *t += share * f);
        add(out.emission, emission);
        add(out.attenuation, attenuation);
        add(out.scattering, scattering);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structures_combine_to_the_finer_one_or_not_at_all() {
        let smooth = |length_scale| Structure::Smooth { length_scale };
        assert_eq!(combined(Structure::Homogeneous, smooth(0.1)), Some(smooth(0.1)));
        assert_eq!(combined(smooth(0.2), smooth(0.1)), Some(smooth(0.1)));
        assert_eq!(combined(smooth(0.2), Structure::Unknown { step: 0.1 }), None);
        assert_eq!(combined(Structure::Unknown { step: 0.1 }, Structure::Homogeneous), None);
    }
}
