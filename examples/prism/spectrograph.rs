//! A dark room with a hole in the shutter, a prism behind it, and a row of pixels for a screen.

use raysect::math::MathError;
use raysect::optical::colour::d65_white;
use raysect::prelude::*;

/// Apex angle of the prism [deg].
const APEX: f64 = 60.0;
/// Length of a side of its faces, and of its edges [m].
const SIDE: f64 = 0.04;
/// Light of this wavelength crosses it parallel to its base [nm].
const TUNED: f64 = 480.0;
/// Width of the square hole in the shutter, and its distance from the prism [m].
const HOLE: (f64, f64) = (0.004, 0.08);
/// Distance and radius of the sun of the picture [m]: 0.53° across.
const SUN: (f64, f64) = (100.0, 0.4625);
/// Distance of the screen from the prism, and how far it reaches beyond the colours on both sides [m].
const SCREEN: (f64, f64) = (1.5, 0.03);

/// The set-up: a beam in the plane z = 0, with the apex of the prism along y.
pub(crate) struct Spectrograph {
    pub(crate) world: World,
    glass: Dielectric,
    /// Where the beam meets the prism, and along what.
    entry: Point3D,
    beam: Vector3D,
    /// Where light of the tuned wavelength leaves the prism.
    exit: Point3D,
    /// From the space of the screen to the world: z leads back to the prism, x to what is deviated more.
    screen: AffineMatrix3D,
    /// Width of the screen [m].
    width: f64,
}

impl Spectrograph {
    /// With a prism of one of Schott's glasses, for a range of wavelengths [nm] to be on the screen.
    pub(crate) fn new(glass: &str, range: (f64, f64)) -> raysect::Result<Self> {
        let glass = schott(glass)?;
        let half = (0.5 * APEX).to_radians();
        let incidence = (index(&glass, TUNED) * half.sin()).asin();
        let (sine, cosine) = (incidence - half).sin_cos();
        let (width, height) = (SIDE * half.sin(), SIDE * half.cos());
        let mut spectrograph = Self {
            world: World::new(),
            glass,
            entry: Point3D::new(-0.5 * width, 0.5 * height, 0.0),
            beam: Vector3D::new(cosine, sine, 0.0),
            exit: Point3D::new(0.5 * width, 0.5 * height, 0.0),
            screen: AffineMatrix3D::IDENTITY,
            width: 0.0,
        };
        let ends = (spectrograph.deviation(range.0)?, spectrograph.deviation(range.1)?);
        let middle = rotate_z(-0.5 * (ends.0 + ends.1)) * spectrograph.beam;
        let centre = spectrograph.exit + middle * SCREEN.0;
        let place = translate(centre.x, centre.y, centre.z);
        spectrograph.screen = place * rotate_basis(-middle, Vector3D::Z)?;
        let spread = (0.5 * (ends.0 - ends.1)).to_radians().tan();
        spectrograph.width = 2.0 * (SCREEN.0 * spread.abs() + SCREEN.1);
        spectrograph.furnish(width, height)?;
        Ok(spectrograph)
    }

    /// Puts everything into the room.
    fn furnish(&mut self, width: f64, height: f64) -> raysect::Result<()> {
        let end = 0.5 * SIDE;
        let corners = [-end, end]
            .into_iter()
            .flat_map(|z| [(-width, 0.0), (width, 0.0), (0.0, height)].map(|(x, y)| Point3D::new(x, y, z)));
        let faces = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        let prism = Mesh::new(MeshData::new(corners.collect::<Vec<_>>(), faces)?)?;
        self.world.add(prism.material(self.glass.clone()).name("prism"))?;
        // Blackened, so that no light comes out that was reflected at the base; a little of it is in the glass.
        let base = Cuboid::new(Point3D::new(-width, -0.005, -end), Point3D::new(width, 0.0002, end))?;
        self.world.add(base.material(AbsorbingSurface).name("base"))?;

        let along = rotate_basis(self.beam, Vector3D::Z)?;
        let at = |distance: f64| {
            let point = self.entry - self.beam * distance;
            translate(point.x, point.y, point.z) * along
        };
        let shutter =
            Subtract::new(Cuboid::centred(5.0, 5.0, 0.001)?, Cuboid::centred(HOLE.0, HOLE.0, 0.01)?)?;
        self.world.add(shutter.material(AbsorbingSurface).transform(at(HOLE.1)).name("shutter"))?;
        let sun = Sphere::new(SUN.1)?.material(UniformSurfaceEmitter::new(d65_white(), 1.0));
        self.world.add(sun.transform(at(SUN.0)).name("sun"))?;
        Ok(())
    }

    /// The screen: a row of pixels that look where the light comes from.
    pub(crate) fn screen(&self, columns: usize) -> raysect::Result<TargetedCcdArray> {
        // On the exit face, as far as the light of any wavelength covers it.
        let down = Vector3D::new((0.5 * APEX).to_radians().sin(), -(0.5 * APEX).to_radians().cos(), 0.0);
        let edges = [down * 0.016, Vector3D::Z * 0.006];
        let corner = self.exit - (edges[0] + edges[1]) * 0.5;
        let inverse = self.screen.inverse()?;
        let port = Target::rectangle(inverse * corner, edges.map(|edge| inverse * edge))?;
        Ok(CcdArray::new((columns, 1), self.width)?.transform(self.screen).targets([port], 0.98)?)
    }

    /// Refractive index of the prism at a wavelength [nm].
    pub(crate) fn index(&self, wavelength: f64) -> f64 {
        index(&self.glass, wavelength)
    }

    /// The angle by which the prism turns light of a wavelength [nm], from Snell's law at both faces [deg] (M. Born and
    /// E. Wolf, *Principles of Optics*, 7th ed., § 4.7.2).
    pub(crate) fn deviation(&self, wavelength: f64) -> raysect::Result<f64> {
        let (apex, index) = (APEX.to_radians(), self.index(wavelength));
        let incidence = (self.index(TUNED) * (0.5 * apex).sin()).asin();
        let inside = apex - (incidence.sin() / index).asin();
        let deviation = incidence + (index * inside.sin()).asin() - apex;
        if deviation.is_nan() { Err(reflected(wavelength)) } else { Ok(deviation.to_degrees()) }
    }

    /// Follows light of a wavelength [nm] through the middle of the hole: the angle by which it is turned [deg], and
    /// where it meets the screen, along its x axis [m].
    pub(crate) fn trace(&self, wavelength: f64) -> raysect::Result<(f64, f64)> {
        let ray = Ray::new(self.entry - self.beam * (0.5 * HOLE.1), self.beam).spectrum(
            wavelength - 1e-7,
            wavelength + 1e-7,
            1,
        );
        // Some are reflected: the first one that goes through tells.
        for number in 0..1000 {
            let path = ray.replay(&self.world, number)?;
            let events: Vec<PathEvent> = path.vertices.iter().map(|vertex| vertex.event).collect();
            if events[1..] == [PathEvent::Refracted, PathEvent::Refracted, PathEvent::Escaped] {
                let (from, to) = (path.vertices[2].point, path.vertices[3].point);
                let inverse = self.screen.inverse()?;
                let (start, way) = (inverse * from, inverse * from.vector_to(to));
                let place = start.x - start.z / way.z * way.x;
                return Ok((self.beam.angle(from.vector_to(to))?, place));
            }
        }
        Err(reflected(wavelength))
    }
}

fn index(glass: &Dielectric, wavelength: f64) -> f64 {
    glass.index().function().evaluate(wavelength)
}

fn reflected(wavelength: f64) -> raysect::Error {
    let range = "what the prism lets through";
    MathError::OutOfRange { name: "wavelength", value: wavelength, unit: "nm", range }.into()
}
