"""extract --simplify, --simplify-error, --triangles: fewer triangles, and nothing else changed, as verify proves."""
import harness
from harness import CliTest


class Simplify(CliTest):
    phantoms = {
        "shells.nrrd": ["nested-shells", "--size", "40", "--shells", "2"],
        "chain.nrrd": ["torus-chain", "--size", "40", "--genus", "2"],
    }
    SPACING = ["--spacing", "1,1,2.5", "--unit", "mm"]

    def test_holds_within_half_a_voxel(self):
        for volume, spacing in (("shells.nrrd", []), ("chain.nrrd", self.SPACING)):
            found = self.run_json("extract", volume, *spacing, "--tau", "0.5", "--simplify", "0.5", "-o", "light.ply")
            self.assert_schema(found, "extract")
            exact = self.run_json("extract", volume, *spacing, "--tau", "0.5", "-o", "exact.ply")
            self.assertIsNone(exact["simplification"])
            self.assertEqual(found["simplification"], {"triangles_before": exact["triangles"], "distance": 0.5, "distance_unit": "voxel"})
            self.assertLess(found["triangles"], exact["triangles"] / 5)
            self.assertEqual((found["objects"], found["contours"], found["closed"]), (exact["objects"], exact["contours"], True))
            proved = self.run_json("verify", "light.ply", "--against", volume, *spacing, "--tau", "0.5", "--max-distance", "0.5")
            self.assertEqual(proved["triangles"], found["triangles"])

    def test_a_length_in_the_unit_of_the_volume(self):
        text = self.run_ok("extract", "chain.nrrd", *self.SPACING, "--tau", "0.5", "--simplify-error", "0.25", "-o", "light.ply").stdout
        self.assertRegex(text, r"simplified from \d+ triangles to \d+ \([\d.e+]+ %\), within 0\.25 mm of the exact surface")
        self.run_ok("verify", "light.ply", "--against", "chain.nrrd", *self.SPACING, "--tau", "0.5", "--max-error", "0.25")

    def test_a_number_of_triangles(self):
        found = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--triangles", "600", "-o", "light.stl")
        self.assertEqual(found["triangles"], 600)
        distance = found["simplification"]["distance"]
        self.assertGreater(distance, 0)
        self.run_ok("verify", "light.stl", "--against", "shells.nrrd", "--tau", "0.5", "--max-distance", str(1.01 * distance))
        few = self.run_json("extract", "chain.nrrd", "--tau", "0.5", "--triangles", "4", "-o", "light.stl")
        self.assertGreater(few["triangles"], 4)  # two tunnels need more
        self.run_ok("verify", "light.stl", "--against", "chain.nrrd", "--tau", "0.5")
        both = self.run_json("extract", "shells.nrrd", "--tau", "0.5", "--triangles", "600", "--simplify", "0.01", "-o", "light.stl")
        self.assertGreater(both["triangles"], 600)

    def test_single_objects_and_printing(self):
        found = self.run_json("extract", "shells.nrrd", "--object", "1@0.5", "--shell", "outer", "--simplify", "0.3", "-o", "light.ply")
        self.assertEqual(found["contours"], 1)
        self.run_ok("verify", "light.ply", "--against", "shells.nrrd", "--object", "1@0.5", "--shell", "outer", "--max-distance", "0.3")
        several = self.run_json("extract", "shells.nrrd", "--top", "2", "--simplify", "0.5", "-o", "light.glb")
        self.assertGreater(several["simplification"]["triangles_before"], 5 * several["triangles"])
        self.run_ok("extract", "shells.nrrd", *self.SPACING, "--object", "1@0.5", "--for-print", "--simplify", "0.5", "-o", "print.stl")
        self.run_ok("verify", "print.stl")

    def test_what_is_refused(self):
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--simplify", "0", "-o", "x.ply", says="--simplify")
        self.run_error(2, "extract", "shells.nrrd", "--tau", "0.5", "--simplify", "1", "--simplify-error", "1", "-o", "x.ply", says="--simplify")
        header = "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 4 4\nencoding: ascii\n\n"
        (self.folder / "flat.nrrd").write_text(header + "0 0 0 0 0 9 9 0 0 9 9 0 0 0 0 0\n")
        self.run_error(2, "extract", "flat.nrrd", "--tau", "5", "--simplify", "0.5", "-o", "x.vtp", says="2D")


if __name__ == "__main__":
    harness.main()
