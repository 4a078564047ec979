use super::super::fault::Fault;
use super::super::polygons::{Polygons, index};
use super::source::{Number, Source};

/// Kinds of cells, by the numbers of the format.
pub(super) const VERTICES: u8 = 2;
pub(super) const LINES: u8 = 4;
pub(super) const STRIPS: u8 = 6;
pub(super) const POLYGONS: u8 = 7;
const EMPTY: u8 = 0;
const TRIANGLE: u8 = 5;
const PIXEL: u8 = 8;
const QUAD: u8 = 9;

/// A list of cells.
#[derive(Debug, Default)]
pub(super) struct Cells {
    corners: Vec<u32>,
    /// One past the last corner of each cell, and its line or byte.
    ends: Vec<(usize, usize)>,
    kinds: Vec<u8>,
}

/// A cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<'a> {
    kind: u8,
    corners: &'a [u32],
    pub(super) place: usize,
}

impl Cells {
    pub(super) fn read(
        &mut self,
        source: &mut Source,
        arguments: &[&[u8]],
        has_offsets: bool,
    ) -> Result<(), Fault> {
        let [cells, size] = arguments else {
            return Err(source.fault("a list of cells needs the number of cells and its size"));
        };
        let (cells, size) =
            (source.count(cells, "the number of cells")?, source.count(size, "the size of the cells")?);
        if has_offsets {
            self.read_offsets(source, cells, size)
        } else {
            self.read_counts(source, cells, size)
        }
    }

    /// Each cell as the number of its corners and the corners.
    fn read_counts(&mut self, source: &mut Source, cells: usize, size: usize) -> Result<(), Fault> {
        let mut left = size;
        for _ in 0..cells {
            let count = source.number(Number::I32, "the number of corners of a cell")?;
            let place = source.place();
            let count = index(count).map(|n| n as usize).ok().filter(|&n| n < left);
            let count =
                count.ok_or_else(|| source.fault("the cell has more corners than the list has room for"))?;
            left -= count + 1;
            for _ in 0..count {
                self.add_corner(source, Number::I32)?;
            }
            self.ends.push((self.corners.len(), place));
        }
        if left == 0 {
            Ok(())
        } else {
            Err(source.fault(format!("the cells leave {left} numbers of their list")))
        }
    }

    /// Where the corners of each cell begin, and after them all corners.
    fn read_offsets(&mut self, source: &mut Source, offsets: usize, size: usize) -> Result<(), Fault> {
        if offsets == 0 && size == 0 && !source.begins_with(b"OFFSETS") {
            return Ok(());
        }
        let number = array_type(source, b"OFFSETS")?;
        let mut ends = Vec::new();
        for _ in 0..offsets {
            let offset = source.number(number, "an offset")?;
            let first = ends.last().map_or(0.0, |&(before, _)| before);
            if !(offset >= first && offset <= size as f64) || (ends.is_empty() && offset != 0.0) {
                return Err(source
                    .fault(format!("the offset {offset} does not follow {first} within {size} corners")));
            }
            ends.push((offset, source.place()));
        }
        let number = array_type(source, b"CONNECTIVITY")?;
        for _ in 0..size {
            self.add_corner(source, number)?;
        }
        if ends.last().is_some_and(|&(last, _)| last != size as f64) {
            return Err(source.fault(format!("the last offset is not the number of corners, {size}")));
        }
        let before = self.ends.last().map_or(0, |&(end, _)| end);
        self.ends.extend(ends.into_iter().skip(1).map(|(end, place)| (before + end as usize, place)));
        Ok(())
    }

    fn add_corner(&mut self, source: &mut Source, number: Number) -> Result<(), Fault> {
        let corner = source.number(number, "a corner of a cell")?;
        self.corners.push(index(corner).map_err(|what| source.fault(what))?);
        Ok(())
    }

    pub(super) fn read_kinds(&mut self, source: &mut Source, arguments: &[&[u8]]) -> Result<(), Fault> {
        let [count] = arguments else { return Err(source.fault("CELL_TYPES needs a number of cells")) };
        for _ in 0..source.count(count, "the number of kinds of cells")? {
            let kind = source.number(Number::I32, "the kind of a cell")?;
            let known = kind as u8;
            if f64::from(known) != kind {
                return Err(source.fault(format!("{kind} is no kind of cells")));
            }
            self.kinds.push(known);
        }
        Ok(())
    }

    /// Gives all cells the same kind.
    pub(super) fn all_of_kind(&mut self, kind: u8) {
        self.kinds = vec![kind; self.ends.len()];
    }

    /// That every cell has a kind.
    pub(super) fn check_kinds(&self, source: &Source) -> Result<(), Fault> {
        let (cells, kinds) = (self.ends.len(), self.kinds.len());
        if cells == kinds {
            Ok(())
        } else {
            Err(source.fault(format!("{kinds} kinds of cells for {cells} cells")))
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Cell<'_>> {
        let starts = std::iter::once(0).chain(self.ends.iter().map(|&(end, _)| end));
        let corners = starts.zip(&self.ends).map(|(start, &(end, place))| (&self.corners[start..end], place));
        self.kinds.iter().zip(corners).map(|(&kind, (corners, place))| Cell { kind, corners, place })
    }
}

/// Reads the line before an array of cells of version 5.
fn array_type(source: &mut Source, keyword: &[u8]) -> Result<Number, Fault> {
    match source.line().as_slice() {
        [word, number] if word.eq_ignore_ascii_case(keyword) => {
            Number::parse(number).map_err(|what| source.fault(what))
        }
        _ => Err(source.fault(format!("{} and its type should follow", String::from_utf8_lossy(keyword)))),
    }
}

impl Cell<'_> {
    /// Adds the polygons of the cell; points and lines have none.
    pub(super) fn add_to(self, polygons: &mut Polygons) -> Result<(), String> {
        let Self { kind, corners, place } = self;
        let expected = match kind {
            TRIANGLE => Some(3),
            QUAD | PIXEL => Some(4),
            _ => None,
        };
        if let Some(expected) = expected.filter(|&n| n != corners.len()) {
            return Err(format!("a cell of kind {kind} with {} corners: it has {expected}", corners.len()));
        }
        match (kind, corners) {
            // Points and lines, one or many.
            (EMPTY..=LINES, _) => return Ok(()),
            (STRIPS, [_, _, _, ..]) => {
                polygons.strip(corners.iter().copied(), place);
                return Ok(());
            }
            // The corners of a pixel run through its rows.
            (PIXEL, &[a, b, c, d]) => [a, b, d, c].into_iter().for_each(|v| polygons.corner(v, None)),
            (TRIANGLE | POLYGONS | QUAD, _) => corners.iter().for_each(|&v| polygons.corner(v, None)),
            (STRIPS, _) => {
                return Err(format!("a strip of {} corners: at least 3 are needed", corners.len()));
            }
            _ => {
                return Err(format!(
                    "a cell of kind {kind}, {}: it is no triangle, quadrilateral or polygon",
                    name(kind)
                ));
            }
        }
        polygons.end_polygon(place);
        Ok(())
    }
}

/// What the format calls the kinds that are refused.
fn name(kind: u8) -> &'static str {
    match kind {
        10 => "a tetrahedron",
        11 => "a voxel",
        12 => "a hexahedron",
        13 => "a wedge",
        14 => "a pyramid",
        21..=37 => "of second order",
        42 => "a polyhedron",
        _ => "of another make",
    }
}
