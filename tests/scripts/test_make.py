#!/usr/bin/env python3
"""What `make demo`, `make install` and others do with the paths and the data that they get: with a build that is there already, a program
isoatlas and a cmake that only pretend."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ISOATLAS_SOURCE"])
ISOATLAS = r"""#!/bin/bash
echo "$*" >>"$FAKE/calls"
output="" previous=""
for word in "$@"; do
    [[ $previous != -o ]] || output=$word
    previous=$word
done
[[ $1 != extract || ! -e $FAKE/broken ]] || { echo "it is broken" >&2; exit 1; }
[[ -z $output ]] || echo "$*" >"$output"
case $1 in
    info) echo '{"rank":3}' ;;
    objects) [[ " $* " != *" --json "* ]] || for ((n = 1; n <= FAKE_OBJECTS; n++)); do echo "{\"number\": $n, \"best_tau\": 1}"; done ;;
    verify) echo "it: all 8 guarantees hold" ;;
esac
"""


class Make(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.folder.chmod(0o755)
        self.repository = self.folder / "a clone"
        shutil.copytree(SOURCE / "scripts", self.repository / "scripts")
        shutil.copy(SOURCE / "Makefile", self.repository)
        self.program(self.repository / "scripts/bootstrap.sh", "#!/bin/sh\n")
        self.program(self.repository / "scripts/build.sh", '#!/bin/sh\necho "build $*" >>"$FAKE/calls"\n')
        self.program(self.repository / "build/release/bin/isoatlas", ISOATLAS)
        self.program(self.folder / "bin/cmake", '#!/bin/sh\necho "cmake $*" >>"$FAKE/calls"\n')
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()

    def program(self, path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def calls(self):
        path = self.folder / "calls"
        return path.read_text().splitlines() if path.exists() else []

    def make(self, *words, folder=None, user=None, **environment):
        folder = folder or self.repository
        inherited = {"PATH": f"{self.folder / 'bin'}:/usr/bin:/bin", "HOME": str(self.folder), "PWD": str(folder), "FAKE": str(self.folder),
                     "FAKE_OBJECTS": "5"}
        return subprocess.run(["make", "-C", self.repository, *words], cwd=folder, env=inherited | environment, user=user, text=True,
                              capture_output=True, timeout=120)

    def test_demo_counts_its_surfaces(self):
        for count, expected in ((5, "a surface for each of the first 5,"), (3, "a surface for each of the first 3,"), (1, "a surface for the first,"),
                                (0, "nothing in this volume rises")):
            with self.subTest(count=count):
                done = self.make("demo", FAKE_OBJECTS=str(count))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(expected, done.stdout)
                self.assertEqual(len(list((self.repository / "demo").glob("object_*.ply"))), count)

    def test_failed_demo_leaves_the_earlier_one_whole(self):
        self.assertEqual(self.make("demo").returncode, 0)
        held = {path.name: path.read_bytes() for path in (self.repository / "demo").iterdir()}
        (self.folder / "broken").touch()
        (self.elsewhere / "other.nrrd").touch()
        done = self.make("demo", f"VOLUME={self.elsewhere / 'other.nrrd'}")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual({path.name: path.read_bytes() for path in (self.repository / "demo").iterdir()}, held)
        self.assertFalse((self.repository / "demo.before").exists())

    def test_volume_is_relative_to_the_caller(self):
        (self.elsewhere / "scan.nrrd").touch()
        done = self.make("demo", "VOLUME=scan.nrrd", folder=self.elsewhere)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(any(f"extract {self.elsewhere}/scan.nrrd" in line for line in self.calls()), self.calls())
        # What is printed can be pasted there.
        self.assertIn(f"{self.repository}/demo/demo.atlas.html", done.stdout)

    def test_volume_of_the_repository_from_elsewhere(self):
        (self.repository / "mine.nrrd").touch()
        done = self.make("demo", "VOLUME=mine.nrrd", folder=self.elsewhere)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(any("extract mine.nrrd" in line for line in self.calls()))

    def test_volume_with_a_tilde(self):
        (self.folder / "scan.nrrd").touch()
        self.assertEqual(self.make("demo", "VOLUME=~/scan.nrrd").returncode, 0)
        self.assertTrue(any(f"extract {self.folder}/scan.nrrd" in line for line in self.calls()))

    def test_volume_that_is_not_there(self):
        done = self.make("demo", "VOLUME=none.nrrd", folder=self.elsewhere)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"there is no {self.elsewhere}/none.nrrd, and no {self.repository}/none.nrrd", done.stderr)
        self.assertEqual(self.calls(), [])  # before anything is built

    def test_install_replaces_the_tilde(self):
        self.assertEqual(self.make("install", "PREFIX=~/x y").returncode, 0)
        self.assertIn(f"cmake --install build/release --prefix {self.folder}/x y", self.calls())

    def test_install_is_relative_to_the_caller(self):
        self.assertEqual(self.make("install", "PREFIX=there", folder=self.elsewhere).returncode, 0)
        self.assertIn(f"cmake --install build/release --prefix {self.elsewhere}/there", self.calls())

    def test_install_where_one_may_not_write(self):
        places = [("/dev/null/x", None)]
        if os.getuid() == 0:
            places.append(("", 65534))
        for prefix, user in places:
            with self.subTest(prefix=prefix, user=user):
                done = self.make("install", *([f"PREFIX={prefix}"] if prefix else []), user=user)
                self.assertEqual(done.returncode, 2)
                self.assertIn(f"may not write to {prefix or '/usr/local'} ", done.stderr)
                self.assertIn("Next: make install PREFIX=~/.local", done.stderr)
                self.assertEqual(self.calls(), [])  # before anything is built

    def test_targets_that_need_data_say_so(self):
        makefile = (self.repository / "Makefile").read_text()
        targets = re.findall(r"^([a-z0-9]+): shared_data", makefile, re.MULTILINE)
        self.assertEqual(targets, ["studies", "table131"])
        listed = self.make("help").stdout
        for target in targets:
            with self.subTest(target=target):
                done = self.make(target)
                self.assertEqual(done.returncode, 2)
                self.assertIn("needs the volumes of ../shared/data", done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                self.assertRegex(listed, rf"make {target} .*\(needs \.\./shared/data\)")
        self.assertEqual(self.calls(), [])


if __name__ == "__main__":
    unittest.main()
