//! Logged paths as files.

use std::io::{self, Write};
use std::path::Path;

use raysect_core::{csv_number, csv_text, write_atomically};

use super::{LoggedPath, PathVertex};
use crate::OpticalError;

/// The columns of a table.
const TITLES: &str = "x [m],y [m],z [m],event,shape,name,material,inside,throughput before,throughput after,\
                      radiance along [W/m²/sr/nm],radiance [W/m²/sr/nm],normal x,normal y,normal z,\
                      local x [m],local y [m],local z [m]";

impl LoggedPath {
    /// Saves it as comma separated values, a line for each vertex: place, event, what is there, throughput before and
    /// after, radiance from the piece before and from the vertex, outward normal in the world, place in the shape.
    /// Throughputs and radiances are means over the bins.
    ///
    /// # Errors
    /// [`OpticalError::File`]; an existing file is then as before.
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<(), OpticalError> {
        self.save(path.as_ref(), |path, out| {
            writeln!(out, "{TITLES}")?;
            path.vertices.iter().try_for_each(|vertex| writeln!(out, "{}", row(vertex)))
        })
    }

    /// Saves it as one polyline in Wavefront OBJ [m].
    ///
    /// # Errors
    /// [`OpticalError::File`]; an existing file is then as before.
    pub fn save_obj(&self, path: impl AsRef<Path>) -> Result<(), OpticalError> {
        self.save(path.as_ref(), |path, out| {
            writeln!(out, "# a path of {} vertices [m]\no path", path.vertices.len())?;
            path.write_points(out, "v ")?;
            let numbers: Vec<String> = (1..=path.vertices.len()).map(|number| number.to_string()).collect();
            writeln!(out, "l {}", numbers.join(" "))
        })
    }

    /// Saves it as one polyline [m] in VTK's legacy format. Its points have the throughput with which the path goes on
    /// (`throughput`), the radiance that the piece before and the vertex add (`radiance` [W/m²/sr/nm]), both as means
    /// over the bins, the number of the event in [`PathEvent::ALL`](super::PathEvent::ALL) (`event`), the outward normal in
    /// the world (`normal`) and the place in the shape (`local_point` [m]), which are zero where there is none.
    ///
    /// # Errors
    /// [`OpticalError::File`]; an existing file is then as before.
    pub fn save_vtk(&self, path: impl AsRef<Path>) -> Result<(), OpticalError> {
        self.save(path.as_ref(), |path, out| {
            let count = path.vertices.len();
            writeln!(out, "# vtk DataFile Version 3.0\na path of light [m]\nASCII\nDATASET POLYDATA")?;
            writeln!(out, "POINTS {count} double")?;
            path.write_points(out, "")?;
            let numbers: Vec<String> = (0..count).map(|number| number.to_string()).collect();
            writeln!(out, "LINES 1 {}\n{count} {}\nPOINT_DATA {count}", count + 1, numbers.join(" "))?;
            path.write_scalars(out, "throughput double", |v| csv_number(v.mean_after()))?;
            path.write_scalars(out, "radiance double", |v| csv_number(v.mean_along() + v.mean_radiance()))?;
            path.write_scalars(out, "event int", |v| (v.event as usize).to_string())?;
            path.write_vectors(out, "normal", normal)?;
            path.write_vectors(out, "local_point", local_point)
        })
    }

    fn save(
        &self,
        path: &Path,
        write: impl FnOnce(&Self, &mut dyn Write) -> io::Result<()>,
    ) -> Result<(), OpticalError> {
        write_atomically(path, |out| write(self, out))
            .map_err(|source| OpticalError::File { path: path.to_owned(), source })
    }

    fn write_points(&self, out: &mut dyn Write, lead: &str) -> io::Result<()> {
        self.vertices.iter().try_for_each(|vertex| {
            let [x, y, z] = [vertex.point.x, vertex.point.y, vertex.point.z].map(csv_number);
            writeln!(out, "{lead}{x} {y} {z}")
        })
    }

    /// A vector of each vertex, of zeros where there is none.
    fn write_vectors(
        &self,
        out: &mut dyn Write,
        title: &str,
        value: impl Fn(&PathVertex) -> Option<[f64; 3]>,
    ) -> io::Result<()> {
        writeln!(out, "VECTORS {title} double")?;
        self.vertices.iter().try_for_each(|vertex| {
            let [x, y, z] = value(vertex).unwrap_or_default().map(csv_number);
            writeln!(out, "{x} {y} {z}")
        })
    }

    fn write_scalars(
        &self,
        out: &mut dyn Write,
        title: &str,
        value: impl Fn(&PathVertex) -> String,
    ) -> io::Result<()> {
        writeln!(out, "SCALARS {title} 1\nLOOKUP_TABLE default")?;
        self.vertices.iter().try_for_each(|vertex| writeln!(out, "{}", value(vertex)))
    }
}

/// The outward normal at a vertex in the world.
fn normal(vertex: &PathVertex) -> Option<[f64; 3]> {
    let normal = vertex.hit.as_ref()?.normal?;
    Some([normal.x, normal.y, normal.z])
}

/// The place of a vertex in the shape [m].
fn local_point(vertex: &PathVertex) -> Option<[f64; 3]> {
    vertex.hit.as_ref().map(|hit| hit.local_point.to_array())
}

/// The line of a vertex.
fn row(vertex: &PathVertex) -> String {
    let point = [vertex.point.x, vertex.point.y, vertex.point.z].map(csv_number);
    let (shape, name, material, inside) = match &vertex.hit {
        Some(hit) => {
            (hit.shape, hit.name.as_str(), hit.material.as_str(), if hit.inside { "1" } else { "0" })
        }
        None => ("", "", "", ""),
    };
    let numbers = [vertex.mean_before(), vertex.mean_after(), vertex.mean_along(), vertex.mean_radiance()];
    [
        point.join(","),
        vertex.event.to_string(),
        csv_text(shape).into_owned(),
        csv_text(name).into_owned(),
        csv_text(material).into_owned(),
        inside.to_owned(),
        numbers.map(csv_number).join(","),
        cells(normal(vertex)),
        cells(local_point(vertex)),
    ]
    .join(",")
}

/// Three cells, which are empty if there is nothing.
fn cells(vector: Option<[f64; 3]>) -> String {
    vector.map_or_else(|| ",,".to_owned(), |vector| vector.map(csv_number).join(","))
}
