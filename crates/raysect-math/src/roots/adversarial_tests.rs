//! A million polynomials of each degree, by chance and by malice: what is left of them at the roots found, and whether
//! every root that went in comes out.

use super::tests::{counted, judge, product, residual, solve};
use crate::Rng;
use crate::error_free::{two_product, two_sum};

/// Polynomials of each degree.
const COUNT: usize = 1_000_000;

/// Half a spacing of numbers at the root times the slope of a quartic, in units of ε Σ |cᵢ xⁱ|.
const ROUNDING: f64 = 2.0;

/// A number of twice the precision.
type Double = (f64, f64);

fn add(a: Double, b: Double) -> Double {
    let (sum, error) = two_sum(a.0, b.0);
    two_sum(sum, error + (a.1 + b.1))
}

fn times(a: Double, b: f64) -> Double {
    let (product, error) = two_product(a.0, b);
    two_sum(product, error + a.1 * b)
}

/// A polynomial made of factors, with all its roots, complex ones by one of each pair.
struct Made {
    /// From the highest degree on, in twice the precision.
    coefficients: Vec<Double>,
    /// Real and imaginary parts, the latter not negative.
    roots: Vec<[f64; 2]>,
}

impl Made {
    fn new(leading: f64) -> Self {
        Self { coefficients: vec![(leading, 0.0)], roots: Vec::new() }
    }

    fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Multiplied by a factor, from the highest degree on.
    fn multiply(&mut self, factor: &[f64]) {
        let old = std::mem::take(&mut self.coefficients);
        self.coefficients = vec![(0.0, 0.0); old.len() + factor.len() - 1];
        for (i, &c) in old.iter().enumerate() {
            for (j, &f) in factor.iter().enumerate() {
                self.coefficients[i + j] = add(self.coefficients[i + j], times(c, f));
            }
        }
    }

    fn root(&mut self, root: f64) {
        self.multiply(&[1.0, -root]);
        self.roots.push([root, 0.0]);
    }

    /// A root so large that the leading coefficient all but vanishes.
    fn far_root(&mut self, reciprocal: f64) {
        self.multiply(&[reciprocal, -1.0]);
        self.roots.push([1.0 / reciprocal, 0.0]);
    }

    /// A pair of complex roots, with numbers of few bits, whose squares are exact.
    fn pair(&mut self, real: f64, imaginary: f64) {
        let short = |x: f64| f64::from(x as f32);
        let (real, imaginary) = (short(real), short(imaginary));
        let (squares, error) = two_sum(real * real, imaginary * imaginary);
        self.multiply(&[1.0, -2.0 * real, squares]);
        let last = self.coefficients.len() - 1;
        // What was rounded off the sum of squares.
        if self.degree() == 2 {
            self.coefficients[last] = add(self.coefficients[last], times(self.coefficients[0], error));
        }
        self.roots.push([real, imaginary]);
    }

    fn rounded(&self) -> Vec<f64> {
        self.coefficients.iter().map(|c| c.0 + c.1).collect()
    }

    /// By how much rounded coefficients and a root of rounding's residual may move a root: (rounding of all terms there)
    /// over slope.
    fn doubt(&self, c: &[f64], [re, im]: [f64; 2]) -> f64 {
        let size = re.hypot(im);
        // Both over powers of the size, which alone might overflow.
        let terms = c.iter().rev().fold(0.0, |sum, c| sum / size + c.abs());
        let distance = |[x, y]: [f64; 2]| (re - x).hypot(im - y) / size;
        let mut slope = c[0].abs();
        let mut itself = 0;
        for &[x, y] in &self.roots {
            if [x, y] == [re, im] {
                itself += 1;
            } else {
                slope *= distance([x, y]);
            }
            if y > 0.0 {
                slope *= distance([x, -y]);
            }
        }
        if itself > 1 { f64::INFINITY } else { (2.0 + ROUNDING) * f64::EPSILON * terms / slope * size }
    }

    /// What is wrong with the roots found. Of each root that rounding cannot confuse with another there must be one; if all
    /// are such, there must be no others.
    fn judge(&self, found: &[f64]) -> Result<(), String> {
        let c = self.rounded();
        let mut clear = true;
        for &[re, im] in &self.roots {
            let doubt = self.doubt(&c, [re, im]);
            let gap = |&[x, y]: &[f64; 2]| match [x, y] == [re, im] {
                true if y == 0.0 => f64::INFINITY,
                true => 2.0 * y,
                false => (re - x).hypot(im - y),
            };
            let nearest = self.roots.iter().map(gap).fold(f64::INFINITY, f64::min);
            if doubt.is_nan() || doubt.is_infinite() || doubt > 0.1 * nearest {
                clear = false;
                continue;
            }
            let tolerance = doubt + 2.0 * f64::EPSILON * re.abs();
            let near = found.iter().filter(|&&r| (r - re).abs() <= tolerance).count();
            if im == 0.0 && near != 1 {
                return Err(format!("{near} times {re:?} ± {tolerance:e} in {found:?} of {c:?}"));
            }
        }
        let real = self.roots.iter().filter(|r| r[1] == 0.0).count();
        if clear && found.len() != real {
            return Err(format!("{found:?} in place of {:?} of {c:?}", self.roots));
        }
        Ok(())
    }
}

/// Either sign, sizes in equal ratios between powers of ten.
fn wide(rng: &mut Rng, low: f64, high: f64) -> f64 {
    let size = 10f64.powf(rng.range(low, high));
    if rng.probability(0.5) { size } else { -size }
}

/// Roots from 1e-8 to 1e8, pairs of them complex.
fn spread(degree: usize, rng: &mut Rng) -> Made {
    let mut made = Made::new(wide(rng, -3.0, 3.0));
    if degree > 2 && rng.probability(0.4) {
        made.pair(wide(rng, -4.0, 4.0), wide(rng, -4.0, 4.0).abs());
    }
    while made.degree() < degree {
        made.root(wide(rng, -8.0, 8.0));
    }
    made
}

/// Two to four roots that differ by parts from 1e-16 to 0.1 of their size.
fn nearly_multiple(degree: usize, rng: &mut Rng) -> Made {
    let (mut made, centre) = (Made::new(wide(rng, -3.0, 3.0)), wide(rng, -2.0, 2.0));
    let apart = 10f64.powf(rng.range(-16.0, -1.0));
    while made.degree() < degree {
        if made.degree() < 2 || rng.probability(0.5) {
            made.root(centre * (1.0 + apart * rng.range(-1.0, 1.0)));
        } else {
            made.root(wide(rng, -2.0, 2.0));
        }
    }
    made
}

/// A root beyond 1e10, up to 1e290: the leading coefficient is tiny.
fn vanishing(degree: usize, rng: &mut Rng) -> Made {
    let mut made = Made::new(wide(rng, -1.0, 1.0));
    while made.degree() + 1 < degree {
        made.root(wide(rng, -2.0, 2.0));
    }
    made.far_root(wide(rng, -290.0, -10.0));
    made
}

/// Coefficients by chance, of one size or of sizes up to 24 orders apart.
fn by_chance(degree: usize, orders: f64, rng: &mut Rng) -> Vec<f64> {
    (0..=degree).map(|_| rng.range(-1.0, 1.0) * 10f64.powf(rng.range(-orders, orders))).collect()
}

/// Roots k / 1024 of exact coefficients, alone, several times or next to each other.
fn exact(degree: usize, rng: &mut Rng) -> Vec<i32> {
    let centre = rng.range(-1400.0, 1400.0) as i32;
    let clustered = rng.probability(0.5);
    let near = |rng: &mut Rng| centre + rng.range(-3.0, 4.0).floor() as i32;
    let far = |rng: &mut Rng| rng.range(-1500.0, 1500.0) as i32;
    (0..degree).map(|_| if clustered && rng.probability(0.8) { near(rng) } else { far(rng) }).collect()
}

/// Polynomials of a degree that fail, and the largest residual.
fn trial(degree: usize) -> (Vec<String>, f64) {
    let mut rng = Rng::new(degree as u64);
    let (mut faults, mut worst) = (Vec::new(), 0.0f64);
    for number in 0..COUNT {
        let (coefficients, outcome) = match number % 6 {
            0 => (by_chance(degree, 0.0, &mut rng), None),
            1 => (by_chance(degree, 12.0, &mut rng), None),
            2 => {
                let roots = exact(degree, &mut rng);
                let c = product(&roots);
                let outcome = judge(&c, &solve(&c), &counted(roots));
                (c, Some(outcome))
            }
            kind => {
                let make = [spread, nearly_multiple, vanishing][kind - 3];
                let made = make(degree, &mut rng);
                let c = made.rounded();
                let outcome = made.judge(&solve(&c));
                (c, Some(outcome))
            }
        };
        if let Some(Err(fault)) = outcome {
            faults.push(fault);
        }
        for &root in solve(&coefficients).iter() {
            worst = worst.max(residual(&coefficients, root));
        }
    }
    (faults, worst)
}

fn check(degree: usize) {
    let (faults, worst) = trial(degree);
    let some = faults.iter().take(5).cloned().collect::<Vec<_>>().join("\n");
    assert!(faults.is_empty(), "{} of {COUNT}:\n{some}", faults.len());
    assert!(worst <= ROUNDING, "{worst}");
    assert!(worst > 0.5, "{worst}: the roots are rounded themselves");
    println!("degree {degree}: residuals up to {worst:.2} ε Σ |cᵢ xⁱ|");
}

#[test]
fn a_million_quadratics() {
    check(2);
}

#[test]
fn a_million_cubics() {
    check(3);
}

#[test]
fn a_million_quartics() {
    check(4);
}

#[test]
fn the_judge_of_factors_refuses_wrong_roots() {
    let mut made = Made::new(3.0);
    made.pair(0.5, 2.0);
    made.root(1e-8);
    made.root(-1e8);
    let right = solve(&made.rounded());
    assert!(made.judge(&right).is_ok() && right.len() == 2);
    let wrong: [&[f64]; 5] = [
        &[],
        &right[..1],
        &[right[0], right[1], 0.5],
        &[right[0] * (1.0 + 1e-12), right[1]],
        &[right[0], right[1] * (1.0 + 1e-12)],
    ];
    for roots in wrong {
        assert!(made.judge(roots).is_err(), "{roots:?}");
    }
    // The formula of schools loses the small root of a wide pair.
    let mut wide = Made::new(1.0);
    wide.root(1e-8);
    wide.root(1e8);
    let [a, b, c] = wide.rounded()[..] else { panic!() };
    let root = (b * b - 4.0 * a * c).sqrt();
    assert!(wide.judge(&[(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)]).is_err());
    assert!(residual(&[a, b, c], (-b - root) / (2.0 * a)) > 1e6);
}
