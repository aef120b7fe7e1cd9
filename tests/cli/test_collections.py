"""Files of several channels and time steps: a folder of stores with an index, and what becomes of it when something is wrong."""
import json
import os
import shutil
import signal
import subprocess

import harness

SIDE, STEPS = 12, 3


class Collections(harness.CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        header = f"NRRD0004\ntype: uint8\ndimension: 4\nsizes: {SIDE} {SIDE} {SIDE} {STEPS}\nspacings: 1 1 1 2\nencoding: raw\n\n".encode()
        samples = bytes((x * x + y * 7 * (t + 1) + z * 13) % 251 for t in range(STEPS) for z in range(SIDE) for y in range(SIDE) for x in range(SIDE))
        (cls.folder / "steps.nrrd").write_bytes(header + samples)

    def setUp(self):
        shutil.rmtree(self.folder / "steps.atlases", ignore_errors=True)

    def index(self):
        return json.loads((self.folder / "steps.atlases/collection.json").read_text())

    def test_stores_are_those_of_each_volume(self):
        built = self.run_json("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        self.assert_schema(built, "build-all")
        self.assert_schema(self.index(), "collection")
        self.assertEqual([one["file"] for one in built["stores"]], [f"time-{t}.atlas" for t in range(STEPS)])
        for t in range(STEPS):
            self.run_ok("build", "steps.nrrd", "--time-step", str(t), "-o", f"own{t}.atlas", "--restart")
            chosen = self.run_json("objects", "steps.atlases", "--time-step", str(t))["objects"]
            self.assertEqual(chosen, self.run_json("objects", f"own{t}.atlas")["objects"])
            self.assertEqual(chosen, self.run_json("objects", "steps.nrrd", "--time-step", str(t))["objects"])
        self.run_ok("verify", "steps.atlases/collection.json", "--time-step", "1")

    def test_a_choice_is_needed_and_info_lists_them(self):
        self.run_ok("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        error = self.run_error(2, "objects", "steps.atlases", says="holds 3 volumes")
        self.assertIn("--time-step", error["next"])
        self.run_error(2, "objects", "steps.atlases", "--time-step", "3", says="has no time step 3")
        self.run_error(2, "objects", "steps.atlases", "--time-step", "0", "--channel", "1", says="channel")
        self.assertEqual(self.run_json("info", "steps.atlases")["time_steps"]["count"], STEPS)
        self.assertEqual(self.run_json("info", "steps.atlases", "--time-step", "2")["time_steps"]["time_step"], 2)

    def test_what_is_there_is_kept(self):
        self.run_ok("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        before = {path.name: path.read_bytes() for path in (self.folder / "steps.atlases").iterdir()}
        (self.folder / "steps.atlases/time-1.atlas").unlink()
        again = self.run_json("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        self.assertEqual([one["was_there"] for one in again["stores"]], [True, False, True])
        self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "steps.atlases").iterdir()}, before)
        self.run_error(2, "build", "steps.nrrd", "--all", "-o", "steps.atlases", "--interpolant", "faces", says="other samples or options")
        self.run_ok("build", "steps.nrrd", "--all", "-o", "steps.atlases", "--interpolant", "faces", "--restart")

    def test_an_interrupt_leaves_no_index(self):
        command = [harness.CLI, "build", "steps.nrrd", "--all", "-o", "steps.atlases"]
        process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            if "store 2 of 3" in line:
                process.send_signal(signal.SIGSTOP)  # so that it is not finished when the interrupt arrives
                process.send_signal(signal.SIGINT)
                process.send_signal(signal.SIGCONT)
                break
        process.stderr.read()
        process.stderr.close()
        code = process.wait()
        if code != 0:  # else it had ended before
            self.assertFalse((self.folder / "steps.atlases/collection.json").exists())
            self.run_error(3, "objects", "steps.atlases", "--time-step", "0")
        self.run_ok("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        self.assertEqual(len(self.index()["stores"]), STEPS)

    def test_a_damaged_index_has_one_message(self):
        self.run_ok("build", "steps.nrrd", "--all", "-o", "steps.atlases")
        path = self.folder / "steps.atlases/collection.json"
        good = path.read_text()
        for changed in ("", "[]", "{", good[:-20], good.replace("collection/1", "collection/9"), good.replace("time-0.atlas", "../own.atlas"),
                        good.replace("time-0.atlas", "/etc/own.atlas"), good.replace('"time_step":1', '"time_step":0'),
                        good.replace('"time_steps": 3', '"time_steps": 3000000000'), good.replace('"time_steps": 3', '"time_steps": 2'),
                        good.replace('"channels": [""]', '"channels": []'), good.replace('"times"', '"tides"'), "[" * 100000):
            path.write_text(changed)
            self.run_error(3, "objects", "steps.atlases", "--time-step", "0")
        path.write_text(good)
        (self.folder / "steps.atlases/time-0.atlas").unlink()
        self.run_error(3, "objects", "steps.atlases", "--time-step", "0", says="time-0.atlas")
        self.run_ok("objects", "steps.atlases", "--time-step", "1")

    def test_options_that_contradict(self):
        self.run_error(2, "build", "steps.nrrd", "--all", says="--output")
        self.run_error(2, "build", "steps.nrrd", "--all", "-o", "x.atlas", says="folder")
        self.run_error(2, "build", "steps.nrrd", "--all", "--time-step", "0", "-o", "y", says="--all")
        self.assertFalse((self.folder / "y").exists())
        (self.folder / "file").write_text("")
        self.run_error(5, "build", "steps.nrrd", "--all", "-o", "file")
        self.assertEqual((self.folder / "file").read_text(), "")
        self.run_ok("build", "steps.nrrd", "--all", "--dry-run")

    def test_one_volume_is_a_collection_too(self):
        self.run_ok("phantom", "noise", "--size", "12", "-o", "one.nrrd")
        self.run_ok("build", "one.nrrd", "--all", "-o", "one.atlases")
        self.assertEqual(sorted(os.listdir(self.folder / "one.atlases")), ["collection.json", "volume.atlas"])
        self.run_ok("objects", "one.atlases")


if __name__ == "__main__":
    harness.main()
