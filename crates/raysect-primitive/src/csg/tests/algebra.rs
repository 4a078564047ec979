use super::*;

/// How many of so many lines cross two bodies differently, by more than rounding allows, and how many hit at all.
fn differences(a: &Shape, b: &Shape, rays: usize, seed: u64) -> (usize, usize) {
    let ball = a.bounding_sphere(&AffineMatrix3D::IDENTITY);
    let mut rng = Rng::new(seed);
    let (mut different, mut hits) = (0, 0);
    for _ in 0..rays {
        let ray = line_through(ball.centre, ball.radius, &mut rng);
        let (of_a, of_b) = (crossings(a, &ray), crossings(b, &ray));
        let speed = ray.direction.length();
        let alike = |(x, y): (&Crossing, &Crossing)| {
            let (n, m) = (a.surface(&ray, x).normal, b.surface(&ray, y).normal);
            let slope = n.dot(ray.direction).abs().min(m.dot(ray.direction).abs()) / speed;
            let across = (x.distance - y.distance).abs() * speed * slope;
            x.exiting == y.exiting && across <= 1e-13 * 20.0 * ball.radius
        };
        let same = of_a.len() == of_b.len() && of_a.iter().zip(&of_b).all(alike);
        different += usize::from(!same);
        hits += usize::from(!of_a.is_empty());
    }
    (different, hits)
}

fn assert_same(name: &str, a: &Shape, b: &Shape) {
    let (different, hits) = differences(a, b, 4000, 5);
    assert!(different == 0 && hits > 100, "{name}: {different} of {hits} lines differ");
}

fn assert_nothing(name: &str, body: &Shape, like: &Shape) {
    let ball = like.bounding_sphere(&AffineMatrix3D::IDENTITY);
    let mut rng = Rng::new(6);
    for _ in 0..4000 {
        let ray = line_through(ball.centre, ball.radius, &mut rng);
        let all = crossings(body, &ray);
        assert!(all.is_empty(), "{name}: {ray:?} {all:?}");
    }
}

#[test]
fn a_body_with_itself_is_itself_or_nothing() {
    let mut rng = Rng::new(1);
    let plain: Vec<Shape> = vec![
        share(Sphere::new(0.7).unwrap()),
        cuboid([-0.7, -0.1, 0.3], [0.1, 0.9, 1.1]),
        share(Cylinder::new(0.3, 1.3).unwrap()),
        share(Cone::new(0.7, 0.6).unwrap()),
        share(Parabola::new(0.4, 0.9).unwrap()),
    ];
    for (index, a) in plain.iter().chain(bodies().iter().map(|(_, b)| b)).enumerate() {
        for twin in
            [a.clone(), moved(a, blurred(a.bounding_sphere(&AffineMatrix3D::IDENTITY).radius, &mut rng))]
        {
            let name = format!("body {index}");
            assert_same(&name, &union(a, &twin), a);
            assert_same(&name, &intersect(&twin, a), a);
            assert_nothing(&name, &subtract(a, &twin), a);
            assert_nothing(&name, &subtract(&twin, a), a);
        }
    }
}

#[test]
fn a_difference_in_the_twelfth_digit_is_found() {
    let a = cuboid([-0.7, -0.1, 0.3], [0.1, 0.9, 1.1]);
    let grown = moved(&a, scale(1.0 + 1e-11));
    assert!(differences(&a, &grown, 1000, 5).0 > 100);
}

#[test]
fn operations_obey_boolean_algebra() {
    let all = bodies();
    let pick = |name: &str| all.iter().find(|(n, _)| *n == name).unwrap().1.clone();
    let frame = rotate(12.0, 34.0, 56.0) * scale(0.9);
    for (x, y, z) in
        [("chain", "cup", "union"), ("subtract", "mirrored", "lens"), ("sheared", "deep", "union")]
    {
        let (a, b, c) = (pick(x), moved(&pick(y), frame), moved(&pick(z), translate(0.1, 0.0, -0.2)));
        assert_same("A ∪ B = B ∪ A", &union(&a, &b), &union(&b, &a));
        assert_same("A ∩ B = B ∩ A", &intersect(&a, &b), &intersect(&b, &a));
        assert_same("(A ∪ B) ∪ C = A ∪ (B ∪ C)", &union(&union(&a, &b), &c), &union(&a, &union(&b, &c)));
        let distributed = union(&intersect(&a, &b), &intersect(&a, &c));
        assert_same("A ∩ (B ∪ C) = (A ∩ B) ∪ (A ∩ C)", &intersect(&a, &union(&b, &c)), &distributed);
        let twice = subtract(&subtract(&a, &b), &c);
        assert_same("A − (B ∪ C) = (A − B) − C", &subtract(&a, &union(&b, &c)), &twice);
        let parts = union(&subtract(&a, &b), &subtract(&a, &c));
        assert_same("A − (B ∩ C) = (A − B) ∪ (A − C)", &subtract(&a, &intersect(&b, &c)), &parts);
        assert_same("(A − B) ∪ (A ∩ B) = A", &union(&subtract(&a, &b), &intersect(&a, &b)), &a);
        assert_same("A ∪ (A ∩ B) = A", &union(&a, &intersect(&a, &b)), &a);
        assert_nothing("(A − B) ∩ B", &intersect(&subtract(&a, &b), &b), &a);
    }
}

#[test]
fn a_body_cut_in_two_is_put_together_again() {
    for m in [AffineMatrix3D::IDENTITY, rotate(17.0, 33.0, 71.0) * scale(1.3), shear()] {
        let halves: Vec<(Shape, [Shape; 2])> = vec![
            (
                cuboid([-1.0, -1.0, 0.1], [1.0, 1.0, 2.3]),
                [cuboid([-1.0, -1.0, 0.1], [1.0, 1.0, 0.7]), cuboid([-1.0, -1.0, 0.7], [1.0, 1.0, 2.3])],
            ),
            (
                share(Cylinder::new(0.7, 1.3).unwrap()),
                [
                    share(Cylinder::new(0.7, 0.4).unwrap()),
                    moved(&share(Cylinder::new(0.7, 1.3 - 0.4).unwrap()), translate(0.0, 0.0, 0.4)),
                ],
            ),
        ];
        for (whole, [lower, upper]) in halves {
            let mut rng = Rng::new(9);
            let (lower, upper) =
                (moved(&lower, blurred(1.0, &mut rng)), moved(&upper, blurred(1.0, &mut rng)));
            assert_same("in two", &moved(&union(&upper, &lower), m), &moved(&whole, m));
            assert_same("what is left", &moved(&subtract(&whole, &lower), m), &moved(&upper, m));
        }
        for (_, body) in bodies() {
            let ball = body.bounding_sphere(&AffineMatrix3D::IDENTITY);
            let (c, r) = (ball.centre.to_array(), 2.0 * ball.radius);
            let side = |from: f64, to: f64| {
                let end = |x: f64| [c[0] + x * r, c[1] + r, c[2] + r];
                let low = [end(from)[0], c[1] - r, c[2] - r];
                cuboid(low, end(to))
            };
            let (left, right) = (side(-1.0, 0.07), side(0.07, 1.0));
            let again = union(&intersect(&body, &left), &intersect(&body, &right));
            assert_same("any body in two", &moved(&again, m), &moved(&body, m));
        }
    }
}

/// A tree of operations that can say what it contains without any of the code that is judged.
enum Tree {
    Leaf(Shape, AffineMatrix3D),
    Branch(u32, [Box<Tree>; 2]),
}

impl Tree {
    fn random(depth: u32, rng: &mut Rng) -> Self {
        let motion = |rng: &mut Rng| {
            let [x, y, z] = [0, 1, 2].map(|_| rng.range(-0.5, 0.5));
            translate(x, y, z) * rotate(rng.range(-180.0, 180.0), rng.range(-90.0, 90.0), 0.0)
        };
        if depth == 0 {
            let shape: Shape = match (rng.uniform() * 5.0) as u32 {
                0 => share(Sphere::new(rng.range(0.4, 1.2)).unwrap()),
                1 => share(Cylinder::new(rng.range(0.2, 0.8), rng.range(0.5, 2.0)).unwrap()),
                2 => share(Cone::new(rng.range(0.2, 0.8), rng.range(0.5, 2.0)).unwrap()),
                3 => share(Parabola::new(rng.range(0.2, 0.8), rng.range(0.5, 2.0)).unwrap()),
                _ => share(Cuboid::centred(rng.range(0.5, 2.0), rng.range(0.5, 2.0), 1.0).unwrap()),
            };
            let m = motion(rng) * if rng.uniform() < 0.3 { shear() } else { AffineMatrix3D::IDENTITY };
            return Self::Leaf(shape, m);
        }
        let pair = [0, 1].map(|_| Box::new(Self::random(depth - 1, rng)));
        Self::Branch((rng.uniform() * 3.0) as u32, pair)
    }

    fn build(&self) -> Shape {
        match self {
            Self::Leaf(shape, m) => moved(shape, *m),
            Self::Branch(0, [a, b]) => union(&a.build(), &b.build()),
            Self::Branch(1, [a, b]) => intersect(&a.build(), &b.build()),
            Self::Branch(_, [a, b]) => subtract(&a.build(), &b.build()),
        }
    }

    fn contains(&self, p: Point3D) -> bool {
        match self {
            Self::Leaf(shape, m) => shape.contains(m.inverse().unwrap() * p),
            Self::Branch(0, [a, b]) => a.contains(p) || b.contains(p),
            Self::Branch(1, [a, b]) => a.contains(p) && b.contains(p),
            Self::Branch(_, [a, b]) => a.contains(p) && !b.contains(p),
        }
    }
}

#[test]
fn points_along_random_lines_through_random_trees_are_where_the_crossings_say() {
    let mut rng = Rng::new(21);
    let (mut inside, mut wrong) = (0, 0);
    for number in 0..120 {
        let tree = Tree::random(number % 5, &mut rng);
        let body = tree.build();
        for _ in 0..100 {
            let ray = line_through(Point3D::ORIGIN, 1.0, &mut rng);
            let all = crossings(&body, &ray);
            for _ in 0..10 {
                let t = rng.range(0.0, 12.0) / ray.direction.length();
                let p = ray.point_at(t);
                // A point within rounding of a surface could be on either side; random ones never are.
                let before = all.iter().filter(|c| c.distance < t).count();
                assert_eq!(body.contains(p), tree.contains(p));
                wrong += usize::from((before % 2 == 1) != tree.contains(p));
                inside += usize::from(before % 2 == 1);
            }
        }
    }
    assert_eq!(wrong, 0);
    assert!(inside > 2000, "{inside}");
}
