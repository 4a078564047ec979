//! Each family holds, and refuses what is wrong on purpose.

use crate::check::{accept, refuse};

macro_rules! families {
    ($($module:ident: $holds:ident, $refuses:ident;)*) => {$(
        #[test]
        fn $holds() {
            accept(stringify!($module));
        }

        #[test]
        fn $refuses() {
            refuse(stringify!($module));
        }
    )*

        #[test]
        fn every_family_is_tested() {
            let tested = [$(stringify!($module)),*];
            assert!(crate::judges::FAMILIES.iter().map(|f| f.name).eq(tested));
        }
    };
}

families! {
    restarts: rays_leave_surfaces_and_meet_the_next, lost_and_repeated_hits_are_found;
    enclosures: closed_meshes_lose_no_ray, leaks_are_found;
    afar: distances_from_afar_are_exact_to_rounding, wrong_distances_and_misses_are_found;
    special: exact_hits_are_finite_and_right, wrong_places_and_normals_are_found;
    tangents: lines_that_all_but_touch_are_counted_right, wider_tori_and_misses_are_found;
    chords: chords_keep_their_digits, wrong_chords_are_found;
    transforms: stretched_and_mirrored_shapes_are_right, culled_and_tilted_shapes_are_found;
    meshes: meshes_are_tight_and_exact, holes_and_wrong_triangles_are_found;
    composites: faces_in_common_leave_neither_gap_nor_skin, gaps_are_found;
    scenes: worlds_agree_with_a_list_of_all_shapes, shapes_that_are_culled_are_found;
    mean_chords: mean_chords_are_four_volumes_over_the_area, wrong_volumes_areas_and_chords_are_found;
    metamorphic: other_descriptions_give_the_same_answers, differences_are_found;
}
