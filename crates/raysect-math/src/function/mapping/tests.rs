use super::super::{Arg, Extrapolation, Function, Interpolation, Interpolator2DArray, Interpolator3DArray};
use super::super::{components, sample2d, sample3d};
use super::{axisymmetric, cylindrical, periodic_sectors};
use crate::{Point3D, Vector3D, rotate_z};
use proptest::prelude::*;

fn turned(at: (f64, f64, f64), angle: f64) -> (f64, f64, f64) {
    let p = rotate_z(angle) * Point3D::new(at.0, at.1, at.2);
    (p.x, p.y, p.z)
}

#[test]
fn the_axis_has_the_parts_of_the_first_half_plane() {
    let f = components(1.0, 2.0, 3.0);
    assert_eq!(axisymmetric(f).evaluate((0.0, 0.0, 1.0)), Vector3D::new(1.0, 2.0, 3.0));
    assert_eq!(cylindrical(f).evaluate((0.0, 0.0, 1.0)), Vector3D::new(1.0, 2.0, 3.0));
}

#[test]
fn a_uniform_field_has_turning_parts() {
    // Along x: radial part cos φ, toroidal part −sin φ.
    let radians = Arg::Z * std::f64::consts::PI / 180.0;
    let field = cylindrical(components(radians.cos(), -radians.sin(), 0.0));
    for angle in [-170.0, -90.0, 0.0, 33.0, 90.0, 180.0] {
        let value = field.evaluate(turned((2.0, 0.0, 1.0), angle));
        assert!((value - Vector3D::X).length() < 1e-15, "{angle}: {value:?}");
    }
}

#[test]
fn the_borders_of_sectors_are_inside_the_table_of_one_sector() {
    for count in [1, 2, 3, 7, 18] {
        let width = 360.0 / f64::from(count);
        let wave = Arg::X + (Arg::Z * (std::f64::consts::TAU / width)).cos();
        let ([r, z, phi], f) = sample3d(&wave, (0.5, 2.0, 4), (-1.0, 1.0, 3), (0.0, width, 101)).unwrap();
        let table = Interpolator3DArray::new(&r, &z, &phi, &f, Interpolation::Linear).unwrap();
        let f = periodic_sectors(table, count).unwrap();
        for border in 0..2 * count {
            for nudge in [-1e-13, -1e-15, 0.0, 1e-15, 1e-13] {
                let at = turned((1.25, 0.0, 0.5), f64::from(border) * width + nudge);
                assert!((f.evaluate(at) - 2.25).abs() < 1e-9, "{count} {border} {nudge}: {}", f.evaluate(at));
            }
        }
    }
    assert!(periodic_sectors(Arg::X, 0).is_err());
}

#[test]
fn a_table_of_a_profile_serves_all_around() {
    let profile = (-(Arg::X - 1.5) * (Arg::X - 1.5) - Arg::Y * Arg::Y).exp();
    let ([r, z], f) = sample2d(&profile, (0.5, 2.5, 41), (-1.0, 1.0, 41)).unwrap();
    let table = Interpolator2DArray::new(&r, &z, &f, Interpolation::Cubic).unwrap();
    let table = table.extrapolate(Extrapolation::Nearest, 0.1, 0.0).unwrap();
    let f = axisymmetric(table);
    let (at, beside) = (turned((1.7, 0.0, 0.2), 100.0), turned((1.9, 0.0, 0.2), 100.0));
    assert!((f.evaluate(at) - profile.evaluate((1.7, 0.2))).abs() < 1e-5);
    assert!((f.evaluate(beside) - profile.evaluate((1.7, 0.2))).abs() > 1e-2);
    assert!(f.evaluate((0.0, 2.61, 0.0)).is_nan() && f.checked((0.0, 2.61, 0.0)).is_err());
}

proptest! {
    #[test]
    fn turning_the_place_turns_the_value(
        r in 0.1..3.0f64, z in -1.0..1.0f64, phi in -180.0..180.0f64, angle in -360.0..360.0f64,
    ) {
        let f = axisymmetric(components(Arg::X, 1.0 + Arg::Y, Arg::X * Arg::Y));
        let at = turned((r, 0.0, z), phi);
        let (value, other) = (f.evaluate(at), f.evaluate(turned(at, angle)));
        prop_assert!((rotate_z(angle) * value - other).length() < 1e-13);
        // The radial part points away from the axis.
        prop_assert!((other.x * other.x + other.y * other.y - r * r - (1.0 + z).powi(2)).abs() < 1e-12);
    }

    #[test]
    fn sectors_are_alike(
        r in 0.1..3.0f64, z in -1.0..1.0f64, phi in 0.01..0.99f64, sector in 0..12u32, count in 1..12u32,
    ) {
        let width = 360.0 / f64::from(count);
        let f = periodic_sectors(components(Arg::X, Arg::Z, Arg::Y), count).unwrap();
        let first = f.evaluate(turned((r, 0.0, z), phi * width));
        let angle = f64::from(sector) * width;
        let other = f.evaluate(turned((r, 0.0, z), phi * width + angle));
        prop_assert!((rotate_z(angle) * first - other).length() < 1e-10);
        // Half a sector on, the function is another.
        let between = angle + width / 2.0;
        let other = f.evaluate(turned((r, 0.0, z), phi * width + between));
        prop_assert!((rotate_z(between) * first - other).length() > width / 2.1);
    }
}
