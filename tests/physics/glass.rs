//! Surfaces and volumes of glass.

use raysect::core::{Node, Ray};
use raysect::math::{AffineMatrix3D, Point3D, Vector3D, rotate, translate};
use raysect::optical::{AbsorbingSurface, Dielectric, NullMaterial, Optics, WithMaterial, World};

use crate::check::{Demand, Probe, Reading, accept, expected};
use crate::materials::{Fog, GlowingGlass};
use crate::scenes::{ball, cuboid, dome, lamp, tilted, times, world};

/// A wide layer of a material between two heights.
fn layer(bottom: f64, top: f64, material: impl raysect::optical::Material) -> Node<Optics> {
    cuboid([-400.0, -400.0, bottom], [400.0, 400.0, top]).material(material)
}

/// Glass of an index and a transmission per metre.
fn glass(index: f64, transmission: f64) -> Dielectric {
    Dielectric::new(index, transmission).unwrap()
}

/// A world of layers with a lamp high above, for rays from below.
fn under_a_lamp(layers: impl IntoIterator<Item = Node<Optics>>) -> World {
    let lamp = cuboid([-900.0, -900.0, 50.0], [900.0, 900.0, 60.0]).material(lamp());
    world(layers.into_iter().chain([lamp]))
}

/// Reads upwards from below, at an angle [deg].
fn upwards(world: &World, degrees: f64, count: u64) -> Reading {
    let direction = tilted(degrees);
    let [x, y, z] = times(direction, -3.0);
    Probe::new(count).seed(21).along(world, [x + 0.3, y + 0.2, z], direction)
}

/// Unpolarised reflectance at an angle [deg] in the first of two media, by Fresnel's formulae of sums and
/// differences of angles; also the angle [deg] in the second.
pub(crate) fn fresnel(degrees: f64, first: f64, second: f64) -> (f64, f64) {
    let incident = degrees.to_radians();
    let refracted = (incident.sin() * first / second).asin();
    if degrees == 0.0 {
        return (((first - second) / (first + second)).powi(2), 0.0);
    }
    let (sum, difference) = (incident + refracted, incident - refracted);
    let s = (difference.sin() / sum.sin()).powi(2);
    let p = (difference.tan() / sum.tan()).powi(2);
    (0.5 * (s + p), refracted.to_degrees())
}

/// Transmittance of a pile of layers between vacuum, without interference: from the reflectance of each surface and
/// the transmission of each layer, added from the far end.
fn pile(reflectances: &[f64], transmissions: &[f64]) -> f64 {
    let last = reflectances[transmissions.len()];
    let (mut through, mut back) = (1.0 - last, last);
    for (r, t) in reflectances.iter().zip(transmissions).rev() {
        let repeated = 1.0 / (1.0 - r * back * t * t);
        through *= (1.0 - r) * t * repeated;
        back = r + (1.0 - r) * (1.0 - r) * back * t * t * repeated;
    }
    through
}

/// The same from the indices of all media, vacuum at both ends included, at normal incidence.
fn pile_of(indices: &[f64], transmissions: &[f64]) -> f64 {
    let reflectances: Vec<f64> = indices.windows(2).map(|w| fresnel(0.0, w[0], w[1]).0).collect();
    pile(&reflectances, transmissions)
}

#[test]
fn o05_o06_fresnel_reflectance() {
    let halfspace = cuboid([-400.0, -400.0, -200.0], [400.0, 400.0, 0.0]).material(glass(1.5, 1.0));
    let sink = cuboid([-390.0, -390.0, -190.0], [390.0, 390.0, -1.0]).material(AbsorbingSurface);
    let world = world([halfspace, sink, ball([0.0; 3], 3000.0, lamp())]);
    for (id, degrees, count) in [("O05", 0.0, 2_800_000), ("O06", 1.5f64.atan().to_degrees(), 1_450_000)] {
        assert!((fresnel(degrees, 1.0, 1.5).0 - expected(id)).abs() < 1e-12);
        let [x, y, z] = tilted(degrees);
        let reading = Probe::new(count).seed(22).along(&world, times([x, y, -z], -3.0), [x, y, -z]);
        accept(id, expected(id), Demand::Mean, &reading);
    }
}

#[test]
fn o07_beyond_the_critical_angle_nothing_is_transmitted() {
    let halfspace = layer(-200.0, 0.0, glass(1.5, 1.0).transmission_only(true));
    let world = world([halfspace, ball([0.0; 3], 3000.0, lamp())]);
    let passes = |degrees: f64| {
        let direction = tilted(degrees);
        Probe::new(1).along(&world, times(direction, -1.0), direction).radiance.mean() > 0.0
    };
    let (mut low, mut high) = (10.0, 89.0);
    assert!(passes(low) && !passes(high));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if passes(middle) { low = middle } else { high = middle }
    }
    assert!((low / expected("O07") - 1.0).abs() < 1e-12, "{low}");
}

#[test]
fn o08_o09_transmittance_of_a_slab() {
    let world = under_a_lamp([layer(0.0, 0.2, glass(1.5, 0.5))]);
    for (id, degrees) in [("O08", 0.0), ("O09", 30.0)] {
        let (r, refracted) = fresnel(degrees, 1.0, 1.5);
        let value = pile(&[r, r], &[0.5f64.powf(0.2 / refracted.to_radians().cos())]);
        assert!((value - expected(id)).abs() < 1e-12);
        accept(id, expected(id), Demand::Mean, &upwards(&world, degrees, 80_000));
    }
}

#[test]
fn o10_a_matched_absorber_follows_beers_law() {
    for material in [glass(1.0, 0.3), glass(1.33, 0.3).external_index(1.33)] {
        let world = under_a_lamp([layer(0.0, 0.7, material)]);
        accept("O10", expected("O10"), Demand::Exact, &upwards(&world, 0.0, 1000));
    }
    let opaque = under_a_lamp([layer(0.0, 0.7, glass(1.0, 0.0))]);
    assert_eq!(upwards(&opaque, 0.0, 10).radiance.mean(), 0.0);
}

#[test]
fn an_external_index_is_that_of_where_no_other_glass_is() {
    let world = under_a_lamp([layer(0.0, 0.2, glass(1.5, 0.5).external_index(1.33))]);
    for (degrees, count) in [(0.0, 40_000), (40.0, 40_000), (75.0, 120_000)] {
        let (r, refracted) = fresnel(degrees, 1.33, 1.5);
        let value = pile(&[r, r], &[0.5f64.powf(0.2 / refracted.to_radians().cos())]);
        accept(
            format!("1.5 in 1.33 at {degrees} degrees"),
            value,
            Demand::Mean,
            &upwards(&world, degrees, count),
        );
    }
    // Seen from within, by a path that begins there: the critical angle is that of 1.33 as well.
    let passes = |degrees: f64| {
        let [x, y, z] = times(tilted(degrees), -0.1);
        let reading = Probe::new(1000).along(&world, [x, y, z + 0.15], tilted(degrees));
        reading.radiance.mean() > 0.7 * (1.5f64 / 1.33).powi(2)
    };
    assert!(passes(60.0) && !passes(63.0), "{}", (1.33f64 / 1.5).asin().to_degrees());
}

#[test]
fn an_external_index_does_not_count_within_other_glass() {
    // The same core in a coat of lower priority, whose own external index counts at its surfaces only.
    for flip in [false, true] {
        let core = glass(1.5, 0.5).external_index(1.33).priority(1);
        let mut nodes = vec![layer(0.0, 3.0, glass(1.2, 0.8).external_index(1.1)), layer(1.0, 2.0, core)];
        nodes.rotate_left(usize::from(flip));
        let (outer, inner) = (fresnel(0.0, 1.1, 1.2).0, fresnel(0.0, 1.2, 1.5).0);
        let value = pile(&[outer, inner, inner, outer], &[0.8, 0.5, 0.8]);
        let case = format!("1.5 in 1.2 in 1.1, flipped {flip}");
        accept(case, value, Demand::Mean, &upwards(&under_a_lamp(nodes), 0.0, 200_000));
    }
}

#[test]
fn x01_x02_emission_inside_glass_loses_the_square_of_the_index() {
    let world = world([ball([0.0; 3], 1.0, GlowingGlass::new())]);
    for (id, impact) in [("X01", 0.0), ("X02", 0.6)] {
        let reading = Probe::new(80_000).seed(23).along(&world, [impact, 0.0, -5.0], [0.0, 0.0, 1.0]);
        accept(id, expected(id), Demand::Mean, &reading);
    }
}

#[test]
fn p01_a_glowing_ball_shows_its_chord() {
    let world = world([ball([0.0; 3], 1.0, Fog::bright())]);
    let reading = Probe::new(10).along(&world, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0]);
    accept("P01", expected("P01"), Demand::Exact, &reading);
}

#[test]
fn x05_x06_x07_emission_and_absorption_in_one_place() {
    let slab = |bottom, top, fog| layer(bottom, top, fog);
    for order in [0, 1] {
        let case = |id: &str, absorber: [f64; 2], transmission: f64, up: bool| {
            let mut nodes =
                vec![slab(0.0, 1.0, Fog::bright()), slab(absorber[0], absorber[1], Fog::dark(transmission))];
            nodes.rotate_left(order);
            let sign = if up { 1.0 } else { -1.0 };
            let reading = Probe::new(2).along(&world(nodes), [0.3, 0.2, -5.0 * sign], [0.0, 0.0, sign]);
            accept(id, expected(id), Demand::Exact, &reading);
        };
        case("X05", [0.4, 1.4], 0.3, false);
        case("X06", [0.4, 1.4], 0.3, true);
        case("X07", [0.0, 1.0], 0.1, true);
    }
}

#[test]
fn ice_in_water_in_glass_multiplies_fresnel_terms() {
    let (ice, water, outer) = (glass(1.31, 1.0).priority(2), glass(1.33, 1.0).priority(1), glass(1.5, 1.0));
    let world = under_a_lamp([layer(0.0, 7.0, outer), layer(1.0, 6.0, water), layer(2.0, 5.0, ice)]);
    let indices = [1.0, 1.5, 1.33, 1.31, 1.33, 1.5, 1.0];
    let reading = upwards(&world, 0.0, 80_000);
    accept("ice in water in glass", pile_of(&indices, &[1.0; 5]), Demand::Mean, &reading);
}

#[test]
fn the_higher_priority_counts_where_glasses_overlap() {
    for (first, second) in [(0, 1), (1, 0)] {
        for flip in [false, true] {
            let mut nodes = vec![
                layer(0.0, 2.0, glass(1.9, 0.8).priority(first)),
                layer(1.0, 3.0, glass(1.3, 0.5).priority(second)),
            ];
            nodes.rotate_left(usize::from(flip));
            let middle = if first > second { 2.0 } else { 1.0 };
            let transmissions = [0.8f64.powf(middle), 0.5f64.powf(3.0 - middle)];
            let value = pile_of(&[1.0, 1.9, 1.3, 1.0], &transmissions);
            let case = format!("overlap, priorities {first} {second}, flipped {flip}");
            accept(case, value, Demand::Mean, &upwards(&under_a_lamp(nodes), 0.0, 80_000));
        }
    }
}

/// Two blocks of glass, one metre each, with a gap between them [m], added from below or from above.
fn two_blocks(gap: f64, indices: [f64; 2], from_below: bool) -> World {
    let mut nodes =
        vec![layer(0.0, 1.0, glass(indices[0], 0.5)), layer(1.0 + gap, 2.0 + gap, glass(indices[1], 0.5))];
    nodes.rotate_left(usize::from(!from_below));
    under_a_lamp(nodes)
}

#[test]
fn blocks_with_a_common_face_are_one_block() {
    let one = pile_of(&[1.0, 1.5, 1.0], &[0.25]);
    assert!((one - 0.230423).abs() < 1e-6);
    for from_below in [true, false] {
        let world = two_blocks(0.0, [1.5, 1.5], from_below);
        let case = format!("gap 0, from below {from_below}");
        accept(case, one, Demand::Mean, &upwards(&world, 0.0, 80_000));
    }
}

#[test]
fn blocks_with_a_common_face_are_one_block_at_an_angle() {
    let (r, refracted) = fresnel(35.0, 1.0, 1.5);
    let one = pile(&[r, r], &[0.25f64.powf(1.0 / refracted.to_radians().cos())]);
    for from_below in [true, false] {
        let reading = upwards(&two_blocks(0.0, [1.5, 1.5], from_below), 35.0, 80_000);
        accept(format!("gap 0 at 35 degrees, from below {from_below}"), one, Demand::Mean, &reading);
    }
}

#[test]
fn a_common_face_is_one_surface_in_a_turned_frame() {
    // Rounding places the face of one block a little before or behind that of the other.
    let value = pile_of(&[1.0, 1.5, 1.9, 1.0], &[0.5, 0.5]);
    for (turn, from_below) in [(1, true), (1, false), (2, true), (2, false)] {
        let turn = rotate(17.0 * f64::from(turn), 23.0, 5.0);
        let mut world = under_a_lamp([]);
        let group = world.add(Node::group().transform(turn)).unwrap();
        let blocks = [(0.0, 1.5, 1.0), (0.9, 1.9, 1.0 / 1.3)].map(|(shift, index, size)| {
            // The same place in two ways: blocks of unlike frames.
            let frame = translate(0.1 * shift, 0.0, shift / 0.9) * scale(size);
            let block = cuboid([-4.0, -4.0, 0.0], [4.0, 4.0, 1.0 / size]);
            block.material(glass(index, 0.5)).transform(frame).parent(group)
        });
        let order: Vec<_> = if from_below { blocks.into() } else { blocks.into_iter().rev().collect() };
        for block in order {
            world.add(block).unwrap();
        }
        let reading = Probe::new(40_000).seed(24).each(&world, |rng| {
            let from = Point3D::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), -2.0);
            Ray::new(turn * from, turn * Vector3D::Z)
        });
        accept(format!("turned, from below {from_below}"), value, Demand::Mean, &reading);
    }
}

/// A uniform scale about the origin.
fn scale(factor: f64) -> AffineMatrix3D {
    let [x, y, z] = [Vector3D::X, Vector3D::Y, Vector3D::Z].map(|axis| axis * factor);
    AffineMatrix3D::from_axes(x, y, z, Point3D::ORIGIN)
}

#[test]
fn a_box_of_nothing_in_a_common_face_changes_nothing() {
    let one = pile_of(&[1.0, 1.5, 1.0], &[0.25]);
    for turns in 0..3 {
        for reversed in [false, true] {
            let mut nodes = vec![
                layer(0.0, 1.0, glass(1.5, 0.5)),
                layer(1.0, 3.0, NullMaterial),
                layer(1.0, 2.0, glass(1.5, 0.5)),
            ];
            nodes.rotate_left(turns);
            if reversed {
                nodes.reverse();
            }
            let reading = upwards(&under_a_lamp(nodes), 0.0, 60_000);
            accept(format!("nothing between, {turns} {reversed}"), one, Demand::Mean, &reading);
        }
    }
}

#[test]
fn a_common_face_of_two_glasses_is_one_surface() {
    for indices in [[1.5, 1.31], [1.31, 1.9]] {
        for from_below in [true, false] {
            let world = two_blocks(0.0, indices, from_below);
            let value = pile_of(&[1.0, indices[0], indices[1], 1.0], &[0.5, 0.5]);
            let case = format!("{indices:?} touch, from below {from_below}");
            accept(case, value, Demand::Mean, &upwards(&world, 0.0, 80_000));
        }
    }
}

#[test]
fn blocks_with_a_gap_are_two_however_small_it_is() {
    let two = pile_of(&[1.0, 1.5, 1.0, 1.5, 1.0], &[0.5, 1.0, 0.5]);
    assert!((two - 0.213023).abs() < 1e-6);
    for (gap, from_below) in [(1e-12, true), (1e-9, false), (1e-8, true), (0.1, false)] {
        let world = two_blocks(gap, [1.5, 1.5], from_below);
        accept(format!("gap {gap:e}"), two, Demand::Mean, &upwards(&world, 0.0, 80_000));
    }
}

#[test]
fn a_flush_inclusion_has_one_surface_on_each_side() {
    // A core that fills the lower half of a block: their bottom faces coincide.
    for flip in [false, true] {
        let mut nodes = vec![layer(0.0, 2.0, glass(1.5, 0.8)), layer(0.0, 1.0, glass(1.9, 0.6).priority(1))];
        nodes.rotate_left(usize::from(flip));
        let value = pile_of(&[1.0, 1.9, 1.5, 1.0], &[0.6, 0.8]);
        accept(
            format!("flush core, flipped {flip}"),
            value,
            Demand::Mean,
            &upwards(&under_a_lamp(nodes), 0.0, 80_000),
        );
    }
}

#[test]
fn blocks_in_a_furnace_vanish_however_they_touch() {
    let block = |x: f64, index: f64| cuboid([x, -0.5, -0.5], [x + 0.5, 0.5, 0.5]).material(glass(index, 1.0));
    for turns in 0..3 {
        for mirrored in [false, true] {
            let mut blocks = vec![block(-0.5, 1.5), block(0.0, 1.7), block(0.5, 1.3)];
            blocks.rotate_left(turns);
            if mirrored {
                blocks.reverse();
            }
            let world = world([dome()].into_iter().chain(blocks));
            let reading = Probe::new(10_000).each(&world, |rng| {
                let target = [rng.range(-0.5, 1.0), rng.range(-0.5, 0.5), rng.range(-0.5, 0.5)];
                let origin = Point3D::new(-3.0, rng.range(-2.0, 2.0), 2.0);
                Ray::new(origin, origin.vector_to(target.into()))
            });
            accept("three blocks in a furnace", 1.0, Demand::Exact, &reading);
        }
    }
}
