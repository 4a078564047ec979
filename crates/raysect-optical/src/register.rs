use std::sync::Arc;

use raysect_core::save::{Entry, MakeError, Registry, SaveError};
use raysect_math::Vector3D;

use crate::material::{LAWS, MASKINGS};
use crate::{
    AbsorbingSurface, Add, BlackBody, Blend, Checkerboard, Conductor, DebugLight, Dielectric, GaussianLine,
    HenyeyGreenstein, InterpolatedSf, Lambert, Material, NullMaterial, Optics, PerfectReflectingSurface,
    PhaseFunction, Rayleigh, RoughConductor, RoughDielectric, Roughen, Sellmeier, SpectralFunction,
    SpectralTable, Spectrum, TopHat, UniformSurfaceEmitter, UniformVolume, UnitySurfaceEmitter,
    VolumeTransform,
};

/// A world of shapes with materials as a file had it, and what was kept with it.
pub type SavedScene = raysect_core::save::SavedScene<Optics>;

/// Teaches a registry how materials and spectral functions are made.
///
/// ```
/// use raysect_core::save::Registry;
/// use raysect_optical::{Lambert, MaterialRegistry, OpticalEntry};
///
/// let mut registry = Registry::new();
/// registry.material("Lambert", |entry| Ok(Lambert::new(entry.function("reflectivity")?)));
/// ```
pub trait MaterialRegistry {
    /// Adds a maker of materials of a kind.
    fn material<M: Material>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<M, MakeError> + Send + Sync + 'static,
    );

    /// Adds a maker of spectral functions of a kind.
    fn function<F: SpectralFunction>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<F, MakeError> + Send + Sync + 'static,
    );
}

impl MaterialRegistry for Registry {
    fn material<M: Material>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<M, MakeError> + Send + Sync + 'static,
    ) {
        self.object(kind, move |entry| Ok(Arc::new(Optics::new(make(entry)?))));
    }

    fn function<F: SpectralFunction>(
        &mut self,
        kind: &str,
        make: impl Fn(&Entry<'_>) -> Result<F, MakeError> + Send + Sync + 'static,
    ) {
        self.object(kind, move |entry| Ok(Arc::new(SpectralTable::new(make(entry)?))));
    }
}

/// Reads what materials are made of.
pub trait OpticalEntry {
    /// The function that a field refers to.
    ///
    /// # Errors
    /// As [`Entry::object`].
    fn function(&self, name: &str) -> Result<SpectralTable, SaveError>;

    /// The other material that a field refers to.
    ///
    /// # Errors
    /// As [`Entry::object`].
    fn material(&self, name: &str) -> Result<Arc<dyn Material>, SaveError>;
}

impl OpticalEntry for Entry<'_> {
    fn function(&self, name: &str) -> Result<SpectralTable, SaveError> {
        Ok(SpectralTable::clone(&*self.object::<SpectralTable>(name)?))
    }

    fn material(&self, name: &str) -> Result<Arc<dyn Material>, SaveError> {
        Ok(self.object::<Optics>(name)?.0.clone())
    }
}

/// Teaches a registry how the materials and spectral functions of this crate are made of what a file says.
pub fn register(registry: &mut Registry) {
    registry.function("Constant", |entry| Ok(entry.number("value")?));
    registry.function("BlackBody", |entry| {
        let body = BlackBody::new(entry.number("temperature")?)?;
        Ok(body.emissivity(entry.function("emissivity")?).scaled(entry.number("scale")?)?)
    });
    registry.function("GaussianLine", |entry| {
        Ok(GaussianLine::new(entry.number("centre")?, entry.number("sigma")?, entry.number("total")?)?)
    });
    registry.function("InterpolatedSf", |entry| {
        Ok(InterpolatedSf::new(entry.numbers("wavelengths")?, entry.numbers("values")?)?)
    });
    registry.function("Sellmeier", |entry| Ok(Sellmeier::new(entry.array("b")?, entry.array("c")?)?));
    registry.function("Spectrum", |entry| {
        let (min, max) = (entry.number("min")?, entry.number("max")?);
        Ok(Spectrum::from_samples(min, max, entry.numbers("samples")?)?)
    });
    registry.function("TopHat", |entry| {
        Ok(TopHat::new(entry.number("min")?, entry.number("max")?, entry.number("value")?)?)
    });

    emitters(registry);
    surfaces(registry);
    modifiers(registry);
}

fn emitters(registry: &mut Registry) {
    registry.material("Checkerboard", |entry| {
        let first = (entry.function("first")?, entry.number("first_scale")?);
        let second = (entry.function("second")?, entry.number("second_scale")?);
        let board = Checkerboard::new(entry.number("width")?)?.spectra(first, second);
        Ok(board.importance(entry.number("importance")?))
    });
    registry.material("DebugLight", |entry| {
        let light = DebugLight::new(Vector3D::from(entry.array::<3>("direction")?))?;
        Ok(light.intensity(entry.number("intensity")?)?.spectrum(entry.function("spectrum")?))
    });
    registry.material("UniformVolume", |entry| {
        let mut volume = UniformVolume::new().importance(entry.number("importance")?);
        if entry.has("emission") {
            volume = volume.emission(entry.function("emission")?);
        }
        if entry.has("absorption") {
            volume = volume.absorption(entry.function("absorption")?);
        }
        if entry.has("scattering") {
            volume = volume.shared_scattering(entry.function("scattering")?, entry.object("phase")?);
        }
        Ok(volume)
    });
    registry.object::<dyn PhaseFunction>("HenyeyGreenstein", |entry| {
        Ok(Arc::new(HenyeyGreenstein::new(entry.number("asymmetry")?)?))
    });
    registry.object::<dyn PhaseFunction>("Rayleigh", |_| Ok(Arc::new(Rayleigh)));
    registry.material("UniformSurfaceEmitter", |entry| {
        let emitter = UniformSurfaceEmitter::new(entry.function("spectrum")?, entry.number("scale")?);
        Ok(emitter.importance(entry.number("importance")?))
    });
    registry.material("UnitySurfaceEmitter", |entry| {
        Ok(UnitySurfaceEmitter::new().importance(entry.number("importance")?))
    });
}

fn surfaces(registry: &mut Registry) {
    registry.material("AbsorbingSurface", |_| Ok(AbsorbingSurface));
    registry.material("Conductor", |entry| {
        let metal = Conductor::new(entry.function("index")?, entry.function("extinction")?);
        Ok(metal.fresnel(entry.choice("fresnel", &LAWS)?))
    });
    registry.material("Dielectric", dielectric);
    registry.material("Lambert", |entry| Ok(Lambert::new(entry.function("reflectivity")?)));
    registry.material("NullMaterial", |_| Ok(NullMaterial));
    registry.material("PerfectReflectingSurface", |_| Ok(PerfectReflectingSurface));
    registry.material("RoughConductor", |entry| {
        let (index, extinction) = (entry.function("index")?, entry.function("extinction")?);
        let metal = RoughConductor::new(index, extinction, entry.number("roughness")?)?;
        let metal = metal.fresnel(entry.choice("fresnel", &LAWS)?);
        Ok(metal.masking(entry.choice("masking", &MASKINGS)?))
    });
    registry.material("RoughDielectric", |entry| {
        let ground = RoughDielectric::of(dielectric(entry)?, entry.number("roughness")?)?;
        Ok(ground.masking(entry.choice("masking", &MASKINGS)?))
    });
}

fn dielectric(entry: &Entry<'_>) -> Result<Dielectric, MakeError> {
    Ok(Dielectric::new(entry.function("index")?, entry.function("transmission")?)?
        .named(entry.text("name")?)
        .external_index(entry.function("external_index")?)
        .priority(entry.integer("priority")?)
        .transmission_only(entry.flag("transmission_only")?)
        .importance(entry.number("importance")?))
}

fn modifiers(registry: &mut Registry) {
    registry.material("Add", |entry| {
        let mut sum = Add::new(entry.material("first")?, entry.material("second")?);
        if entry.flag("surface_only")? {
            sum = sum.surface_only()?;
        }
        if entry.flag("volume_only")? {
            sum = sum.volume_only()?;
        }
        Ok(sum)
    });
    registry.material("Blend", |entry| {
        let (first, second) = (entry.material("first")?, entry.material("second")?);
        let mut blend = Blend::new(first, second, entry.number("ratio")?)?;
        if entry.flag("surface_only")? {
            blend = blend.surface_only()?;
        }
        if entry.flag("volume_only")? {
            blend = blend.volume_only()?;
        }
        Ok(blend)
    });
    registry
        .material("Roughen", |entry| Ok(Roughen::new(entry.material("base")?, entry.number("roughness")?)?));
    registry.material("VolumeTransform", |entry| {
        Ok(VolumeTransform::new(entry.material("base")?, entry.transform("transform")?)?)
    });
}
