"""Betti numbers of a segmentation against those of the truth, as a loss of topology is measured."""
import numpy as np

import isoatlas

truth = isoatlas.phantom("torus-chain", 48)
level = float(truth.min() + truth.max()) / 2
guess = truth + np.random.default_rng(1).normal(0, 0.2 * np.ptp(truth), truth.shape)
for name, volume in ("truth", truth), ("guess", guess):
    b0, b1, b2 = isoatlas.betti(volume, level)
    print(f"{name}: {b0} objects, {b1} tunnels, {b2} cavities; Euler number {isoatlas.euler_number(volume, level)}")
atlas = isoatlas.open(guess)
kept = atlas.find_objects(min_persistence=0.5 * float(np.ptp(truth)))
print(f"{len(atlas.persistence())} objects at all isovalues, {len(kept)} lines that last")
