use raysect_math::Vector3D;

use super::SurfacePoint;
use crate::Departure;

/// Cosine below which a chord may be hidden by rounding: that of one as high as the rounding of its place, where a
/// surface of a radius of 100 roundings is still one.
const GRAZING: f64 = 0.1;

/// How many surfaces at one place are remembered while a ray works its way through them.
const CLUSTER: usize = 4;

/// Where a ray comes from: the surface it leaves, and others that coincide with it.
///
/// Nothing is moved off a surface. The ray begins at the hit point, and the crossing that it leaves is recognised
/// by its instance and kind. Within the error of the point, crossings of *other* instances count exactly if the
/// ray still has to pass them: if it runs through their surface in the sense in which it arrived, and has not been
/// through them already.
#[derive(Debug, Clone, Copy)]
pub struct Leaving {
    pub(super) departure: Departure,
    pub(super) grazes: bool,
    pub(super) instance: u32,
    clustered: u32,
    pub(super) zone: f64,
    arrived: Vector3D,
    towards: Vector3D,
    /// Instances that coincide here, and in which direction the ray went away from them: a sign is all that is
    /// asked of it.
    cluster: [(u32, [f32; 3]); CLUSTER],
}

impl Leaving {
    /// For a ray that arrived along `arrived` at `surface` and leaves along `towards` (both unit vectors).
    /// `before` is where the arriving ray itself came from.
    // Written so that the answer is made where it is wanted: it is too large to be copied in passing.
    #[inline]
    pub fn new(surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D, before: Option<&Self>) -> Self {
        if let Some(before) = before.filter(|b| surface.distance <= b.zone) {
            return Self::departing(surface, arrived, towards).remembering(before);
        }
        Self::departing(surface, arrived, towards)
    }

    /// The same for a ray whose departure is kept: from where it came is replaced by where it now is.
    #[inline]
    pub fn renew(kept: &mut Option<Self>, surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D) {
        if let Some(before) = kept.as_ref().filter(|b| surface.distance <= b.zone) {
            *kept = Some(Self::departing(surface, arrived, towards).remembering(before));
            return;
        }
        *kept = Some(Self::departing(surface, arrived, towards));
    }

    #[inline(always)]
    fn departing(surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D) -> Self {
        let cosine = surface.normal.dot(towards);
        // A chord that is thinner than rounding may end where the normal still faces the ray: what goes straight on has
        // passed it all the same.
        let inward = if towards == arrived { !surface.exiting } else { cosine < 0.0 };
        let departure =
            Departure { inward, bound: surface.bound / cosine.abs().max(1e-12), feature: surface.feature };
        Self {
            departure,
            grazes: cosine.abs() < GRAZING,
            instance: surface.instance,
            clustered: 0,
            zone: surface.bound / cosine.abs().max(1e-3),
            arrived,
            towards,
            cluster: [(u32::MAX, [0.0; 3]); CLUSTER],
        }
    }

    /// Takes over what coincides here: the same place as before, left anew.
    #[cold]
    fn remembering(mut self, before: &Self) -> Self {
        let towards = before.towards.to_array().map(|x| x as f32);
        let known = &before.cluster[..before.clustered as usize];
        for &(instance, direction) in known.iter().chain([&(before.instance, towards)]) {
            if instance != self.instance && (self.clustered as usize) < CLUSTER {
                self.cluster[self.clustered as usize] = (instance, direction);
                self.clustered += 1;
            }
        }
        self
    }

    /// Notes that the ray has gone through another surface at the same place, too.
    pub fn passed(&mut self, instance: u32) {
        if instance != self.instance && (self.clustered as usize) < CLUSTER {
            let towards = self.towards.to_array().map(|x| x as f32);
            self.cluster[self.clustered as usize] = (instance, towards);
            self.clustered += 1;
        }
    }

    /// Within this distance along the ray, crossings count as being at the same place.
    pub fn zone(&self) -> f64 {
        self.zone
    }

    /// Number of the instance that is being left.
    pub fn instance(&self) -> u32 {
        self.instance
    }

    /// True if a crossing of another instance within the zone of doubt has still to be passed.
    #[cold]
    pub(super) fn pending(&self, instance: u32, normal: Vector3D) -> bool {
        let ahead = normal.dot(self.towards);
        let known = self.cluster[..self.clustered as usize].iter().rev().find(|(i, _)| *i == instance);
        match known {
            // It has been dealt with, and comes again only if the ray has turned back.
            Some((_, direction)) => normal.dot(direction.map(f64::from)) * ahead < 0.0,
            None => normal.dot(self.arrived) * ahead > 0.0,
        }
    }
}
