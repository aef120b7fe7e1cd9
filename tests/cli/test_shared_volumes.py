"""Real volumes, where they lie beside the checkout: the same store in any memory, on any number of threads; from it the answers of the volume.

Volumes up to 2 million samples; ISOATLAS_ALL_DATA=1 takes all."""
import os
import pathlib
import unittest

import harness

DATA = pathlib.Path(os.environ["ISOATLAS_SOURCE"]).resolve().parent / "shared" / "data"
MOST = 2 ** 62 if os.environ.get("ISOATLAS_ALL_DATA") else 2 * 10 ** 6
PARTS = (0.15, 0.4, 0.8)  # of the range of values: isovalues; without ISOATLAS_ALL_DATA each volume has one of them
SUFFIXES = {".nrrd", ".mha", ".nii", ".gz", ".vti", ".npy", ".tif", ".mhd"}


def candidates():
    return sorted(path for path in DATA.rglob("*") if path.is_file() and path.suffix in SUFFIXES and "original" not in path.parts)


@unittest.skipUnless(DATA.is_dir(), "no shared data beside the checkout")
class SharedVolumes(harness.CliTest):
    def same_file(self, suffix, volume, verb, *options):
        """Runs a verb on the volume and on its store."""
        written = []
        for source in (volume, "a.atlas"):
            name = f"{len(written)}{suffix}"
            done = self.start([verb, source, *options, "-o", name, "--quiet"])
            written.append((done.returncode, (self.folder / name).read_bytes() if done.returncode == 0 else done.stderr.split("Next:")[-1].replace(str(source), "FILE")))
            (self.folder / name).unlink(missing_ok=True)
        self.assertEqual(*written, msg=f"{volume} {verb} {options}")

    def check(self, volume, parts):
        self.run_ok("build", volume, "-o", "a.atlas", "--threads", "1")
        least = self.run_json("build", volume, "-o", "b.atlas", "--dry-run")["estimate"]["min_memory"]
        # A sanitizer takes more than the budget by itself: arrays would be unmapped at every step (minutes a build).
        memory = [] if harness.SANITIZED else ["--memory", f"{(least >> 20) + 1}M"]
        told = self.run_json("build", volume, "-o", "b.atlas", *memory, "--threads", "3")
        if not harness.SANITIZED:
            self.assertLess(told["peak_memory"], ((least >> 20) + 1) * 2 ** 20 * 1.1, volume)
        self.assertEqual((self.folder / "a.atlas").read_bytes(), (self.folder / "b.atlas").read_bytes(), volume)
        values = self.run_json("info", "a.atlas")["values"]  # without fill values
        low, high = values["low"], values["high"]
        for part in parts:
            tau = repr(low + part * (high - low))
            self.same_file(".ply", volume, "extract", "--tau", tau)
            self.same_file(".nrrd", volume, "label", "--tau", tau)
            for verb in (["objects"], ["measure", "--no-percolation"]):
                one, other = (self.run_json(*verb, source, "--tau", tau) for source in (volume, "a.atlas"))
                self.assertEqual(one["objects"], other["objects"], volume)
        self.same_file(".ply", volume, "extract", "--best")
        self.same_file(".csv", volume, "tree", "--detail", "events")
        one, other = (self.run_json("objects", source) for source in (volume, "a.atlas"))
        self.assertEqual(one["objects"], other["objects"], volume)

    def test_stores_answer_as_their_volumes(self):
        checked = 0
        for path in candidates():
            done = self.start(["info", path, "--json"])
            if done.returncode != 0:
                continue  # no volume, or one of several
            told = harness.json.loads(done.stdout)
            if "volume" not in told or told["time_steps"]["count"] > 1 or len(told["channels"]["names"]) > 1:
                continue
            if told["voxels"] > MOST or told["values"] is None:
                continue
            with self.subTest(volume=path.name):
                self.check(path, PARTS if os.environ.get("ISOATLAS_ALL_DATA") else [PARTS[checked % 3]])
                checked += 1
        print(checked, "volumes")
        self.assertGreater(checked, 10)


if __name__ == "__main__":
    unittest.main()
