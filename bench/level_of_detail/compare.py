#!/usr/bin/env python3
"""Simplified surfaces of isoatlas, meshoptimizer, VTK and CGAL, of the same exact ones, each judged by `isoatlas verify --against`.

    compare.py PROGRAMS [--surfaces fuel@50 ...] [--voxels 0.5] [--data FOLDER] [--cache FOLDER] [--seconds 150] [--json FILE]

PROGRAMS: the folder with isoatlas and bench_simplifiers. isoatlas, meshoptimizer and CGAL's envelope are told the greatest distance, VTK and
CGAL's Lindstrom-Turk the number of triangles that isoatlas needs for it. What takes longer than --seconds is stopped, and its row says so.
Distances are the greatest in both directions, of all points and not only of corners. Needs python3-vtk9 (run with the system's python3).
"""
import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from runs import file_of

SURFACES = ["fuel@50", "neghip@60", "neghip@120", "headsq@500", "headsq@1200", "tooth@500", "tooth@1000", "engine@80", "engine@150", "bonsai@40",
            "bonsai@120"]
FIELDS = ["smooth-64@0", "white-16@0.5"]  # without data
FALLBACK = 0.02  # of the triangles, where isoatlas does not simplify
COLUMNS = [("surface", "<12"), ("method", "<34"), ("triangles", ">10"), ("distance, voxels", ">17"), ("contours", ">9"), ("genus", ">6"),
           ("self-crossings", ">15"), ("what else is wrong", "<40"), ("seconds", ">9")]


class TooLong(Exception):
    pass


def run(command, seconds):
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired as stopped:
        raise TooLong from stopped
    return done


def checked(command, seconds=None):
    done = run(command, seconds)
    if done.returncode != 0:
        sys.exit(f"{command}: {done.stderr}")
    return json.loads(done.stdout)


def vtk_main(method, source, target, triangles):
    """In a process of its own: it may take long, and then is stopped."""
    import vtk
    reader = vtk.vtkPLYReader()
    reader.SetFileName(source)
    reader.Update()
    mesh = reader.GetOutput()
    decimate = vtk.vtkQuadricDecimation() if method == "quadric" else vtk.vtkDecimatePro()
    decimate.SetInputData(mesh)
    decimate.SetTargetReduction(max(0.0, 1 - int(triangles) / mesh.GetNumberOfPolys()))
    if method == "pro":
        decimate.PreserveTopologyOn()
    start = time.perf_counter()
    decimate.Update()
    seconds = time.perf_counter() - start
    writer = vtk.vtkPLYWriter()
    writer.SetFileName(target)
    writer.SetInputData(decimate.GetOutput())
    writer.Write()
    print(json.dumps({"triangles": decimate.GetOutput().GetNumberOfPolys(), "seconds": seconds}))


class Comparison:
    def __init__(self, arguments):
        self.arguments = arguments
        self.isoatlas = Path(arguments.programs).resolve() / "isoatlas"
        self.others = Path(arguments.programs).resolve() / "bench_simplifiers"
        self.folder = Path(arguments.cache).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.simplifies = "--simplify" in subprocess.run([self.isoatlas, "extract", "--help"], capture_output=True, text=True).stdout

    def surface(self, text):
        """Rows of one surface."""
        name, tau = text.split("@")
        volume = file_of(name, self.isoatlas, self.arguments)
        exact, light = self.folder / "exact.ply", self.folder / "light.ply"
        extract = [self.isoatlas, "extract", volume, "--tau", tau, "--json", "-o"]
        full = checked([*extract, exact])["triangles"]
        info = checked([self.isoatlas, "info", volume, "--json"])["volume"]
        length = self.arguments.voxels * min(info["spacing"])
        rows = [self.row(text, "exact", {"triangles": full, "seconds": None}, volume, tau, exact)]
        count = round(FALLBACK * full)

        def ours():
            start = time.perf_counter()
            told = checked([*extract, light, "--simplify", self.arguments.voxels], self.arguments.seconds)
            return {"triangles": told["triangles"], "seconds": time.perf_counter() - start}

        def other(method, *options):
            return lambda: self.told([self.others, method, exact, light, *options])

        def vtk(method):
            return lambda: self.told([sys.executable, __file__, "--vtk", method, exact, light, count])

        if self.simplifies:
            rows.append(self.attempt(text, "isoatlas, with the extraction", ours, volume, tau, light))
            count = rows[-1]["triangles"] or count
        methods = [("meshoptimizer, at the error", other("meshoptimizer", "--error", length)),
                   ("meshoptimizer, as many triangles", other("meshoptimizer", "--triangles", count)),
                   ("VTK QuadricDecimation", vtk("quadric")), ("VTK DecimatePro, PreserveTopology", vtk("pro")),
                   ("CGAL Lindstrom-Turk", other("cgal", "--triangles", count)),
                   ("CGAL polyhedral envelope", other("cgal-envelope", "--error", length))]
        return rows + [self.attempt(text, title, make, volume, tau, light) for title, make in methods]

    def told(self, command):
        done = run(command, self.arguments.seconds)
        if done.returncode != 0:
            return {"failed": done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}"}
        return json.loads(done.stdout)

    def attempt(self, surface, title, make, volume, tau, mesh):
        mesh.unlink(missing_ok=True)
        try:
            made = make()
        except TooLong:
            made = {"failed": f"stopped after {self.arguments.seconds} s"}
        if "failed" in made:
            row = {name: None for name, _ in COLUMNS} | {"surface": surface, "method": title, "what else is wrong": made["failed"]}
            print_row(row)
            return row
        return self.row(surface, title, made, volume, tau, mesh)

    def row(self, surface, title, made, volume, tau, mesh):
        done = run([self.isoatlas, "verify", mesh, "--against", volume, "--tau", tau, "--json"], None)
        if done.returncode not in (0, 7):
            sys.exit(done.stderr)
        found = json.loads(done.stdout)
        checks = {check["name"]: check for check in found["checks"]}
        told_apart = ("contours_are_one_to_one", "contours_have_same_genus", "surface_does_not_cross_itself")
        wrong = [name for name, check in checks.items() if not check["holds"] and name not in told_apart]
        exact = found["exact"]
        voxels = found["distance"] and found["distance"]["voxels"]
        greatest = voxels and max((x for x in (voxels["mesh_to_exact"][1], voxels["exact_to_mesh"][1]) if x is not None), default=None)
        crossings = checks.get("surface_does_not_cross_itself", {"detail": ""})["detail"].split(" ")[0]
        row = {"surface": surface, "method": title, "triangles": made["triangles"], "distance, voxels": greatest,
               "contours": f"{found['contours']} of {exact['contours']}", "genus": f"{'-' if found['genus'] is None else found['genus']} of {exact['genus']}",
               "self-crossings": int(crossings) if crossings else None, "what else is wrong": ", ".join(wrong), "seconds": made["seconds"]}
        print_row(row)
        return row


def print_row(row):
    def text(value):
        return "" if value is None else f"{value:.3f}" if isinstance(value, float) else str(value)
    print("  ".join(f"{text(row[name]):{width}}" for name, width in COLUMNS), flush=True)


def main():
    if sys.argv[1:2] == ["--vtk"]:
        vtk_main(*sys.argv[2:])
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs")
    parser.add_argument("--surfaces", nargs="+", help="NAME@TAU; default: those of the shared data where --data is given")
    parser.add_argument("--voxels", type=float, default=0.5, help="the greatest distance, in voxels")
    parser.add_argument("--data", help="folder with NAME/NAME.nrrd")
    parser.add_argument("--cache", default="build/bench/volumes", help="folder for samples and meshes")
    parser.add_argument("--seconds", type=float, default=150, help="longer runs are stopped")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    comparison = Comparison(arguments)
    print("  ".join(f"{name:{width}}" for name, width in COLUMNS))
    surfaces = arguments.surfaces or (SURFACES if arguments.data else FIELDS)
    rows = [row for surface in surfaces for row in comparison.surface(surface)]
    if arguments.json:
        Path(arguments.json).write_text(json.dumps({"voxels": arguments.voxels, "simplified": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
