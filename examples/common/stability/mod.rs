//! Judges of geometry where methods fail: tiny, huge, far, grazing, degenerate. Every expected value comes from closed forms
//! or from arithmetic with 32 digits; every family has controls that its judge must refuse.

mod afar;
mod bodies;
mod cell;
mod chords;
mod composites;
#[path = "../../../crates/raysect-primitive/src/double_double.rs"]
mod double_double;
mod enclosures;
mod exact;
mod mean_chords;
mod meshes;
mod metamorphic;
mod restarts;
mod scenes;
mod special;
mod tangents;
mod transforms;
mod wrong;

pub(crate) use cell::{Cell, Tally};

/// What is judged alike.
pub(crate) struct Family {
    /// Its name.
    pub(crate) name: &'static str,
    /// What must hold.
    pub(crate) cells: fn() -> Vec<Cell>,
    /// What is wrong on purpose and must be refused.
    pub(crate) controls: fn() -> Vec<Cell>,
}

macro_rules! families {
    ($($module:ident),* $(,)?) => {
        /// All families.
        pub(crate) const FAMILIES: &[Family] = &[$(Family {
            name: stringify!($module),
            cells: $module::cells,
            controls: $module::controls,
        }),*];
    };
}

families!(
    restarts,
    enclosures,
    afar,
    special,
    tangents,
    chords,
    transforms,
    meshes,
    composites,
    scenes,
    mean_chords,
    metamorphic,
);
