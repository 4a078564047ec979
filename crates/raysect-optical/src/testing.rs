//! The contract of [`Bsdf`] as code, for our surfaces and for users' own.

use std::cell::RefCell;
use std::f64::consts::TAU;

use raysect_math::sampling::{sphere, uniforms};
use raysect_math::{Rng, Statistics, Stratum, Vector3D};

use crate::{Bsdf, Context};

/// Bands of equal solid angle and sectors into which the sphere of directions is cut.
const CELLS: (usize, usize) = (32, 16);
/// Of so many directions drawn.
const SAMPLES: usize = 100_000;
/// Expected directions below which cells are put together.
const FEW: f64 = 10.0;
/// What the integral of a density may lack, and an albedo exceed: many times the error of the quadrature.
const SLACK: f64 = 1e-3;
/// Standard deviations, and those of χ², that pass as chance.
const SIGMAS: f64 = 5.0;

/// How [`check_bsdf`] looks at a surface.
#[derive(Debug, Clone, Copy)]
pub struct BsdfTest<'a> {
    /// Bins and refractive indices.
    pub at: Context<'a>,
    /// Where the path comes from: a unit vector of surface space with z > 0.
    pub incoming: Vector3D,
    /// False for a surface that is declared not to be reciprocal.
    pub reciprocal: bool,
    /// Seed of all that is drawn.
    pub seed: u64,
}

/// Tests a surface against the contract of [`Bsdf`], and answers with its directional albedo, bin by bin: the share
/// of the light from everywhere that leaves along `incoming`, with radiance from the other side freed of the square
/// of the ratio of the indices.
///
/// The scattering function must be finite, not negative, and reciprocal: f(i → o)/n_o² = f(o → i)/n_i²; the density
/// must integrate to one over the sphere and agree with what is drawn (χ²); the albedo must be at most 1, and the
/// same by quadrature and by sampling. All that must hold for grazing directions and for uniforms near 0 and 1.
///
/// The surface must be isotropic, and its lobes not narrower than about a degree.
///
/// # Errors
/// A sentence that says which rule is broken, by which direction, and by how much.
pub fn check_bsdf(bsdf: &dyn Bsdf, test: &BsdfTest<'_>) -> Result<Vec<f64>, String> {
    let mut rng = Rng::new(test.seed);
    let mut judge = Judge { bsdf, test, out: vec![0.0; test.at.slice.bins] };
    judge.check_values(&mut rng)?;
    if test.reciprocal {
        judge.check_reciprocity(&mut rng)?;
    }
    judge.check_density(&mut rng)?;
    judge.check_albedo(&mut rng)
}

struct Judge<'a> {
    bsdf: &'a dyn Bsdf,
    test: &'a BsdfTest<'a>,
    out: Vec<f64>,
}

/// From z and the angle about it [rad].
fn direction(z: f64, phi: f64) -> Vector3D {
    let (y, x) = phi.sin_cos();
    let sine = ((1.0 - z) * (1.0 + z)).sqrt();
    Vector3D::new(sine * x, sine * y, z)
}

impl Judge<'_> {
    /// The scattering function times cosine, checked.
    fn evaluate(
        &mut self,
        incoming: Vector3D,
        outgoing: Vector3D,
        at: Context<'_>,
    ) -> Result<&[f64], String> {
        self.out.fill(f64::NAN);
        self.bsdf.evaluate(incoming, outgoing, at, &mut self.out);
        match self.out.iter().find(|f| !(f.is_finite() && **f >= 0.0)) {
            Some(f) => Err(format!("evaluate gives {f} from {incoming:?} into {outgoing:?}")),
            None => Ok(&self.out),
        }
    }

    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D) -> Result<f64, String> {
        let pdf = self.bsdf.pdf(incoming, outgoing, self.test.at);
        let right = pdf.is_finite() && pdf >= 0.0;
        right.then_some(pdf).ok_or_else(|| format!("pdf is {pdf} from {incoming:?} into {outgoing:?}"))
    }

    fn check_values(&mut self, rng: &mut Rng) -> Result<(), String> {
        let grazing = [0.0, f64::MIN_POSITIVE, 1e-16, 1e-9, 1e-4];
        let arriving: Vec<Vector3D> = grazing.into_iter().map(|z| direction(z, 0.3)).collect();
        let at = self.test.at;
        for incoming in [self.test.incoming, Vector3D::Z].into_iter().chain(arriving) {
            let mut outgoing = vec![incoming, -incoming, Vector3D::new(-incoming.x, -incoming.y, incoming.z)];
            for z in grazing {
                let phi = TAU * rng.uniform();
                outgoing.extend([direction(z, phi), direction(-z, phi)]);
                outgoing.extend([direction(1.0 - z, phi), direction(z - 1.0, phi)]);
            }
            outgoing.extend((0..100).map(|_| sphere::sample(uniforms(rng))));
            outgoing.extend(self.extreme_samples(incoming, rng));
            for outgoing in outgoing {
                let length = outgoing.length();
                if (length - 1.0).abs() > 1e-9 || length.is_nan() {
                    return Err(format!("from {incoming:?} sample gives {outgoing:?}, of length {length}"));
                }
                let pdf = self.pdf(incoming, outgoing)?;
                let largest = self.evaluate(incoming, outgoing, at)?.iter().fold(0.0f64, |a, &b| a.max(b));
                if pdf > 0.0 && !(largest / pdf).is_finite() {
                    return Err(format!("{largest} / {pdf} from {incoming:?} into {outgoing:?}"));
                }
            }
        }
        Ok(())
    }

    /// Directions drawn with uniforms near 0 and near 1 first, and with any.
    fn extreme_samples(&self, incoming: Vector3D, rng: &mut Rng) -> Vec<Vector3D> {
        let mut all = Vec::new();
        for (low, first) in [(0, 51), (255, 8)] {
            for (other, second) in [(0, 51), (255, 8), (0, 0)] {
                for _ in 0..20 {
                    let stratum = Stratum { cell: [low, other], bits: [first, second] };
                    let mut own = Rng::new(rng.bits()).confined_to(stratum);
                    all.push(self.bsdf.sample(incoming, self.test.at, &mut own));
                }
            }
        }
        all
    }

    fn check_reciprocity(&mut self, rng: &mut Rng) -> Result<(), String> {
        let at = self.test.at;
        for number in 0..2000 {
            let incoming = direction(rng.uniform(), TAU * rng.uniform());
            let drawn = self.bsdf.sample(incoming, at, rng);
            let outgoing = if number % 2 == 0 { drawn } else { sphere::sample(uniforms(rng)) };
            if outgoing.z.abs() < 1e-6 || incoming.z < 1e-6 {
                continue;
            }
            let one = self.evaluate(incoming, outgoing, at)?.to_vec();
            // Seen from below what was behind is in front.
            let through = outgoing.z < 0.0;
            let flip = |v: Vector3D| if through { Vector3D::new(v.x, v.y, -v.z) } else { v };
            let back =
                if through { Context { index_in: at.index_out, index_out: at.index_in, ..at } } else { at };
            let two = self.evaluate(flip(outgoing), flip(incoming), back)?;
            for (one, two) in one.into_iter().zip(two) {
                let one = one / outgoing.z.abs() / at.index_in.powi(2);
                let two = two / incoming.z.abs() / back.index_in.powi(2);
                if (one - two).abs() > 1e-7 * one.max(two) {
                    return Err(format!(
                        "not reciprocal: f/n² is {one} from {incoming:?} into {outgoing:?}, and {two} back"
                    ));
                }
            }
        }
        Ok(())
    }

    fn check_density(&mut self, rng: &mut Rng) -> Result<(), String> {
        let incoming = self.test.incoming;
        let density = |outgoing| self.bsdf.pdf(incoming, outgoing, self.test.at);
        let expected: Vec<f64> = cells().map(|cell| cell.integral(&density)).collect();
        let integral: f64 = expected.iter().sum();
        if (integral - 1.0).abs() > SLACK {
            return Err(format!("the density from {incoming:?} integrates to {integral}"));
        }
        let mut found = vec![0.0; expected.len()];
        for _ in 0..SAMPLES {
            found[cell_of(self.bsdf.sample(incoming, self.test.at, rng))] += 1.0;
        }
        let (mut chi, mut freedoms, mut few, mut found_few) = (0.0, 0.0, 0.0, 0.0);
        let mut add = |expected: f64, found: f64| {
            chi += (found - expected).powi(2) / expected;
            freedoms += 1.0;
        };
        for (expected, found) in expected.into_iter().zip(found) {
            let expected = expected * SAMPLES as f64;
            if expected < FEW {
                few += expected;
                found_few += found;
            } else {
                add(expected, found);
            }
        }
        add(few + 1.0, found_few);
        // Nearly normal, by the cube root (E. Wilson and M. Hilferty, 1931).
        let spread: f64 = 2.0 / (9.0 * freedoms);
        let z = ((chi / freedoms).cbrt() - (1.0 - spread)) / spread.sqrt();
        if z > SIGMAS {
            return Err(format!(
                "what is drawn from {incoming:?} is not of the density claimed: χ² = {chi:.0} of {freedoms}, {z:.1} σ"
            ));
        }
        Ok(())
    }

    fn check_albedo(&mut self, rng: &mut Rng) -> Result<Vec<f64>, String> {
        let (at, incoming) = (self.test.at, self.test.incoming);
        let mut sampled = vec![Statistics::new(); at.slice.bins];
        for _ in 0..SAMPLES {
            let outgoing = self.bsdf.sample(incoming, at, rng);
            let pdf = self.pdf(incoming, outgoing)?;
            let share = if pdf > 0.0 { freed(outgoing, at) / pdf } else { 0.0 };
            let values = self.evaluate(incoming, outgoing, at)?;
            sampled.iter_mut().zip(values).for_each(|(s, f)| s.add(f * share));
        }
        let (mut answer, room) = (Vec::new(), RefCell::new(vec![0.0; at.slice.bins]));
        for (bin, sampled) in sampled.into_iter().enumerate() {
            let share = |outgoing: Vector3D| {
                let mut out = room.borrow_mut();
                self.bsdf.evaluate(incoming, outgoing, at, &mut out);
                out[bin] * freed(outgoing, at)
            };
            let albedo: f64 = cells().map(|cell| cell.integral(&share)).sum();
            if albedo > 1.0 + SLACK {
                return Err(format!("bin {bin} gives {albedo} of what arrives into {incoming:?}"));
            }
            let (mean, error) = (sampled.mean(), sampled.error());
            let unlike = (mean - albedo).abs() > SIGMAS * error + SLACK * albedo;
            if unlike || mean.is_nan() {
                return Err(format!("the albedo of bin {bin} is {albedo}, but {mean} ± {error} by sampling"));
            }
            answer.push(albedo);
        }
        Ok(answer)
    }
}

/// What frees radiance from the other side of its change by refraction.
fn freed(outgoing: Vector3D, at: Context<'_>) -> f64 {
    if outgoing.z < 0.0 { (at.index_out / at.index_in).powi(2) } else { 1.0 }
}

/// A piece of the sphere of directions: ranges of z and of the angle about it [rad].
#[derive(Debug, Clone, Copy)]
struct Cell {
    z: (f64, f64),
    phi: (f64, f64),
}

fn cells() -> impl Iterator<Item = Cell> {
    let (bands, sectors) = CELLS;
    let z = move |i: usize| 2.0 * i as f64 / bands as f64 - 1.0;
    let phi = move |j: usize| TAU * j as f64 / sectors as f64;
    (0..bands * sectors).map(move |k| {
        let (i, j) = (k / sectors, k % sectors);
        Cell { z: (z(i), z(i + 1)), phi: (phi(j), phi(j + 1)) }
    })
}

fn cell_of(v: Vector3D) -> usize {
    let (bands, sectors) = CELLS;
    let share = (v.y.atan2(v.x) / TAU).rem_euclid(1.0);
    let band = (0.5 * (v.z + 1.0) * bands as f64) as usize;
    let sector = (share * sectors as f64) as usize;
    band.min(bands - 1) * sectors + sector.min(sectors - 1)
}

impl Cell {
    fn integral(&self, f: &dyn Fn(Vector3D) -> f64) -> f64 {
        self.refined(f, self.gauss(f), 0)
    }

    /// Quarters the cell until that changes next to nothing, at least twice.
    fn refined(&self, f: &dyn Fn(Vector3D) -> f64, coarse: f64, depth: u32) -> f64 {
        let quarters = self.quarters().map(|q| (q, q.gauss(f)));
        let fine: f64 = quarters.iter().map(|q| q.1).sum();
        if depth == 9 || (depth > 0 && (fine - coarse).abs() < 1e-8 + 1e-6 * fine.abs()) {
            return fine;
        }
        quarters.iter().map(|(q, own)| q.refined(f, *own, depth + 1)).sum()
    }

    fn quarters(&self) -> [Self; 4] {
        let middle = |(a, b): (f64, f64)| 0.5 * (a + b);
        let (z, phi) = (middle(self.z), middle(self.phi));
        let halves = [(self.z.0, z), (z, self.z.1)];
        let sides = [(self.phi.0, phi), (phi, self.phi.1)];
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| Self { z: halves[i], phi: sides[j] })
    }

    /// Three by three points of Gauss and Legendre.
    fn gauss(&self, f: &dyn Fn(Vector3D) -> f64) -> f64 {
        let nodes = [(-0.6f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6f64.sqrt(), 5.0 / 18.0)];
        let place = |(a, b): (f64, f64), x: f64| a + (b - a) * 0.5 * (1.0 + x);
        let mut sum = 0.0;
        for (x, w) in nodes {
            for (y, v) in nodes {
                sum += w * v * f(direction(place(self.z, x), place(self.phi, y)));
            }
        }
        sum * (self.z.1 - self.z.0) * (self.phi.1 - self.phi.0)
    }
}
