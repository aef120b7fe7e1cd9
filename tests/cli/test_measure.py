"""isoatlas measure: the document, the table, the CSV file, volume and store alike; voxels as scikit-image measures them."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import unittest

import harness

# regionprops of python3-skimage 0.19.3 on the labels of demo.nrrd at 95.15625 (spacing 0.5), by label: area (voxels), centroid in voxels
# (z y x), mean, min and max intensity, Euler number, eigenvalues of the covariance of its coordinates: what REGIONPROPS prints. Compared
# anew where scikit-image is installed.
RECORDED = json.loads("""[
 {"voxels": 38912, "centroid": [47.5, 34.063527960526315, 40.00827508223684], "mean": 183.53080549365595, "min": 95.1620101928711, "max": 250.0, "euler": 2, "moments": [60.41478207236842, 60.51158785188593, 344.1884094318691]},
 {"voxels": 6502, "centroid": [47.5, 72.455859735466, 62.851737926791756], "mean": 159.86603130761824, "min": 95.16129302978516, "max": 200.0, "euler": 0, "moments": [6.832589972316211, 77.45593910610526, 77.68615672679182]}
]""")

REGIONPROPS = """
import json, sys
import numpy, skimage.measure
labels, samples = numpy.load(sys.argv[1]), numpy.load(sys.argv[2]).astype(float)  # means of float32 are sums of float32 there
print(json.dumps([{"voxels": int(p.area), "centroid": list(map(float, p.centroid)), "mean": float(p.mean_intensity), "min": float(p.min_intensity),
                   "max": float(p.max_intensity), "euler": int(p.euler_number), "moments": sorted(map(float, numpy.linalg.eigvalsh(
                       numpy.cov(numpy.array(p.coords).T, bias=True))))} for p in skimage.measure.regionprops(labels, intensity_image=samples)]))
"""


def skimage_python():
    """The Python that has scikit-image: that of Debian's packages, or the one of this test; None."""
    for python in ("/usr/bin/python3", sys.executable):
        if os.path.exists(python) and subprocess.run([python, "-c", "import skimage.measure"], capture_output=True).returncode == 0:
            return python
    return None


PYTHON = skimage_python()
DATA = pathlib.Path(os.environ["ISOATLAS_SOURCE"]).resolve().parent / "shared" / "data"


class Measure(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo"], "shells.nrrd": ["nested-shells", "--shells", "2", "--size", "32"],
                "noise.nrrd": ["noise", "--size", "12", "--quantise", "16"]}

    def document(self, *arguments):
        document = self.run_json("measure", *arguments)
        self.assert_schema(document, "measure")
        return document

    def test_the_table(self):
        done = self.run_ok("measure", "demo.nrrd", "--top", "3")
        lines = done.stdout.splitlines()
        self.assertIn("volume [mm³]", lines[0])
        self.assertIn("sphericity", lines[0])
        self.assertEqual(len(lines), 1 + 3 + 1 + 2)
        self.assertTrue(lines[-2].startswith("high values percolate up to "), done.stdout)
        self.assertTrue(lines[-1].startswith("low values percolate above "), done.stdout)
        self.assertIn("isoatlas measure demo.nrrd -o measures.csv", done.stderr)
        at = self.run_ok("measure", "demo.nrrd", "--tau", "150", "--no-percolation").stdout
        self.assertIn("porosity: ", at)
        self.assertIn("% of the samples are below 150", at)
        self.assertNotIn("percolate", at)

    def test_objects_are_those_of_the_table(self):
        measured, table = self.document("demo.nrrd"), self.run_json("objects", "demo.nrrd")
        self.assertEqual([(o["id"], o["tau"], o["voxels"], o["tunnels"], o["cavities"], o["euler"], o["note"]) for o in measured["objects"]],
                         [(o["id"], o["best_tau"], o["voxels"], o["tunnels"], o["cavities"], o["chi"], o["note"]) for o in table["objects"]])
        self.assertIsNone(measured["sizes"])
        for one, other in zip(measured["objects"], table["objects"]):
            self.assertAlmostEqual(one["voxel_volume"], other["measure"], delta=1e-9 * other["measure"])
            self.assertAlmostEqual(one["volume"], one["voxel_volume"], delta=0.12 * one["voxel_volume"])
            self.assertAlmostEqual(one["volume_ml"], one["volume"] / 1000, delta=1e-12)
            self.assertLessEqual(one["values"]["min"], one["values"]["mean"])
            self.assertGreaterEqual(one["values"]["min"], one["tau"])

    def test_objects_at_an_isovalue(self):
        measured, table = self.document("noise.nrrd", "--tau", "12"), self.run_json("objects", "noise.nrrd", "--tau", "12")
        self.assertEqual([(o["id"], o["voxels"], o["tunnels"], o["cavities"]) for o in measured["objects"]],
                         [(o["id"], o["voxels"], o["b1"], o["b2"]) for o in table["objects"]])
        self.assertEqual(measured["sizes"]["objects"], len(measured["objects"]))
        self.assertEqual(sum(o["voxels"] for o in measured["objects"]) + measured["below_tau"], measured["samples"])
        porosity = dict(zip(measured["porosity"]["tau"], measured["porosity"]["below"]))
        self.assertEqual(porosity[12], measured["below_tau"])
        self.assertEqual(porosity[0], 0)
        self.assertEqual(len(self.document("noise.nrrd", "--tau", "12", "--top", "2")["objects"]), 2)

    def test_objects_that_are_named(self):
        table = self.document("shells.nrrd", "--no-percolation")["objects"]
        self.assertEqual([each["reference"] for each in table], [str(i + 1) for i in range(len(table))])
        self.assertGreater(len(table), 1)
        self.run_ok("build", "shells.nrrd", "--polarity", "both", "-o", "both.atlas")
        for file in ("shells.nrrd", "both.atlas"):
            named = self.document(file, "--object", "2", "--object", "1")["objects"]
            for found, entry in zip(named, (table[1], table[0]), strict=True):
                self.assertEqual({**found, "note": ""}, {**entry, "note": ""})
            low = self.document(file, "--polarity", "low", "--top", "2")["objects"][1]
            self.assertEqual(low["reference"], "low2")
            self.assertEqual({**self.document(file, "--object", "low2")["objects"][0], "note": ""}, {**low, "note": ""})
        at = self.document("shells.nrrd", "--tau", "0.5")["objects"]
        for typed in (["--object", f"v{at[1]['id']}@0.5"], ["--object", f"v{at[1]['id']}", "--tau", "0.5"]):
            one = self.document("shells.nrrd", *typed)
            self.assertIsNone(one["percolation"])
            self.assertEqual({**one["objects"][0], "reference": None}, at[1])
        line = self.run_ok("measure", "shells.nrrd", "--object", "low2").stdout.splitlines()
        self.assertEqual(len(line), 2)
        self.assertTrue(line[1].lstrip().startswith("low2 "), line)
        for wrong in (["--object", "c1"], ["--object", "1", "--min-voxels", "3"]):
            self.run_error(2, "measure", "shells.nrrd", *wrong)
        self.run_error(6, "measure", "shells.nrrd", "--object", "99")

    def test_percolation_is_where_an_object_reaches_both_ends(self):
        measured = self.document("noise.nrrd")

        def reaches(tau, axis):
            objects = self.run_json("objects", "noise.nrrd", "--tau", repr(tau))["objects"]
            return any(o["box"]["low"][axis] == 0 and o["box"]["high"][axis] == 11 for o in objects)

        for axis, tau in enumerate(measured["percolation"]["high"]):
            self.assertTrue(reaches(tau, axis))
            self.assertFalse(reaches(tau + 1e-9, axis))

    def test_store_and_volume_are_alike(self):
        self.run_ok("build", "demo.nrrd", "-o", "demo.atlas")
        for options in ([], ["--tau", "95.5"], ["--keep", "2"], ["--voxel"]):
            volume, store = self.document("demo.nrrd", *options), self.document("demo.atlas", *options)
            self.assertIsNone(volume["reads"])
            self.assertIsNotNone(store["reads"])
            for name in ("objects", "porosity", "percolation", "sizes", "below_tau"):
                self.assertEqual(volume[name], store[name], (options, name))

    def test_threads_do_not_matter(self):
        one, more = (self.run_ok("measure", "demo.nrrd", "--json", "--threads", n).stdout for n in (1, 3))
        self.assertEqual(one, more)

    def test_the_file_has_all_measures(self):
        document = self.document("noise.nrrd", "--tau", "12")
        self.run_ok("measure", "noise.nrrd", "--tau", "12", "--top", "2", "-o", "noise.csv")
        with open(self.folder / "noise.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(document["objects"]))
        for row, one in zip(rows, document["objects"]):
            self.assertEqual((int(row["id"]), int(row["voxels"]), int(row["tunnels"])), (one["id"], one["voxels"], one["tunnels"]))
            for column, value in (("volume", one["volume"]), ("area", one["area"]), ("mean", one["values"]["mean"]),
                                  ("axis_1", one["axes"]["length"][0]), ("feret_max", one["feret"]["max"]),
                                  ("centroid_z", one["centroid"][2]), ("box_3", one["box"]["size"][2]), ("high_y", one["bounds"][1][1])):
                self.assertEqual(float(row[column]), value)

    def test_thickness(self):
        self.assertTrue(all(one["thickness"] is None for one in self.document("demo.nrrd")["objects"]))
        measured = self.document("demo.nrrd", "--thickness")["objects"]
        for one in measured:
            self.assertLessEqual(one["thickness"]["min"], one["thickness"]["median"])
            self.assertLess(one["thickness"]["median"], one["feret"]["max"])
        self.assertIn("thickness [mm]", self.run_ok("measure", "demo.nrrd", "--thickness", "--no-percolation").stdout)
        self.run_ok("measure", "demo.nrrd", "--thickness", "--no-percolation", "-o", "walls.csv")
        with open(self.folder / "walls.csv", newline="") as file:
            for row, one in zip(csv.DictReader(file), measured, strict=True):
                self.assertEqual((float(row["thickness_min"]), float(row["thickness_median"])), tuple(one["thickness"].values()))

    def test_refusals(self):
        self.run_error(2, "measure", "demo.nrrd", "-o", "x.txt", next_says="format follows the name")
        self.run_error(2, "measure", "demo.nrrd", "--tau", "100", "--keep", "3")
        self.run_error(6, "measure", "demo.nrrd", "--tau", "100000")
        self.run_error(3, "measure", "none.nrrd")

    def labels_and_samples(self):
        self.run_ok("label", "demo.nrrd", "--tau", "95.15625", "-o", "labels.nrrd")
        self.run_ok("convert", "labels.nrrd", "-o", "labels.npy")
        self.run_ok("convert", "demo.nrrd", "-o", "demo.npy")
        return ["labels.npy", "demo.npy"]

    def compare(self, recorded):
        """Of regionprops in voxels; the volume has its samples 0.5 mm apart."""
        document = self.document("demo.nrrd", "--tau", "95.15625")
        spacing, origin = document["volume"]["spacing"], document["volume"]["origin"]
        self.assertEqual(len(recorded), len(document["objects"]))
        for one, other in zip(document["objects"], recorded):
            self.assertEqual((one["voxels"], one["euler"]), (other["voxels"], other["euler"]))
            for axis in range(3):
                place = origin[axis] + spacing[axis] * other["centroid"][2 - axis]
                self.assertAlmostEqual(one["centroid"][axis], place, delta=1e-9 * max(1, abs(place)))
                moment = (one["axes"]["length"][axis] / 2) ** 2 / 5 / spacing[0] ** 2 - 1 / 12  # regionprops takes voxels as points
                self.assertAlmostEqual(moment, other["moments"][2 - axis], delta=1e-9 * max(1, moment))
            for name in ("mean", "min", "max"):
                self.assertAlmostEqual(one["values"][name], other[name], delta=1e-6)

    def test_voxels_are_those_of_regionprops_as_recorded(self):
        self.compare(RECORDED)

    @unittest.skipUnless(PYTHON, "python3-skimage is not installed: only the recorded results are compared")
    def test_voxels_are_those_of_regionprops(self):
        done = subprocess.run([PYTHON, "-c", REGIONPROPS, *self.labels_and_samples()], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.compare(json.loads(done.stdout))


@unittest.skipUnless(DATA.is_dir(), "no shared data beside the checkout")
class SharedVolumes(harness.CliTest):
    def test_a_head_is_the_same_in_any_orientation_of_its_axes(self):
        heads = [self.run_json("measure", DATA / "nifti_orientations" / f"{axes}.nii.gz", "--top", "1")
                 for axes in ("RAS", "LPI", "AIL", "SRP")]
        first = heads[0]["objects"][0]
        for head in heads:
            one = head["objects"][0]
            self.assertEqual((one["voxels"], one["euler"], one["tau"], one["values"]["max"]),
                             (first["voxels"], first["euler"], first["tau"], first["values"]["max"]))
            self.assertAlmostEqual(one["volume"] / first["volume"], 1, delta=1e-4)  # other diagonals cut its faces
            self.assertAlmostEqual(one["area"] / first["area"], 1, delta=1e-3)
            for name in ("max", "min", "mean"):
                self.assertAlmostEqual(one["feret"][name] / first["feret"][name], 1, delta=1e-5)
            for one_number, number in zip(one["centroid"] + one["axes"]["length"], first["centroid"] + first["axes"]["length"]):
                self.assertAlmostEqual(one_number, number, delta=1e-4)
            for side in ("high", "low"):
                for tau, other in zip(sorted(head["percolation"][side]), sorted(heads[0]["percolation"][side])):
                    self.assertAlmostEqual(tau, other, delta=1e-9)

    def test_a_rock_and_a_tooth(self):
        rock = self.run_json("measure", DATA / "berea" / "berea.nrrd", "--tau", "0.5")
        self.assertEqual(rock["below_tau"], 6410278)
        self.assertEqual(rock["percolation"], {"high": [1, 1, 1], "low": [0, 0, 0]})
        self.assertEqual(sum(one["voxels"] for one in rock["objects"]), 8000000 - 6410278)
        tooth = self.run_json("measure", DATA / "tooth" / "tooth.nrrd", "--top", "2")["objects"]
        for one in tooth:
            self.assertAlmostEqual(one["volume"] / one["voxel_volume"], 1, delta=0.01)
        self.assertAlmostEqual(tooth[0]["feret"]["max"], 164.46, delta=0.01)


if __name__ == "__main__":
    harness.main()
