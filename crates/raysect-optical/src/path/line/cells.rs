//! Media of known structure, solved cell by cell.

use raysect_core::Ray;

use super::effective_length;
use super::part::is_declared;
use super::room::{LineRoom, UNDERFLOW};
use super::rule::NODES;
use crate::Coefficients;
use crate::path::Path;
use crate::path::media::MediaList;

/// A cell is not halved more often than this.
const HALVINGS: u32 = 48;
/// Attenuation beyond this lets nothing through, and would overflow in sums.
const OPAQUE: f64 = 1e150;

impl Path<'_> {
    /// Adds a piece without breaks, in cells no longer than `cell`.
    pub(super) fn advance(
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
