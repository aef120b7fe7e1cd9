"""isoatlas levels: levels of detail beside a store, which viewers read instead of the samples."""
import json
import os
import struct

from file_server import FileServer
import harness
from harness import CliTest
from served import Viewer


class Levels(CliTest):
    phantoms = {"field.nrrd": ["random-field", "--size", "48"], "other.nrrd": ["torus-chain", "--size", "24"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name in ("field", "other"):
            done = cls.start(["build", f"{name}.nrrd", "-o", f"{name}.atlas"])
            assert done.returncode == 0, done.stderr

    def made(self, *options):
        document = self.run_json("levels", "field.atlas", *options)
        self.assert_schema(document, "levels")
        return document["files"]

    def test_what_is_made_is_listed(self):
        self.assertEqual(self.made("--top", "1")[0]["file"], "field.atlas.lod")
        found, = self.made("--object", "2", "--object", "1@0.3")
        self.assertEqual(len(found["surfaces"]), 3)  # the first is kept
        self.assertEqual(found["bytes"], (self.folder / "field.atlas.lod").stat().st_size)
        for surface in found["surfaces"]:
            options = ("--object", f"v{surface['voxel']}@{surface['tau']!r}")
            exact = self.run_json("extract", "field.atlas", *options, "-o", "exact.ply")
            self.assertEqual(surface["triangles"], exact["triangles"])
            self.assertLess(surface["coarsest"], surface["triangles"])
            self.assertGreater(surface["distance"], 0)
        before = (self.folder / "field.atlas.lod").read_bytes()
        self.assertEqual(self.made("--object", "2"), [found])
        self.assertEqual((self.folder / "field.atlas.lod").read_bytes(), before)
        self.assertIn("levels of 3 surfaces", self.run_ok("levels", "field.atlas", "--object", "2").stdout)

    def test_verify_proves_levels(self):
        self.made("--top", "2")
        names = [check["name"] for check in self.run_json("verify", "field.atlas", "--levels", "1")["checks"]]
        self.assertEqual(names[-2:], ["levels_hold_exact_surfaces", "levels_keep_topology"])
        self.run_ok("build", "field.nrrd", "-o", "again.atlas", "--tunnel-height", "5%")
        lod = self.folder / "again.atlas.lod"
        lod.write_bytes((self.folder / "field.atlas.lod").read_bytes())
        checks = self.run_json("verify", "again.atlas", "--levels", "1", code=7)["checks"]
        self.assertEqual((checks[-1]["name"], checks[-1]["holds"]), ("levels_can_be_read", False))
        lod.unlink()

    def test_refusals(self):
        self.run_error(2, "levels", "field.nrrd", says="beside a store", next_says="isoatlas build")
        self.run_ok("levels", "other.atlas", "--top", "1", "-o", "other.lod")
        self.run_error(3, "levels", "field.atlas", "--top", "1", "-o", "other.lod", says="of another store")
        self.run_error(3, "info", "other.lod", says="levels of detail of surfaces, not a store", next_says="without .lod")
        self.run_error(6, "levels", "field.atlas", "--object", "9999")
        samples = " ".join(str(9 * (2 < x < 6 and 2 < y < 6)) for y in range(9) for x in range(9))
        (self.folder / "flat.nrrd").write_text(f"NRRD0004\ntype: uint8\ndimension: 2\nsizes: 9 9\nencoding: ascii\n\n{samples}\n")
        self.run_ok("build", "flat.nrrd", "-o", "flat.atlas")
        self.run_error(4, "levels", "flat.atlas", "--object", "1", says="2D image", next_says="extract")

    def first_surface(self, store):
        """Its answer, and its triangles."""
        viewer = Viewer(self.folder, store, "--cache", "0", env={**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache")})
        try:
            found = self.objects["objects"][0]
            status, headers, body = viewer.ask(f"/api/surface?tau={found['best_tau']!r}&object=v{found['id']}&max=300")
            self.assertEqual(status, 200, body)
            return int(headers["X-Triangles"]), headers["X-Coarse"], float(headers.get("X-Distance", -1))
        finally:
            viewer.stop()

    def test_viewers_are_answered_from_where_they_look(self):
        found = self.run_json("objects", "field.atlas")["objects"][0]
        listed = self.made("--top", "1")[0]["surfaces"]
        surface, = (one for one in listed if (one["voxel"], one["tau"]) == (found["id"], found["best_tau"]))
        viewer = Viewer(self.folder, "field.atlas")
        try:
            def seen(eye, triangles):
                path = f"/api/surface?tau={found['best_tau']!r}&object=v{found['id']}&max={triangles}{eye}"
                status, headers, body = viewer.ask(path)
                self.assertEqual(status, 200, body)
                return int(headers["X-Triangles"]), float(headers.get("X-Pixels", -1)), float(headers.get("X-Distance", -1))
            budget = surface["triangles"] // 3
            evenly, no_pixels, distance = seen("", budget)
            self.assertEqual(no_pixels, -1)
            near, pixels, farthest = seen("&eye=0,0,0&pixel=0.001", budget)
            self.assertLessEqual(max(near, evenly), budget)
            self.assertGreater(pixels, 0)
            self.assertGreaterEqual(farthest, distance)  # at least as coarse where it is far
            far, one_pixel, _ = seen("&eye=0,0,1e6&pixel=0.001", budget)
            self.assertLess(far, near)
            self.assertLessEqual(one_pixel, 1)
            towards = "&eye=-100,-100,-100&pixel=0.0003&angle=40&towards="
            ahead, seen_pixels, _ = seen(towards + "1,1,1", surface["triangles"] - 1)
            behind, _, _ = seen(towards + "-1,-1,-1", surface["triangles"] - 1)
            self.assertLess(behind, ahead)  # what is not seen may be coarser
            self.assertLessEqual(seen_pixels, 1)
            for wrong in ("&eye=0,0,0&pixel=1&towards=1,0,0", "&eye=0,0,0&pixel=1&angle=40", "&towards=1,0,0&angle=40",
                          "&eye=0,0,0&pixel=1&towards=0,0,0&angle=40", "&eye=0,0,0&pixel=1&towards=1,0,0&angle=180",
                          "&eye=0,0,0", "&pixel=1", "&eye=0,0&pixel=1", "&eye=0,0,x&pixel=1", "&eye=0,0,0&pixel=0"):
                self.assertEqual(viewer.ask(f"/api/surface?tau=0.5&max=9{wrong}")[0], 400, wrong)
        finally:
            viewer.stop()

    def without_samples(self):
        """A copy of the store in which every sample is damaged."""
        bytes_ = bytearray((self.folder / "field.atlas").read_bytes())
        begin, length = struct.unpack_from("<qq", bytes_, 24)
        samples, = (array for array in json.loads(bytes_[begin:begin + length])["arrays"] if array["name"] == "volume/data")
        for at in range(samples["offset"], samples["offset"] + samples["shape"][0]):
            bytes_[at] ^= 0xff
        (self.folder / "damaged.atlas").write_bytes(bytes_)
        return "damaged.atlas"

    def test_viewers_elsewhere_read_levels_and_no_samples(self):
        self.objects = self.run_json("objects", "field.atlas")
        lod = self.folder / "field.atlas.lod"
        lod.unlink(missing_ok=True)
        damaged = self.without_samples()
        with FileServer(self.folder) as server:
            _, coarse, distance = self.first_surface(f"{server.address}/field.atlas")
            self.assertEqual((coarse, distance), ("1", -1))
            with self.assertRaisesRegex(AssertionError, "damaged.atlas"):
                self.first_surface(f"{server.address}/{damaged}")
        self.run_ok("levels", "field.atlas", "--top", "1")
        (self.folder / f"{damaged}.lod").write_bytes(lod.read_bytes())
        with FileServer(self.folder) as server:
            triangles, coarse, distance = self.first_surface(f"{server.address}/{damaged}")
            self.assertEqual(coarse, "1")
            self.assertGreater(distance, 0)
        listed, = self.made("--top", "1")
        self.assertLessEqual(triangles, max(300, listed["surfaces"][0]["coarsest"]))
        lod.write_bytes(lod.read_bytes()[:5000])
        with FileServer(self.folder) as server, self.assertRaisesRegex(AssertionError, "field.atlas.lod"):
            self.first_surface(f"{server.address}/field.atlas")
        lod.unlink()


if __name__ == "__main__":
    harness.main()
