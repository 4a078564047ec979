use std::fmt;

use raysect_optical::illumination::Illumination;
use raysect_optical::{Dispersion, LightSampling, World};

use crate::{Observer, ObserverError, Sensor};

/// What an observation will model, what it will not, and why: one line each, to be printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    lines: Vec<(String, String)>,
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (what, how)) in self.lines.iter().enumerate() {
            let end = if index + 1 == self.lines.len() { "" } else { "\n" };
            write!(f, "{what:<12} {how}{end}")?;
        }
        Ok(())
    }
}

impl Plan {
    pub(crate) fn new<S: Sensor>(observer: &Observer<S>, world: &World) -> Result<Self, ObserverError> {
        let (scene, slicing) = (world.scene()?, observer.slicing()?);
        let known = &scene.compiled;
        let engine = observer.chosen_engine()?;
        let mut plan = Self { lines: Vec::new() };
        let sensor = observer.sensor();
        plan.line("sensor", format!("{}, {}", sensor.kind(), sensor.shape()));
        plan.line(
            "quantity",
            match sensor.etendue(0) {
                Some(g) => format!("radiance, and power by an étendue of {g:.6e} m² sr (first pixel)"),
                None => "radiance only: no étendue is given, so no power".to_owned(),
            },
        );
        plan.line("scene", format!("{} shapes, {}", scene.instances.len(), scene.accelerator().describe()));
        plan.line(
            "spectrum",
            format!(
                "{} bins over {} … {} nm, {} ray{} a sample",
                slicing.bins(),
                slicing.min_wavelength(),
                slicing.max_wavelength(),
                slicing.slice_count(),
                if slicing.slice_count() == 1 { "" } else { "s" },
            ),
        );
        plan.line(
            "dispersion",
            dispersion(
                known,
                observer.path_settings().chosen_dispersion(),
                slicing.bins(),
                slicing.slice_count(),
            ),
        );
        plan.line("lights", lights(known, observer));
        plan.line(
            "volumes",
            if known.any_medium { volumes(known) } else { "none: no containment is asked for".to_owned() },
        );
        plan.line(
            "shadows",
            if known.any_transparent || known.any_medium {
                "followed through transparent surfaces and media".to_owned()
            } else {
                "any surface blocks: none is transparent, no volume is filled".to_owned()
            },
        );
        let paths = observer.path_settings();
        plan.line("paths", paths.to_string());
        plan.line(
            "work",
            format!(
                "{} samples a pixel, seed {}, {} thread{}",
                observer.samples_per_observation(),
                observer.seed_value(),
                engine.workers(),
                if engine.workers() == 1 { "" } else { "s" }
            ),
        );
        Ok(plan)
    }

    fn line(&mut self, what: &str, how: String) {
        self.lines.push((what.to_owned(), how));
    }

    /// The lines: what, and how.
    pub fn lines(&self) -> &[(String, String)] {
        &self.lines
    }
}

fn dispersion(known: &Illumination, model: Dispersion, bins: usize, slices: usize) -> String {
    if !known.any_dispersion {
        return "none: nothing refracts by wavelength, so one ray for all bins is exact".to_owned();
    }
    if model == Dispersion::Sampled {
        return "a wavelength is drawn in every bin; a path keeps one bin where it meets smooth glass"
            .to_owned();
    }
    let all = format!(
        "the mean index of each of {slices} slices of {bins} bins; inside a slice it is not modelled"
    );
    if slices < bins { format!("{all} (more with spectral_rays)") } else { all }
}

fn volumes(known: &Illumination) -> String {
    let line = match known.any_structure {
        true => "solved along every piece of a path as their structure is declared",
        false => "solved exactly along every piece of a path",
    };
    let scattering = if known.any_scattering { "paths are scattered in them" } else { "none scatters" };
    // Whether they overlap is found out by the paths.
    let equals = match known.contestable {
        true => {
            "; some refract with equal priority: the later node counts where they overlap, and the report warns"
        }
        false => "",
    };
    format!("media, {line}; {scattering}{equals}")
}

fn lights<S: Sensor>(known: &Illumination, observer: &Observer<S>) -> String {
    let names = |instances: &mut dyn Iterator<Item = usize>| {
        instances.map(|i| known.names[i].clone()).collect::<Vec<_>>().join(", ")
    };
    let sampled = names(&mut known.lights.iter().map(|l| l.instance as usize));
    match observer.path_settings().sampling() {
        LightSampling::Off => "not looked for: paths follow the surfaces alone".to_owned(),
        LightSampling::BoundingSpheres => {
            format!("{} bounding spheres are aimed at", known.all_targets.len())
        }
        LightSampling::Lights => {
            let lights = match known.lights.len() {
                0 => "none is sampled".to_owned(),
                n => format!("{n} sampled by shape ({sampled})"),
            };
            match known.targets.len() {
                0 => format!("{lights}; nothing else is important, so no mixture of directions"),
                n => format!("{lights}; {n} bounding spheres of other important things are aimed at"),
            }
        }
    }
}
