//! The media of the two materials of a sum or a blend, in the same volume.

use raysect_core::Ray;

use super::buffers::with_buffer;
use super::parts::Parts;
use crate::Context;
use crate::material::{Coefficients, Medium, MediumPoint, Refraction, Structure};

/// The structure of two media together: the finer one if both are declared, else that of one which is not, so that
/// each is solved by itself.
fn combined(first: Structure, second: Structure) -> Structure {
    use Structure::{Homogeneous, Smooth, Unknown};
    match (first, second) {
        (Smooth { length_scale: a }, Smooth { length_scale: b }) => Smooth { length_scale: a.min(b) },
        (Unknown { step: a }, Unknown { step: b }) => Unknown { step: a.min(b) },
        (Homogeneous | Smooth { .. }, other) if other != Homogeneous => other,
        (other, _) => other,
    }
}

/// True for a mixture whose parts have to be solved each by itself.
pub(super) fn is_divided(medium: &dyn Medium) -> bool {
    use Structure::{Homogeneous, Smooth, Unknown};
    medium.parts().is_some_and(|parts| {
        let [one, two] = parts.map(|(_, part)| part);
        let at_once = match (one.structure(), two.structure()) {
            (Homogeneous | Smooth { .. }, Homogeneous | Smooth { .. }) | (Unknown { .. }, Unknown { .. }) => {
                true
            }
            (first, second) => first == second,
        };
        !at_once || is_divided(one) || is_divided(two)
    })
}

impl Parts {
    /// Both media, if there are two, with their shares.
    fn media(&self) -> Option<[(f64, &dyn Medium); 2]> {
        let (first, second) = (self.first.medium()?, self.second.medium()?);
        Some([(self.shares[0], first), (self.shares[1], second)])
    }
}

/// Asked for only where both parts have a medium.
impl Medium for Parts {
    fn refraction(&self) -> Option<&Refraction> {
        self.media()?.into_iter().find_map(|(_, medium)| medium.refraction())
    }

    fn structure(&self) -> Structure {
        self.media().map(|[a, b]| combined(a.1.structure(), b.1.structure())).unwrap_or_default()
    }

    fn breakpoints(&self, ray: &Ray, out: &mut Vec<f64>) {
        self.media().into_iter().flatten().for_each(|(_, medium)| medium.breakpoints(ray, out));
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        for (share, medium) in self.media().into_iter().flatten() {
            add_share(share, medium, at, out);
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
pub(crate) fn add_share(share: f64, medium: &dyn Medium, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
    if share == 1.0 {
        return medium.coefficients(at, out);
    }
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
    fn structures_combine_to_the_finer_one_or_to_that_which_is_not_declared() {
        let smooth = |length_scale| Structure::Smooth { length_scale };
        let (unknown, steps) =
            (|step| Structure::Unknown { step }, Structure::Trapezium { step: 0.3, points: 5 });
        assert_eq!(combined(Structure::Homogeneous, smooth(0.1)), smooth(0.1));
        assert_eq!(combined(smooth(0.1), Structure::Homogeneous), smooth(0.1));
        assert_eq!(combined(smooth(0.2), smooth(0.1)), smooth(0.1));
        assert_eq!(combined(unknown(0.2), unknown(0.1)), unknown(0.1));
        for declared in [Structure::Homogeneous, smooth(0.2)] {
            for other in [unknown(0.1), steps] {
                assert_eq!((combined(declared, other), combined(other, declared)), (other, other));
            }
        }
    }
}
