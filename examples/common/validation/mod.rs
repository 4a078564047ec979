//! Problems with answers in closed form: builds the scene of each from its kind and parameters, measures, and judges.

mod beacon;
mod case;
mod chords;
mod colours;
mod factors;
mod fault;
mod furnaces;
mod instruments;
mod lenses;
mod measure;
mod plates;
mod prisms;
mod reading;
mod refraction;
mod scenes;
mod sensors;

pub(crate) use case::{Case, read_cases};
pub(crate) use fault::Fault;
pub(crate) use reading::{Reading, Verdict, judge};
use scenes::Bench;

/// What a case reads; none if nothing here knows its kind, an error if it cannot be built or measured.
pub(crate) fn measure(case: &Case, seed: u64, fault: Option<Fault>) -> Option<Result<Reading, String>> {
    let bench = Bench { seed, fault };
    let kinds = [
        furnaces::measure,
        factors::measure,
        chords::measure,
        prisms::measure,
        lenses::measure,
        refraction::measure,
        colours::measure,
        sensors::measure,
        plates::measure,
    ];
    kinds.iter().find_map(|kind| kind(case, bench))
}
