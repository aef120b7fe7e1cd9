"""Nuclei in a stack of a confocal microscope: each at its own threshold, as one for all cannot."""
import sys

import numpy as np

import isoatlas

atlas = isoatlas.open(sys.argv[1])
nuclei = [one for one in atlas.find_objects(top=0) if not one.background and 50 <= one.voxels <= 4000]
labels = atlas.labels(objects=nuclei)
sizes = np.bincount(labels.ravel())[1:]
levels = [one.best_tau for one in nuclei]
print(f"{len(nuclei)} nuclei of {np.median(sizes[sizes > 0]):.0f} voxels (median), at thresholds from {min(levels):g} to {max(levels):g}")
for level in np.quantile(levels, (0, 0.5, 1)):
    print(f"one threshold for all, {level:g}: {sum(one['voxels'] >= 50 for one in atlas.objects_at(float(level)))}")
atlas.save_labels("nuclei.seg.nrrd", objects=nuclei)
picture = isoatlas.render([one.surface() for one in nuclei], colours=[one.colour for one in nuclei], size=480)
isoatlas.save_image(sys.argv[2], picture)
