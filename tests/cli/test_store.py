"""Stores on the command line: what a store answers is what its volume answers."""
import json
import os
import random
import resource
import shutil

import harness

NOBODY = 65534


class Stores(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "20", "--quantise", "64"]}

    def setUp(self):
        self.built = self.run_json("build", "noise.nrrd", "-o", "noise.atlas")

    def read(self, name):
        return (self.folder / name).read_bytes()

    def test_build_says_what_it_made(self):
        self.assertEqual(self.built["schema"], "isoatlas/build/2")
        self.assertEqual(self.built["bytes"], len(self.read("noise.atlas")))
        self.assertEqual(self.built["sample_bytes"], 20 ** 3 * 1)
        self.assertEqual(self.built["interpolant"], "trilinear")

    def test_surfaces_labels_and_trees_are_those_of_the_volume(self):
        for options in (["--tau", "31"], ["--tau", "40.5", "--style", "full"], ["--tau", "20", "--shell", "outer"], ["--best"]):
            self.run_ok("extract", "noise.nrrd", *options, "-o", "volume.ply")
            told = self.run_json("extract", "noise.atlas", *options, "-o", "store.ply")
            self.assertEqual(self.read("volume.ply"), self.read("store.ply"), options)
            reads = told["reads"]
            self.assertGreater(reads["bytes"], 0)
            self.assertGreaterEqual(reads["cells_visited"], reads["cells_loaded"])
            self.assertGreater(reads["cells_active"], 0)
            self.assertEqual(reads["load_utility"], reads["cells_active"] / reads["cells_loaded"])
            self.assertEqual(reads["travel_utility"], reads["cells_active"] / reads["cells_visited"])
        for name, options in (("l.nrrd", ["--tau", "31"]), ("z.nrrd", ["--zones"])):
            self.run_ok("label", "noise.nrrd", *options, "-o", "volume-" + name)
            self.run_ok("label", "noise.atlas", *options, "-o", "store-" + name)
            self.assertEqual(self.read("volume-" + name), self.read("store-" + name))
        for detail in ("events", "levels", "elements", "contours"):
            self.run_ok("tree", "noise.nrrd", "--detail", detail, "-o", "volume.csv")
            self.run_ok("tree", "noise.atlas", "--detail", detail, "-o", "store.csv")
            self.assertEqual(self.read("volume.csv"), self.read("store.csv"), detail)
        for options in (["--tau", "31"], [], ["--top", "3"], ["--all"], ["--voxel"]):
            one = self.run_json("objects", "noise.nrrd", *options)
            other = self.run_json("objects", "noise.atlas", *options)
            self.assertEqual(one["objects"], other["objects"])

    def test_a_changed_byte_is_a_damaged_store_or_does_not_matter(self):
        """Never a file of an unknown format, and never another answer. What `verify` can open it finds."""
        self.run_ok("phantom", "noise", "--size", "4", "-o", "tiny.nrrd", "--quiet")
        self.run_ok("build", "tiny.nrrd", "-o", "tiny.atlas", "--quiet")
        whole = self.read("tiny.atlas")
        right = self.run_json("objects", "tiny.atlas", "--all")["objects"]
        seed = int(os.environ.get("ISOATLAS_SEED", 7))
        chance = random.Random(seed)
        print("seed", seed)
        places = [*range(0, 56, 3), 56, 511, *range(512, 524, 2), *chance.sample(range(524, len(whole) - 40), 40), *range(len(whole) - 40, len(whole), 5)]
        for at in places:
            damaged = bytearray(whole)
            damaged[at] ^= 1 << chance.randrange(8)
            (self.folder / "tiny.atlas").write_bytes(damaged)
            done = self.start(["objects", "tiny.atlas", "--all", "--json", "--quiet"])
            self.assertIn(done.returncode, (0, 3), f"byte {at}: {done.stderr}")
            if done.returncode == 0:
                self.assertEqual(json.loads(done.stdout)["objects"], right, f"byte {at}")
            self.assertIn(self.start(["verify", "tiny.atlas", "--quiet", "--levels", "1"]).returncode, (3, 7), f"byte {at}")
        for damaged in (whole[:5], whole[:100], b"\0" * 512 + whole[512:], b"\0" * 600 + whole[600:], b""):
            (self.folder / "tiny.atlas").write_bytes(damaged)
            self.run_error(3, "objects", "tiny.atlas")

    def test_info_and_verify(self):
        self.assertEqual(self.run_json("info", "noise.atlas")["values"]["low"], self.run_json("info", "noise.nrrd")["values"]["low"])
        told = self.run_json("verify", "noise.atlas", "--levels", "3", "--seed", "5")
        self.assertTrue(told["holds"])
        self.assertEqual((told["what"], told["sample"]), ("store", {"full": False, "levels": 3, "seed": 5, "objects": 3}))
        full = self.run_json("verify", "noise.atlas", "--levels", "2", "--full")
        self.assertTrue(full["holds"])
        names = {check["name"] for check in full["checks"]}
        self.assertLess({check["name"] for check in told["checks"]}, names)
        self.assertLessEqual({"checksums_are_right", "bricks_hold_active_cells", "join_tree_is_valid", "objects_equal_volume", "tree_equals_cut",
                              "surface_is_manifold", "stored_tables_are_recomputed", "stored_tree_equals_analysis", "zones_partition_voxels"}, names)
        self.assertIn("seed 5", self.run_ok("verify", "noise.atlas", "--levels", "1", "--seed", "5").stdout.splitlines()[-1])

    def test_a_tunnel_height_in_percent_is_of_the_filtered_samples(self):
        options = ["--gaussian", "1.5", "--tunnel-height", "2%"]
        built = self.run_json("build", "noise.nrrd", *options, "-o", "smooth.atlas")
        values = self.run_json("info", "smooth.atlas")["values"]
        self.assertLess(values["high"] - values["low"], 40)
        self.assertAlmostEqual(built["tunnel_height"], 0.02 * (values["high"] - values["low"]))
        self.run_ok("convert", "smooth.atlas", "-o", "smooth.nrrd")
        again = self.run_json("objects", "smooth.nrrd", "--tunnel-height", "2%")
        self.assertEqual(again["tunnel_height"], built["tunnel_height"])
        self.assertEqual(again["objects"], self.run_json("objects", "smooth.atlas")["objects"])
        self.assertEqual(self.run_json("build", "noise.nrrd", "--tunnel-height", "2%", "-o", "rough.atlas")["tunnel_height"], 0.02 * 63)

    def test_convert_gives_the_samples_back(self):
        for name in ("back.nrrd", "back.npy", "back.raw", "back.mha", "back.nii", "back.nii.gz", "back.vti", "back.tif"):
            told = self.run_json("convert", "noise.atlas", "-o", name)
            self.assertEqual((told["schema"], told["output"], told["sample_bytes"]), ("isoatlas/convert/1", name, 20 ** 3))
            self.run_ok("build", name, "-o", "again.atlas")
            one, other = (self.run_json("dump", store, "contents")["text"] for store in ("noise.atlas", "again.atlas"))
            self.assertEqual(one["parameters"], other["parameters"])
            self.assertEqual(self.run_json("info", name)["values"], self.run_json("info", "noise.nrrd")["values"])
        self.run_ok("convert", "noise.nrrd", "--box", "2:7,3:5,0:20", "-o", "part.nrrd")
        self.assertEqual(self.run_json("info", "part.nrrd")["volume"]["dims"], [5, 2, 20])
        self.run_error(2, "convert", "noise.atlas", "-o", "noise.atlas", says="noise.atlas")
        self.run_error(2, "convert", "noise.atlas", "-o", "noise.ply", says=".ply")

    def test_preview(self):
        preview = self.run_json("info", "noise.atlas", "--tau", "31")["preview"]
        found = self.run_json("objects", "noise.atlas", "--tau", "31")
        self.assertEqual(preview["objects"], found["object_count"])
        self.assertEqual(preview["contours"], found["contour_count"])
        self.assertEqual(preview["active_cells"], {"min": found["active_cells"], "max": found["active_cells"]})
        voxels = sum(entry["voxels"] for entry in found["objects"])
        self.assertEqual(preview["voxels"], {"min": voxels, "max": voxels})
        reads = self.run_json("extract", "noise.atlas", "--tau", "31", "-o", "x.ply")["reads"]
        for name in ("bytes", "extents", "bricks"):
            self.assertLessEqual(preview[name]["min"], reads[name])
            self.assertGreaterEqual(preview[name]["max"], reads[name])
        self.assertIn("to be read", self.run_ok("info", "noise.atlas", "--tau", "31").stdout)
        self.run_error(2, "info", "noise.nrrd", "--tau", "31", next_says="build")

    def test_damage_is_found(self):
        whole = bytearray(self.read("noise.atlas"))
        (data,) = [part for part in self.run_json("dump", "noise.atlas")["parts"] if part["name"] == "volume/data"]
        whole[data["offset"] + data["bytes"] // 2] ^= 1  # between arrays lie bytes that nobody reads
        (self.folder / "damaged.atlas").write_bytes(whole)
        checked = self.run_json("verify", "damaged.atlas", code=7)
        self.assertFalse(checked["holds"])
        (self.folder / "short.atlas").write_bytes(whole[:-100])
        self.run_error(3, "objects", "short.atlas", "--tau", "31", says="damaged")

    def test_a_full_disk_is_told_and_leaves_nothing(self):
        whole = len(self.read("noise.atlas"))
        for limit in [1000, 30000, whole // 2, whole - 5000, whole - 600, whole - 1]:
            done = self.start(["build", "noise.nrrd", "-o", "full.atlas"],
                              preexec_fn=lambda size=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.assertEqual(done.returncode, 5, f"{limit}: {done.stderr}")
            self.assertIn("cannot be written: File too large", done.stderr)
            self.assertFalse((self.folder / "full.atlas").exists())
            self.assert_no_partial()

    def test_a_store_in_a_folder_that_is_read_only(self):
        media, outside = self.folder / "media", self.folder / "outside"
        for folder in (media, outside):
            folder.mkdir()
        shutil.copy(self.folder / "noise.atlas", media)
        self.run_ok("extract", "noise.nrrd", "--tau", "31", "-o", "volume.ply")
        is_root = os.geteuid() == 0
        identity = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if is_root else {}  # root may write everywhere
        self.folder.chmod(0o755)
        outside.chmod(0o777)
        (media / "noise.atlas").chmod(0o444)
        media.chmod(0o555)
        try:
            for arguments in (["info", "media/noise.atlas"], ["tree", "media/noise.atlas"], ["objects", "media/noise.atlas", "--tau", "31"],
                              ["verify", "media/noise.atlas", "--levels", "2"],
                              ["label", "media/noise.atlas", "--tau", "31", "-o", "outside/labels.nrrd"],
                              ["extract", "media/noise.atlas", "--tau", "31", "-o", "outside/surface.ply"]):
                try:
                    done = self.start(arguments, **identity)
                except PermissionError:
                    self.skipTest("the program lies where only root may go")
                self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
            self.assertEqual(self.read("outside/surface.ply"), self.read("volume.ply"))
            self.assertEqual(os.listdir(media), ["noise.atlas"])
            done = self.start(["extract", "media/noise.atlas", "--tau", "31", "-o", "media/surface.ply"], **identity)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn("may not be written to", done.stderr)
        finally:
            media.chmod(0o755)

    def test_options_that_contradict_the_store(self):
        self.run_error(2, "extract", "noise.atlas", "--tau", "31", "--interpolant", "faces", "-o", "x.ply", says="built with")
        self.run_error(2, "tree", "noise.atlas", "--tunnel-height", "2", next_says="omit")
        self.run_error(2, "build", "noise.atlas", "-o", "other.atlas", says="already a store")
        self.run_error(2, "build", "noise.nrrd", "-o", "other.h5", says=".atlas")


if __name__ == "__main__":
    harness.main()
