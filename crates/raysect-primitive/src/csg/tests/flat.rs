use raysect_core::{Departure, Interval};

use super::*;
use crate::csg::composite::{Composite, Operation};
use crate::csg::flat::Flat;
use crate::csg::walk::Walk;

/// A composite that always asks its operands.
struct General(Composite);

crate::inner::answers_by_inner!(General);

/// A composite twice: with the list of its leaves, which may be spoiled, and without.
#[derive(Clone)]
struct Twin {
    flat: Shape,
    general: Shape,
}

/// How the first of a pair of composites is made.
type Make<'a> = &'a dyn Fn(Composite) -> Shape;

fn plainly(composite: Composite) -> Shape {
    match composite.operation {
        Operation::Union => share(Union(composite)),
        Operation::Intersect => share(Intersect(composite)),
        Operation::Subtract => share(Subtract(composite)),
    }
}

impl Twin {
    fn leaf(shape: Shape) -> Self {
        Self { flat: shape.clone(), general: shape }
    }

    fn of(
        operation: Operation,
        a: (&Self, AffineMatrix3D),
        b: (&Self, AffineMatrix3D),
        make: Make<'_>,
    ) -> Self {
        let composite = |pick: fn(&Self) -> &Shape| {
            let [a, b] = [a, b].map(|(twin, m)| pick(twin).clone().placed(m));
            Composite::new(operation, a, b).unwrap()
        };
        let mut general = composite(|twin| &twin.general);
        general.flat = None;
        Self { flat: make(composite(|twin| &twin.flat)), general: share(General(general)) }
    }

    fn random(leaves: u32, rng: &mut Rng) -> Self {
        if leaves == 1 {
            let size = |rng: &mut Rng| rng.range(0.4, 1.3);
            return Self::leaf(match (rng.uniform() * 5.0) as u32 {
                0 => share(Sphere::new(size(rng)).unwrap()),
                1 => share(Arc::new(Cylinder::new(size(rng), 2.0 * size(rng)).unwrap())),
                2 => share(Cone::new(size(rng), 2.0 * size(rng)).unwrap()),
                3 => share(Parabola::new(size(rng), 2.0 * size(rng)).unwrap()),
                _ => share(Cuboid::centred(size(rng), 2.0 * size(rng), 1.5).unwrap()),
            });
        }
        let first = 1 + (rng.uniform() * f64::from(leaves - 1)) as u32;
        let [a, b] = [first, leaves - first].map(|count| Self::random(count, rng));
        let operation = [Operation::Union, Operation::Intersect, Operation::Subtract];
        let operation = operation[(rng.uniform() * 3.0) as usize];
        Self::of(operation, (&a, Self::place(rng)), (&b, Self::place(rng)), &plainly)
    }

    /// Where it is, moved, turned, mirrored, or sheared.
    fn place(rng: &mut Rng) -> AffineMatrix3D {
        let [x, y, z] = [0, 1, 2].map(|_| rng.range(-0.4, 0.4));
        let moved = translate(x, y, z);
        let turned = moved * rotate(rng.range(-180.0, 180.0), rng.range(-90.0, 90.0), 0.0);
        match (rng.uniform() * 6.0) as u32 {
            0 | 1 => AffineMatrix3D::IDENTITY,
            2 => moved,
            3 => turned,
            4 => turned * stretch(1.2, -0.9, 1.0),
            _ => turned * shear(),
        }
    }

    /// How many of so many rays are answered differently, how many hit, and of how many the list of leaves has decided at
    /// all, and found the hit without the chords of all leaves.
    fn compare(&self, rays: usize, rng: &mut Rng) -> [usize; 4] {
        let ball = self.general.bounding_sphere(&AffineMatrix3D::IDENTITY);
        let mut scratch = Scratch::default();
        let [mut different, mut hits, mut decided, mut soon] = [0; 4];
        for _ in 0..rays {
            let mut ray = line_through(ball.centre, ball.radius, rng);
            let across = ball.radius / ray.direction.length();
            if rng.uniform() < 0.5 {
                ray.origin = ray.point_at(rng.range(0.0, 8.0) * across);
            }
            let [min, max] = [0, 1].map(|_| rng.range(-3.0, 6.0) * across);
            let within = match (rng.uniform() * 3.0) as u32 {
                0 => Interval::AHEAD,
                1 => Interval::new(0.0, max),
                _ => Interval::new(min, max),
            };
            let mut answers = |shape: &Shape| {
                let (hit, all) = (shape.hit(&ray, within, &mut scratch), crossings(shape, &ray));
                let starts = all.iter().flat_map(|c| [(c, true), (c, false)]);
                let after: Vec<_> = starts
                    .map(|(c, inward)| {
                        let surface = shape.surface(&ray, c);
                        let start = Ray::new(surface.point, ray.direction);
                        let departure = Departure { inward, bound: 1e3 * surface.bound, feature: c.feature };
                        (surface, shape.hit_after(&start, &departure, f64::INFINITY, &mut scratch))
                    })
                    .collect();
                (hit, all, after)
            };
            let of_flat = answers(&self.flat);
            different += usize::from(of_flat != answers(&self.general));
            hits += usize::from(of_flat.0.is_some());
            let Some(flat) = list_of(&self.flat) else { continue };
            decided += usize::from(flat.hit(&ray, within).is_some());
            let found = |mut walk: Walk<'_>| walk.meets() && walk.entry(within).flatten().is_some();
            soon += usize::from(Walk::new(flat, &ray, within).is_some_and(found));
        }
        [different, hits, decided, soon]
    }
}

fn list_of(shape: &Shape) -> Option<&Flat> {
    use crate::csg::leaf::known;
    let composite = known::<Union>(&**shape).map(|s| &s.0);
    let composite = composite.or_else(|| known::<Intersect>(&**shape).map(|s| &s.0));
    composite.or_else(|| known::<Subtract>(&**shape).map(|s| &s.0))?.flat.as_ref()
}

/// Sums over bodies.
fn total(counts: impl Iterator<Item = [usize; 4]>) -> [usize; 4] {
    counts.fold([0; 4], |sum, one| [0, 1, 2, 3].map(|i| sum[i] + one[i]))
}

#[test]
fn composites_as_lists_of_leaves_answer_to_the_bit_as_those_that_ask_their_operands() {
    let mut rng = Rng::new(51);
    let (bodies, rays) = (400, 200);
    let [different, hits, decided, soon] = total((0..bodies).map(|number| {
        let body = Twin::random(2 + number % 5, &mut rng);
        body.compare(rays, &mut rng)
    }));
    let all = bodies as usize * rays;
    assert!(different == 0 && hits > all / 10, "{different} of {hits}");
    assert!(decided * 1000 > all * 995, "{decided} of {all}");
    assert!(soon > all / 40, "{soon} of {all}");
}

#[test]
fn a_list_with_a_mistake_in_its_table_is_found_out() {
    let mut rng = Rng::new(52);
    let ball = Twin::leaf(share(Sphere::new(1.0).unwrap()));
    let spoiled = |mut composite: Composite| {
        if let Some(flat) = &mut composite.flat {
            flat.spoil_table();
        }
        plainly(composite)
    };
    for operation in [Operation::Union, Operation::Intersect, Operation::Subtract] {
        let placed = (&ball, translate(0.5, 0.3, 0.0));
        let body = Twin::of(operation, (&ball, AffineMatrix3D::IDENTITY), placed, &spoiled);
        let [different, ..] = body.compare(500, &mut rng);
        assert!(different > 50, "{operation:?}: {different}");
    }
}

/// Boxes piled up and cut, whose faces coincide to rounding.
fn pile(make: Make<'_>, rng: &mut Rng) -> Twin {
    let piece = |from: f64, to: f64| Twin::leaf(cuboid([-1.0, -1.0, from], [1.0, 1.0, to]));
    let here = AffineMatrix3D::IDENTITY;
    let two = Twin::of(
        Operation::Union,
        (&piece(0.0, 0.7), blurred(1.0, rng)),
        (&piece(0.7, 1.0), blurred(1.0, rng)),
        make,
    );
    Twin::of(Operation::Subtract, (&two, here), (&piece(0.0, 0.3), blurred(1.0, rng)), make)
}

#[test]
fn faces_in_common_are_left_to_the_tie_rule() {
    let mut rng = Rng::new(53);
    let [different, hits, decided, _] =
        total((0..20).map(|_| pile(&plainly, &mut rng).compare(300, &mut rng)));
    assert!(different == 0 && hits > 1000, "{different} of {hits}");
    assert!(decided < 20 * 300 * 9 / 10, "{decided}");
    // A list that believes itself where crossings nearly coincide.
    let rash = |mut composite: Composite| {
        if let Some(flat) = &mut composite.flat {
            flat.trust_blindly();
        }
        plainly(composite)
    };
    let [different, ..] = total((0..20).map(|_| pile(&rash, &mut rng).compare(300, &mut rng)));
    assert!(different > 100, "{different}");
}

#[test]
fn lists_know_small_and_large_bodies_and_those_far_away() {
    let mut rng = Rng::new(54);
    let ball = Twin::leaf(share(Sphere::new(1.0).unwrap()));
    let rod = Twin::leaf(share(Cylinder::new(0.4, 2.0).unwrap()));
    for (size, far) in [(1e-9, 0.0), (1e9, 0.0), (1.0, 1e5), (1e-3, 1e3)] {
        let here = translate(far, -far, 0.5 * far) * scale(size);
        let bored = Twin::of(
            Operation::Subtract,
            (&ball, here),
            (&rod, here * rotate(20.0, 30.0, 0.0) * translate(0.2, 0.0, -1.0)),
            &plainly,
        );
        let [different, hits, ..] = bored.compare(2000, &mut rng);
        assert!(different == 0 && hits > 500, "{different} of {hits} at {size} m, {far} m away");
    }
}

#[test]
fn what_is_no_list_of_few_convex_leaves_is_none() {
    let ball = share(Sphere::new(1.0).unwrap());
    let torus = share(crate::Torus::new(0.7, 0.3).unwrap());
    assert!(list_of(&union(&ball, &torus)).is_none());
    let mut body = union(&ball, &moved(&ball, translate(0.1, 0.0, 0.0)));
    assert!(list_of(&body).is_some_and(|flat| flat.leaves.len() == 3));
    body = union(&body, &body);
    assert!(list_of(&body).is_some_and(|flat| flat.leaves.len() == 6));
    assert!(list_of(&union(&body, &ball)).is_none());
}
