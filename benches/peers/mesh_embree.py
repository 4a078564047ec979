"""Embree 4 (embreex): seconds to build a tree, and for two sets of rays, from the files in a folder."""
import sys
import time
from pathlib import Path

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh

folder = Path(sys.argv[1])
vertices = np.fromfile(folder / "vertices", np.float32).reshape(-1, 3)
triangles = np.fromfile(folder / "triangles", np.int32).reshape(-1, 3)


def seconds(run):
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def rays(name):
    origins, directions = np.fromfile(folder / name, np.float32).reshape(2, -1, 3)
    return np.ascontiguousarray(origins), np.ascontiguousarray(directions)


# The first tree also pays for the start of the library.
for scene in (rtcore_scene.EmbreeScene(), rtcore_scene.EmbreeScene()):
    def build(scene=scene):
        TriangleMesh(scene, vertices, triangles)
        scene.run(np.zeros((1, 3), np.float32), np.array([[0, 0, 1]], np.float32))
    build_seconds = seconds(build)
sets = [rays("coherent"), rays("incoherent")]
scene.run(*(x[:1000] for x in sets[0]))
print(build_seconds, *(seconds(lambda: scene.run(*s)) for s in sets))
