//! probe
use raysect::prelude::*;
use raysect::observer::Measurement;
use raysect::optical::Slicing;
use crate::truth;
struct M(Frame);
impl Pipeline for M {
    fn channels(&self, _: &Slicing) -> Vec<String> { ["1","2","3","4"].map(str::to_owned).into() }
    fn measure(&self, s: &Measurement<'_>, out: &mut [f64]) {
        let x: f64 = s.radiance.iter().sum::<f64>();
        for k in 0..4 { out[k] += x.powi(k as i32 + 1); }
    }
    fn frame(&self) -> &Frame { &self.0 }
    fn frame_mut(&mut self) -> &mut Frame { &mut self.0 }
}
#[test]
fn probe_moments() {
    let d = PathSettings::default;
    for (name, s) in [("default", d()), ("no roulette", d().roulette_threshold(0.0).unwrap()), ("d1", d().max_depth(1)), ("d2", d().max_depth(2)),("d3", d().max_depth(3)), ("roulette .3", d().roulette_threshold(0.3).unwrap()), ("off", d().light_sampling(LightSampling::Off))] {
        let mut m = M(Frame::new("m", "1"));
        let t = std::time::Instant::now();
        truth::camera(8).engine(Serial).pixel_samples(20000).paths(s).observe(&truth::world(), &mut m).unwrap();
        let mut g: Vec<(f64, f64, f64)> = (0..64).map(|p| {
            let e = |k| m.0.pixel(p, k).value;
            let (a, b, c, dd) = (e(0), e(1), e(2), e(3));
            let v = b - a * a;
            (( c - 3.0*a*b + 2.0*a*a*a) / v.powf(1.5), (dd - 4.0*a*c + 6.0*a*a*b - 3.0*a*a*a*a)/v/v - 3.0, v.sqrt()/a)
        }).collect();
        g.sort_by(|a, b| a.0.total_cmp(&b.0));
        println!("{name:12} skew {:.2} {:.2} {:.2} {:.2} {:.2}; kurt med {:.1} {:.1}; relsd {:.2} {:?}", g[0].0, g[16].0, g[32].0, g[48].0, g[63].0, g[32].1, g[63].1, g[32].2, t.elapsed());
    }
}
