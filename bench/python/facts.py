"""What opening, importing, dropping and interrupting cost in the Python package."""
import json
import os
import random
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import ours, sources

MEMMAP = """
import json, resource, sys, time
import numpy, isoatlas
array = numpy.memmap(sys.argv[1], sys.argv[3], "r", shape=tuple(json.loads(sys.argv[2])))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
start = time.perf_counter()
with isoatlas.open(array, memory="1G") as atlas:
    objects = len(atlas.objects)
    triangles = len(atlas.objects[0].surface().triangles)
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(json.dumps({"seconds": time.perf_counter() - start, "before": 1024 * before, "peak": 1024 * peak, "objects": objects,
                  "triangles": triangles}))
"""

LOOPS = """
import json, sys
import numpy, isoatlas
def resident():
    return 1024 * int(next(line for line in open("/proc/self/status") if line.startswith("VmRSS")).split()[1])
def once(array):
    atlas = isoatlas.open(array)
    return len(atlas.objects[0].surface().triangles)
array = isoatlas.phantom("demo", 32)
count = int(sys.argv[1])
for _ in range(count // 10):
    once(array)
early = resident()
for _ in range(count - count // 10):
    once(array)
print(json.dumps({"loops": count, "early": early, "late": resident()}))
"""

IMPORT = """
import json, sys, time
import numpy
start = time.perf_counter()
import isoatlas
imported = time.perf_counter() - start
seconds = []
for _ in range(20):
    start = time.perf_counter()
    isoatlas.open(sys.argv[1])
    seconds.append(time.perf_counter() - start)
print(json.dumps({"import": imported, "open": seconds}))
"""

# Says when it is in the loop, and when the interrupt came; the clock is that of all processes.
INTERRUPTED = """
import sys, time
import numpy, isoatlas
array = numpy.random.default_rng(1).random((int(sys.argv[2]),) * 3, dtype=numpy.float32)
atlas, path = isoatlas.open(array), sys.argv[3]
while True:
    try:
        print("in", flush=True)
        while True:
            exec(sys.argv[1])
    except KeyboardInterrupt:
        print(time.monotonic(), flush=True)
"""

INTERRUPTED_CALLS = {
    "a loop of short calls": ("atlas.surface(0.5)", 32),
    "a loop of opening and listing objects": ("isoatlas.open(array).objects", 24),
    "trees": ("isoatlas.open(array).tree", 150),
    "objects": ("isoatlas.open(array).objects", 150),
    "persistence of dimension 1": ("isoatlas.open(array).persistence(1)", 150),
    "surfaces": ("atlas.surface(0.5)", 150),
    "label volumes": ("atlas.labels(0.5)", 150),
    "building a store": ("isoatlas.build(array, path, restart=True)", 150),
}


def environment(arguments):
    return dict(os.environ, PYTHONPATH=str(Path(arguments.program).parent.parent / "python"))


def in_python(arguments, script, *words):
    done = subprocess.run([sys.executable, "-B", "-c", script, *map(str, words)], capture_output=True, text=True, env=environment(arguments))
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def interrupts(arguments, code, size, count, chance):
    """Seconds from SIGINT to KeyboardInterrupt, `count` times, each at a random moment of the second after the call began."""
    store = Path(arguments.cache) / "interrupted.atlas"
    child = subprocess.Popen([sys.executable, "-B", "-c", INTERRUPTED, code, str(size), str(store)], stdout=subprocess.PIPE, text=True,
                             env=environment(arguments))
    seconds = []
    for _ in range(count):
        if child.stdout.readline() != "in\n":
            sys.exit(f"{code}: it did not begin")
        time.sleep(chance.uniform(0.05, 1))
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        seconds.append(float(child.stdout.readline()) - sent)
    child.kill()
    child.wait()
    store.unlink(missing_ok=True)
    return seconds


def facts(arguments):
    program, cache = arguments.program, Path(arguments.cache)
    made = ours(program, arguments.memmap, *sources(arguments))
    raw, shape = cache / f"{arguments.memmap}.raw", made["size"][::-1]
    memmap = in_python(arguments, MEMMAP, raw, shape, made["type"])
    store = cache / "python.atlas"
    in_python(arguments, "import json, sys, isoatlas\nprint(json.dumps(isoatlas.build(isoatlas.phantom('demo', 64), sys.argv[1]) and 1))", store)
    start = in_python(arguments, IMPORT, store)
    store.unlink()
    loops = in_python(arguments, LOOPS, arguments.loops)
    rows = [{"what": f"{arguments.memmap}, a memmap with memory=\"1G\": objects and a surface", "measured":
             f"peak {memmap['peak'] / 2**20:.0f} MiB, {memmap['seconds']:.1f} s", "goal": "1.1 GB"},
            {"what": "opening a store", "measured": f"{1e3 * statistics.median(start['open']):.2f} ms", "goal": "10 ms"},
            {"what": "import isoatlas, beyond numpy", "measured": f"{1e3 * start['import']:.0f} ms", "goal": "100 ms"},
            {"what": f"{loops['loops']:,} times: open an array, objects, a surface, drop all", "measured":
             f"{(loops['late'] - loops['early']) / 2**20:+.1f} MiB after the first tenth", "goal": "no growth"}]
    chance = random.Random(1)
    for what, (code, size) in INTERRUPTED_CALLS.items():
        seconds = sorted(interrupts(arguments, code, size, arguments.interrupts, chance))
        rows.append({"what": f"Ctrl-C in {what}, {size}^3 of noise, {len(seconds)} times", "measured":
                     f"median {1e3 * statistics.median(seconds):.0f} ms, longest {1e3 * seconds[-1]:.0f} ms", "goal": "100 ms"})
    return rows
