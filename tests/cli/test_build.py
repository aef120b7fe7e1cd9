"""Building stores: killed anywhere and run again, in any memory, two at once, refused before it starts."""
import hashlib
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import time

import harness


class Builds(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "72", "--quantise", "64"],
                "field.nrrd": ["random-field", "--size", "48", "--quantise", "256"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        started = time.monotonic()
        assert cls.start(["build", "noise.nrrd", "-o", "noise.atlas"]).returncode == 0
        cls.seconds = time.monotonic() - started
        cls.wanted = cls.digest("noise.atlas")

    @classmethod
    def digest(cls, name):
        return hashlib.sha256((cls.folder / name).read_bytes()).hexdigest()

    def left(self, name):
        return sorted(path.name for path in self.folder.iterdir() if path.name.startswith(name + "."))

    def begin(self, *arguments):
        return subprocess.Popen([harness.CLI, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def test_killed_anywhere_it_goes_on_and_makes_the_same_bytes(self):
        seed = int(os.environ.get("ISOATLAS_SEED", random.randrange(1 << 30)))
        print("seed", seed)
        chance = random.Random(seed)
        resumed = 0
        for _ in range(25):
            (self.folder / "killed.atlas").unlink(missing_ok=True)
            builder = self.begin("build", "noise.nrrd", "-o", "killed.atlas")
            time.sleep(chance.random() * self.seconds)
            builder.send_signal(signal.SIGKILL)
            builder.communicate()
            if (self.folder / "killed.atlas").exists():
                self.assertEqual(self.digest("killed.atlas"), self.wanted)
                continue
            told = self.run_json("build", "noise.nrrd", "-o", "killed.atlas")
            resumed += bool(told["resumed"])
            self.assertEqual(self.digest("killed.atlas"), self.wanted)
            self.assertEqual(self.left("killed.atlas"), [])
        print("went on from a finished phase", resumed, "times")

    def stop_after(self, phase, *words):
        """Builds until a phase is finished, then kills."""
        builder = self.begin("build", *(words or ["noise.nrrd"]), "-o", "stopped.atlas")
        finished = self.folder / "stopped.atlas.build" / phase
        while not finished.exists() and builder.poll() is None:
            time.sleep(0.001)
        builder.send_signal(signal.SIGKILL)
        builder.communicate()
        return finished.exists()

    def test_finished_phases_are_used_unless_they_belong_to_something_else(self):
        for _ in range(20):
            if self.stop_after("trees"):
                break
            (self.folder / "stopped.atlas").unlink(missing_ok=True)
        else:
            self.skipTest("too fast to be stopped between two phases")
        phase = self.folder / "stopped.atlas.build" / "trees"
        held, mark = phase.read_bytes(), (phase.parent / "lock").read_bytes()
        self.run_error(3, "info", str(phase))  # not a store
        self.assertIn("trees", self.run_json("build", "noise.nrrd", "-o", "stopped.atlas")["resumed"])
        self.assertEqual(self.digest("stopped.atlas"), self.wanted)

        def again(bytes_of_phase, *options, volume="noise.nrrd"):
            phase.parent.mkdir(exist_ok=True)
            (phase.parent / "lock").write_bytes(mark)
            phase.write_bytes(bytes_of_phase)
            return self.run_json("build", volume, "-o", "stopped.atlas", *options)["resumed"]
        self.assertEqual(again(held), ["trees"])
        self.assertEqual(again(held, "--restart"), [])
        self.assertEqual(again(held[:-1]), [])
        damaged = bytearray(held)
        damaged[len(held) // 2] ^= 1
        self.assertEqual(again(bytes(damaged)), [])
        self.assertEqual(self.digest("stopped.atlas"), self.wanted)
        self.assertEqual(again(held, "--interpolant", "faces"), [])
        self.assertEqual(again(held, volume="field.nrrd"), [])

    def test_phases_of_other_lengths_are_not_used_and_the_difference_is_said(self):
        """A finished phase holds volumes of objects in the unit of the file: another spacing is another build."""
        samples = bytes(random.Random(3).choices(range(64), k=72 ** 3))
        (self.folder / "scan.raw").write_bytes(samples)
        (self.folder / "scan.raw.json").write_text('{"dims": [72, 72, 72], "type": "uint8"}')
        self.run_ok("build", "scan.raw", "--spacing", "2,2,2", "-o", "uninterrupted.atlas")
        for _ in range(20):
            (self.folder / "stopped.atlas").unlink(missing_ok=True)
            if self.stop_after("zones", "scan.raw", "--spacing", "1,1,1"):
                break
        else:
            self.skipTest("too fast to be stopped between two phases")
        (self.folder / "stopped.atlas").unlink(missing_ok=True)
        told = self.run_json("build", "scan.raw", "--spacing", "2,2,2", "-o", "stopped.atlas")
        self.assert_schema(told, "build")
        self.assertEqual(told["resumed"], [])
        self.assertEqual(told["not_used"], ["trees, zones of an earlier build are not used: spacing 1 x 1 x 1 there, 2 x 2 x 2 here"])
        self.assertEqual(self.digest("stopped.atlas"), self.digest("uninterrupted.atlas"))
        (self.folder / "stopped.atlas").unlink()

    def test_interrupted_it_keeps_what_is_finished_and_says_so(self):
        builder = self.begin("build", "noise.nrrd", "-o", "interrupted.atlas")
        finished = self.folder / "interrupted.atlas.build" / "lock"
        while not finished.exists() and builder.poll() is None:
            time.sleep(0.001)
        builder.send_signal(signal.SIGINT)
        said = builder.communicate()[1]
        self.assertEqual(builder.returncode, 130)
        self.assertIn("resumes", said)
        self.assertFalse((self.folder / "interrupted.atlas").exists())
        self.run_ok("build", "noise.nrrd", "-o", "interrupted.atlas")
        self.assertEqual(self.digest("interrupted.atlas"), self.wanted)

    def test_two_builders_of_one_store(self):
        first = self.begin("build", "noise.nrrd", "-o", "both.atlas")
        lock = self.folder / "both.atlas.build" / "lock"
        while not (lock.exists() and lock.read_text()) and first.poll() is None:
            time.sleep(0.001)
        first.send_signal(signal.SIGSTOP)
        try:
            self.run_error(5, "build", "noise.nrrd", "-o", "both.atlas", says="another process, %d" % first.pid)
        finally:
            first.send_signal(signal.SIGCONT)
        first.communicate()
        self.assertEqual(first.returncode, 0)
        self.assertEqual(self.digest("both.atlas"), self.wanted)

    def test_memory_is_kept_and_changes_nothing(self):
        self.run_ok("phantom", "noise", "--size", "160", "--quantise", "64", "-o", "large.nrrd")
        self.run_ok("build", "large.nrrd", "-o", "large.atlas", "--memory", "2G")
        for megabytes in (96, 200):
            told = self.run_json("build", "large.nrrd", "-o", "small.atlas", "--memory", f"{megabytes}M")
            self.assertEqual(self.digest("small.atlas"), self.digest("large.atlas"))
            if not harness.SANITIZED:
                self.assertLess(told["peak_memory"], megabytes * 1.1 * 2 ** 20)
        self.assertEqual(self.left("small.atlas"), [])

    def test_estimates_and_refusals(self):
        told = self.run_json("build", "noise.nrrd", "-o", "dry.atlas", "--dry-run", "--memory", "100M")["estimate"]
        self.assertEqual(told["budget"], 100 * 2 ** 20)
        self.assertGreater(told["critical_elements"], 0.5 * 72 ** 3)
        self.assertEqual(self.run_json("build", "noise.nrrd", "--dry-run", "--memory", "100M")["estimate"]["store_bytes"], told["store_bytes"])
        self.run_error(2, "build", "noise.nrrd", says="needs --output FILE")
        self.assertFalse((self.folder / "dry.atlas").exists())
        self.assertEqual(self.left("dry.atlas"), [])
        with open(self.folder / "huge.raw", "wb") as huge:
            huge.truncate(40000 ** 2 * 4)  # a hole: two slices would be too much for the budget
        shape = ["--dims", "40000x40000x4", "--type", "uint8"]
        self.run_error(5, "build", "huge.raw", *shape, "-o", "huge.atlas", "--memory", "80M", says="memory budget")
        self.run_error(5, "build", "huge.raw", *shape, "-o", "huge.atlas", "--memory", "80M", "--dry-run", says="memory budget")
        for size in ("1", "10M", "a lot", "-1G", "1e400G"):
            self.run_error(2, "build", "noise.nrrd", "-o", "dry.atlas", "--memory=" + size, says="--memory")


if __name__ == "__main__":
    harness.main()
