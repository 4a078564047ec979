//! Passes keep no memory.

use std::process::Command;

use raysect::prelude::*;

use crate::cornell::{self, Variant};

/// Resident memory of this process in units of a page of 4 KiB; none where the system does not tell.
fn resident_pages() -> Option<i64> {
    std::fs::read_to_string("/proc/self/statm").ok()?.split_whitespace().nth(1)?.parse().ok()
}

/// The same test in a process of its own, so that nothing else allocates.
#[test]
fn memory_is_flat_over_passes() {
    let program = std::env::current_exe().unwrap();
    let arguments = ["--exact", "memory::alone", "--ignored", "--nocapture"];
    let run = Command::new(program).args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    println!("{said}");
    assert!(run.status.success(), "{said}\n{}", String::from_utf8_lossy(&run.stderr));
    assert!(said.contains("1 passed"), "{said}");
}

#[test]
#[ignore = "started by memory_is_flat_over_passes, alone in its process"]
fn alone() {
    let world = cornell::cornell_box(Variant::Glass).unwrap();
    let camera = cornell::camera((64, 64)).unwrap().pixel_samples(1).threads(2).unwrap().quiet(true);
    let (mut rgb, mut radiance) = (RgbPipeline2D::new(), RadiancePipeline2D::new());
    let mut pages = Vec::new();
    for _ in 0..30 {
        camera.observe(&world, &mut (&mut rgb, &mut radiance)).unwrap();
        pages.extend(resident_pages());
    }
    if let (Some(&tenth), Some(&last)) = (pages.get(9), pages.last()) {
        let grown = (last - tenth) as f64 * 4096.0 / 1e6;
        println!("{:.1} MB, {grown:+.2} MB from pass 10 to 30", last as f64 * 4096.0 / 1e6);
        assert!(grown < 3.0, "{grown} MB more after 20 passes");
    }
}
