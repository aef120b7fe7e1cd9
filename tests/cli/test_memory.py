"""--memory holds: the peak of a build is at most the budget and a tenth, or it is refused with a budget that holds (bench/memory/matrix.py)."""
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["ISOATLAS_SOURCE"]) / "bench" / "memory"))
import kinds  # noqa: E402
import matrix  # noqa: E402

SIZES, BUDGETS = [16, 32, 48], [80, 96, 128]  # the bench has larger ones

# Arrays of these take more than their budgets: where memory is bounded by work in parts.
LARGE = {"checkerboard": 96, "noise of 2": 112}


@unittest.skipIf(os.environ.get("ISOATLAS_SANITIZE"), "memory is mostly that of the sanitizer")
class Memory(unittest.TestCase):
    def check(self, cells):
        for cell in cells:
            with self.subTest(cell["kind"], size=cell["size"], budget=cell["budget"]):
                self.assertTrue(cell["holds"], cell)

    def setUp(self):
        held = tempfile.TemporaryDirectory(prefix="isoatlas-memory-")
        self.addCleanup(held.cleanup)
        self.matrix = matrix.Matrix(os.environ["ISOATLAS_CLI"], held.name)

    def test_every_kind(self):
        self.assertGreaterEqual(len(kinds.KINDS), 20)
        for kind in kinds.KINDS:
            for n in SIZES:
                self.check(self.matrix.volume(kind, n, BUDGETS))

    def test_what_does_not_fit(self):
        for kind, n in LARGE.items():
            self.check(self.matrix.volume(kind, n, [80]))

    def test_a_refusal_names_a_budget_that_holds(self):
        cells = self.matrix.volume("image of one value", 160, [80])
        self.check(cells)
        self.assertIn("named", cells[0])
        _, _, _, program, _ = matrix.run([os.environ["ISOATLAS_CLI"], "--version"])
        self.assertLess(cells[0]["refused_peak"], program / matrix.MIB + 32)  # before the work


if __name__ == "__main__":
    unittest.main()
