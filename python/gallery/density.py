"""A density map of electron microscopy: which contour level is stable, and how the topology changes around it."""
import sys

import numpy as np

import isoatlas

atlas = isoatlas.open(sys.argv[1])
first = atlas.objects[0]
for one in first.isovalues[:4]:
    b0, b1, b2 = atlas.betti(one.tau)
    print(f"{one.tau:.3f} ({one.reason}): {b0} parts, {b1} tunnels, {b2} cavities")
pairs = atlas.persistence(dimension=1)
lengths = np.sort(pairs[:, 0] - pairs[:, 1])[::-1]
print(f"{len(pairs)} tunnels at all levels; the five that last longest: {', '.join(f'{length:.2f}' for length in lengths[:5])}")
picture = isoatlas.render(atlas.surface(first.best_tau), size=480, caption=[f"level {first.best_tau:.3f}"])
isoatlas.save_image(sys.argv[2], picture)
