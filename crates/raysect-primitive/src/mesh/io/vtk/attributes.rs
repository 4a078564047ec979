use raysect_math::Normal3D;

use super::super::fault::Fault;
use super::super::text::{integer, shown};
use super::TriangleScalars;
use super::source::{Number, Source};

/// Values that belong to points or cells.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    place: Option<Place>,
    /// How many things have values, of the section that is being read.
    count: usize,
    points: Option<usize>,
    cells: Option<usize>,
    normals: Vec<Normal3D>,
    /// Values of cells.
    pub(super) scalars: Vec<TriangleScalars>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Points,
    Cells,
}

impl Attributes {
    /// Begins the section of points or of cells.
    pub(super) fn begin(&mut self, place: Place, source: &Source, arguments: &[&[u8]]) -> Result<(), Fault> {
        let [count] = arguments else { return Err(source.fault("the number of values should follow")) };
        let count = source.count(count, "the number of values")?;
        let known = match place {
            Place::Points => &mut self.points,
            Place::Cells => &mut self.cells,
        };
        if known.is_some_and(|before| before != count) {
            return Err(source.fault(format!("{count} values, {} before", known.unwrap_or(0))));
        }
        *known = Some(count);
        (self.place, self.count) = (Some(place), count);
        Ok(())
    }

    /// Reads one array, or passes it over.
    pub(super) fn read(
        &mut self,
        source: &mut Source,
        keyword: &[u8],
        arguments: &[&[u8]],
    ) -> Result<(), Fault> {
        let number = |word: &[u8]| Number::parse(word);
        let parsed = match (keyword, arguments) {
            (b"FIELD", [_, arrays]) => return self.read_field(source, arrays),
            (b"SCALARS", [name, kind]) => number(kind).map(|kind| (*name, kind, 1)),
            (b"SCALARS", [name, kind, n]) => {
                both(number(kind), integer(n, "components")).map(|(k, n)| (*name, k, n))
            }
            (b"VECTORS" | b"NORMALS", [name, kind]) => number(kind).map(|kind| (*name, kind, 3)),
            (b"TENSORS", [name, kind]) => number(kind).map(|kind| (*name, kind, 9)),
            (b"TENSORS6", [name, kind]) => number(kind).map(|kind| (*name, kind, 6)),
            (b"GLOBAL_IDS" | b"PEDIGREE_IDS" | b"EDGE_FLAGS", [name, kind]) => {
                number(kind).map(|kind| (*name, kind, 1))
            }
            (b"TEXTURE_COORDINATES", [name, n, kind]) => {
                both(number(kind), integer(n, "components")).map(|(k, n)| (*name, k, n))
            }
            (b"COLOR_SCALARS", [name, n]) => integer(n, "components").map(|n| (*name, Number::U8, n)),
            (b"LOOKUP_TABLE", [_, size]) => {
                let values = source.count(size, "the size of a table")?;
                let values = source.admit(4 * values as u64, "the size of a table")?;
                return source.pass_over(values, Number::U8, "a colour");
            }
            _ => Err(format!("'{}' does not begin a section that is read here", shown(keyword))),
        };
        let (name, kind, components): (_, _, u64) = parsed.map_err(|what| source.fault(what))?;
        if keyword == b"SCALARS" && source.begins_with(b"LOOKUP_TABLE") {
            source.line();
        }
        let is_normals = keyword == b"NORMALS" && self.place == Some(Place::Points);
        // Cells and points may have as many colours or numbers as they like; one is a scalar.
        let is_scalar = keyword == b"SCALARS" || keyword.ends_with(b"_IDS");
        if self.place.is_none() {
            return Err(source.fault(format!("{} before POINT_DATA or CELL_DATA", shown(keyword))));
        }
        if is_normals {
            return self.read_normals(source, kind);
        }
        self.read_array(source, name, (kind, self.count, components), is_scalar)
    }

    fn read_normals(&mut self, source: &mut Source, kind: Number) -> Result<(), Fault> {
        self.normals.clear();
        for _ in 0..self.count {
            let mut normal = [0.0; 3];
            for x in &mut normal {
                *x = source.finite(kind, "a component of a normal")?;
            }
            self.normals.push(Normal3D::from(normal));
        }
        Ok(())
    }

    /// Arrays with their own headers; before the section of points or cells they belong to the file.
    fn read_field(&mut self, source: &mut Source, arrays: &[u8]) -> Result<(), Fault> {
        for _ in 0..source.count(arrays, "the number of arrays")? {
            let mut line = source.line();
            if line.first().is_some_and(|word| *word == b"METADATA") {
                while source.raw_line().is_some_and(|line| !line.trim_ascii().is_empty()) {}
                line = source.line();
            }
            let [name, components, tuples, kind] = line.as_slice() else {
                return Err(source.fault("an array of a field needs its name, components, length and type"));
            };
            let kind = Number::parse(kind).map_err(|what| source.fault(what))?;
            let tuples = source.count(tuples, "the length of an array")?;
            let components = integer(components, "components").map_err(|what| source.fault(what))?;
            self.read_array(source, name, (kind, tuples, components), tuples == self.count)?;
        }
        Ok(())
    }

    /// Reads an array of a type, a length and a number of components.
    fn read_array(
        &mut self,
        source: &mut Source,
        name: &[u8],
        (kind, tuples, components): (Number, usize, u64),
        is_scalar: bool,
    ) -> Result<(), Fault> {
        let values = (tuples as u64).saturating_mul(components);
        let count = source.admit(values, "the number of values")?;
        if !(is_scalar && components == 1 && self.place == Some(Place::Cells)) {
            return source.pass_over(count, kind, "a value");
        }
        let mut values = Vec::new();
        source.each(count, kind, "a value", |value| values.push(value))?;
        self.scalars.push(TriangleScalars { name: decoded(name), values });
        Ok(())
    }

    pub(super) fn check_points(&self, found: usize, source: &Source) -> Result<(), Fault> {
        agree(self.points, found, "points", source)
    }

    pub(super) fn check_cells(&self, found: usize, source: &Source) -> Result<(), Fault> {
        agree(self.cells, found, "cells", source)
    }

    pub(super) fn take_normals(&mut self) -> Vec<Normal3D> {
        std::mem::take(&mut self.normals)
    }
}

fn agree(declared: Option<usize>, found: usize, what: &str, source: &Source) -> Result<(), Fault> {
    match declared {
        Some(count) if count != found => {
            Err(source.fault(format!("values for {count} {what}, there are {found}")))
        }
        _ => Ok(()),
    }
}

fn both(number: Result<Number, String>, count: Result<u64, String>) -> Result<(Number, u64), String> {
    Ok((number?, count?))
}

/// A name, in which the format writes odd characters as % and two hexadecimal digits.
fn decoded(name: &[u8]) -> String {
    let (mut bytes, mut rest) = (Vec::new(), name);
    while let [first, tail @ ..] = rest {
        let code =
            tail.get(..2).filter(|_| *first == b'%').and_then(|digits| std::str::from_utf8(digits).ok());
        match code.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(code) => {
                bytes.push(code);
                rest = &tail[2..];
            }
            None => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
