//! The two materials of a sum or a blend.

use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::buffers::with_buffer;
use crate::material::{Context, Facts, IndexUse, Material, Medium, SurfaceHit};
use crate::{OpticalError, Slice};

/// What of two materials is combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scope {
    Both,
    Surface,
    Volume,
}

/// Two materials, and which of their sides are combined: what is not is that of the first one.
#[derive(Clone)]
pub(super) struct Parts {
    pub(super) first: Arc<dyn Material>,
    pub(super) second: Arc<dyn Material>,
    /// How much of each counts.
    pub(super) shares: [f64; 2],
    scope: Scope,
    /// Asked for once: names are strings.
    known: [Known; 2],
}

/// What a hit needs to know of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub(super) emits: bool,
    pub(super) absorbs: bool,
    pub(super) transparent: bool,
}

impl Known {
    fn of(material: &dyn Material) -> Self {
        let Facts { emits, absorbs, transparent, .. } = material.facts();
        Self { emits, absorbs, transparent }
    }
}

impl Parts {
    pub(super) fn new(first: Arc<dyn Material>, second: Arc<dyn Material>, shares: [f64; 2]) -> Self {
        let known = [Known::of(&*first), Known::of(&*second)];
        Self { first, second, shares, scope: Scope::Both, known }
    }

    fn restricted(mut self, to: Scope) -> Result<Self, OpticalError> {
        if self.scope != Scope::Both && self.scope != to {
            return Err(OpticalError::Modifier { what: "surface_only and volume_only exclude each other" });
        }
        self.scope = to;
        Ok(self)
    }

    pub(super) fn surface_only(self) -> Result<Self, OpticalError> {
        self.restricted(Scope::Surface)
    }

    pub(super) fn volume_only(self) -> Result<Self, OpticalError> {
        self.restricted(Scope::Volume)
    }

    /// What is known of both surfaces; none if only that of the first counts.
    pub(super) fn surfaces(&self) -> Option<[Known; 2]> {
        (self.scope != Scope::Volume).then_some(self.known)
    }

    /// The sum of what both surfaces emit, with weights.
    pub(super) fn emit(&self, weights: [f64; 2], hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        let Some([first, second]) = self.surfaces() else { return self.first.emit(hit, at, out) };
        let one = first.emits && self.first.emit(hit, at, out);
        if !second.emits {
            scale(out, weights[0]);
            return one;
        }
        if !one {
            let two = self.second.emit(hit, at, out);
            scale(out, weights[1]);
            return two;
        }
        scale(out, weights[0]);
        with_buffer(out.len(), |buffer| {
            if self.second.emit(hit, at, buffer) {
                out.iter_mut().zip(buffer.iter()).for_each(|(o, b)| *o += weights[1] * b);
            }
        });
        true
    }

    /// What fills the volume: the media of both parts, with their shares; one that is alone counts whole.
    pub(super) fn medium(&self) -> Option<&dyn Medium> {
        match self.scope {
            Scope::Surface => self.first.medium(),
            Scope::Both | Scope::Volume => match (self.first.medium(), self.second.medium()) {
                (Some(_), Some(_)) => Some(self),
                (first, second) => first.or(second),
            },
        }
    }

    /// The facts of both together, under a name made of theirs.
    pub(super) fn facts(&self, name: impl FnOnce(&str, &str) -> String) -> Facts {
        let (first, second) = (self.first.facts(), self.second.facts());
        let name = name(&first.name, &second.name);
        // One that is impossible is not hidden by the other.
        let impossible = [&first, &second].into_iter().find(|facts| facts.check().is_err());
        let importance =
            impossible.map_or_else(|| first.importance.max(second.importance), |facts| facts.importance);
        let disperses = first.disperses || second.disperses;
        if self.scope == Scope::Volume {
            return Facts { name, importance, disperses, ..first };
        }
        Facts {
            name,
            importance,
            emits: first.emits || second.emits,
            transparent: first.transparent && second.transparent,
            disperses,
            absorbs: first.absorbs && second.absorbs,
            index_use: common(first.index_use, second.index_use),
        }
    }

    pub(super) fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.first.check(slice)?;
        self.second.check(slice)
    }

    pub(super) fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(saved
            .reference("first", writer.shared_object(&self.first)?)
            .reference("second", writer.shared_object(&self.second)?)
            .flag("surface_only", self.scope == Scope::Surface)
            .flag("volume_only", self.scope == Scope::Volume))
    }
}

/// What two surfaces in one place do with the indices.
fn common(first: IndexUse, second: IndexUse) -> IndexUse {
    match (first, second) {
        (IndexUse::None, other) | (other, IndexUse::None) => other,
        (IndexUse::EachBin, IndexUse::EachBin) => IndexUse::EachBin,
        _ => IndexUse::One,
    }
}

fn scale(bins: &mut [f64], factor: f64) {
    if factor != 1.0 {
        bins.iter_mut().for_each(|b| *b *= factor);
    }
}
