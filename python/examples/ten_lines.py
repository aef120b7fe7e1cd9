"""The objects of a volume, a closed surface of one, and labels of all."""
import numpy as np

import isoatlas

volume = isoatlas.phantom("demo", 64)
atlas = isoatlas.open(volume, spacing=(0.5, 0.5, 0.5), unit="mm")
print(atlas.objects)
ring = next(one for one in atlas.objects if one.tunnels and not one.main_branch)
mesh = ring.surface()
mesh.verify()
mesh.save("ring.stl")
print(mesh, f"{ring.measure:.0f} mm3")
labels = atlas.labels(keep=24)
print(dict(zip(*np.unique(labels, return_counts=True))))
