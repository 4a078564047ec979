use super::super::MeshData;
use super::super::weld::Places;

/// Edges and fans of a mesh, told by places.
#[derive(Debug)]
pub(super) struct Topology {
    /// The places of each triangle.
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its shell.
    pub(super) shell_of: Vec<u32>,
    pub(super) shell_count: usize,
    /// For each shell: every edge belongs to an even number of triangles; fronts meet fronts.
    pub(super) shell_flags: Vec<ShellFlags>,
    pub(super) used_vertices: usize,
    pub(super) used_places: usize,
    pub(super) duplicates: usize,
    pub(super) boundary_edges: usize,
    pub(super) non_manifold_edges: usize,
    pub(super) odd_edges: usize,
    pub(super) inconsistent_edges: usize,
    pub(super) touching_places: usize,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct ShellFlags {
    pub(super) is_closed: bool,
    pub(super) is_consistent: bool,
}

/// One side of one triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    low: u32,
    high: u32,
    /// Three times the triangle, plus the corner at which the side begins.
    corner: usize,
    forward: bool,
}

impl Topology {
    pub(super) fn new(mesh: &MeshData) -> Self {
        let places = Places::new(mesh.vertices());
        let triangles: Vec<[u32; 3]> =
            mesh.triangles().iter().map(|t| t.map(|v| places.of[v as usize])).collect();
        let mut topology = Self {
            shell_of: Vec::new(),
            shell_count: 0,
            shell_flags: Vec::new(),
            used_vertices: count_used(mesh.triangles(), mesh.vertex_count()),
            used_places: count_used(&triangles, places.points.len()),
            duplicates: count_duplicates(&triangles),
            boundary_edges: 0,
            non_manifold_edges: 0,
            odd_edges: 0,
            inconsistent_edges: 0,
            touching_places: 0,
            triangles,
        };
        topology.pair_sides(places.points.len());
        topology
    }

    fn pair_sides(&mut self, place_count: usize) {
        let sides = sides(&self.triangles);
        let mut shells = Union::new(self.triangles.len());
        let mut fans = Union::new(3 * self.triangles.len());
        let mut unsound = Vec::new();
        for edge in sides.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)) {
            let forward = edge.iter().filter(|side| side.forward).count();
            let backward = edge.len() - forward;
            let is_odd = edge.len() % 2 == 1;
            let is_inconsistent = forward.abs_diff(backward) > usize::from(is_odd);
            self.boundary_edges += usize::from(edge.len() == 1);
            self.non_manifold_edges += usize::from(edge.len() > 2);
            self.odd_edges += usize::from(is_odd);
            self.inconsistent_edges += usize::from(is_inconsistent);
            if is_odd || is_inconsistent {
                unsound.push((edge[0].corner / 3, is_odd, is_inconsistent));
            }
            for pair in edge.windows(2) {
                shells.join(pair[0].corner / 3, pair[1].corner / 3);
                let ends = pair[0].ends().into_iter().zip(pair[1].ends());
                ends.for_each(|(a, b)| fans.join(a, b));
            }
        }
        self.touching_places = self.count_touching(&mut fans, place_count);
        self.number_shells(&mut shells);
        for (triangle, is_odd, is_inconsistent) in unsound {
            let flags = &mut self.shell_flags[self.shell_of[triangle] as usize];
            flags.is_closed &= !is_odd;
            flags.is_consistent &= !is_inconsistent;
        }
    }

    fn number_shells(&mut self, shells: &mut Union) {
        let mut number = vec![u32::MAX; self.triangles.len()];
        for triangle in 0..self.triangles.len() {
            let root = shells.root(triangle);
            if number[root] == u32::MAX {
                number[root] = self.shell_count as u32;
                self.shell_count += 1;
            }
            self.shell_of.push(number[root]);
        }
        self.shell_flags = vec![ShellFlags { is_closed: true, is_consistent: true }; self.shell_count];
    }

    /// Places at which corners belong to more than one fan.
    fn count_touching(&self, fans: &mut Union, place_count: usize) -> usize {
        let mut fan_of = vec![usize::MAX; place_count];
        let mut touching = vec![false; place_count];
        for (triangle, corners) in self.triangles.iter().enumerate().filter(|(_, t)| is_proper(t)) {
            for (k, &place) in corners.iter().enumerate() {
                let (fan, known) = (fans.root(3 * triangle + k), &mut fan_of[place as usize]);
                if *known == usize::MAX {
                    *known = fan;
                }
                touching[place as usize] |= *known != fan;
            }
        }
        touching.into_iter().filter(|&t| t).count()
    }
}

impl Side {
    /// The corners of the triangle at the lower and the higher place.
    fn ends(self) -> [usize; 2] {
        let begin = self.corner;
        let end = begin - begin % 3 + (begin + 1) % 3;
        if self.forward { [begin, end] } else { [end, begin] }
    }
}

/// True if the three corners lie at three places. Others have no side that could be shared.
fn is_proper(&[a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// The sides of all proper triangles, those of one edge side by side.
fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate().filter(|(_, t)| is_proper(t)) {
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            let corner = 3 * triangle + k;
            sides.push(Side { low: from.min(to), high: from.max(to), corner, forward: from < to });
        }
    }
    sides.sort_unstable();
    sides
}

fn count_used(triangles: &[[u32; 3]], count: usize) -> usize {
    let mut used = vec![false; count];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    used.into_iter().filter(|&u| u).count()
}

fn count_duplicates(triangles: &[[u32; 3]]) -> usize {
    let mut sorted: Vec<[u32; 3]> = triangles.iter().filter(|t| is_proper(t)).copied().collect();
    sorted.iter_mut().for_each(|t| t.sort_unstable());
    sorted.sort_unstable();
    let all = sorted.len();
    sorted.dedup();
    all - sorted.len()
}

/// Sets that are joined (R. Tarjan, *Efficiency of a Good But Not Linear Set Union Algorithm*, 1975).
#[derive(Debug)]
struct Union(Vec<usize>);

impl Union {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&mut self, mut element: usize) -> usize {
        while self.0[element] != element {
            let above = self.0[element];
            self.0[element] = self.0[above];
            element = above;
        }
        element
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        // The lower root stays: numbers follow the order of the triangles.
        self.0[a.max(b)] = a.min(b);
    }
}
