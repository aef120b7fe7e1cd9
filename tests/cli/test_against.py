"""verify --against: meshes, ours and damaged ones, beside the exact surface of a volume or store."""
import math
import re

import harness
from harness import CliTest

OWN = {"surface_does_not_cross_itself", "contours_are_one_to_one", "contours_have_same_genus", "contours_are_nested_alike"}


class Against(CliTest):
    phantoms = {
        "shells.nrrd": ["nested-shells", "--size", "32", "--shells", "2"],
        "chain.nrrd": ["torus-chain", "--size", "32", "--genus", "2"],
        "figure.nrrd": ["figure-plateau"],
    }

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for arguments in (["extract", "shells.nrrd", "--tau", "0.5", "-o", "shells.obj"], ["extract", "chain.nrrd", "--tau", "0.5", "-o", "chain.ply"],
                          ["build", "shells.nrrd", "-o", "shells.atlas"]):
            done = cls.start(arguments)
            assert done.returncode == 0, done.stderr

    def obj(self, change_points=lambda points: points, change_faces=lambda faces: faces):
        """shells.obj with changed lines, as changed.obj: `v x y z` and `f ...`."""
        lines = (self.folder / "shells.obj").read_text().splitlines()
        points = [line for line in lines if line.startswith("v ")]
        faces = [[int(corner.split("/")[0]) for corner in line.split()[1:4]] for line in lines if line.startswith("f ")]
        points = change_points([tuple(map(float, line.split()[1:4])) for line in points])
        faces = change_faces(faces)
        text = ["v {!r} {!r} {!r}".format(*p) for p in points] + ["f {} {} {}".format(*f) for f in faces]
        (self.folder / "changed.obj").write_text("\n".join(text) + "\n")
        return "changed.obj"

    def failing(self, document):
        return [check["name"] for check in document["checks"] if not check["holds"]]

    def test_the_surface_itself_holds(self):
        for volume in ("shells.nrrd", "shells.atlas"):
            told = self.run_json("verify", "shells.obj", "--against", volume, "--tau", "0.5", "--max-distance", "0.001")
            self.assert_schema(told, "verify")
            self.assertTrue(told["holds"])
            self.assertEqual((told["what"], told["file"], told["tau"]), ("mesh", "shells.obj", 0.5))
            self.assertEqual((told["contours"], told["genus"]), (told["exact"]["contours"], told["exact"]["genus"]))
            self.assertEqual(told["triangles"], told["exact"]["triangles"])
            self.assertLessEqual(OWN | {"distance_is_within", "surface_is_closed"}, {check["name"] for check in told["checks"]})
            self.assertLess(told["distance"]["voxels"]["mesh_to_exact"][1], 1e-3)
        text = self.run_ok("verify", "shells.obj", "--against", "shells.nrrd", "--tau", "0.5", "--unit", "mm").stdout
        self.assertRegex(text, r"(?m)^greatest distance: mesh to exact surface .* voxels \(.* mm\), back ")
        self.assertRegex(text, r"(?m)^holds  contours_are_nested_alike ")
        self.assertRegex(text, r"shells\.obj: all \d+ guarantees hold\n$")

    def test_objects_and_shells(self):
        self.run_ok("extract", "shells.nrrd", "--object", "1@0.5", "--shell", "outer", "-o", "outer.stl")
        self.run_ok("verify", "outer.stl", "--against", "shells.nrrd", "--object", "1@0.5", "--shell", "outer")
        whole = self.run_json("verify", "outer.stl", "--against", "shells.nrrd", "--tau", "0.5", code=7)
        self.assertIn("contours_are_one_to_one", self.failing(whole))
        self.run_ok("extract", "figure.nrrd", "--tau", "40", "--boundary", "open", "-o", "open.ply")
        self.run_ok("verify", "open.ply", "--against", "figure.nrrd", "--tau", "40", "--boundary", "open")

    def test_a_moved_point_is_measured(self):
        mesh = self.obj(lambda points: [(points[0][0], points[0][1], points[0][2] + 0.001), *points[1:]])
        told = self.run_json("verify", mesh, "--against", "shells.nrrd", "--tau", "0.5")
        lower, upper = told["distance"]["lengths"]["mesh_to_exact"]
        self.assertLessEqual(lower, 0.001 + 1e-9)
        self.assertLessEqual(lower, upper)
        mesh = self.obj(lambda points: [(p[0] + 1, p[1], p[2]) for p in points])
        told = self.run_json("verify", mesh, "--against", "shells.nrrd", "--tau", "0.5", "--max-error", "1.01")
        lower, upper = told["distance"]["lengths"]["exact_to_mesh"]
        self.assertTrue(0.9 < lower <= upper < 1.01, told["distance"])
        told = self.run_json("verify", mesh, "--against", "shells.nrrd", "--tau", "0.5", "--max-error", "0.9", code=7)
        self.assertEqual(self.failing(told), ["distance_is_within"])
        spacing = told["volume"]["spacing"][0]
        self.assertTrue(math.isclose(told["distance"]["voxels"]["exact_to_mesh"][1], upper / spacing, rel_tol=0.01))

    def test_what_is_broken_is_told(self):
        def without_first_contour(faces):
            joined, size = set(faces[0]), 0
            while size != len(joined):
                size = len(joined)
                for face in faces:
                    if joined & set(face):
                        joined |= set(face)
            return [face for face in faces if not joined & set(face)]
        done = self.start(["verify", self.obj(change_faces=without_first_contour), "--against", "shells.nrrd", "--tau", "0.5"])
        self.assertEqual(done.returncode, 7)
        self.assertRegex(done.stdout, r"(?m)^FAILS  contours_are_one_to_one .*the mesh has none for the contour at \(")
        self.assertIn("changed.obj: a guarantee does not hold", done.stderr)
        holed = self.run_json("verify", self.obj(change_faces=lambda faces: faces[1:]), "--against", "shells.nrrd", "--tau", "0.5", code=7)
        self.assertIn("surface_is_closed", self.failing(holed))
        other = self.run_json("verify", "chain.ply", "--against", "shells.nrrd", "--tau", "0.5", code=7)
        self.assertFalse(other["holds"])
        self.assert_schema(other, "verify")

    def test_errors_have_a_next_step(self):
        self.run_error(2, "verify", "shells.obj", "--against", "shells.nrrd", says="which isovalue", next_says="isoatlas objects shells.nrrd")
        self.run_error(2, "verify", "shells.obj", "--tau", "0.5", says="--against")
        self.run_error(2, "verify", "shells.obj", "--max-distance", "0.5", says="--against")
        self.run_error(2, "verify", "shells.obj", "--against", "shells.nrrd", "--object", "1@0.5", "1@0.3", says="several isovalues", next_says="--split")
        self.run_error(2, "verify", "shells.obj", "--against", "shells.nrrd", "--tau", "0.5", "--max-distance", "-1", says="--max-distance")
        self.run_error(3, "verify", "none.obj", "--against", "shells.nrrd", "--tau", "0.5", says="none.obj")
        self.run_error(3, "verify", "shells.obj", "--against", "none.nrrd", "--tau", "0.5", says="none.nrrd")
        self.run_error(6, "verify", "shells.obj", "--against", "shells.nrrd", "--tau", "1e9", says="above every sample")


if __name__ == "__main__":
    harness.main()
