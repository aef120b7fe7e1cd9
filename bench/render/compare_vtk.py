#!/usr/bin/env python3
"""Volume rendering beside VTK's ray caster (vtkFixedPointVolumeRayCastMapper): the same samples, transfer function, camera, pixels and threads,
at equal error. Pictures first, then medians of runs in turns.

    compare_vtk.py BENCH_RENDER [--volumes bonsai ...] [--size 512] [--threads 2] [--pairs 3] [--cache FOLDER] [--data FOLDER]
                   [--json FILE]

Both are compared with the integral of emission and absorption, summed by numpy eight steps to a voxel along every eighth ray both ways: the
mean over those pixels and their colours of the difference, in linear light; 1 is white. With a light ("shaded") the two differ in what they
call a light, so those pictures are not compared. Both take one ray a pixel. VTK takes a step of a voxel; ours is the longest of STEPS whose
picture is at least as close to the integral as VTK's. VTK's first picture, in which it prepares its tables and gradients, is left out, ours has
everything but reading and analysing the volume.

VTK shows its picture in a window: without a display the script starts itself under xvfb-run. Needs python3-vtk9, numpy, xvfb and xauth (Debian
packages; the system's python3).
"""
import argparse
import json
import os
import shutil
import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import FIELDS, REAL, add_options, chosen, ours, sources, times_faster

VOLUMES = [*FIELDS, *REAL, "heptane"]
MOST_DIFFERENCE = 0.01  # of our finest picture: a few steps of an 8-bit channel, or a tenth of the light
EVERY = 8               # pixels between two rays of the integral
FINE = 8                # steps of the integral to a voxel
STEPS = (0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 2.25, 2.5, 2.75, 3)  # ours, in voxels; the first for noise
FINER = 0.05            # between two of them


def under_a_display():
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("xvfb-run") is None:
        sys.exit("compare_vtk: VTK needs a display to show its picture: install xvfb and xauth")
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


def linear(colour):
    colour = np.asarray(colour, float)
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


def light_of(path, size):
    """What reaches the eye from our picture, rows from the top."""
    pixels = np.fromfile(path, dtype=np.uint8).reshape(size, size, 4) / 255
    return linear(pixels[..., :3]) * pixels[..., 3:]


def extinction(bump, values):
    ramp = max(bump["ramp"] * (bump["high"] - bump["low"]), 1e-9)
    return bump["density"] * np.clip(np.minimum(values - bump["low"], bump["high"] - values) / ramp, 0, 1)


def matter(bumps, values):
    """Extinction, and light sent out, at some values."""
    parts = np.array([extinction(bump, values) for bump in bumps])
    return parts.sum(axis=0), parts.T @ np.array([linear(bump["colour"]) for bump in bumps])


def between(samples, places):
    """Trilinear; places are in samples, x first, and inside."""
    size = np.array(samples.shape[::-1])
    cell = np.minimum(places.astype(int), size - 2)
    part, value = places - cell, 0
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, part, 1 - part), axis=1)
        x, y, z = (cell + corner).T
        value = value + weight * samples[z, y, x]
    return value


def integral(drawn, samples, size):
    """What reaches the eye, by adding up small steps."""
    camera, spacing = drawn["camera"], np.array(drawn["spacing"])
    toward, up = np.array(camera["toward"]), np.array(camera["up"])
    right, pixel = np.cross(up, toward), camera["height"] / size
    rows, columns = (grid.ravel() + 0.5 - size / 2 for grid in np.mgrid[0:size:EVERY, 0:size:EVERY])
    starts = np.array(camera["target"]) + pixel * (np.outer(columns, right) - np.outer(rows, up))
    step = min(spacing) / FINE
    reach = int(np.linalg.norm(spacing * drawn["size"]) / step)
    light, through = np.zeros((len(starts), 3)), np.ones(len(starts))
    for i in range(-reach, reach):
        places = (starts - (i + 0.5) * step * toward - drawn["origin"]) @ np.array(drawn["direction"]) / spacing
        inside = np.all((places >= 0) & (places <= np.array(drawn["size"]) - 1), axis=1) & (through > 1e-4)
        if not inside.any():
            continue
        swallowed, glow = matter(drawn["bumps"], between(samples, places[inside]))
        passed = np.exp(-swallowed * step)
        part = np.divide(through[inside] * (1 - passed), swallowed, out=np.zeros_like(swallowed), where=swallowed > 0)
        light[inside] += part[:, None] * glow
        through[inside] *= passed
    return light.reshape(-1, len(range(0, size, EVERY)), 3)


class Vtk:
    """The same scene in VTK."""

    def __init__(self, drawn, raw, size, threads):
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk
        self.vtk, self.size, self.samples = vtk, size, np.fromfile(raw, dtype=drawn["type"])
        image = vtk.vtkImageData()
        image.SetDimensions(*drawn["size"])
        image.SetSpacing(*drawn["spacing"])
        image.SetOrigin(*drawn["origin"])
        image.SetDirectionMatrix(*np.ravel(drawn["direction"]))
        image.GetPointData().SetScalars(numpy_to_vtk(self.samples))
        self.step = float(min(drawn["spacing"]))
        self.mapper = vtk.vtkFixedPointVolumeRayCastMapper()
        self.mapper.SetInputData(image)
        self.mapper.SetAutoAdjustSampleDistances(0)
        self.mapper.SetLockSampleDistanceToInputSpacing(0)
        self.mapper.SetImageSampleDistance(1)
        self.mapper.SetSampleDistance(self.step)
        self.mapper.SetNumberOfThreads(threads)
        self.volume = vtk.vtkVolume()
        self.volume.SetMapper(self.mapper)
        self.volume.SetProperty(self.property(drawn["bumps"]))
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(0, 0, 0)
        renderer.AddVolume(self.volume)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(renderer)
        self.aim(renderer, drawn["camera"])

    def property(self, bumps):
        values = np.linspace(float(self.samples.min()), float(self.samples.max()), 2041)
        total, glow = matter(bumps, values)
        colours = np.divide(glow, total[:, None], out=np.zeros_like(glow), where=total[:, None] > 0)
        opacity, colour = self.vtk.vtkPiecewiseFunction(), self.vtk.vtkColorTransferFunction()
        for value, swallowed, rgb in zip(values, total, colours):
            opacity.AddPoint(value, 1 - np.exp(-swallowed * self.step))
            colour.AddRGBPoint(value, *rgb)
        properties = self.vtk.vtkVolumeProperty()
        properties.SetInterpolationTypeToLinear()
        properties.SetScalarOpacity(opacity)
        properties.SetScalarOpacityUnitDistance(self.step)
        properties.SetColor(colour)
        return properties

    @staticmethod
    def aim(renderer, camera):
        eye = renderer.GetActiveCamera()
        eye.ParallelProjectionOn()
        eye.SetParallelScale(camera["height"] / 2)
        eye.SetFocalPoint(*camera["target"])
        eye.SetPosition(*(np.array(camera["target"]) + 4 * camera["height"] * np.array(camera["toward"])))
        eye.SetViewUp(*camera["up"])
        renderer.ResetCameraClippingRange()

    def draw(self, shaded):
        """Seconds."""
        self.volume.GetProperty().SetShade(int(shaded))
        start = time.perf_counter()
        self.window.Render()
        return time.perf_counter() - start

    def light(self):
        from vtk.util.numpy_support import vtk_to_numpy
        picture = self.vtk.vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        picture.Update()
        pixels = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(self.size, self.size, 3)
        return pixels[::-1] / 255


def difference(a, b):
    return float(np.abs(a - b).mean())


def longest_step(draw, most):
    """The longest step at which draw(step), the error, is at most `most` there and at all shorter ones from a voxel on, and the error; the
    longest one below where that is too long; the first if none is. To FINER."""
    best, i = None, STEPS.index(1)
    while i < len(STEPS) and (error := draw(STEPS[i])) <= most:
        best, i = (STEPS[i], error), i + 1
    while best is None:
        i -= 1
        error = draw(STEPS[i])
        best = (STEPS[i], error) if error <= most or i == 0 else None
    while best[1] <= most and (step := round(best[0] + FINER, 2)) < STEPS[-1] and step not in STEPS and (error := draw(step)) <= most:
        best = (step, error)
    return best


def compare(volume, arguments):
    size, threads, cache = arguments.size, arguments.threads, Path(arguments.cache)
    raw, picture, first = cache / "render.raw", cache / "render.rgba", cache / "render.json"

    def draw(*options):
        return ours(arguments.program, volume, *sources(arguments), "--size", size, "--samples", 1, *options)

    drawn = draw("--flat", "--raw", raw, "--repeats", 1)
    first.write_text(json.dumps(drawn))
    scene = Vtk(drawn, raw, size, threads)
    scene.draw(shaded=False)
    exact = integral(drawn, scene.samples.reshape(drawn["size"][::-1]), size)
    vtk_error = difference(scene.light()[::EVERY, ::EVERY], exact)

    def error(step):
        draw("--flat", "--picture", picture, "--repeats", 1, "--step", step, "--like", first)
        return difference(light_of(picture, size)[::EVERY, ::EVERY], exact)

    step, own_error = longest_step(error, vtk_error)
    record = {"volume": volume, "size": "x".join(map(str, drawn["size"])), "type": drawn["type"], "mean light": float(exact.mean()),
              "our step, voxels": step, "ours - integral": own_error, "VTK - integral": vtk_error}
    light = record["mean light"]
    if error(STEPS[0]) > min(MOST_DIFFERENCE, 0.1 * light) or max(own_error, vtk_error) > 0.25 * light:
        sys.exit(f"{volume}: the pictures differ: {record}")
    for name, options in (("flat", ["--flat"]), ("shaded", [])):
        own, theirs = [], []
        scene.draw(shaded=not options)
        for _ in range(arguments.pairs):
            seconds = draw(*options, "--step", step, "--threads", threads, "--repeats", 3, "--like", first)["seconds"]
            own.append(min(a + b for a, b in zip(seconds["prepare"], seconds["draw"])))
            theirs.append(min(scene.draw(shaded=not options) for _ in range(3)))
        record |= {f"{name}, s": statistics.median(own), f"VTK {name}, s": statistics.median(theirs),
                   f"{name}, times faster": times_faster(own, theirs)}
    for file in (raw, picture, first):
        file.unlink()
    return record


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, VOLUMES, pairs=3)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    under_a_display()
    records = []
    for volume in chosen(arguments, VOLUMES):
        records.append(compare(volume, arguments))
        print(records[-1], flush=True)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps({"threads": arguments.threads, "pictures": records}, indent=1))


if __name__ == "__main__":
    main()
