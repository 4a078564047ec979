//! Other numbers of bins.

use raysect::prelude::*;

use crate::comparison::{Picture, compare};
use crate::cornell::{self, Variant};
use crate::frames::ERROR;
use crate::reference;

#[test]
fn probe() {
    for (a, b) in [(15, 30), (15, 60), (30, 60), (15, 10)] {
        let r = |bins, seed| reference::render(Variant::Diffuse, 8, 8, bins, seed, 0.01).unwrap();
        let (x, y) = (r(a, 1), r(b, 2));
        let c = compare(&x, &y).unwrap();
        println!("{a} {b} {c}");
        for (s, ok) in c.criteria(ERROR) {
            println!("   {ok} {s}");
        }
        for ch in 0..3 {
            let t = |p: &Picture| {
                (
                    p.mean.iter().skip(ch).step_by(3).sum::<f64>(),
                    p.error.iter().skip(ch).step_by(3).map(|e| e * e).sum::<f64>().sqrt(),
                )
            };
            println!("{:?} {:?} {}", t(&x), t(&y), t(&x).0 / t(&y).0 - 1.0);
        }
    }
    let _ = cornell::camera((1, 1)).map(|c: PinholeCamera| c);
}
