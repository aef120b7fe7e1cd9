"""Selections: what the table, the simplified tree and the labels show, and what they say is hidden."""
import csv
import json
import re
import struct
import unittest

import harness

try:
    import networkx
except ImportError:
    networkx = None


class Selection(harness.CliTest):
    phantoms = {"figure.nrrd": ["figure-plateau"], "noise.nrrd": ["noise", "--size", "12", "--quantise", "64"], "one.npy": ["noise", "--size", "1"]}

    def test_the_table(self):
        everything = self.run_json("objects", "figure.nrrd", "--all")
        self.assertEqual(everything["hidden"], 0)
        kept = self.run_json("objects", "figure.nrrd", "--keep", "2")
        self.assert_schema(kept, "objects")
        self.assertEqual(kept["hidden"], 2)
        self.assertEqual({o["merges"] for o in kept["objects"]}, {None, 40})
        self.assertEqual(self.run_json("objects", "figure.nrrd", "--top", "50%")["objects"], kept["objects"])
        for words in (["--persistence", "40"], ["--persistence", "40%"], ["--min-voxels", "145"], ["--min-volume", "1e3"]):
            self.assertLess(self.run_json("objects", "figure.nrrd", *words)["hidden"], 4, words)
        self.assertIn("2 hidden", self.run_ok("objects", "figure.nrrd", "--keep", "2").stderr)

    def test_the_simplified_tree(self):
        tree = self.run_json("tree", "figure.nrrd", "--keep", "2")
        self.assert_schema(tree, "simplified-tree")
        self.assertEqual([(n["kind"], n["tau_high"], n["tau_low"], n["parent"]) for n in tree["nodes"]],
                         [("maximum", 100, 40, 2), ("maximum", 80, 40, 2), ("merge", 40, None, None)])
        self.assertEqual(sum(n["voxels"] for n in tree["nodes"]), 24 ** 3)
        self.assertIn("2 of 4 objects shown", self.run_ok("tree", "figure.nrrd", "--keep", "2").stdout)
        whole = self.run_json("tree", "figure.nrrd", "--keep", "99")
        self.assertEqual((whole["kept"], whole["hidden"], whole["hidden_voxels"]), (4, 0, 0))

    def written_tree(self, suffix, *source):
        done = self.run_json("tree", *source, "-o", "t" + suffix)
        self.assert_schema(done, "tree-file")
        return self.folder / ("t" + suffix), done

    def test_the_simplified_tree_as_files(self):
        self.run_ok("build", "noise.nrrd", "-o", "tree.atlas", "--quiet")
        for source in (["figure.nrrd", "--keep", "2"], ["noise.nrrd", "--top", "30%"], ["tree.atlas", "--persistence", "40%"], ["one.npy", "--keep", "1"]):
            told = self.run_json("tree", *source)
            path, done = self.written_tree(".json", *source)
            self.assertEqual(json.loads(path.read_text()), told)
            self.assertEqual((done["nodes"], done["hidden"]), (len(told["nodes"]), told["hidden"]))
            with open(self.written_tree(".csv", *source)[0], newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([(int(r["event"]), r["parent"], float(r["tau_high"]), int(r["voxels"])) for r in rows],
                             [(n["event"], "" if n["parent"] is None else str(n["parent"]), n["tau_high"], n["voxels"]) for n in told["nodes"]])
            self.assertEqual(self.lines_of_vtu(self.written_tree(".vtu", *source)[0]), [n["parent"] for n in told["nodes"] if n["parent"] is not None])
        self.assert_no_partial()

    def lines_of_vtu(self, path):
        """The array downNodeId of the lines."""
        before, after = re.split(rb'<AppendedData encoding="raw">\s*_', path.read_bytes(), maxsplit=1)
        found = re.search(rb'Name="downNodeId" format="appended" offset="(\d+)"', before)
        if found is None:
            return []
        offset = int(found[1])
        length = struct.unpack_from("<Q", after, offset)[0]
        return list(struct.unpack_from(f"<{length // 8}q", after, offset + 8))

    @unittest.skipUnless(networkx, "networkx is not installed")
    def test_networkx_reads_the_simplified_tree(self):
        for source in (["figure.nrrd", "--keep", "2"], ["noise.nrrd", "--top", "30%"]):
            told = self.run_json("tree", *source)
            graph = networkx.read_graphml(self.written_tree(".graphml", *source)[0])
            self.assertEqual({(int(a[1:]), int(b[1:])) for a, b in graph.edges},
                             {(i, n["parent"]) for i, n in enumerate(told["nodes"]) if n["parent"] is not None})
            self.assertEqual([graph.nodes[f"n{i}"]["voxels"] for i in range(len(graph))], [n["voxels"] for n in told["nodes"]])
            self.assertTrue(networkx.is_arborescence(graph.reverse()))

    def test_labels(self):
        label = self.run_json("label", "figure.nrrd", "--zones", "--keep", "2", "-o", "z.nrrd")
        self.assertEqual((label["labels"], label["labels_are"]), (3, "zones"))

    def test_cavities_and_stores(self):
        self.assertEqual(len(self.run_json("objects", "noise.nrrd", "--cavities", "--keep", "3")["objects"]), 3)
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        for words in (["objects", "--keep", "7"], ["objects", "--persistence", "30%"]):
            self.assertEqual(self.run_json(words[0], "noise.nrrd", *words[1:])["objects"], self.run_json(words[0], "noise.atlas", *words[1:])["objects"])

    def test_curves(self):
        self.run_ok("objects", "noise.nrrd", "--curve", "c.csv")
        with open(self.folder / "c.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["size"] for row in rows}, {"hypervolume", "persistence", "voxels"})
        self.assertEqual(int(rows[-1]["kept"]), self.run_json("objects", "noise.nrrd")["branches"])
        self.run_ok("objects", "noise.nrrd", "--curve", "c.json")
        self.assert_schema(self.load("c.json"), "curves")
        for name in ("noise.nrrd", "one.npy"):
            self.run_ok("objects", name, "--curve", "c.svg")
        self.assert_no_partial()

    def load(self, name):
        return json.loads((self.folder / name).read_text())

    def test_errors(self):
        self.run_error(2, "objects", "noise.nrrd", "--keep", "0", says="--keep")
        self.run_error(2, "objects", "noise.nrrd", "--top", "0", says="--top")
        self.run_error(2, "objects", "noise.nrrd", "--top", "101%", says="--top")
        self.run_error(2, "tree", "noise.nrrd", "--top", "5", says="--top")
        self.run_error(2, "objects", "noise.nrrd", "--persistence", "-1", says="--persistence")
        self.run_error(2, "objects", "noise.nrrd", "--keep", "3", "--all", says="--all")
        self.run_error(2, "objects", "noise.nrrd", "--keep", "3", "--tau", "5", says="selection")
        self.run_error(2, "objects", "noise.nrrd", "--curve", "c.png", says=".png")
        self.run_error(2, "tree", "noise.nrrd", "--keep", "3", "-o", "x.xyz", says=".xyz")
        self.run_error(2, "tree", "noise.nrrd", "--keep", "3", "--detail", "levels", says="detail")
        self.run_error(2, "label", "noise.nrrd", "--tau", "5", "--keep", "3", "-o", "x.nrrd", says="--zones")


if __name__ == "__main__":
    harness.main()
