use super::*;
use crate::csg::composite::{Composite, Operation};

/// Length inside an axis-parallel box, by slabs.
fn chord(ray: &Ray, low: [f64; 3], high: [f64; 3]) -> f64 {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let [a, b] = [low, high].map(|side| (side[axis] - ray.origin[axis]) / ray.direction[axis]);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    (far - near).max(0.0) * ray.direction.length()
}

/// Boxes of the unit square column between heights.
fn slab(from: f64, to: f64) -> Shape {
    cuboid([-1.0, -1.0, from], [1.0, 1.0, to])
}

type Case = (&'static str, fn(&mut dyn FnMut(f64, f64) -> Shape) -> Shape, Vec<[f64; 2]>);

/// How pieces of the column are put together, and between which heights the result must lie.
fn cases() -> Vec<Case> {
    vec![
        ("union, face in common", |s| union(&s(0.0, 1.0), &s(1.0, 2.0)), vec![[0.0, 2.0]]),
        ("union of twins", |s| union(&s(0.0, 1.0), &s(0.0, 1.0)), vec![[0.0, 1.0]]),
        ("intersect of twins", |s| intersect(&s(0.0, 1.0), &s(0.0, 1.0)), vec![[0.0, 1.0]]),
        ("subtract of twins", |s| subtract(&s(0.0, 1.0), &s(0.0, 1.0)), vec![]),
        ("lower half off", |s| subtract(&s(0.0, 2.0), &s(0.0, 1.0)), vec![[1.0, 2.0]]),
        ("upper half off", |s| subtract(&s(0.0, 2.0), &s(1.0, 2.0)), vec![[0.0, 1.0]]),
        ("middle off", |s| subtract(&s(0.0, 3.0), &s(1.0, 2.0)), vec![[0.0, 1.0], [2.0, 3.0]]),
        ("intersect, face in common", |s| intersect(&s(0.0, 1.0), &s(1.0, 2.0)), vec![]),
        ("subtract, face in common", |s| subtract(&s(0.0, 1.0), &s(1.0, 2.0)), vec![[0.0, 1.0]]),
        (
            "ten in a chain",
            |s| {
                (1..10)
                    .fold(s(0.0, 0.1), |body, k| union(&body, &s(0.1 * f64::from(k), 0.1 * f64::from(k + 1))))
            },
            vec![[0.0, 1.0]],
        ),
        (
            "ten in a tree, taken out again",
            |s| {
                let all = (1..5).fold(s(0.0, 0.2), |body, k| {
                    union(&s(0.2 * f64::from(k), 0.2 * f64::from(k + 1)), &body)
                });
                subtract(&all, &union(&s(0.2, 0.4), &s(0.4, 0.6)))
            },
            vec![[0.0, 0.2], [0.2 * 3.0, 1.0]],
        ),
        (
            "hole filled again",
            |s| union(&subtract(&s(0.0, 1.0), &s(0.3, 0.7)), &s(0.3, 0.7)),
            vec![[0.0, 1.0]],
        ),
    ]
}

/// Lines with a wrong number of crossings or a wrong length inside, of `rays` in the frame `m`.
fn wrong_lines(body: &Shape, parts: &[[f64; 2]], m: AffineMatrix3D, rays: usize, rng: &mut Rng) -> usize {
    let body = moved(body, m);
    let mut wrong = 0;
    for _ in 0..rays {
        let mut ray = line_through(Point3D::new(0.0, 0.0, 1.0), 1.5, rng);
        if rng.uniform() < 0.2 {
            // Flat to the faces that coincide, through a point of one of them.
            let [x, y] = [0, 1].map(|_| rng.range(-0.9, 0.9));
            let target = Point3D::new(x, y, 0.1 * (rng.uniform() * 21.0).floor());
            ray.direction.z = 10f64.powf(rng.range(-7.0, 0.0)) * ray.direction.length();
            ray.origin = target - ray.direction * (rng.range(1.0, 8.0) / ray.direction.length());
        }
        let chords: Vec<f64> =
            parts.iter().map(|[a, b]| chord(&ray, [-1.0, -1.0, *a], [1.0, 1.0, *b])).collect();
        let image = Ray::new(m * ray.origin, m * ray.direction);
        let all = crossings(&body, &image);
        let speed = ray.direction.length();
        let length: f64 = all.chunks(2).map(|pair| (pair[1].distance - pair[0].distance) * speed).sum();
        let slope = ray.direction.to_array().iter().fold(f64::INFINITY, |s: f64, d| s.min(d.abs())) / speed;
        let count = chords.iter().filter(|c| **c > 0.0).count();
        let off = (length - chords.iter().sum::<f64>()).abs() > 1e-12 / slope;
        wrong += usize::from(off || all.len() != 2 * count);
    }
    wrong
}

fn frames() -> Vec<AffineMatrix3D> {
    let turned = translate(0.37, -1.21, 2.3) * rotate(17.0, 33.0, 71.0);
    vec![
        AffineMatrix3D::IDENTITY,
        turned,
        turned * scale(0.7),
        turned * shear(),
        rotate(5.0, 6.0, 7.0) * scale(1e-7),
    ]
}

#[test]
fn faces_in_common_leave_neither_gap_nor_skin() {
    let mut rng = Rng::new(31);
    for (name, make, parts) in cases() {
        for (number, m) in frames().into_iter().enumerate() {
            let plain = make(&mut |a, b| slab(a, b));
            assert_eq!(wrong_lines(&plain, &parts, m, 1500, &mut rng), 0, "{name} in frame {number}");
            // Each piece in a frame of its own: its faces lie where the others' do only to rounding.
            let mut own = Rng::new(32);
            let blurry = make(&mut |a, b| moved(&slab(a, b), blurred(1.0, &mut own)));
            assert_eq!(wrong_lines(&blurry, &parts, m, 1500, &mut rng), 0, "{name}, blurred, frame {number}");
        }
    }
}

/// A composite with its tie rule switched off.
struct Naive(Composite);

impl Naive {
    fn of(operation: Operation, a: Shape, b: Shape) -> Shape {
        let mut composite = Composite::new(operation, a.into(), b.into()).unwrap();
        composite.ties = false;
        share(Self(composite))
    }
}

crate::inner::answers_by_inner!(Naive);

#[test]
fn without_the_tie_rule_there_are_gaps_and_skins() {
    let mut rng = Rng::new(33);
    let (a, b) =
        (moved(&slab(0.0, 0.7), blurred(1.0, &mut rng)), moved(&slab(0.7, 2.0), blurred(1.0, &mut rng)));
    for (operation, parts) in [(Operation::Union, vec![[0.0, 2.0]]), (Operation::Intersect, vec![])] {
        let naive = Naive::of(operation, a.clone(), b.clone());
        let wrong = wrong_lines(&naive, &parts, frames()[1], 1500, &mut rng);
        assert!(wrong > 50, "{operation:?}: {wrong}");
    }
    let naive =
        Naive::of(Operation::Subtract, slab(0.0, 2.0), moved(&slab(0.0, 0.7), blurred(1.0, &mut rng)));
    assert!(wrong_lines(&naive, &[[0.7, 2.0]], frames()[1], 1500, &mut rng) > 50);
}

#[test]
fn walls_thicker_than_rounding_are_kept() {
    // From a few sizes away crossings are good to 1e-14 sizes or so, and a wall of 1e-12 is real.
    let whole = slab(0.0, 1.0);
    for wall in [1e-12, 1e-10, 1e-6] {
        let skin = subtract(&whole, &slab(wall, 2.0));
        let mut rng = Rng::new(34);
        for _ in 0..1000 {
            let x = [0, 1].map(|_| rng.range(-0.4, 0.4));
            let direction = Vector3D::new(rng.range(-0.1, 0.1), rng.range(-0.1, 0.1), 1.0);
            let all = crossings(&skin, &Ray::new(Point3D::new(x[0], x[1], -0.5), direction));
            assert_eq!(all.len(), 2, "{wall}");
            assert!((all[1].distance - all[0].distance - wall).abs() < 1e-15 + 1e-9 * wall, "{wall} {all:?}");
        }
    }
}

#[test]
fn the_steeper_surface_speaks_for_an_event() {
    // A line that is all but flat to the top of one box meets it where the side of the other stands upright.
    let mut rng = Rng::new(36);
    let (low, side) =
        (cuboid([-1.0, -1.0, -1.0], [1.0, 1.0, 0.0]), cuboid([0.0, -1.0, -1.0], [2.0, 1.0, 1.0]));
    for _ in 0..1000 {
        let turned = rotate(rng.range(-180.0, 180.0), rng.range(-90.0, 90.0), 0.0);
        let back = turned.inverse().unwrap();
        let tilt = 1e-6;
        let line =
            Ray::new(Point3D::new(-0.5, rng.range(-0.9, 0.9), 0.5 * tilt), Vector3D::new(1.0, 0.0, -tilt));
        let ray = Ray::new(turned * line.origin, turned * line.direction);
        for (body, part) in [
            (intersect(&moved(&low, turned), &moved(&side, turned)), 2),
            (intersect(&moved(&side, turned), &moved(&low, turned)), 0),
        ] {
            let first = crossings(&body, &ray)[0];
            assert!((first.distance - 0.5).abs() < 4e-15, "{first:?}");
            assert_eq!(first.feature.part / 2 * 2, part, "{first:?}");
            let normal = back * body.surface(&ray, &first).normal.as_vector();
            assert!(normal.x < -0.999, "{normal:?}");
        }
    }
}

#[test]
fn operands_under_uneven_maps_still_touch() {
    let mut rng = Rng::new(38);
    for _ in 0..20 {
        let turn = |rng: &mut Rng| {
            rotate(rng.range(-180.0, 180.0), rng.range(-90.0, 90.0), rng.range(-180.0, 180.0))
        };
        let uneven = turn(&mut rng) * stretch(30.0, 1.0, 1.0 / 30.0) * turn(&mut rng);
        let upper = moved(&moved(&slab(1.0, 2.0), uneven), uneven.inverse().unwrap());
        let whole = union(&slab(0.0, 1.0), &upper);
        assert_eq!(wrong_lines(&whole, &[[0.0, 2.0]], AffineMatrix3D::IDENTITY, 500, &mut rng), 0);
    }
}

#[test]
fn crossings_stay_in_order_where_events_overlap() {
    // Of a line that is all but flat to the top of a box which ends just before that which is taken off ends, too.
    let tilt = 1e-6;
    let (low, side) =
        (cuboid([-1.0, -1.0, -1.0], [-1e-9, 1.0, 0.0]), cuboid([-2.0, -1.0, -1.0], [0.0, 1.0, 1.0]));
    let mut rng = Rng::new(37);
    let mut found = 0;
    for _ in 0..1000 {
        let body = subtract(&moved(&low, blurred(1.0, &mut rng)), &side);
        let from = Point3D::new(-0.5, rng.range(-0.9, 0.9), (0.5 - 10f64.powf(rng.range(-9.0, -7.0))) * tilt);
        let all = crossings(&body, &Ray::new(from, Vector3D::new(1.0, 0.0, -tilt)));
        assert!(all.windows(2).all(|w| w[0].distance <= w[1].distance), "{all:?}");
        found += all.len();
    }
    assert!(found > 100);
}

#[test]
fn balls_that_touch_are_counted_right_on_their_axis() {
    let ball = |r: f64, z: f64| moved(&share(Sphere::new(r).unwrap()), translate(0.0, 0.0, z));
    let length = |body: &Shape, sign: f64| {
        let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0 * sign), Vector3D::Z * sign);
        let all = crossings(body, &ray);
        all.chunks(2).map(|pair| pair[1].distance - pair[0].distance).sum::<f64>()
    };
    for sign in [1.0, -1.0] {
        assert_eq!(length(&union(&ball(1.0, 0.0), &ball(1.0, 2.0)), sign), 4.0);
        assert_eq!(length(&subtract(&ball(1.0, 0.0), &ball(0.5, 0.5)), sign), 1.0);
        assert_eq!(length(&intersect(&ball(1.0, 0.0), &ball(1.0, 2.0)), sign), 0.0);
        let capped = union(&share(Cylinder::new(0.8, 1.0).unwrap()), &slab(1.0, 2.0));
        assert_eq!(length(&capped, sign), 2.0);
    }
}

#[test]
fn the_tie_rule_has_room_to_spare() {
    // The largest distance of coincident faces in units of what the rule admits.
    let mut rng = Rng::new(35);
    let mut worst = 0.0f64;
    let plain: Vec<Shape> = vec![
        share(Sphere::new(0.7).unwrap()),
        cuboid([-0.7, -0.1, 0.3], [0.1, 0.9, 1.1]),
        share(Cylinder::new(0.3, 1.3).unwrap()),
        share(Cone::new(0.7, 0.6).unwrap()),
        share(Parabola::new(0.4, 0.9).unwrap()),
    ];
    for shape in &plain {
        let ball = shape.bounding_sphere(&AffineMatrix3D::IDENTITY);
        for _ in 0..200 {
            let twin = moved(shape, blurred(1.0, &mut rng));
            for _ in 0..100 {
                let mut ray = line_through(ball.centre, ball.radius, &mut rng);
                let back = ray.direction * (10f64.powf(rng.range(0.0, 4.0)) / ray.direction.length());
                ray.origin = ray.origin - back;
                let (a, b) = (crossings(shape, &ray), crossings(&twin, &ray));
                for (x, y) in a.iter().zip(&b).filter(|_| a.len() == b.len()) {
                    let speed = ray.direction.length();
                    let slope = shape.surface(&ray, x).normal.dot(ray.direction).abs() / speed;
                    let across = (x.distance - y.distance).abs() * speed * slope;
                    let reach = ray.origin.max_abs() + x.distance * speed + ball.radius;
                    worst = worst.max(across / (64.0 * f64::EPSILON * reach));
                }
            }
        }
    }
    println!("{worst}");
    assert!(worst > 0.001 && worst < 0.25, "{worst}");
}
