use crate::{Medium, Structure};

/// A medium that is solved by a rule of its own: a whole one, or a part of a mixture.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    pub(super) instance: u32,
    /// Its place among the parts of what fills the instance.
    pub(super) number: u32,
    pub(super) medium: &'a dyn Medium,
    pub(super) share: f64,
}

/// True if what happens along a ray can be told, and needs no places of its own at which it is asked.
pub(super) fn is_declared(structure: Structure) -> bool {
    matches!(structure, Structure::Homogeneous | Structure::Smooth { .. })
}

impl<'a> Part<'a> {
    pub(super) fn whole(instance: u32, medium: &'a dyn Medium) -> Self {
        Self { instance, number: 0, medium, share: 1.0 }
    }

    /// Lends `each` a whole medium with its structure, or the parts of a mixture whose own structure is not declared.
    pub(super) fn each(self, each: &mut dyn FnMut(Self, Structure)) {
        self.count(&mut 0, each);
    }

    fn count(self, next: &mut u32, each: &mut dyn FnMut(Self, Structure)) {
        let structure = self.medium.structure();
        let parts = if is_declared(structure) { None } else { self.medium.parts() };
        for (share, medium) in parts.into_iter().flatten() {
            Part { medium, share: self.share * share, ..self }.count(next, each);
        }
        if parts.is_none() {
            each(Part { number: *next, ..self }, structure);
            *next += 1;
        }
    }
}
