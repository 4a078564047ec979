use raysect_math::Point3D;

use super::super::fault::Fault;
use super::super::polygons::{Meshed, Polygons};
use super::super::text::{integer, shown, words};
use super::TriangleScalars;
use super::attributes::{Attributes, Place};
use super::cells::{Cells, LINES, POLYGONS, STRIPS, VERTICES};
use super::source::{Number, Source};
use crate::mesh::MeshData;

/// The most values for a byte of the file: a cell of many triangles repeats its own for each.
const MOST_VALUES: usize = 64;

/// Reads a file section by section.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    source: Source<'a>,
    /// Version 5 writes cells as offsets and connectivity.
    has_offsets: bool,
    dataset: Dataset,
    polygons: Polygons,
    /// Cells of polygonal data by their kind, in the order in which their values stand.
    lists: [Cells; 4],
    /// Cells of a grid.
    grid: Cells,
    attributes: Attributes,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Dataset {
    Polygonal,
    Grid,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut source = Source::new(bytes);
        let version = source.raw_line().and_then(version).ok_or_else(|| {
            source
                .fault("not a legacy VTK file: the first line is not '# vtk DataFile Version' with a number")
        })?;
        if source.raw_line().is_none() {
            return Err(source.fault("the file ends where its title should follow"));
        }
        let encoding = source.line();
        let is_binary = match encoding.as_slice() {
            [word, ..] if word.eq_ignore_ascii_case(b"ascii") => false,
            [word, ..] if word.eq_ignore_ascii_case(b"binary") => true,
            _ => return Err(source.fault("the third line is neither ASCII nor BINARY")),
        };
        let dataset = match source.line().as_slice() {
            [_, kind] if kind.eq_ignore_ascii_case(b"polydata") => Dataset::Polygonal,
            [_, kind] if kind.eq_ignore_ascii_case(b"unstructured_grid") => Dataset::Grid,
            [_, kind, ..] => {
                let what = format!("'{}': POLYDATA and UNSTRUCTURED_GRID are read", shown(kind));
                return Err(source.fault(what));
            }
            _ => return Err(source.fault("DATASET and its kind should follow")),
        };
        source.is_binary = is_binary;
        Ok(Self {
            source,
            has_offsets: version >= 5,
            dataset,
            polygons: Polygons::default(),
            lists: Default::default(),
            grid: Cells::default(),
            attributes: Attributes::default(),
        })
    }

    pub(super) fn read(mut self, scaling: f64) -> Result<(MeshData, Vec<TriangleScalars>), Fault> {
        loop {
            let line = self.source.line();
            let Some((keyword, arguments)) = line.split_first() else { break };
            self.read_section(&keyword.to_ascii_uppercase(), arguments)?;
        }
        let cell_of = self.add_polygons()?;
        let points = self.polygons.vertices.len();
        self.attributes.check_points(points, &self.source)?;
        let normals = self.attributes.take_normals();
        if !normals.is_empty() {
            self.polygons.normals = normals;
            self.polygons.normals_of_vertices();
        }
        let Meshed { mesh, polygon_of } = self.polygons.finish(scaling, self.source.fault_at())?;
        let values = polygon_of.len().saturating_mul(self.attributes.scalars.len());
        if values > MOST_VALUES.saturating_mul(self.source.size()) {
            let what = format!("{values} values for all triangles are out of proportion to the file");
            return Err(self.source.fault(what));
        }
        let spread = |s: TriangleScalars| {
            let values = polygon_of.iter().map(|&polygon| s.values[cell_of[polygon]]).collect();
            TriangleScalars { name: s.name, values }
        };
        Ok((mesh, self.attributes.scalars.into_iter().map(spread).collect()))
    }

    fn read_section(&mut self, keyword: &[u8], arguments: &[&[u8]]) -> Result<(), Fault> {
        let list = match keyword {
            b"VERTICES" => Some(0),
            b"LINES" => Some(1),
            b"POLYGONS" => Some(2),
            b"TRIANGLE_STRIPS" => Some(3),
            _ => None,
        };
        match (keyword, list, self.dataset) {
            (b"POINTS", ..) => self.read_points(arguments),
            (_, Some(list), Dataset::Polygonal) => {
                self.lists[list].read(&mut self.source, arguments, self.has_offsets)
            }
            (b"CELLS", _, Dataset::Grid) => self.grid.read(&mut self.source, arguments, self.has_offsets),
            (b"CELL_TYPES", _, Dataset::Grid) => self.grid.read_kinds(&mut self.source, arguments),
            (b"METADATA", ..) => {
                // Text up to an empty line.
                while self.source.raw_line().is_some_and(|line| !line.trim_ascii().is_empty()) {}
                Ok(())
            }
            (b"POINT_DATA", ..) => self.attributes.begin(Place::Points, &self.source, arguments),
            (b"CELL_DATA", ..) => self.attributes.begin(Place::Cells, &self.source, arguments),
            _ => self.attributes.read(&mut self.source, keyword, arguments),
        }
    }

    fn read_points(&mut self, arguments: &[&[u8]]) -> Result<(), Fault> {
        let [count, number] = arguments else {
            return Err(self.source.fault("POINTS needs a number of points and a type"));
        };
        let number = Number::parse(number).map_err(|what| self.source.fault(what))?;
        let count = self.source.count(count, "the number of points")?;
        for _ in 0..count {
            let mut point = [0.0; 3];
            for x in &mut point {
                *x = self.source.finite(number, "a coordinate of a point")?;
            }
            self.polygons.vertices.push(Point3D::from(point));
        }
        Ok(())
    }

    /// Makes polygons of all cells; tells the cell of each.
    fn add_polygons(&mut self) -> Result<Vec<usize>, Fault> {
        let fault = self.source.fault_at();
        for (list, kind) in self.lists.iter_mut().zip([VERTICES, LINES, POLYGONS, STRIPS]) {
            list.all_of_kind(kind);
        }
        let lists = self.lists.iter().chain([&self.grid]);
        let (mut cell_of, mut cells) = (Vec::new(), 0);
        for list in lists {
            list.check_kinds(&self.source)?;
            for cell in list.iter() {
                cell.add_to(&mut self.polygons).map_err(|what| fault(cell.place, what))?;
                cell_of.resize(self.polygons.len(), cells);
                cells += 1;
            }
        }
        self.attributes.check_cells(cells, &self.source)?;
        Ok(cell_of)
    }
}

/// The first number of the version.
fn version(line: &[u8]) -> Option<u32> {
    let line: Vec<&[u8]> = words(line).collect();
    let [b"#", vtk, file, word, number] = line.as_slice() else { return None };
    let expected: [&[u8]; 3] = [b"vtk", b"datafile", b"version"];
    let is_it = [*vtk, file, word].iter().zip(expected).all(|(found, word)| found.eq_ignore_ascii_case(word));
    let major = number.split(|&b| b == b'.').next()?;
    integer(major, "version").ok().filter(|major| is_it && (1..=5).contains(major))
}
