"""A volume as VTK and numpy see it, and how many of its cells are active at an isovalue.

    field.py FILE.raw NX NY NZ TYPE FRACTION   prints the isovalue above the median at which this fraction of the cells is active
"""
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


class Field:
    def __init__(self, path, size, type_name):
        """path: raw samples, x fastest."""
        self.path, self.size, self.type = path, size, np.dtype(type_name)
        self.samples = np.fromfile(path, dtype=self.type).reshape(size[::-1])
        self.low = self.high = self.samples
        for axis in range(3):
            first, second = [slice(None)] * 3, [slice(None)] * 3
            first[axis], second[axis] = slice(None, -1), slice(1, None)
            self.low = np.minimum(self.low[tuple(first)], self.low[tuple(second)])
            self.high = np.maximum(self.high[tuple(first)], self.high[tuple(second)])

    def image(self):
        return self.image_of(self.samples)

    def image_of(self, samples):
        image = vtk.vtkImageData()
        image.SetDimensions(*self.size)
        image.GetPointData().SetScalars(numpy_to_vtk(samples.reshape(-1)))
        return image

    def read(self):
        return self.image_of(np.fromfile(self.path, dtype=self.type))

    def active_cells(self, tau):
        return int(np.count_nonzero((self.low < tau) & (self.high >= tau)))

    def percent(self, active):
        return 100 * active / self.low.size

    def isovalue_of(self, fraction):
        """The isovalue above the median at which this fraction of the cells is active; where it is never that many, the median."""
        middle, top = float(np.median(self.samples[::4, ::4, ::4])), float(self.samples.max())
        step = (lambda tau: np.floor(tau) + 0.5) if np.issubdtype(self.type, np.integer) else (lambda tau: float(np.float32(tau)))
        if self.active_cells(step(middle)) < fraction * self.low.size:
            return step(middle)
        for _ in range(24):
            tau = step((middle + top) / 2)
            middle, top = (tau, top) if self.active_cells(tau) >= fraction * self.low.size else (middle, tau)
        return step(middle)

    def isovalues_of(self, fractions):
        return sorted({self.isovalue_of(fraction) for fraction in fractions}, reverse=True)


if __name__ == "__main__":
    print(repr(float(Field(sys.argv[1], list(map(int, sys.argv[2:5])), sys.argv[5]).isovalue_of(float(sys.argv[6])))))
