"""A simulation of burning heptane: the regions that matter, ranked by contrast and size, and when they merge."""
import math
import sys

import isoatlas

atlas = isoatlas.open(sys.argv[1])
kept = [one for one in atlas.find_objects(keep=4) if not one.background][:5]
for one in kept:
    merges = "never" if math.isinf(one.merges) else f"at {one.merges:g}"
    print(f"object {one.number}: best at {one.best_tau:g}, {one.voxels:,} voxels, {one.tunnels} tunnels, merges {merges}")
spectrum = atlas.spectrum(samples=0)
print(f"at most {max(spectrum.objects)} objects at one isovalue, {max(spectrum.tunnels)} tunnels")
meshes = [one.surface() for one in kept]
opacities = [0.3 if one.number == kept[0].number else 1.0 for one in kept]
picture = isoatlas.render(meshes, colours=[one.colour for one in kept], opacities=opacities, names=[f"object {one.number}" for one in kept],
                          legend=True, size=480)
isoatlas.save_image(sys.argv[2], picture)
