//! Every sensor by its name, with the parameters that a case gives and usual ones for the others.

use raysect::observer::{ObserverError, Sightline, Target};
use raysect::prelude::*;

use super::measure::{Quantity, pixels};
use super::scenes::{Bench, ball, dome, world, wrong};
use super::{Case, Reading};

/// Where sensors stand: a closed emitter of radiance one, with glass around the sensor or without.
pub(super) struct Stand<'c> {
    case: &'c Case,
    bench: Bench,
    /// Index of a ball of glass about the sensor.
    glass: Option<f64>,
    quantity: Quantity,
    /// Of all pixels together, not of any of them.
    together: bool,
    /// Whether a part of the rays is aimed.
    targeted: bool,
}

/// A reading, or none of what nothing here knows.
type Known = Result<Option<Reading>, String>;

impl<'c> Stand<'c> {
    /// None for a quantity that no sensor reads: it is "radiance of any pixel", "power" and the like.
    pub(super) fn new(case: &'c Case, bench: Bench, glass: Option<f64>) -> Option<Self> {
        let text = case.text("quantity").ok()?.to_lowercase();
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        let says = |all: &[&str]| words.iter().any(|word| all.contains(word));
        let quantity = if says(&["radiance"]) {
            Quantity::Radiance
        } else if says(&["power", "etendue", "étendue"]) {
            // In a band of 1 nm at a radiance of one the power is the étendue.
            Quantity::Power
        } else {
            return None;
        };
        let together = quantity == Quantity::Power && says(&["total", "all", "sum"]);
        Some(Self { case, bench, glass, quantity, together, targeted: false })
    }

    /// The reading of a sensor of a size [m]: of the pixel that is farthest from what is expected, or of all together.
    fn read<S: Sensor>(&self, size: f64, observer: Result<Observer<S>, ObserverError>) -> Known {
        let observer = observer.map_err(wrong)?;
        if !self.targeted {
            return self.reading(size, observer).map(Some);
        }
        let share = self.case.number_among(&["targeted_path_prob", "probability"], 0.9)?;
        match observer.targets(self.targets(size)?, share) {
            Ok(aimed) => self.reading(size, aimed).map(Some),
            Err(ObserverError::OneWay { .. }) => Ok(None),
            Err(other) => Err(wrong(other)),
        }
    }

    fn reading<S: Sensor>(&self, size: f64, observer: Observer<S>) -> Result<Reading, String> {
        let (scene, place) = match self.glass {
            None => (dome(size)?, translate(0.1 * size, 0.2 * size, 0.3 * size) * rotate(10.0, 20.0, 30.0)),
            Some(_) => (dome(100.0 * size)?, AffineMatrix3D::IDENTITY),
        };
        let mut scene = world([scene])?;
        if let Some(index) = self.glass {
            scene.add(ball([0.0; 3], 100.0 * size, self.bench.glass(index, 1.0)?)?).map_err(wrong)?;
        }
        let observer = observer.transform(place);
        let observer = if self.together { observer } else { some_pixels(observer)? };
        let all = pixels(self.bench, &scene, observer, self.quantity)?;
        if self.together {
            let error = all.iter().map(|r| r.error * r.error).sum::<f64>().sqrt();
            return Ok(Reading::of(all.iter().map(|r| r.mean).sum(), error));
        }
        let off = |r: &Reading| (r.mean - self.case.expected).abs();
        let worst = all.into_iter().max_by(|a, b| off(a).total_cmp(&off(b)));
        worst.ok_or_else(|| "the sensor has no pixels".to_owned())
    }

    /// Balls as [x, y, z, radius], or one above the sensor.
    fn targets(&self, size: f64) -> Result<Vec<Target>, String> {
        let balls =
            self.case.lists("targets")?.unwrap_or(vec![vec![0.5 * size, 0.0, 2.0 * size, 0.8 * size]]);
        let target = |numbers: Vec<f64>| match numbers[..] {
            [x, y, z, radius] => Target::sphere(Point3D::new(x, y, z), radius).map_err(wrong),
            _ => Err("targets: x, y, z and radius are needed".to_owned()),
        };
        balls.into_iter().map(target).collect()
    }

    /// What a sensor without an étendue of its own is given [m² sr].
    fn etendue(&self) -> Result<f64, String> {
        self.case.number_among(&["etendue", "sensitivity"], 1.0)
    }
}

/// So many columns and rows are looked at, the outermost among them.
const LOOKED_AT: usize = 6;

/// Of a large picture, pixels in all parts of it.
fn some_pixels<S: Sensor>(observer: Observer<S>) -> Result<Observer<S>, String> {
    let shape = observer.sensor().shape();
    let spread = |count: usize, most: usize| -> Vec<usize> {
        if count <= most {
            (0..count).collect()
        } else {
            (0..most).map(|i| i * (count - 1) / (most - 1)).collect()
        }
    };
    let most = if shape.rows() == 1 { LOOKED_AT * LOOKED_AT } else { LOOKED_AT };
    let mut mask = vec![false; shape.pixels()];
    for row in spread(shape.rows(), LOOKED_AT) {
        for column in spread(shape.columns(), most) {
            mask[row * shape.columns() + column] = true;
        }
    }
    observer.mask(mask).map_err(wrong)
}

/// The reading of a sensor; none for a name that nothing here knows. Names are those of the library or of Raysect, in
/// any spelling: `CCDArray`, `ccd_array`, `ccd`.
pub(super) fn by_name(stand: &Stand<'_>, name: &str) -> Known {
    let name: String =
        name.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect();
    let plain = name.strip_prefix("targeted");
    let stand = &Stand { targeted: plain.is_some(), ..*stand };
    match plain.unwrap_or(&name) {
        "pixel" => flat(stand),
        "ccd" | "ccdarray" => ccd(stand),
        "fibreoptic" | "fiberoptic" | "fibre" | "fiber" => fibre(stand),
        "meshpixel" => mesh(stand, |data, offset| MeshPixel::new(data)?.surface_offset(offset)),
        "meshcamera" => mesh(stand, |data, offset| MeshCamera::new(data)?.surface_offset(offset)),
        "pinhole" | "pinholecamera" => pinhole(stand),
        "orthographic" | "orthographiccamera" => orthographic(stand),
        "thinlens" | "thinlenscamera" => thin_lens(stand),
        "vector" | "vectorcamera" => vectors(stand),
        "opencv" | "opencvcamera" => opencv(stand),
        "sightline" => stand.read(1.0, SightLine::new().etendue(stand.etendue()?)),
        "sightlinearray" | "sightlines" => sightlines(stand),
        _ => Ok(None),
    }
}

fn flat(stand: &Stand<'_>) -> Known {
    let (width, height) = (stand.case.number_or("x_width", 0.01)?, stand.case.number_or("y_width", 0.01)?);
    stand.read(width.max(height), Pixel::new(width, height))
}

/// A square pixel.
pub(super) fn square(stand: &Stand<'_>) -> Known {
    let side = stand.case.number("side")?;
    stand.read(side, Pixel::new(side, side))
}

fn ccd(stand: &Stand<'_>) -> Known {
    let (pixels, width) = (stand.case.pixels_or((720, 480))?, stand.case.number_or("width", 0.035)?);
    stand.read(width * (1.0 + pixels.1 as f64 / pixels.0 as f64), CcdArray::new(pixels, width))
}

fn fibre(stand: &Stand<'_>) -> Known {
    let acceptance =
        stand.case.number_among(&["acceptance_deg", "acceptance_angle", "acceptance", "deg"], 5.0)?;
    let radius = stand.case.number_among(&["radius", "a"], 1e-3)?;
    stand.read(radius, FibreOptic::new(acceptance, radius))
}

fn pinhole(stand: &Stand<'_>) -> Known {
    let pixels = stand.case.pixels_or((4, 3))?;
    let camera = PinholeCamera::new(pixels, field_of_view(stand.case)?);
    let camera = if stand.case.has("aperture") {
        let area = stand.case.number("aperture")?;
        camera.and_then(|camera| camera.aperture(area))
    } else {
        let etendue = stand.etendue()?;
        camera.and_then(|camera| camera.etendue(etendue))
    };
    stand.read(1.0, camera)
}

fn field_of_view(case: &Case) -> Result<f64, String> {
    case.number_among(&["fov_deg", "fov", "field_of_view_deg", "field_of_view"], 45.0)
}

fn orthographic(stand: &Stand<'_>) -> Known {
    let (pixels, width) = (stand.case.pixels_or((4, 3))?, stand.case.number_or("width", 1.0)?);
    let (size, etendue) = (width * (1.0 + pixels.1 as f64 / pixels.0 as f64), stand.etendue()?);
    stand.read(size, OrthographicCamera::new(pixels, width).and_then(|camera| camera.etendue(etendue)))
}

fn thin_lens(stand: &Stand<'_>) -> Known {
    let radius = stand.case.number_among(&["lens_radius", "radius"], 0.025)?;
    let focus = stand.case.number_among(&["focus_distance", "focus"], 3.0)?;
    let pixels = stand.case.pixels_or((4, 3))?;
    stand.read(radius, ThinLensCamera::new(pixels, field_of_view(stand.case)?, radius, focus))
}

/// As far as points reach from the origin, or one.
fn reach(points: &[Point3D]) -> f64 {
    let farthest = points.iter().map(|point| point.max_abs()).fold(0.0, f64::max);
    if farthest > 0.0 { farthest } else { 1.0 }
}

/// Origins and directions, as a case gives them, or a fan from one point over the pixels.
struct Lines {
    pixels: (usize, usize),
    origins: Vec<Point3D>,
    directions: Vec<Vector3D>,
}

impl Lines {
    fn of(case: &Case, usual: (usize, usize)) -> Result<Self, String> {
        let given = case.vectors(&["pixel_directions", "directions"])?;
        let ((columns, rows), directions) = match given {
            Some((found, directions)) => {
                (if found.1 > 1 { found } else { case.pixels_or(found)? }, directions)
            }
            None => {
                let (columns, rows) = case.pixels_or(usual)?;
                let fan = |i: usize| [0.05 * (i % columns) as f64, -0.05 * (i / columns) as f64, 1.0];
                ((columns, rows), (0..columns * rows).map(fan).collect())
            }
        };
        let directions: Vec<Vector3D> = directions.into_iter().map(Vector3D::from).collect();
        let origins = match case.vectors(&["pixel_origins", "origins"])? {
            Some((_, origins)) => origins.into_iter().map(Point3D::from).collect(),
            None => vec![Point3D::ORIGIN; directions.len()],
        };
        Ok(Self { pixels: (columns, rows), origins, directions })
    }
}

fn vectors(stand: &Stand<'_>) -> Known {
    let Lines { pixels, origins, directions } = Lines::of(stand.case, (4, 3))?;
    let (size, etendue) = (reach(&origins), stand.etendue()?);
    let footprint = stand.case.flag_or("footprint", true)?;
    let camera = VectorCamera::new(pixels, origins, directions).map(|camera| camera.footprint(footprint));
    stand.read(size, camera.and_then(|camera| camera.etendue(etendue)))
}

fn sightlines(stand: &Stand<'_>) -> Known {
    let Lines { origins, directions, .. } = Lines::of(stand.case, (4, 1))?;
    let acceptance = stand.case.number_among(&["acceptance_deg", "acceptance_angle", "acceptance"], 0.0)?;
    let aperture = stand.case.has("aperture").then(|| stand.case.number("aperture")).transpose()?;
    let (size, etendue) = (reach(&origins), stand.etendue()?);
    let line = |(origin, direction): (Point3D, Vector3D)| {
        let line = Sightline::new(origin, direction)?.acceptance(acceptance)?;
        aperture.map_or(line.etendue(etendue), |area| line.aperture(area))
    };
    let lines: Result<Vec<Sightline>, ObserverError> =
        origins.into_iter().zip(directions).map(line).collect();
    stand.read(size, lines.and_then(SightlineArray::new))
}

fn opencv(stand: &Stand<'_>) -> Known {
    let case = stand.case;
    let (columns, rows) = case.pixels_or((4, 3))?;
    let focal = columns.max(rows) as f64;
    let usual = [
        [focal, 0.0, 0.5 * (columns as f64 - 1.0)],
        [0.0, focal, 0.5 * (rows as f64 - 1.0)],
        [0.0, 0.0, 1.0],
    ];
    let matrix = case.matrix("camera_matrix")?.unwrap_or(usual);
    let distortion = case.list_or("distortion", &[])?;
    let vector = |key| case.numbers_or(key, [0.0; 3]);
    let (rotation, translation) = (vector("r_vector")?, vector("t_vector")?);
    let size = reach(&[Point3D::from(translation)]);
    let etendue = stand.etendue()?;
    let camera = OpenCvCamera::new((columns, rows), matrix, &distortion)
        .and_then(|camera| camera.extrinsics(rotation, translation)?.etendue(etendue));
    stand.read(size, camera)
}

/// A mesh of a case: a cube of twelve triangles, an icosphere, or its vertices and triangles; none for any other.
fn mesh_of(case: &Case) -> Result<Option<MeshData>, String> {
    let text = if case.has("mesh") { case.text("mesh")?.to_lowercase() } else { "cube".to_owned() };
    let data = if case.has("vertices") {
        let vertices = case.vectors(&["vertices"])?.map_or_else(Vec::new, |(_, all)| all);
        let triangles = case.vectors(&["triangles"])?.map_or_else(Vec::new, |(_, all)| all);
        MeshData::new(vertices, triangles.into_iter().map(|corners| corners.map(|i| i as u32)))
    } else if text.starts_with("cube") {
        MeshData::cube(case.number_or("half_size", 0.05)?)
    } else if text.starts_with("icosphere") {
        let splits = case.number_or("splits", 2.0)? as u32;
        MeshData::icosphere(splits, case.number_or("radius", 0.05)?)
    } else {
        return Ok(None);
    };
    let data = data.map_err(wrong)?;
    Ok(Some(if text.contains("inward") { data.flipped() } else { data }))
}

fn mesh<S: Sensor>(
    stand: &Stand<'_>,
    sensor: impl Fn(&MeshData, f64) -> Result<Observer<S>, ObserverError>,
) -> Known {
    let Some(data) = mesh_of(stand.case)? else { return Ok(None) };
    let offset = stand.case.number_among(&["surface_offset", "offset"], 0.0)?;
    stand.read(reach(data.vertices()) + offset, sensor(&data, offset))
}
