use std::sync::Arc;

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_core::{NodeId, Ray};
use raysect_math::{MathError, Point3D, Rng, Vector3D};
use raysect_optical::World;

use crate::{FrameShape, Observer, ObserverError, Sensor, Target};

/// A sensor that sends a part of its rays towards targets, and the others as it would without.
///
/// What it measures is the same; small and bright targets are seen with less noise. The density of its directions is the
/// mixture of that of the sensor and those of all targets, evaluated in full for every ray, so that nothing is counted
/// twice or lost wherever targets lie, overlap, or dip below the horizon. Any sensor can be targeted that tells the
/// density of its directions ([`Sensor::direction_pdf`]): all but those that look one way only, and
/// [`VectorCamera`](crate::VectorCamera).
///
/// Made by [`Observer::targets`] or [`Observer::aimed_at`].
#[derive(Debug, Clone)]
pub struct Targeted<S> {
    inner: S,
    targets: Arc<[Target]>,
    probability: f64,
}

impl<S: Sensor> Observer<S> {
    /// Aims a share `probability` of all rays at targets, each as often as the others.
    ///
    /// Targets are in the observer's own space and move with it. From a point that lies inside a target, or in its plane if
    /// it is flat, the sensor's own directions take the place of those towards it.
    ///
    /// # Errors
    /// [`ObserverError::Math`] without targets, or for a probability outside 0 … 1: both are excluded, since a sensor that
    /// looks at nothing but its targets would not see what is not one. [`ObserverError::OneWay`] for a sensor that cannot
    /// look elsewhere.
    #[doc(alias = "targeted_path_prob")]
    pub fn targets(
        self,
        targets: impl Into<Vec<Target>>,
        probability: f64,
    ) -> Result<Observer<Targeted<S>>, ObserverError> {
        let targets = targets.into();
        self.try_map(|inner| Targeted::of(inner, targets, probability))
    }

    /// Aims a share `probability` of all rays at shapes of a world, where observer and shapes are now: at what they fill, or
    /// at their bounding spheres ([`Target::shape`]). What is measured stays right if they move apart later, but the rays go
    /// where the shapes have been.
    ///
    /// # Errors
    /// As [`targets`](Self::targets); [`ObserverError::NoShape`] for a node without shape,
    /// [`raysect_core::CoreError::UnknownNode`] for one of another world.
    pub fn aimed_at(
        self,
        world: &World,
        nodes: &[NodeId],
        probability: f64,
    ) -> Result<Observer<Targeted<S>>, ObserverError> {
        let to_sensor = self.to_root(world)?.inverse()?;
        let target = |&node: &NodeId| {
            let shape = world.primitive(node)?.ok_or_else(|| ObserverError::NoShape(node.to_string()))?;
            Target::shape(shape, to_sensor * world.to_root(node)?)
        };
        let targets = nodes.iter().map(target).collect::<Result<Vec<_>, ObserverError>>()?;
        self.targets(targets, probability)
    }
}

impl<S: Sensor> Targeted<S> {
    fn of(inner: S, targets: Vec<Target>, probability: f64) -> Result<Self, ObserverError> {
        let count = targets.len() as f64;
        MathError::check(!targets.is_empty(), count, "number of targets", "", "1 or more")?;
        let admitted = probability > 0.0 && probability < 1.0;
        MathError::check(admitted, probability, "share of rays at targets", "", "0 … 1, both excluded")?;
        for pixel in 0..inner.shape().pixels() {
            if inner.direction_pdf(pixel, Point3D::ORIGIN, Vector3D::Z).is_none() {
                return Err(ObserverError::OneWay { sensor: inner.kind(), pixel });
            }
        }
        Ok(Self { inner, targets: targets.into(), probability })
    }

    /// The sensor whose directions are mixed.
    pub fn inner(&self) -> &S {
        &self.inner
    }

    /// What it aims at.
    pub fn all_targets(&self) -> &[Target] {
        &self.targets
    }

    /// Density of the mixture [1/sr], and that of the sensor alone.
    fn densities(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> (f64, f64) {
        let own = self.inner.direction_pdf(pixel, origin, direction).unwrap_or(0.0);
        let towards = |target: &Target| target.pdf(origin, direction).unwrap_or(own);
        let aimed = self.targets.iter().map(towards).sum::<f64>() / self.targets.len() as f64;
        ((1.0 - self.probability) * own + self.probability * aimed, own)
    }
}

impl<S: Sensor> Sensor for Targeted<S> {
    fn shape(&self) -> FrameShape {
        self.inner.shape()
    }

    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let ray = self.inner.sample_ray(pixel, rng);
        let u = rng.uniform();
        if u >= self.probability {
            return ray;
        }
        // What is left of the number chooses the target.
        let chosen = (u / self.probability * self.targets.len() as f64) as usize;
        match self.targets[chosen.min(self.targets.len() - 1)].sample(ray.origin, rng) {
            Some(direction) => Ray::new(ray.origin, direction),
            None => ray,
        }
    }

    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.inner.origin_pdf(pixel, origin)? * self.densities(pixel, origin, direction).0)
    }

    fn origin_pdf(&self, pixel: usize, origin: Point3D) -> Option<f64> {
        self.inner.origin_pdf(pixel, origin)
    }

    fn direction_pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.densities(pixel, origin, direction).0)
    }

    /// That of the sensor; of one that weighs its own directions equally, times their share in the mixture.
    fn response(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> f64 {
        let response = self.inner.response(pixel, origin, direction);
        if self.inner.origin_pdf(pixel, origin).is_some() {
            return response;
        }
        let (mixture, own) = self.densities(pixel, origin, direction);
        if own > 0.0 { response * (own / mixture) } else { 0.0 }
    }

    fn cosine(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> f64 {
        self.inner.cosine(pixel, origin, direction)
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.inner.etendue(pixel)
    }

    fn description(&self) -> String {
        let (inner, share) = (self.inner.description(), self.probability);
        let numbers = self.targets.iter().flat_map(Target::numbers);
        let digest = crate::imaging::etendue::digest(numbers);
        format!("{inner}, {share} of its rays at {} targets {digest:016x}", self.targets.len())
    }

    fn kind(&self) -> &'static str {
        self.inner.kind()
    }
}

impl<S: Sensor + Storable> Storable for Targeted<S> {
    const KIND: &'static str = "Targeted";

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let mut saved = self
            .inner
            .save(saved, writer)?
            .text("targeted_sensor", S::KIND)
            .number("target_probability", self.probability)
            .count("target_count", self.targets.len() as u64);
        for (index, target) in self.targets.iter().enumerate() {
            saved = target.save(&format!("target_{index}"), saved, writer)?;
        }
        Ok(saved)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        entry.choice("targeted_sensor", &[(S::KIND, ())])?;
        let inner = S::load(entry)?;
        let mut targets = Vec::new();
        for index in 0..entry.count("target_count")? {
            targets.push(Target::load(&format!("target_{index}"), entry)?);
        }
        Ok(Self::of(inner, targets, entry.number("target_probability")?)?)
    }
}

#[cfg(test)]
#[path = "targeted_tests.rs"]
mod tests;
