"""OpenVDB and GDCM are loaded when a file needs them; a program without them says so, and reads everything else."""
import os
import pathlib
import shutil
import subprocess

import harness
from harness import CliTest

PARTS = sorted(pathlib.Path(harness.CLI).parent.parent.glob("lib*/**/isoatlas/*-*.so"))
NAMES = {"openvdb": "OpenVDB", "gdcm": "GDCM"}


@harness.unittest.skipUnless(PARTS, "this program links its libraries")
class OnDemand(CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "32"]}

    def setUp(self):
        corpus = pathlib.Path(os.environ["ISOATLAS_SOURCE"]) / "tests/fuzz/corpus"
        self.files = {"openvdb": self.folder / "v.vdb", "gdcm": self.folder / "one/v.dcm"}  # not among others, which may be of its series
        self.files["gdcm"].parent.mkdir(exist_ok=True)
        shutil.copy(corpus / "openvdb/leaf", self.files["openvdb"])
        shutil.copy(corpus / "dicom/jpeg", self.files["gdcm"])

    def test_the_program_itself_links_neither(self):
        needed = subprocess.run(["ldd", harness.CLI], capture_output=True, text=True, check=True).stdout
        for name in ("libopenvdb", "libgdcm"):
            self.assertNotIn(name, needed)

    def test_files_that_need_them_are_read_and_written(self):
        for file in self.files.values():
            self.run_ok("info", file)
        self.run_ok("label", "demo.nrrd", "--tau", "90", "-o", "labels.vdb")
        self.run_ok("info", "labels.vdb")

    def test_without_a_part(self):
        """Also where its file is damaged: nothing else is lost, and nothing is written."""
        alone = self.folder / "alone/bin/isoatlas"
        alone.parent.mkdir(parents=True)
        shutil.copy(harness.CLI, alone)
        for part in PARTS:
            name = part.name.split("-")[0]
            lacking = alone.parent.parent / part.relative_to(pathlib.Path(harness.CLI).parent.parent)
            for damage in (None, b"no library"):
                lacking.parent.mkdir(parents=True, exist_ok=True)
                if damage:
                    lacking.write_bytes(damage)
                done = subprocess.run([alone, "info", self.files[name], "--json"], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 4, done)
                self.assertIn(f"uses {NAMES[name]} cannot be loaded", done.stderr)
                self.assertIn(str(lacking), done.stderr)
        done = subprocess.run([alone, "label", "demo.nrrd", "--tau", "90", "-o", "none.vdb"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 4, done)
        self.assertFalse((self.folder / "none.vdb").exists())
        self.assert_no_partial()
        subprocess.run([alone, "info", self.folder / "demo.nrrd"], capture_output=True, check=True)


if __name__ == "__main__":
    harness.main()
