"""Porous rock: the largest pores, their sizes, and a picture of them."""
import numpy as np

import isoatlas

noise = isoatlas.phantom("noise", 48).astype(np.float32)
for axis in (0, 1, 2) * 3:
    noise = (np.roll(noise, 1, axis) + 2 * noise + np.roll(noise, -1, axis)) / 4
atlas = isoatlas.open(noise, spacing=2.0, unit="um", polarity="low")
level = float(np.quantile(noise, 0.25))
pores = atlas.objects_at(level)
print(f"{len(pores)} pores at {level:.3g}; porosity {np.mean(noise <= level):.2f}")
for pore in pores[:5]:
    print(f"{pore['measure']:8.0f} um3, {pore['tunnels']} tunnels, {pore['cavities']} grains inside")
mesh = atlas.surface(level, objects=[pore["id"] for pore in pores[:5]])
isoatlas.render(mesh, size=256, samples=1)
mesh.save("pores.ply")
