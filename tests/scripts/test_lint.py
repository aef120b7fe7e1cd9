#!/usr/bin/env python3
"""Which sources are linted when only changed ones are: those that differ from a revision, and those that include what differs."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

SOURCE = pathlib.Path(os.environ["ISOATLAS_SOURCE"])
sys.path.insert(0, str(SOURCE / "scripts"))
import lint  # noqa: E402

FILES = {
    "include/isoatlas/volume.h": "",
    "src/base/sort.h": '#include "isoatlas/volume.h"\n',
    "src/base/sort.cpp": '#include "base/sort.h"\n',
    "src/tree/join.cpp": '#include "base/sort.h"\n',
    "src/tree/split.cpp": "",
    "src/image/png.cpp": '#include <vector>\n',
    ".clang-tidy": "",
}


class Lint(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        for name, text in FILES.items():
            self.write(name, text)
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("-c", "user.name=test", "-c", "user.email=test@example.org", "commit", "--quiet", "-m", "all")
        self.enterContext(unittest.mock.patch.object(lint, "ROOT", self.root))

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def git(self, *words):
        subprocess.run(["git", "-C", self.root, *words], check=True, capture_output=True)

    def folders(self, revision):
        """The folders that are linted."""
        sources = [path for path in self.root.glob("src/*/*.cpp")]
        units = [(folder, [path for path in sources if path.parent.name == folder]) for folder in ("base", "tree", "image")]
        return [folder for folder, _ in lint.units_to_lint(units, revision)]

    def test_nothing_differs(self):
        self.assertEqual(self.folders("HEAD"), [])

    def test_a_source(self):
        self.write("src/tree/split.cpp", "int one;\n")
        self.assertEqual(self.folders("HEAD"), ["tree"])

    def test_a_header_that_is_included_by_way_of_another(self):
        self.write("include/isoatlas/volume.h", "int one;\n")
        self.assertEqual(self.folders("HEAD"), ["base", "tree"])

    def test_a_source_that_git_does_not_know_yet(self):
        self.write("src/image/gif.cpp", "")
        self.assertEqual(self.folders("HEAD"), ["image"])

    def test_everything_when_the_checks_or_the_revision_are_others(self):
        self.assertEqual(self.folders(None), ["base", "tree", "image"])
        self.assertEqual(self.folders("HEAD~40"), ["base", "tree", "image"])
        self.write(".clang-tidy", "Checks: all\n")
        self.assertEqual(self.folders("HEAD"), ["base", "tree", "image"])


if __name__ == "__main__":
    unittest.main()
