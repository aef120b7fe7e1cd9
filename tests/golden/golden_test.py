"""Every golden store opens, passes verify, and answers what it did when it was made. What the present version would write does not matter."""
import json
import pathlib
import unittest

from answers import answers, run


class Golden(unittest.TestCase):
    maxDiff = 4000

    def test_stores_of_all_versions_answer_the_same(self):
        stores = sorted(pathlib.Path(__file__).parent.glob("*/*.atlas"))
        self.assertGreater(len(stores), 0)
        for store in stores:
            with self.subTest(store.parent.name + "/" + store.name):
                self.assertEqual(answers(store), json.loads(store.with_suffix(".json").read_text()))
                told = run("verify", store, "--full", "--levels", "2")
                self.assertEqual([check for check in told["checks"] if not check["holds"]], [])
                has_levels = any(check["name"] == "levels_keep_topology" for check in told["checks"])
                self.assertEqual(has_levels, pathlib.Path(f"{store}.lod").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
