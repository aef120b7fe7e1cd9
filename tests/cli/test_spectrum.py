"""What there is at every isovalue: as table, JSON, CSV and plot."""
import collections
import csv
import xml.etree.ElementTree

import harness


class Spectrum(harness.CliTest):
    phantoms = {"figure.nrrd": ["figure-plateau"], "noise.nrrd": ["noise", "--size", "12", "--quantise", "64"], "one.npy": ["noise", "--size", "1"]}

    def test_counts_are_those_of_objects(self):
        spectrum = self.run_json("spectrum", "figure.nrrd")
        self.assert_schema(spectrum, "spectrum")
        self.assertEqual(len(spectrum["sizes"]), 24)
        for tau in (95, 57, 39, 25, 10):
            at = self.run_json("objects", "figure.nrrd", "--tau", str(tau))
            inside = [i for i in spectrum["intervals"] if (i["low"] is None or i["low"] < tau) and tau <= i["high"]]
            self.assertEqual(len(inside), 1)
            self.assertEqual(inside[0]["merged"], 1)
            self.assertEqual(inside[0]["all"]["objects"], 2 * [at["object_count"]])
            self.assertEqual(inside[0]["all"]["contours"], 2 * [at["contour_count"]])
            self.assertEqual(inside[0]["all"]["tunnels"], 2 * [sum(o["b1"] for o in at["objects"])])
            self.assertEqual(inside[0]["all"]["cavities"], 2 * [sum(o["b2"] for o in at["objects"])])

    def test_many_intervals_are_put_together(self):
        self.run_ok("phantom", "noise", "--size", "20", "-o", "many.nrrd")
        brief = self.run_json("spectrum", "many.nrrd", "--samples", "0")
        whole = self.run_json("spectrum", "many.nrrd", "--samples", "0", "--all")
        self.assert_schema(whole, "spectrum")
        self.assertGreater(len(whole["intervals"]), 1000)
        self.assertLessEqual(len(brief["intervals"]), 512)
        self.assertEqual(brief["interval_count"], len(whole["intervals"]))
        self.assertEqual(whole["interval_count"], len(whole["intervals"]))
        at = 0
        for row in brief["intervals"]:
            inside = whole["intervals"][at:at + row["merged"]]
            at += row["merged"]
            self.assertEqual((row["high"], row["low"]), (inside[0]["high"], inside[-1]["low"]))
            for which in ("all", "significant"):
                for name, counts in row[which].items():
                    self.assertEqual(counts, [min(i[which][name][0] for i in inside), max(i[which][name][1] for i in inside)])
        self.assertEqual(at, len(whole["intervals"]))

    def test_the_same_from_a_store_and_for_any_threads(self):
        one = self.run_json("spectrum", "noise.nrrd", "--threads", "1")
        self.assertEqual(one, self.run_json("spectrum", "noise.nrrd", "--threads", "3"))
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        store = self.run_json("spectrum", "noise.atlas")
        for name in ("intervals", "sizes", "advice"):
            self.assertEqual(one[name], store[name], name)

    def test_files(self):
        self.run_ok("spectrum", "noise.nrrd", "--samples", "3", "-o", "x.csv")
        with open(self.folder / "x.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        document = self.run_json("spectrum", "noise.nrrd", "--samples", "3", "-o", "x.json")
        kinds = collections.Counter(row["kind"] for row in rows)
        self.assertEqual(kinds, {"interval": document["interval_count"], "size": 3, "advice": len(document["advice"])})
        advice = [(int(row["object"]), row["reason"]) for row in rows if row["kind"] == "advice"]
        self.assertEqual(advice, [(a["object"], a["reason"]) for a in document["advice"]])
        self.assert_schema(document, "spectrum")
        self.run_ok("spectrum", "noise.nrrd", "-o", "x.svg")
        root = xml.etree.ElementTree.parse(self.folder / "x.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))
        text = (self.folder / "x.svg").read_text()
        self.assertIn("tunnels", text)
        self.assertIn(f"object {document['advice'][0]['object']} ({document['advice'][0]['reason']}", text)
        self.assert_no_partial()

    def test_a_selection_says_what_is_essential(self):
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        whole = self.run_json("spectrum", "noise.nrrd", "--top", "100%", "--samples", "0")
        self.assertTrue(whole["selected"])
        for interval in whole["intervals"]:
            self.assertEqual(interval["all"], interval["significant"])
        for source in ("noise.nrrd", "noise.atlas"):
            kept = self.run_json("spectrum", source, "--keep", "3", "--samples", "0")
            self.assert_schema(kept, "spectrum")
            self.assertEqual(max(i["significant"]["objects"][1] for i in kept["intervals"]), 3)
            self.assertEqual([i["all"] for i in kept["intervals"]], [i["all"] for i in whole["intervals"]])
        self.run_ok("spectrum", "noise.nrrd", "--keep", "3", "-o", "k.svg")
        self.assertIn("Of the selected objects", (self.folder / "k.svg").read_text())
        self.assertIn("selected", self.run_ok("spectrum", "noise.nrrd", "--keep", "3").stdout)
        self.run_error(2, "spectrum", "noise.nrrd", "--top", "5", says="--top")

    def test_text_and_edges(self):
        text = self.run_ok("spectrum", "noise.nrrd", "--samples", "5").stdout
        self.assertIn("significant", text)
        self.assertIn("interpolant trilinear", text)
        self.assert_schema(self.run_json("spectrum", "one.npy"), "spectrum")
        self.assertEqual(self.run_json("spectrum", "one.npy", "--samples", "0")["sizes"], [])
        self.run_ok("spectrum", "one.npy", "-o", "one.svg")
        self.run_error(2, "spectrum", "noise.nrrd", "--samples", "-1", says="--samples")
        self.run_error(2, "spectrum", "noise.nrrd", "-o", "x.png", says=".png")


if __name__ == "__main__":
    harness.main()
