"""What a store answers, as far as no later version may change it: numbers and names that today's documents have, checksums of the rest."""
import hashlib
import json
import math
import os
import pathlib
import subprocess
import tempfile

CLI = os.environ.get("ISOATLAS_CLI", "isoatlas")
STL_HEADER = 80   # names the version
MEMBERS = {
    "events": ["id", "value", "position", "kind", "parent", "children", "objects_in", "lows_out", "delta_chi", "zone", "object"],
    "levels": ["value", "event", "in", "out"],
    "elements": ["value", "position", "h0", "l0"],
    "contours": ["id", "upper", "lower", "tau_high", "tau_low", "genus"],
}
OF_OBJECTS = ["id", "event", "appears", "merges", "best_tau", "chi", "b1", "b2", "tunnels", "cavities", "voxels", "measure", "hypervolume",
              "position", "position_physical"]
OF_OBJECTS_AT = ["id", "chi", "b1", "b2", "voxels", "measure", "box", "contours"]
OF_VOLUME = ["type", "rank", "dims", "spacing", "origin", "direction", "space", "unit", "value_unit", "calibration", "gaussian"]
OF_PREVIEW = ["objects", "contours", "tunnels"]
OF_SURFACE = ["points", "triangles", "segments", "objects", "contours", "closed"]


SIDE = []   # options of the polarity that is asked about


def run(*words):
    side = [] if words[0] in ("info", "convert") else SIDE
    done = subprocess.run([CLI, *map(str, words), *side, "--quiet", "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"isoatlas {' '.join(map(str, words))}: {done.stderr}")
    return json.loads(done.stdout)


def sum_of(thing):
    data = thing if isinstance(thing, bytes) else json.dumps(thing, sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()


def chosen(members, document):
    return {name: document[name] for name in members}


def skew_of(volume):
    """Area or volume that the unit vectors of the axes span."""
    (a, b, c), (d, e, f), (g, h, i) = volume["direction"]
    if volume["rank"] == 2:
        return math.hypot(a * e - b * d, d * h - e * g, g * b - h * a)
    return abs(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))


def sized(members, entry, volume):
    """An object with its size as it was until 0.2, when axes were taken as perpendicular."""
    box = math.prod(volume["spacing"][:volume["rank"]])
    if not math.isclose(entry["measure"], entry["voxels"] * box * skew_of(volume), rel_tol=1e-9):
        raise RuntimeError(f"{entry['voxels']} voxels have the size {entry['measure']}")
    return {**chosen(members, entry), "measure": entry["voxels"] * box}


def event(columns, row):
    """A row of the tree as the object that it was until 0.2."""
    e = dict(zip(columns, row))
    genera = [genus for genus, count in e["genera"] for _ in range(count)]
    return {"id": e["id"], "value": e["value"], "position": [e["x"], e["y"], e["z"]], "kind": e["kind"], "parent": e["parent"],
            "children": e["children"], "objects_in": len(e["children"]), "lows_out": e["lows_out"], "delta_chi": e["delta_chi"],
            "zone": {"tau_low": e["tau_low"], "tau_high": e["value"], "voxels": e["zone_voxels"]},
            "object": {"chi": e["chi"], "b1": e["b1"], "b2": e["b2"], "voxels": e["object_voxels"], "contours": genera}}


def tree(store, detail):
    document = run("tree", store, "--detail", detail, "--all")
    if detail == "events":
        return [event(document["columns"], row) for row in document["events"]]
    return document[detail]


def surface(folder, store, *options):
    file = folder / "surface.stl"
    told = run("extract", store, "-o", file, "--space", "file", *options)
    return {**chosen(OF_SURFACE, told), "stl": sum_of(file.read_bytes()[STL_HEADER:])}


def at_isovalue(folder, store, tau):
    found = run("objects", store, "--tau", tau)
    objects = [sized(OF_OBJECTS_AT, entry, found["volume"]) for entry in found["objects"]]
    answer = {"tau": tau, "objects": objects[:3], "of_all_objects": sum_of(objects), "active_cells": found["active_cells"],
              "preview": chosen(OF_PREVIEW, run("info", store, "--tau", tau)["preview"])}
    if found["volume"]["rank"] == 3:
        answer["surface"] = surface(folder, store, "--tau", tau)
        answer["of_one_object"] = surface(folder, store, "--tau", tau, "--object", f"v{objects[-1]['id']}")
    return answer


def answers(store):
    """Of a store; of one of both polarities also of that of low values, and of both in one list."""
    answer = answers_of_side(store)
    try:
        listed = run("objects", store, "--polarity", "both")["objects"]
    except RuntimeError:   # of one polarity
        return answer
    SIDE[:] = ["--polarity", "low"]
    try:
        answer["low"] = answers_of_side(store)
    finally:
        SIDE.clear()
    answer["both"] = [[entry["reference"], entry["id"], entry["best_tau"], entry["inside"], entry["cavity_of"]] for entry in listed]
    return answer


def answers_of_side(store):
    """Volume, samples, parameters, trees, objects, and surfaces at three isovalues."""
    with tempfile.TemporaryDirectory(prefix="isoatlas-golden-") as name:
        folder = pathlib.Path(name)
        info = run("info", store)
        low, high = info["values"]["low"], info["values"]["high"]
        told = run("convert", store, "-o", folder / "samples.npy")
        found = run("objects", store)
        answer = {"volume": chosen(OF_VOLUME, info["volume"]), "values": [low, high], "interpolant": found["interpolant"],
                  "tunnel_height": found.get("tunnel_height"), "samples": sum_of((folder / "samples.npy").read_bytes()[-told["sample_bytes"]:]),
                  "trees": {},
                  "objects": [sized(OF_OBJECTS, entry, info["volume"]) for entry in found["objects"]], "branches": found["branches"],
                  "noise": found["noise"]}
        for detail, members in MEMBERS.items():
            lines = [chosen(members, line) for line in tree(store, detail)]
            answer["trees"][detail] = {"count": len(lines), "first": lines[:2], "of_all": sum_of(lines)}
        answer["isovalues"] = [at_isovalue(folder, store, low + part * (high - low)) for part in (0.25, 0.5, 0.8125)]
        return answer
