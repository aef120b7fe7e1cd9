"""A store is built from an array that is read in slabs, within a memory budget; surfaces read only the bricks that they need."""
import numpy as np

import isoatlas

samples = np.memmap("samples.raw", dtype=np.float32, mode="w+", shape=(64, 64, 64))
samples[...] = isoatlas.phantom("demo", 64)
report = isoatlas.build(samples, "demo.atlas", spacing=0.5, unit="mm", memory="200M")
print(f"{report['bytes']:,} bytes")
with isoatlas.open("demo.atlas") as atlas:
    for one in atlas.objects:
        print(one, one.surface())
