//! The line integral: dL/ds = j − α L along a straight piece of a path, through all media that fill it.

use raysect_core::Ray;

use super::Path;
use super::media::MediaList;
use crate::material::add_share;
use crate::{Coefficients, Medium, MediumPoint, Structure};

/// Nodes of a cell.
const NODES: usize = 5;
/// Weights of the Gauss-Lobatto rule on (0, 1), whose nodes are the ends, the middle and (1 ± √(3/7)) / 2
/// (M. Abramowitz and I. Stegun, *Handbook of Mathematical Functions*, 25.4.32). With nodes at the ends no jump can hide
/// between the last node of a cell and the first of the next.
const WEIGHTS: [f64; NODES] = [1.0 / 20.0, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 1.0 / 20.0];
/// So far inside a cell, in units of its width, lie the nodes at its ends: on the near side of a break.
const INSIDE: f64 = 1e-9;

/// A cell is not halved more often than this.
const HALVINGS: u32 = 48;
/// Attenuation beyond this lets nothing through, and would overflow in sums.
const OPAQUE: f64 = 1e150;
/// Differences of radiance below this are not worth a halving: numbers so small have lost their digits.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// A rule for cells: where to ask, and how to integrate up to there.
#[derive(Debug, Clone, Copy)]
struct Rule {
    nodes: [f64; NODES],
    weights: [f64; NODES],
    /// Integral from 0 to a node of the polynomial through all of them: `[node][value]`.
    partial: [[f64; NODES]; NODES],
}

impl Rule {
    fn new() -> Self {
        let inner = 0.5 * (3.0f64 / 7.0).sqrt();
        let lobatto = [0.0, 0.5 - inner, 0.5, 0.5 + inner, 1.0];
        let nodes = lobatto.map(|x: f64| x.clamp(INSIDE, 1.0 - INSIDE));
        let lagrange = |r: usize, x: f64| {
            let others = (0..NODES).filter(|&k| k != r);
            others.map(|k| (x - nodes[k]) / (nodes[r] - nodes[k])).product::<f64>()
        };
        let to = |x: f64, r: usize| -> f64 {
            (0..NODES).map(|k| WEIGHTS[k] * lagrange(r, x * lobatto[k])).sum::<f64>() * x
        };
        let partial = std::array::from_fn(|q| std::array::from_fn(|r| to(nodes[q], r)));
        Self { nodes, weights: std::array::from_fn(|r| to(1.0, r)), partial }
    }
}

/// What a piece adds, and how much it lets through, bin by bin.
#[derive(Debug, Clone, Default)]
struct Cell {
    /// Light that leaves it at the end where the path comes in [W/m²/sr/nm].
    light: Vec<f64>,
    /// Its optical depth.
    depth: Vec<f64>,
    /// The largest emission met [W/m³/sr/nm] and attenuation [1/m].
    peak: [f64; 2],
}

impl Cell {
    fn clear(&mut self, bins: usize) {
        for values in [&mut self.light, &mut self.depth] {
            values.clear();
            values.resize(bins, 0.0);
        }
    }
}

/// A medium that is solved by a rule of its own: a whole one, or a part of a mixture.
#[derive(Clone, Copy)]
struct Part<'a> {
    instance: u32,
    /// Its place among the parts of what fills the instance.
    number: u32,
    medium: &'a dyn Medium,
    share: f64,
}

/// True if what happens along a ray can be told, and needs no places of its own at which it is asked.
fn is_declared(structure: Structure) -> bool {
    matches!(structure, Structure::Homogeneous | Structure::Smooth { .. })
}

impl<'a> Part<'a> {
    fn whole(instance: u32, medium: &'a dyn Medium) -> Self {
        Self { instance, number: 0, medium, share: 1.0 }
    }

    /// Lends `each` a whole medium with its structure, or the parts of a mixture whose own structure is not declared.
    fn each(self, each: &mut dyn FnMut(Self, Structure)) {
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

/// A place where a medium of unknown structure is asked.
#[derive(Debug, Clone, Copy)]
struct Sample {
    distance: f64,
    weight: f64,
    instance: u32,
    /// Which part of what fills the instance.
    part: u32,
}

/// Room for line integrals, grown at first use.
#[derive(Debug)]
pub(super) struct LineRoom {
    rule: Rule,
    breaks: Vec<f64>,
    samples: Vec<Sample>,
    /// Sum from the beginning of the piece.
    sum: Cell,
    cells: [Cell; 3],
    /// How much light a piece will add, roughly.
    scale: Vec<f64>,
    /// Coefficients at the nodes of a cell, node by node.
    emission: Vec<f64>,
    attenuation: Vec<f64>,
    stack: Vec<(f64, f64, u32)>,
}

impl Default for LineRoom {
    fn default() -> Self {
        Self {
            rule: Rule::new(),
            breaks: Vec::new(),
            samples: Vec::new(),
            sum: Cell::default(),
            cells: Default::default(),
            scale: Vec::new(),
            emission: Vec::new(),
            attenuation: Vec::new(),
            stack: Vec::new(),
        }
    }
}

impl<'a> Path<'a> {
    /// The media of a list that count, of the refracting ones only that of the highest priority.
    fn each_medium(&self, media: &MediaList, mut each: impl FnMut(u32, &'a dyn Medium)) {
        let counts = self.refracting(media).map(|(i, _)| i);
        for &instance in media.as_slice() {
            if let Some(medium) = self.medium(instance)
                && (medium.refraction().is_none() || counts == Some(instance))
            {
                each(instance, medium);
            }
        }
    }

    /// The same, with mixtures taken apart whose structure is not declared.
    fn each_part(&self, media: &MediaList, mut each: impl FnMut(Part<'a>, Structure)) {
        self.each_medium(media, |instance, medium| {
            let (whole, structure) = (Part::whole(instance, medium), medium.structure());
            if is_declared(structure) { each(whole, structure) } else { whole.each(&mut each) }
        });
    }

    /// Asks one medium for its coefficients at a place along a ray.
    pub(super) fn ask(
        &self,
        medium: &dyn Medium,
        instance: u32,
        ray: &Ray,
        distance: f64,
        out: &mut Coefficients<'_>,
    ) {
        self.ask_part(Part::whole(instance, medium), ray, distance, out);
    }

    /// Asks a part for its share of the coefficients.
    fn ask_part(&self, part: Part<'_>, ray: &Ray, distance: f64, out: &mut Coefficients<'_>) {
        let at = MediumPoint {
            point: ray.point_at(distance),
            direction: -ray.direction,
            to_local: &self.scene.instances[part.instance as usize].to_local,
            at: self.context(),
        };
        add_share(part.share, part.medium, &at, out);
    }

    /// Adds up the coefficients of the media of a list at a place along a ray into `emitted`, `attenuation` and
    /// `scattering`.
    pub(super) fn add_up(&mut self, media: &MediaList, ray: &Ray, distance: f64) {
        let mut emission = std::mem::take(&mut self.emitted);
        let mut attenuation = std::mem::take(&mut self.attenuation);
        let mut scattering = std::mem::take(&mut self.scattering);
        emission.fill(0.0);
        attenuation.fill(0.0);
        scattering.fill(0.0);
        self.each_medium(media, |instance, medium| {
            let mut out = Coefficients {
                emission: &mut emission,
                attenuation: &mut attenuation,
                scattering: &mut scattering,
            };
            self.ask(medium, instance, ray, distance, &mut out);
        });
        (self.emitted, self.attenuation, self.scattering) = (emission, attenuation, scattering);
    }

    /// True if the coefficients are the same all along a ray.
    pub(super) fn is_homogeneous(&self, media: &MediaList) -> bool {
        let facts = &self.scene.compiled.facts;
        !self.scene.compiled.any_structure || media.as_slice().iter().all(|&i| !facts[i as usize].structured)
    }

    /// Collects the emission of a piece of the path, and reduces the throughput unless something scatters there, which
    /// does that itself.
    pub(super) fn cross_media(&mut self, ray: &Ray, distance: f64, scatters: bool) {
        if distance == 0.0 || distance.is_infinite() {
            return;
        }
        let media = self.media;
        if !self.is_homogeneous(&media) {
            self.integrate_line(&media, ray, distance, true);
            let sum = &self.line.sum;
            for i in 0..self.throughput.len() {
                self.radiance[i] += self.throughput[i] * sum.light[i];
                if !scatters {
                    self.throughput[i] *= (-sum.depth[i]).exp();
                }
            }
            return;
        }
        self.add_up(&media, ray, 0.5 * distance);
        for i in 0..self.throughput.len() {
            let (emission, attenuation) = (self.emitted[i], self.attenuation[i]);
            if emission != 0.0 {
                self.radiance[i] += self.throughput[i] * emission * effective_length(attenuation, distance);
            }
            if attenuation != 0.0 && !scatters {
                self.throughput[i] *= (-attenuation * distance).exp();
            }
        }
    }

    /// Reduces `reflected` by what the media of a list let through.
    pub(super) fn attenuate_shadow(&mut self, media: &MediaList, ray: &Ray, distance: f64) {
        if media.is_empty() || distance == 0.0 {
            return;
        }
        if !self.is_homogeneous(media) {
            self.integrate_line(media, ray, distance, false);
            let through = self.reflected.iter_mut().zip(&self.line.sum.depth);
            through.for_each(|(f, depth)| *f *= (-depth).exp());
            return;
        }
        self.add_up(media, ray, 0.5 * distance);
        for (f, attenuation) in self.reflected.iter_mut().zip(&self.attenuation) {
            if *attenuation != 0.0 {
                *f *= (-attenuation * distance).exp();
            }
        }
    }

    /// Solves along a piece where something has structure; the answer is in `line.sum`.
    ///
    /// Media whose structure is declared are solved from break to break; those of unknown structure are asked at
    /// places of their own, and what they emit there is seen through the others.
    fn integrate_line(&mut self, media: &MediaList, ray: &Ray, distance: f64, emission: bool) {
        let mut room = std::mem::take(&mut self.line);
        room.sum.clear(self.slice.bins);
        room.breaks.clear();
        room.samples.clear();
        let mut cell = f64::INFINITY;
        self.each_part(media, |part, structure| {
            let to_local = &self.scene.instances[part.instance as usize].to_local;
            let local =
                Ray::new(to_local.transform_point(ray.origin), to_local.transform_vector(ray.direction))
                    .with_max_distance(distance);
            part.medium.breakpoints(&local, &mut room.breaks);
            if let Structure::Smooth { length_scale } = structure {
                cell = cell.min(length_scale / local.direction.length());
            }
        });
        if emission {
            self.place_samples(media, ray, distance, &mut room.samples);
        }
        room.breaks.retain(|&t| t > 0.0 && t < distance);
        room.breaks.extend(room.samples.iter().map(|s| s.distance));
        room.breaks.push(distance);
        room.breaks.sort_by(f64::total_cmp);
        room.samples.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let (mut start, mut next) = (0.0, 0);
        for k in 0..room.breaks.len() {
            let end = room.breaks[k];
            if end > start {
                self.advance(&mut room, media, ray, start, end, cell);
                start = end;
            }
            while room.samples.get(next).is_some_and(|s| s.distance <= end) {
                self.take_sample(&mut room, ray, next);
                next += 1;
            }
        }
        self.line = room;
    }

    /// Chooses where the media of unknown structure are asked, with the length that each place stands for.
    fn place_samples(&mut self, media: &MediaList, ray: &Ray, distance: f64, samples: &mut Vec<Sample>) {
        let mut rng = self.rng.clone();
        self.each_part(media, |Part { instance, number, .. }, structure| {
            let scale = {
                let to_local = &self.scene.instances[instance as usize].to_local;
                to_local.transform_vector(ray.direction).length()
            };
            let local = distance * scale;
            match structure {
                Structure::Unknown { step } => {
                    let steps = (local / step).ceil().max(1.0);
                    let width = distance / steps;
                    let place = |i: usize, u: f64| Sample {
                        distance: (i as f64 + u) * width,
                        weight: width,
                        instance,
                        part: number,
                    };
                    samples.extend((0..steps as usize).map(|i| place(i, rng.uniform())));
                }
                Structure::Trapezium { step, points } => {
                    let steps = (f64::from(points) - 1.0).max((local / step).floor()).max(1.0);
                    let width = distance / steps;
                    samples.extend((0..=steps as usize).map(|i| {
                        let end = i == 0 || i == steps as usize;
                        let weight = if end { 0.5 * width } else { width };
                        Sample { distance: (i as f64 * width).min(distance), weight, instance, part: number }
                    }));
                }
                Structure::Homogeneous | Structure::Smooth { .. } => {}
            }
        });
        self.rng = rng;
    }

    /// Adds the emission of a medium of unknown structure at one place, seen through what lies before it.
    fn take_sample(&mut self, room: &mut LineRoom, ray: &Ray, number: usize) {
        let Sample { distance, weight, instance, part } = room.samples[number];
        let Some(medium) = self.medium(instance) else { return };
        let mut emission = std::mem::take(&mut self.emitted);
        let mut attenuation = std::mem::take(&mut self.attenuation);
        let mut scattering = std::mem::take(&mut self.scattering);
        emission.fill(0.0);
        let mut out = Coefficients {
            emission: &mut emission,
            attenuation: &mut attenuation,
            scattering: &mut scattering,
        };
        Part::whole(instance, medium).each(&mut |found, _| {
            if found.number == part {
                self.ask_part(found, ray, distance, &mut out);
            }
        });
        for (i, emission) in emission.iter().enumerate() {
            room.sum.light[i] += weight * emission * (-room.sum.depth[i]).exp();
        }
        (self.emitted, self.attenuation, self.scattering) = (emission, attenuation, scattering);
    }

    /// Adds a piece without breaks, in cells no longer than `cell`.
    fn advance(
        &mut self,
        room: &mut LineRoom,
        media: &MediaList,
        ray: &Ray,
        start: f64,
        end: f64,
        cell: f64,
    ) {
        if cell == f64::INFINITY {
            self.add_up_solved(media, ray, 0.5 * (start + end), None, room);
            for i in 0..self.slice.bins {
                let (emission, attenuation) = (room.emission[i], room.attenuation[i]);
                let seen = emission * effective_length(attenuation, end - start);
                room.sum.light[i] += seen * (-room.sum.depth[i]).exp();
                room.sum.depth[i] += attenuation * (end - start);
            }
            return;
        }
        let count = ((end - start) / cell).ceil().max(1.0);
        let edge = |i: f64| if i == count { end } else { start + (end - start) * (i / count) };
        self.estimate(room, media, ray, count, &edge);
        let mut number = 0.0;
        while number < count {
            room.stack.push((edge(number), edge(number + 1.0), 0));
            number += 1.0;
            while let Some((from, to, halvings)) = room.stack.pop() {
                self.solve_cell(room, media, ray, (from, to, halvings), count);
            }
        }
    }

    /// Roughly what a piece adds, so that cells which add next to nothing are not solved to many digits.
    fn estimate(
        &mut self,
        room: &mut LineRoom,
        media: &MediaList,
        ray: &Ray,
        count: f64,
        edge: &dyn Fn(f64) -> f64,
    ) {
        room.scale.clear();
        room.scale
            .extend(room.sum.light.iter().zip(&room.sum.depth).map(|(l, d)| l / (-d).exp().max(UNDERFLOW)));
        let mut number = 0.0;
        while number < count {
            self.fill_cell(room, media, ray, edge(number), edge(number + 1.0), 0);
            room.scale.iter_mut().zip(&room.cells[0].light).for_each(|(s, l)| *s += l);
            number += 1.0;
        }
    }

    /// Adds a cell, or puts its halves onto the stack.
    fn solve_cell(
        &mut self,
        room: &mut LineRoom,
        media: &MediaList,
        ray: &Ray,
        (from, to, halvings): (f64, f64, u32),
        count: f64,
    ) {
        // At a jump the difference of two rules is up to ten times smaller than their error.
        let (tolerance, width) = (self.settings.line_tolerance / 30.0, to - from);
        self.fill_cell(room, media, ray, from, to, 0);
        let dark = room.scale.iter().fold(f64::INFINITY, |a: f64, &s| if s > 0.0 { a.min(s) } else { a });
        let [emission, attenuation] = room.cells[0].peak;
        let nothing = emission == 0.0 || emission * width * count < 1e-3 * tolerance * dark;
        if nothing && attenuation * width * count < 1e-3 * tolerance {
            room.add(0);
            return;
        }
        let middle = 0.5 * (from + to);
        self.fill_cell(room, media, ray, from, middle, 1);
        self.fill_cell(room, media, ray, middle, to, 2);
        let exhausted = halvings >= HALVINGS || middle <= from || middle >= to;
        if room.agrees(tolerance) || exhausted {
            self.ledger.unresolved += u64::from(exhausted);
            room.add(1);
            room.add(2);
        } else {
            room.stack.push((middle, to, halvings + 1));
            room.stack.push((from, middle, halvings + 1));
        }
    }

    /// Solves a cell by the polynomials through its nodes.
    fn fill_cell(
        &mut self,
        room: &mut LineRoom,
        media: &MediaList,
        ray: &Ray,
        from: f64,
        to: f64,
        place: usize,
    ) {
        let (width, bins) = (to - from, self.slice.bins);
        for q in 0..NODES {
            let distance = from + width * room.rule.nodes[q];
            self.add_up_solved(media, ray, distance, Some(q), room);
        }
        let LineRoom { rule, cells, emission, attenuation, .. } = room;
        let cell = &mut cells[place];
        cell.clear(bins);
        cell.peak = [&*emission, &*attenuation].map(|all| all.iter().fold(0.0, |a: f64, &b| a.max(b.abs())));
        for i in 0..bins {
            let value = |of: &[f64], q: usize| of[q * bins + i];
            let mut light = 0.0;
            for q in 0..NODES {
                let emitted = value(emission, q);
                if emitted != 0.0 {
                    let before = (0..NODES).map(|r| rule.partial[q][r] * value(attenuation, r)).sum::<f64>();
                    light += rule.weights[q] * emitted * (-(before * width).max(0.0)).exp();
                }
            }
            cell.light[i] = light * width;
            cell.depth[i] = (0..NODES).map(|r| rule.weights[r] * value(attenuation, r)).sum::<f64>() * width;
        }
    }

    /// Coefficients of the media whose structure is declared, at one place, into the row of a node.
    fn add_up_solved(
        &mut self,
        media: &MediaList,
        ray: &Ray,
        distance: f64,
        node: Option<usize>,
        room: &mut LineRoom,
    ) {
        let bins = self.slice.bins;
        let row = node.unwrap_or(0) * bins;
        for values in [&mut room.emission, &mut room.attenuation] {
            values.resize(NODES * bins, 0.0);
            values[row..row + bins].fill(0.0);
        }
        let mut scattering = std::mem::take(&mut self.scattering);
        let (emission, attenuation) =
            (&mut room.emission[row..row + bins], &mut room.attenuation[row..row + bins]);
        self.each_part(media, |part, structure| {
            if is_declared(structure) {
                let mut out = Coefficients {
                    emission: &mut *emission,
                    attenuation: &mut *attenuation,
                    scattering: &mut scattering,
                };
                self.ask_part(part, ray, distance, &mut out);
            }
        });
        attenuation.iter_mut().for_each(|a| *a = a.min(OPAQUE));
        self.scattering = scattering;
    }
}

impl LineRoom {
    /// Appends a cell to the sum.
    fn add(&mut self, place: usize) {
        let cell = &self.cells[place];
        for i in 0..cell.light.len() {
            if cell.light[i] != 0.0 {
                self.sum.light[i] += cell.light[i] * (-self.sum.depth[i]).exp();
            }
            self.sum.depth[i] += cell.depth[i];
        }
    }

    /// True if a cell and its two halves give the same.
    fn agrees(&self, tolerance: f64) -> bool {
        let [whole, first, second] = &self.cells;
        (0..whole.light.len()).all(|i| {
            let depth = first.depth[i] + second.depth[i];
            let light = first.light[i] + second.light[i] * (-first.depth[i]).exp();
            let off = (whole.light[i] - light).abs();
            let through = (-self.sum.depth[i]).exp();
            let seen = off * through <= tolerance * (self.scale[i] * through).max(self.sum.light[i].abs());
            // What nothing gets through need not be known to many digits.
            let depth_off = (whole.depth[i] - depth).abs();
            let deep = depth_off * (-whole.depth[i].min(depth)).exp() <= tolerance || through == 0.0;
            (seen || off <= UNDERFLOW || through == 0.0) && deep
        })
    }
}

/// ∫₀ˢ exp(−α t) dt = (1 − exp(−α s)) / α, right down to α = 0.
fn effective_length(attenuation: f64, distance: f64) -> f64 {
    let depth = attenuation * distance;
    if depth == 0.0 { distance } else { -(-depth).exp_m1() / attenuation }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effective_lengths_have_their_limits() {
        assert_eq!(effective_length(0.0, 2.0), 2.0);
        assert!((effective_length(1e-12, 2.0) - 2.0).abs() < 1e-11);
        assert!((effective_length(3.0, 2.0) - (1.0 - (-6.0f64).exp()) / 3.0).abs() < 1e-16);
        assert_eq!(effective_length(f64::INFINITY, 2.0), 0.0);
    }

    #[test]
    fn the_rule_integrates_polynomials_exactly() {
        let rule = Rule::new();
        for power in 0..8 {
            let whole: f64 = (0..NODES).map(|q| rule.weights[q] * rule.nodes[q].powi(power)).sum();
            assert!((whole - 1.0 / f64::from(power + 1)).abs() < 1e-8, "{power}: {whole}");
        }
        for power in 0..NODES as i32 {
            for q in 0..NODES {
                let part: f64 = (0..NODES).map(|r| rule.partial[q][r] * rule.nodes[r].powi(power)).sum();
                let exact = rule.nodes[q].powi(power + 1) / f64::from(power + 1);
                assert!((part - exact).abs() < 1e-14, "{power} {q}");
            }
        }
    }
}
