//! Points drawn uniformly over the area of a mesh.

use raysect_math::sampling::triangle;

use super::MeshData;

/// Sums of the areas of triangles, among which a share of the whole is looked up: in a number of steps that grows as
/// the logarithm of the number of triangles.
#[derive(Debug)]
pub(super) struct Areas {
    /// Of each triangle with all before it [m²].
    sums: Vec<f64>,
}

impl Areas {
    pub(super) fn new(data: &MeshData) -> Self {
        let mut sum = 0.0;
        let add = |triangle| {
            sum += data.triangle_area(triangle);
            sum
        };
        Self { sums: (0..data.triangle_count()).map(add).collect() }
    }

    /// The area of all triangles [m²].
    pub(super) fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    /// A triangle and the barycentric coordinates of the second and the third corner of a point in it, from three
    /// uniforms in (0, 1). Triangles without area are never drawn.
    pub(super) fn draw(&self, u: [f64; 3]) -> (u32, [f64; 2]) {
        let share = u[0] * self.total();
        let drawn = self.sums.partition_point(|&sum| sum < share).min(self.sums.len() - 1);
        let [_, v, w] = triangle::sample([u[1], u[2]]);
        (drawn as u32, [v, w])
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.sums.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_drawn_by_their_areas_and_never_without_one() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 3.0, 0.0], [2.0, 0.0, 0.0]];
        // Areas 0, 1/2, 0, 3/2, 0.
        let triangles = [[0, 1, 4], [0, 1, 2], [0, 0, 1], [0, 1, 3], [0, 4, 1]];
        let areas = Areas::new(&MeshData::new(corners, triangles).unwrap());
        assert_eq!(areas.total(), 2.0);
        let count = 1000;
        let draws = (0..count).map(|i| areas.draw([(f64::from(i) + 0.5) / f64::from(count), 0.3, 0.6]).0);
        let mut found = [0; 5];
        draws.for_each(|triangle| found[triangle as usize] += 1);
        assert_eq!(found, [0, 250, 0, 750, 0]);
        for edge in [f64::MIN_POSITIVE, 0.25, 1.0 - f64::EPSILON] {
            assert!([1, 3].contains(&areas.draw([edge, 0.5, 0.5]).0));
        }
    }
}
