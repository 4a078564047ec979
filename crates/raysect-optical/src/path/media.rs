//! The media that a path is in, and what they do to it.

use raysect_core::{Leaving, Ray, SurfacePoint};

use super::Path;
use super::dispersion::Side;
use crate::{Medium, Refraction, SurfaceHit};

/// Instances whose volumes overlap at one place.
const CAPACITY: usize = 16;

/// The instances that fill the space around a path: a short list without allocation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct MediaList {
    instances: [u32; CAPACITY],
    count: usize,
}

impl MediaList {
    /// A list of one instance.
    pub(super) fn of(instance: u32) -> Self {
        let mut list = Self::default();
        list.insert(instance);
        list
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(super) fn as_slice(&self) -> &[u32] {
        &self.instances[..self.count]
    }

    fn contains(&self, instance: u32) -> bool {
        self.as_slice().contains(&instance)
    }

    /// `false` if it is in the list already, or the list is full.
    fn insert(&mut self, instance: u32) -> bool {
        if self.contains(instance) || self.count == CAPACITY {
            return false;
        }
        self.instances[self.count] = instance;
        self.count += 1;
        true
    }

    /// `false` if it is not in the list.
    fn remove(&mut self, instance: u32) -> bool {
        let Some(place) = self.as_slice().iter().position(|&i| i == instance) else { return false };
        self.instances.copy_within(place + 1..self.count, place);
        self.count -= 1;
        true
    }

    /// Into or out of an instance; `false` if that does not agree with the list.
    fn cross(&mut self, instance: u32, exiting: bool) -> bool {
        if exiting { self.remove(instance) } else { self.insert(instance) }
    }
}

/// Surfaces that may coincide with the one that a path is at.
const COINCIDENT: usize = 4;

/// Other refracting surfaces at the place of a path, and whether it leaves their solids there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Coincident {
    instances: [(u32, bool); COINCIDENT],
    count: usize,
}

impl Coincident {
    fn as_slice(&self) -> &[(u32, bool)] {
        &self.instances[..self.count]
    }

    /// Notes that a ray has gone through these surfaces, too.
    pub(super) fn note_passed(&self, leaving: &mut Leaving) {
        self.as_slice().iter().for_each(|(instance, _)| leaving.passed(*instance));
    }
}

impl<'a> Path<'a> {
    /// Finds the media that a path begins in: those whose surface it meets next from the inside. On a surface this
    /// is what the direction says, and it agrees with the crossings to come, whatever rounding makes of the origin.
    pub(super) fn surround(&mut self, ray: &Ray) {
        if !self.scene.compiled.any_medium {
            return;
        }
        if self.start.is_none_or(|(known, _)| known != ray.origin) {
            let (facts, mut near, mut fits) = (&self.scene.compiled.facts, MediaList::default(), true);
            let accelerator = self.scene.accelerator();
            accelerator.visit_containing(ray.origin, &mut |i| {
                fits &= !facts[i as usize].has_medium || near.insert(i);
            });
            self.ledger.inconsistencies += u64::from(!fits);
            self.start = Some((ray.origin, near));
        }
        self.media = MediaList::default();
        let near = self.start.map(|(_, near)| near).unwrap_or_default();
        for &instance in near.as_slice() {
            let next = self.scene.hit_instance(instance, ray, None, f64::INFINITY, &mut self.scratch);
            if next.is_some_and(|crossing| crossing.exiting) {
                self.media.insert(instance);
            }
        }
        self.note_contest();
    }

    pub(super) fn medium(&self, instance: u32) -> Option<&'a dyn Medium> {
        let scene = self.scene;
        scene.instances[instance as usize].attached.material().medium()
    }

    /// The refracting medium that counts among those of a list.
    pub(super) fn refracting(&self, media: &MediaList) -> Option<(u32, &'a Refraction)> {
        let all = media
            .as_slice()
            .iter()
            .filter_map(|&i| self.medium(i).and_then(|m| m.refraction()).map(|r| (i, r)));
        all.max_by_key(|(i, r)| (r.priority, *i))
    }

    /// What refracts before and behind a surface of a refracting solid; none if the same medium counts on both sides.
    fn interface(
        &self,
        media: &MediaList,
        surface: &SurfacePoint,
        others: &Coincident,
    ) -> Option<(Side<'a>, Side<'a>)> {
        let own = self.medium(surface.instance).and_then(|m| m.refraction())?;
        // What a surface says of itself is believed, whatever the list holds.
        let (mut before, mut behind) = (*media, *media);
        if surface.exiting {
            before.insert(surface.instance);
            behind.remove(surface.instance);
        } else {
            before.remove(surface.instance);
            behind.insert(surface.instance);
        }
        for &(instance, exiting) in others.as_slice() {
            behind.cross(instance, exiting);
        }
        let (near, far) = (self.refracting(&before), self.refracting(&behind));
        if near.map(|n| n.0) == far.map(|f| f.0) {
            return None;
        }
        let index =
            |medium: Option<(u32, &'a Refraction)>| medium.map_or(&own.external_index, |(_, r)| &r.index);
        Some((Some(index(near)), Some(index(far))))
    }

    /// The refracting surfaces of other solids that coincide with a surface, in the way of a path that goes straight
    /// through it: touching solids meet in one interface, not in two with nothing in between.
    fn coincident(&mut self, at: &SurfaceHit) -> Coincident {
        let (scene, direction) = (self.scene, at.direction);
        let mut found = Coincident::default();
        let mut leaving = Leaving::new(&at.surface, direction, direction, self.leaving.as_ref());
        let mut point = at.surface.point;
        while found.count < COINCIDENT {
            let ray = Ray::new(point, direction).with_max_distance(leaving.zone());
            let Some(next) = scene.hit(&ray, Some(&leaving), &mut self.scratch) else { break };
            let surface = scene.finish(&ray, &next);
            if self.refracts(next.instance) {
                found.instances[found.count] = (surface.instance, surface.exiting);
                found.count += 1;
            } else if !scene.compiled.facts[next.instance as usize].transparent {
                break;
            }
            leaving = Leaving::new(&surface, direction, direction, Some(&leaving));
            point = surface.point;
        }
        found
    }

    fn refracts(&self, instance: u32) -> bool {
        self.medium(instance).is_some_and(|m| m.refraction().is_some())
    }

    /// True unless the surface belongs to a refracting solid and is hidden by a medium of higher priority.
    pub(super) fn is_interface(&self, media: &MediaList, surface: &SurfacePoint) -> bool {
        !self.refracts(surface.instance) || self.interface(media, surface, &Coincident::default()).is_some()
    }

    /// Notes the indices at a surface; `false` if there is nothing to be met, since another medium hides it.
    pub(super) fn enter_interface(&mut self, at: &SurfaceHit) -> bool {
        let compiled = &self.scene.compiled;
        if !compiled.any_medium {
            return true;
        }
        self.coincident = Coincident::default();
        let facts = &compiled.facts[at.surface.instance as usize];
        if !facts.has_medium || !self.refracts(at.surface.instance) {
            let here = self.side_within(&self.media);
            self.note_indices(here, here, facts.index_use);
            return true;
        }
        let others = if compiled.refracting > 1 { self.coincident(at) } else { Coincident::default() };
        match self.interface(&self.media, &at.surface, &others) {
            Some((near, far)) => {
                self.note_indices(near, far, facts.index_use);
                self.coincident = others;
                true
            }
            // The others are met one by one, as if this surface were not there.
            None => false,
        }
    }

    /// What counts among the media of a list.
    fn side_within(&self, media: &MediaList) -> Side<'a> {
        self.refracting(media).map(|(_, r)| &r.index)
    }

    /// What refracts before and behind the surface of a light in given media, as a path would find it there; none if
    /// another medium hides it.
    pub(super) fn sides(&self, media: &MediaList, surface: &SurfacePoint) -> Option<(Side<'a>, Side<'a>)> {
        if !self.refracts(surface.instance) {
            let here = self.side_within(media);
            return Some((here, here));
        }
        self.interface(media, surface, &Coincident::default())
    }

    /// Follows the path through a surface and those that coincide with it, into or out of what lies behind.
    pub(super) fn change_medium(&mut self, surface: &SurfacePoint) {
        let mut media = self.media;
        let consistent = self.pass_into(&mut media, surface);
        if let Some(leaving) = &mut self.leaving {
            self.coincident.note_passed(leaving);
        }
        self.ledger.inconsistencies += u64::from(!consistent);
        self.media = media;
        if self.media.count > 1 && self.refracts(surface.instance) {
            self.note_contest();
        }
    }

    /// Counts it if two refracting media of a list share the highest priority, so that the order of the nodes decides
    /// which of them counts. Two volumes of one material are one.
    #[inline]
    fn note_contest(&mut self) {
        let media = self.media;
        if !self.scene.compiled.contestable || media.count < 2 {
            return;
        }
        let Some((winner, first)) = self.refracting(&media) else { return };
        let of_winner = self.medium(winner);
        let rival = media.as_slice().iter().find(|&&other| {
            let medium = self.medium(other);
            let equal = medium.and_then(|m| m.refraction()).is_some_and(|r| r.priority == first.priority);
            equal && !of_winner.zip(medium).is_some_and(|(a, b)| std::ptr::addr_eq(a, b))
        });
        if let Some(&rival) = rival {
            self.ledger.contested += 1;
            self.ledger.name_contestants([rival, winner]);
        }
    }

    /// Changes a list as a way through the surface of the moment does, and through those that coincide with it;
    /// `false` if that does not agree with the list.
    pub(super) fn pass_into(&self, media: &mut MediaList, surface: &SurfacePoint) -> bool {
        let mut consistent = self.change_list(media, surface);
        for &(instance, exiting) in self.coincident.as_slice() {
            consistent &= media.cross(instance, exiting);
        }
        consistent
    }

    pub(super) fn change_list(&self, media: &mut MediaList, surface: &SurfacePoint) -> bool {
        if !self.scene.compiled.facts[surface.instance as usize].has_medium {
            return true;
        }
        media.cross(surface.instance, surface.exiting)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_know_what_they_hold() {
        let mut list = MediaList::default();
        assert!(list.insert(3) && list.insert(5) && list.insert(7) && !list.insert(5));
        assert!(list.remove(5) && !list.remove(5));
        assert_eq!(list.as_slice(), [3, 7]);
        (10..24).for_each(|i| assert!(list.insert(i)));
        assert!(!list.insert(99) && list.remove(3));
    }
}
