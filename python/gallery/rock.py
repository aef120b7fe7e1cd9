"""Porous rock (micro-CT): how much of the pore space hangs together, and the throats that hold it together."""
import sys

import isoatlas

atlas = isoatlas.open(sys.argv[1])  # segmented: 1 is pore, 0 is grain
level = 0.5
pores = atlas.objects_at(level)
total = sum(pore["voxels"] for pore in pores)
largest = pores[0]
print(f"porosity {total / atlas.volume.size:.3f}; {len(pores)} pores, the largest has {largest['voxels'] / total:.1%} of the space")
print(f"{largest['tunnels']} independent loops in it: {largest['tunnels'] / total * 1e6:.0f} in a million voxels of pore space")
through = [axis for axis, low, high, size in zip("xyz", *largest["box"], atlas.shape[::-1]) if high - low + 1 == size]
print(f"it reaches from end to end along {', '.join(through) or 'no axis'}")
closed = [pore["id"] for pore in pores[1:]]
meshes = [atlas.surface(level, objects=[largest["id"]]), atlas.surface(level, objects=closed)]
picture = isoatlas.render(meshes, opacities=[0.35, 1.0], names=["connected", "closed"], legend=True, size=480)
isoatlas.save_image(sys.argv[2], picture)
