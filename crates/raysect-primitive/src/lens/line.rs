use raysect_core::{Crossing, Departure, Feature};

use super::LensFace;

/// A range of distances, which may be endless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch {
    pub(super) first: f64,
    pub(super) last: f64,
}

impl Stretch {
    /// Where `t · climb ≤ missing`.
    #[inline]
    pub(super) fn below(missing: f64, climb: f64) -> Option<Self> {
        if climb == 0.0 {
            return (missing >= 0.0).then_some(Self { first: f64::NEG_INFINITY, last: f64::INFINITY });
        }
        let t = missing / climb;
        let (first, last) = if climb > 0.0 { (f64::NEG_INFINITY, t) } else { (t, f64::INFINITY) };
        Some(Self { first, last })
    }
}

/// An end of a stretch and the face it lies on.
type End = (f64, LensFace);

/// What a line has in common with a lens: a stretch of a convex body without the hollows of its faces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) entry: End,
    pub(super) exit: End,
    hollows: [Option<(Stretch, LensFace)>; 2],
}

/// The crossings of a line in order: three pairs at most.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Crossings {
    list: [(f64, u32); 6],
    count: usize,
}

impl Crossings {
    fn push_pair(&mut self, entry: End, exit: End) {
        if entry.0.is_finite() && exit.0.is_finite() && self.count < self.list.len() {
            self.list[self.count] = (entry.0, entry.1 as u32);
            self.list[self.count + 1] = (exit.0, exit.1 as u32);
            self.count += 2;
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Crossing> + '_ {
        let list = self.list[..self.count].iter().enumerate();
        list.map(|(index, &(distance, face))| crossing(distance, face, index % 2 == 1))
    }
}

fn crossing(distance: f64, face: u32, exiting: bool) -> Crossing {
    Crossing { distance, feature: Feature { face, ..Feature::default() }, exiting }
}

impl Line {
    /// All of the line within the barrel.
    pub(super) fn within_barrel(stretch: Stretch) -> Self {
        let barrel = LensFace::Barrel;
        Self { entry: (stretch.first, barrel), exit: (stretch.last, barrel), hollows: [None; 2] }
    }

    #[inline]
    pub(super) fn keep(&mut self, part: Stretch, face: LensFace) {
        if part.first > self.entry.0 {
            self.entry = (part.first, face);
        }
        if part.last < self.exit.0 {
            self.exit = (part.last, face);
        }
    }

    pub(super) fn hollow_out(&mut self, part: Stretch, face: LensFace) {
        let place = usize::from(self.hollows[0].is_some());
        self.hollows[place] = Some((part, face));
    }

    /// The crossings, counted on another scale of distances.
    pub(super) fn crossings(&self, scale: impl Fn(f64) -> f64) -> Crossings {
        let mut found = Crossings::default();
        let scaled = |end: End| (scale(end.0), end.1);
        let mut hollows = self.hollows;
        if let [Some((a, _)), Some((b, _))] = &hollows
            && b.first < a.first
        {
            hollows.swap(0, 1);
        }
        let mut start = self.entry;
        for (hollow, face) in hollows.into_iter().flatten() {
            if hollow.first > hollow.last || hollow.last < start.0 || hollow.first > self.exit.0 {
                continue;
            }
            if hollow.first > start.0 {
                found.push_pair(scaled(start), scaled((hollow.first, face)));
            }
            start = (hollow.last, face);
        }
        if start.0 < self.exit.0 {
            found.push_pair(scaled(start), scaled(self.exit));
        }
        found
    }

    /// Where the body or the gap is too thin to be seen by a ray that starts on it: the face, of those that go through
    /// its origin, that ends what the ray is in.
    #[cold]
    pub(super) fn leave_at_once(
        &self,
        departure: &Departure,
        scale: impl Fn(f64) -> f64,
    ) -> Option<Crossing> {
        let of_hollow =
            |(part, face): (Stretch, LensFace)| (if departure.inward { part.first } else { part.last }, face);
        let whole = if departure.inward { self.exit } else { self.entry };
        let ends = self.hollows.into_iter().flatten().map(of_hollow).chain([whole]);
        ends.map(|(t, face)| (scale(t).abs(), face))
            .filter(|(t, _)| *t <= 4.0 * departure.bound)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, face)| crossing(0.0, face as u32, departure.inward))
    }
}
