//! The Cornell box against recorded frames of Raysect, and against itself.

#[path = "../../examples/common/comparison.rs"]
mod comparison;
#[path = "../../examples/common/cornell.rs"]
mod cornell;
#[path = "../../examples/common/reference.rs"]
mod reference;

use cornell::Variant;
#[test]
fn probe() {
    for v in [Variant::Glass, Variant::Diffuse] {
        let t = std::time::Instant::now();
        let p = reference::render(v, 24, 24, 15, 1, 0.03).unwrap();
        println!("{:?} {:?} {}", v, t.elapsed(), p.median_error());
        let name = if v == Variant::Glass { "glass" } else { "diffuse" };
        let path = format!("{}/tests/data/cornell_{name}.npz", env!("CARGO_MANIFEST_DIR"));
        let theirs = reference::load(std::path::Path::new(&path)).unwrap();
        println!("theirs {}", theirs.median_error());
        let c = comparison::compare(&p, &theirs).unwrap();
        for (s, ok) in c.criteria(0.03) { println!("{ok} {s}"); }
    }
}
