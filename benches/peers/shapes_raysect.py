"""Raysect 0.9.1: World.hit per second, for a world of the benchmark `shapes` and four files of rays, and how many hit."""
import sys
import time
from collections import deque

import numpy as np
from raysect.core import Point3D, Ray, Vector3D, World, rotate, translate
from raysect.primitive import Box, Cone, Cylinder, Intersect, Parabola, Sphere, Subtract, Torus, Union

name, *files = sys.argv[1:]
world = World()
shape = None
if name == "sphere":
    shape = Sphere(1.0, world)
elif name == "cuboid":
    shape = Box(Point3D(-0.5, -0.6, -0.4), Point3D(0.5, 0.6, 0.4), world)
elif name == "cylinder":
    shape = Cylinder(0.7, 1.2, world)
elif name == "cone":
    shape = Cone(0.7, 1.2, world)
elif name == "parabola":
    shape = Parabola(0.7, 1.2, world)
elif name == "torus":
    shape = Torus(0.7, 0.3, world)
else:
    x, y, z = (Cylinder(1, 4.2, transform=rotate(a, b, 0) * translate(0, 0, -2.1)) for a, b in ((90, 0), (0, 90), (0, 0)))
    cube = Box(Point3D(-1.5, -1.5, -1.5), Point3D(1.5, 1.5, 1.5))
    ball = Sphere(2.0)
    for u, v, a, b in ((-2.1, 2.1, 30, -20), (2.1, 2.1, -30, -20), (2.1, -2.1, -30, 20), (-2.1, -2.1, 30, 20)):
        Intersect(ball, Subtract(cube, Union(Union(x, y), z)), world, translate(u, v, 2.5) * rotate(a, b, 0))
    large, small = Sphere(1.0, transform=translate(0, 0, 0.99)), Sphere(0.5, transform=translate(0, 0, -0.49))
    Intersect(large, small, world, translate(0, 0, -3.6) * rotate(50, 50, 0))
    Box(Point3D(-50, -50, 50), Point3D(50, 50, 50.1), world)
    Box(Point3D(-100, -100, -100), Point3D(100, 100, 100), world)
world.build_accelerator()

sets = []
for file in files:
    numbers = np.fromfile(file, np.float64).reshape(-1, 6).tolist()
    sets.append([Ray(Point3D(*n[:3]), Vector3D(*n[3:])) for n in numbers])
asked = [(world.hit, rays) for rays in sets] + [(shape.hit if shape else None, rays) for rays in sets[:2]]
for hit, rays in asked:
    if hit is None:
        print("nan")
        continue
    best = 0
    for _ in range(5):
        start = time.perf_counter()
        deque(map(hit, rays), maxlen=0)
        best = max(best, len(rays) / (time.perf_counter() - start))
    print(best)
for rays in sets[:2]:
    print(sum(world.hit(ray) is not None for ray in rays))
