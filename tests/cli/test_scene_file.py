"""`isoatlas view --scene FILE`: what is checked before a page opens, and what it begins with."""
import copy
import json

import harness
import served


class Scenes(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "32"], "other.nrrd": ["demo", "--size", "40"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name in ("demo", "other"):
            done = cls.start(["build", f"{name}.nrrd", "-o", f"{name}.atlas"])
            assert done.returncode == 0, done.stderr
        entry = {"entry": 0, "id": 1, "tau": 100.5, "opacity": 1, "visible": True, "colour": None, "walls": "all", "name": "the {first} one"}
        cls.scene = {"schema": "isoatlas/scene/1", "volume": {"name": "demo", "size": [32, 32, 32]}, "shown": [entry], "selected": 0,
                     "view": [0, 0, 100, 1.5, 2, 3], "parts": {"flat": "1"}}

    def write(self, text):
        (self.folder / "a.scene.json").write_text(text if isinstance(text, str) else json.dumps(text))

    def refused(self, code, says, where="", volume="demo.atlas"):
        error = self.run_error(code, "view", volume, "--no-browser", "--scene", "a.scene.json", says=says)
        self.assertEqual((error["file"], error["where"]), ("a.scene.json", where))
        self.assertNotEqual(error["next"], "")
        return error

    def test_a_scene_is_served(self):
        self.write(self.scene)
        viewer = served.Viewer(self.folder, "demo.atlas", "--scene", "a.scene.json")
        status, _, body = viewer.ask("/api/scene")
        told = json.loads(body)
        self.assertEqual((status, told["scene"], told["file"]), (200, self.scene, "a.scene.json"))
        self.assert_schema(told, "server-scene")
        self.assertEqual(viewer.ask("/api/scene?x=1")[0], 400)
        self.assertEqual(viewer.ask("/api/scene", token="")[0], 403)
        self.assertEqual(viewer.stop()[0], 0)

    def test_without_one(self):
        viewer = served.Viewer(self.folder, "demo.atlas")
        told = json.loads(viewer.ask("/api/scene")[2])
        self.assertIsNone(told["scene"])
        self.assert_schema(told, "server-scene")
        status, told = viewer.change("/api/scene", data=json.dumps(self.scene).encode())
        self.assertEqual((status, told["version"]), (200, 1))
        self.assert_schema(told, "server-scene-version")
        told = json.loads(viewer.ask("/api/scene")[2])
        self.assertEqual((told["scene"], told["version"]), (self.scene, 1))
        self.assert_schema(told, "server-scene")
        self.assertEqual(viewer.change("/api/scene?after=0", data=json.dumps(self.scene).encode())[0], 409)
        self.assertEqual(viewer.change("/api/scene")[0], 400)
        self.assertEqual(viewer.stop()[0], 0)

    def test_a_file_that_is_not_there(self):
        (self.folder / "a.scene.json").unlink(missing_ok=True)
        self.refused(3, "No such file")

    def test_not_json(self):
        for text, byte in (("", 1), ("not a scene", 2), (json.dumps(self.scene)[:-1], len(json.dumps(self.scene)))):
            self.write(text)
            error = self.refused(3, "not JSON", f"byte {byte}")
            self.assertIn("isoatlas/scene/1", error["expected"])
        self.write("[" * 100000)
        self.refused(3, "8 levels")

    def test_not_a_scene(self):
        self.write("[]")
        self.refused(3, "not a scene")
        for path, value, where in (("schema", "isoatlas/page/1", "schema"), ("view", [1, 2], "view"), ("selected", 0.5, "selected"),
                                   ("parts", {"flat": 1}, "parts"), ("shown", {}, "shown"), ("volume", [], "volume")):
            scene = copy.deepcopy(self.scene)
            scene[path] = value
            self.write(scene)
            self.assertNotEqual(self.refused(3, "not a scene", where)["expected"], "")
            del scene[path]
            self.write(scene)
            self.refused(3, "missing", where)
        for name, value in (("entry", "1"), ("tau", None), ("visible", 1), ("walls", "none"), ("colour", 3), ("id", 0.5)):
            scene = copy.deepcopy(self.scene)
            scene["shown"][0][name] = value
            self.write(scene)
            self.refused(3, "not a scene", f"shown[0].{name}")

    def test_of_another_volume(self):
        self.write(self.scene)
        for volume in ("other.atlas", "other.nrrd"):
            error = self.refused(2, "of another volume, demo, of 32 x 32 x 32 samples", "volume.size", volume)
            self.assertIn("40 x 40 x 40", error["expected"])
        (self.folder / "new.nrrd").write_bytes((self.folder / "other.nrrd").read_bytes())
        self.refused(2, "of another volume", "volume.size", "new.nrrd")
        self.assertFalse((self.folder / "new.atlas").exists())   # refused before a build


if __name__ == "__main__":
    harness.main()
