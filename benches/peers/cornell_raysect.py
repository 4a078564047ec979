#!/usr/bin/env python3
"""The Cornell box in Raysect 0.9.1: what the benchmark of this repository compares itself with.

Renders one picture, times it, saves the mean tristimulus values as `xyz_mean` [row, column, channel], and prints one
line of JSON. Equal options give equal values, whatever the number of processes: each group of pixels has a seed of
its own.
"""

import argparse
import hashlib
import json
import random as python_random
import tempfile
import time
from pathlib import Path

import numpy as np
from raysect.core.math import random as raysect_random
from raysect.core.workflow import MulticoreEngine
from raysect.optical import InterpolatedSF, Point3D, World, rotate, translate
from raysect.optical.library import schott
from raysect.optical.material import Lambert, UniformSurfaceEmitter
from raysect.optical.observer import PinholeCamera, RGBPipeline2D
from raysect.primitive import Box, Sphere

SPECTRA = Path(__file__).resolve().parents[2] / "assets" / "spectra"

# Pixels that a process takes at a time.
GROUP = 64

# The source is published without scale; Raysect's demonstration doubles it.
LIGHT_SCALE = 2.0

# Solids float this far above the floor [m], since Raysect has no rule for faces that coincide.
GAP = 1e-6


def spectrum(name):
    """A spectral function from a file of the repository: wavelength [nm], value."""
    table = np.loadtxt(SPECTRA / f"cornell_{name}.csv", delimiter=",", comments="#")
    return InterpolatedSF(table[:, 0].copy(), table[:, 1].copy())


def cornell_box(variant):
    """A room of 2 m, open to the front, with a box and a ball of glass or of the white of its walls."""
    world = World()
    paint = {name: Lambert(spectrum(name)) for name in ("white", "green", "red")}
    walls = [
        ("white", translate(0, 0, 1)),
        ("white", translate(0, -1, 0) * rotate(0, -90, 0)),
        ("white", translate(0, 1, 0) * rotate(0, 90, 0)),
        ("red", translate(1, 0, 0) * rotate(-90, 0, 0)),
        ("green", translate(-1, 0, 0) * rotate(90, 0, 0)),
    ]
    for colour, place in walls:
        Box(Point3D(-1, -1, 0), Point3D(1, 1, 0), world, place, paint[colour])

    lamp = UniformSurfaceEmitter(spectrum("light"), LIGHT_SCALE)
    ceiling = translate(0, 1, 0) * rotate(0, 90, 0)
    Box(Point3D(-0.4, -0.4, -0.01), Point3D(0.4, 0.4, 0.0), world, ceiling, lamp)

    def solid():
        return schott("N-BK7") if variant == "glass" else paint["white"]

    standing = translate(0.4, GAP - 1, 0.4) * rotate(30, 0, 0)
    Box(Point3D(-0.4, 0.0, -0.4), Point3D(0.3, 1.4, 0.3), world, standing, solid())
    Sphere(0.4, world, translate(-0.4, GAP - 0.6, -0.4), solid())
    return world


class RadianceCamera(PinholeCamera):
    """A pinhole camera whose rays all count alike, so that it measures radiance and not radiance × cos θ."""

    def _generate_rays(self, x, y, template, ray_count):
        return [(ray, 1.0) for ray, _ in super()._generate_rays(x, y, template, ray_count)]


class SeededEngine(MulticoreEngine):
    """Raysect's processes, with random numbers that depend on the seed and the group of pixels alone."""

    def __init__(self, processes, seed):
        super().__init__(processes, tasks_per_job=GROUP)
        self.seed = seed

    def _worker(self, render, args, kwargs, job_queue, result_queue):
        for job in iter(job_queue.get, None):
            try:
                digest = hashlib.sha256(repr((self.seed, job[0])).encode()).digest()
                # The lowest bit is set since Raysect takes a seed of 0 for none.
                raysect_random.seed(int.from_bytes(digest[:8], "big") | 1)
                result_queue.put([render(task, *args, **kwargs) for task in job])
            except Exception as error:  # the parent raises it
                result_queue.put(error)
                return


def observe(options):
    """The mean tristimulus values [row, column, channel] and the time that the rendering took [s]."""
    world = cornell_box(options.variant)
    pipeline = RGBPipeline2D(display_progress=False)
    camera = RadianceCamera(
        (options.pixels, options.pixels), fov=45, parent=world, transform=translate(0, 0, -3.3), pipelines=[pipeline]
    )
    camera.quiet = True
    camera.min_wavelength, camera.max_wavelength = 375, 740
    camera.spectral_bins = options.bins
    camera.spectral_rays = 1
    camera.pixel_samples = options.samples
    camera.ray_importance_sampling = True
    camera.ray_important_path_weight = 0.25
    camera.ray_extinction_prob = 0.01
    camera.ray_extinction_min_depth = 3
    camera.ray_max_depth = 500
    camera.render_engine = SeededEngine(options.processes, options.seed)
    # The order of the pixels, and with it the groups, comes from Python's own generator.
    python_random.seed(options.seed)
    world.build_accelerator()

    start = time.perf_counter()
    camera.observe()
    seconds = time.perf_counter() - start
    # Raysect's frames are [column, row].
    return np.array(pipeline.xyz_frame.mean).transpose(1, 0, 2), seconds


def positive(text):
    """A whole number of at least 1."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number} is not 1 or more")
    return number


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--variant", choices=("diffuse", "glass"), default="glass", help="what box and ball are of")
    parser.add_argument("--pixels", type=positive, default=128, help="pixels along each side")
    parser.add_argument("--samples", type=positive, default=16, help="paths a pixel")
    parser.add_argument("--bins", type=positive, default=15, help="spectral bins over 375 … 740 nm")
    parser.add_argument("--processes", type=positive, default=2, help="worker processes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, help="the .npz file to write; a new temporary file by default")
    options = parser.parse_args()

    path = options.output
    if path is None:
        name = f"cornell_{options.variant}_{options.pixels}_{options.samples}_{options.seed}.npz"
        path = Path(tempfile.mkdtemp(prefix="raysect-peer-")) / name

    xyz_mean, seconds = observe(options)
    # Through an open file, so that the name is kept as it was given.
    with open(path, "wb") as file:
        np.savez(file, xyz_mean=xyz_mean)
    paths = options.pixels**2 * options.samples
    answer = {
        "paths_per_s": paths / seconds,
        "wall_seconds": seconds,
        "samples": options.samples,
        "xyz": str(path.resolve()),
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
