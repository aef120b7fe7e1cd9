"""extract --octree: surfaces by blocks of cells, of volumes and of stores, with the topology of the exact one."""
import struct

import harness
from harness import CliTest
from served import Viewer


class Octree(CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "48"]}

    def extract(self, *options, file="demo.nrrd", output="front.ply"):
        document = self.run_json("extract", file, "--tau", "90", *options, "-o", output)
        self.assert_schema(document, "extract")
        return document

    def test_blocks_have_fewer_triangles_and_the_same_topology(self):
        exact = self.extract()
        self.assertIsNone(exact["octree"])
        before = exact["triangles"]
        for cells in (2, 4, 16):
            front = self.extract("--octree", str(cells))
            self.assertLess(front["triangles"], before)
            before = front["triangles"]
            self.assertEqual((front["objects"], front["contours"]), (exact["objects"], exact["contours"]))
            self.assertEqual(front["octree"]["cells"], cells)
            self.assertIsNone(front["octree"]["deviation"])
            self.assertEqual([leaf["cells"] for leaf in front["octree"]["leaves"]], [2 ** i for i in range(cells.bit_length())])
            checked = self.run_json("verify", "front.ply", "--against", "demo.nrrd", "--tau", "90")
            self.assertTrue(all(check["holds"] for check in checked["checks"]), checked["checks"])

    def test_a_limit_of_the_distance(self):
        exact, free = self.extract(), self.extract("--octree", "16")
        front = self.extract("--octree", "16", "--octree-error", "0.2")
        self.assertLess(front["octree"]["deviation"], 0.2)
        self.assertTrue(free["triangles"] < front["triangles"] < exact["triangles"])
        text = self.run_ok("extract", "demo.nrrd", "--tau", "90", "--octree", "16", "--octree-error", "0.2", "-o", "front.ply").stdout
        self.assertIn("points of the exact surface within 0.", text)
        self.assertIn("with the same topology", text)

    def test_pixels_seen_from_an_eye(self):
        exact, free = self.extract(), self.extract("--octree", "16")
        near, far = (self.extract("--octree", "16", "--eye", eye) for eye in ("24,24,-60", "24,24,-3000"))
        for front in (near, far):
            self.assertTrue(0 < front["octree"]["pixels"] <= 1)
            self.assertIsNone(front["octree"]["deviation"])
            self.assertEqual((front["objects"], front["contours"]), (exact["objects"], exact["contours"]))
        self.assertTrue(free["triangles"] <= far["triangles"] < near["triangles"] < exact["triangles"])
        coarse = self.extract("--octree", "16", "--eye", "24,24,-60", "--octree-pixels", "3")
        self.assertLess(coarse["triangles"], near["triangles"])
        self.assertTrue(1 < coarse["octree"]["pixels"] <= 3)
        text = self.run_ok("extract", "demo.nrrd", "--tau", "90", "--octree", "16", "--eye", "24,24,-60", "-o", "front.ply").stdout
        self.assertIn("pixels from the eye, with the same topology", text)

    def test_a_store_gives_the_same_bytes(self):
        self.run_ok("build", "demo.nrrd", "-o", "demo.atlas")
        for options in ([], ["--octree-error", "0.3"], ["--eye", "24,24,-60"]):
            self.extract("--octree", "8", *options, output="volume.ply")
            document = self.extract("--octree", "8", *options, file="demo.atlas", output="store.ply")
            self.assertGreater(document["reads"]["bytes"], 0)
            self.assertEqual((self.folder / "volume.ply").read_bytes(), (self.folder / "store.ply").read_bytes())

    def test_an_object_of_a_store_is_seen_as_in_the_volume(self):
        self.run_ok("build", "demo.nrrd", "-o", "demo.atlas")
        for file in ("demo.nrrd", "demo.atlas"):
            self.run_ok("extract", file, "--top", "1", "--octree", "8", "--eye", "10,50,-20", "-o", file + ".ply")
        self.assertEqual((self.folder / "demo.nrrd.ply").read_bytes(), (self.folder / "demo.atlas.ply").read_bytes())

    def test_objects_by_blocks(self):
        document = self.run_json("extract", "demo.nrrd", "--top", "2", "--octree", "8", "-o", "objects.glb")
        self.assert_schema(document, "extract")
        exact = self.run_json("extract", "demo.nrrd", "--top", "2", "-o", "objects.glb")
        self.assertEqual(len(document["surfaces"]), 2)
        for front, whole in zip(document["surfaces"], exact["surfaces"]):
            self.assertEqual(front["id"], whole["id"])
            self.assertLess(front["triangles"], whole["triangles"])

    def test_objects_of_both_sides(self):
        document = self.run_json("extract", "demo.nrrd", "--polarity", "both", "--top", "3", "--octree", "8", "-o", "both.glb")
        self.assert_schema(document, "extract")
        alone = self.run_json("extract", "demo.nrrd", "--top", "1", "--octree", "8", "-o", "one.glb")
        counts = [sum(leaf["count"] for leaf in one["octree"]["leaves"]) for one in (document, alone)]
        self.assertGreater(counts[0], counts[1])

    def test_what_contradicts(self):
        for options, said in ((["--octree", "7"], "2, 4, 8, 16 or 32"), (["--octree", "64"], "--octree"),
                              (["--octree-error", "1"], "add --octree"), (["--octree", "8", "--simplify", "1"], "contradict"),
                              (["--octree", "8", "--boundary", "open"], "contradict"), (["--octree", "8", "--coarser", "2"], "contradict"),
                              (["--eye", "1,2,3"], "add --octree"), (["--octree", "8", "--octree-pixels", "2"], "add --eye"), (["--octree-pixels", "2"], "add --eye"),
                              (["--octree", "8", "--eye", "1,x,3"], "--eye"),
                              (["--octree", "8", "--eye", "1,2,3", "--octree-error", "1"], "contradict"),
                              (["--octree", "8", "-o", "front.precomputed"], "does not apply to .precomputed")):
            output = [] if "-o" in options else ["-o", "front.glb"]
            self.run_error(2, "extract", "demo.nrrd", "--tau", "90", *options, *output, says=said)
            self.assertFalse((self.folder / "front.glb").exists())

    def test_viewers_get_the_exact_topology_or_points(self):
        """However few triangles may be drawn: never a mesh with another Euler number."""
        self.run_ok("build", "demo.nrrd", "-o", "demo.atlas")
        exact = self.run_json("extract", "demo.atlas", "--tau", "90", "-o", "exact.ply")
        viewer = Viewer(self.folder, "demo.atlas")
        kinds = set()
        try:
            for most in (1, 10, 100, *(exact["triangles"] * part // 24 for part in range(1, 26, 3))):
                status, headers, mesh = viewer.ask(f"/api/surface?tau=90&max={most}")
                self.assertEqual(status, 200)
                _, points, triangles = struct.unpack_from("<4sII", mesh)
                self.assertEqual(triangles, int(headers["X-Triangles"]))
                self.assertLessEqual(triangles, most)
                if triangles == 0:
                    kinds.add("points")
                    self.assertTrue(0 < points <= 2 * most)
                    self.assertEqual(headers["X-Coarse"], "1")
                    self.assertGreater(float(headers["X-Spacing"]), 0)
                    continue
                self.assertNotIn("X-Spacing", headers)
                kinds.add("front" if headers["X-Coarse"] == "1" else "exact")
                self.assertEqual(points - triangles // 2, exact["points"] - exact["triangles"] // 2)  # of closed surfaces
        finally:
            viewer.stop()
        self.assertEqual(kinds, {"points", "front", "exact"})

    @harness.unittest.skipIf(harness.SANITIZED, "a sanitizer takes more than the memory of the server")
    def test_a_server_with_little_memory_draws_blocks(self):
        """More triangles than its memory allows: a front, with the same Euler number, and how far it may be."""
        self.run_ok("phantom", "random-field", "--size", "160", "-o", "large.nrrd")
        self.run_ok("build", "large.nrrd", "-o", "large.atlas")
        exact = self.run_json("extract", "large.atlas", "--tau", "0.1", "-o", "exact.ply")
        viewer = Viewer(self.folder, "large.atlas", "--memory", "80M")
        try:
            status, headers, mesh = viewer.ask("/api/surface?tau=0.1&max=100000000")
        finally:
            viewer.stop()
        self.assertEqual((status, headers["X-Coarse"]), (200, "1"))
        _, points, triangles = struct.unpack_from("<4sII", mesh)
        self.assertLess(triangles, exact["triangles"])
        self.assertEqual(triangles, int(headers["X-Triangles"]))
        self.assertEqual(points - triangles // 2, exact["points"] - exact["triangles"] // 2)  # of closed surfaces
        self.assertLess(float(headers["X-Distance"]), 16 * 2)


if __name__ == "__main__":
    harness.main()
