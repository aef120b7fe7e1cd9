"""The methods of the literature, side by side on one volume: as text, JSON, CSV, and as a page."""
import csv
import html.parser
import io
import re

import harness


class Page(html.parser.HTMLParser):
    """What a page shows, and what it would load."""

    VOID = {"meta", "link", "img", "br"}

    def __init__(self, text):
        super().__init__()
        self.open, self.loads, self.tables, self.alternatives, self.ids, self.leads = [], [], {}, [], set(), []
        self.words, self.row, self.caption = "", None, ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag not in self.VOID:
            self.open.append(tag)
        if tag == "script" or any(name.startswith("on") for name in attributes):
            self.loads.append(tag)
        for name in ("src", "href", "xlink:href", "srcset", "data", "poster"):
            if name in attributes and not attributes[name].startswith(("data:", "#")):
                self.loads.append(attributes[name])
        if attributes.get("href", "").startswith("#"):
            self.leads.append(attributes["href"][1:])
        self.ids.add(attributes.get("id"))
        if tag == "img":
            self.alternatives.append(attributes["alt"])
        if tag == "caption":
            self.words = ""
        if tag == "tr":
            self.row = []
        if tag in ("th", "td"):
            self.words = ""

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_data(self, data):
        self.words += data

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag
        if tag == "caption":
            self.caption = self.words
            self.tables[self.caption] = []
        if tag in ("th", "td"):
            self.row.append(self.words)
        if tag == "tr":
            self.tables[self.caption].append(self.row)


class Compare(harness.CliTest):
    phantoms = {"noise.nrrd": ["noise", "--size", "14", "--quantise", "64"], "one.npy": ["noise", "--size", "1"],
                "smooth.nrrd": ["figure-smooth", "--size", "32"], "a<b>&\"c\".nrrd": ["noise", "--size", "6"]}

    def test_every_method_finds_the_same_cells(self):
        for tau in ("20", "31.5", "32"):
            found = self.run_json("compare", "noise.nrrd", "--tau", tau)
            self.assertEqual(found["cells"], 13 ** 3)
            self.assertEqual(found["searches"][0]["name"], "brute-force")
            self.assertEqual(found["searches"][0]["cells"], found["cells"])
            for method in found["searches"]:
                self.assertGreaterEqual(method["cells"], found["active_cells"], method["name"])
                self.assertEqual(method["blocks"] > 0, method["file_bytes"] > 0, method["name"])
                self.assertEqual(method["cold_seconds"] is not None, method["file_bytes"] > 0, method["name"])
            holes = {surface["name"]: surface["hole_edges"] for surface in found["surfaces"] if not surface["makes_points"]}
            self.assertGreater(holes.pop("marching-cubes"), 0)
            self.assertGreater(holes.pop("connected-contours"), 0)
            self.assertEqual(set(holes.values()) if tau == "31.5" else {0}, {0})
            reference = found["surfaces"][-1]
            self.assertEqual((reference["name"], reference["wrong_components"]), ("trilinear", 0))
        text = self.run_ok("compare", "noise.nrrd", "--tau", "32").stdout
        for words in ("Brute force", "Branch-on-need octree", "Kd-tree of the span space", "Six tetrahedra a cell", "edges of holes", "every method finds them all"):
            self.assertIn(words, text)

    def test_chosen_methods(self):
        names = lambda found: ([each["name"] for each in found["surfaces"]], [each["name"] for each in found["searches"]])
        run = lambda methods: names(self.run_json("compare", "noise.nrrd", "--tau", "31.5", "--methods", methods))
        self.assertEqual(run("octree"), ([], ["brute-force", "octree"]))
        self.assertEqual(run("dividing-cubes-4"), (["dividing-cubes-4", "trilinear"], []))
        self.assertEqual(run("marching-cubes,interval-tree-file-64k"), (["marching-cubes", "trilinear"], ["brute-force", "interval-tree-file-64k"]))
        usual = names(self.run_json("compare", "noise.nrrd", "--tau", "31.5"))
        self.assertEqual((run("surfaces"), run("searches")), ((usual[0], []), ([], usual[1])))
        self.assertIn("interval-tree-file-4k", usual[1])
        every = run("all")
        for kind in (0, 1):
            self.assertLess(set(usual[kind]), set(every[kind]))
        self.run_error(2, "compare", "noise.nrrd", "--tau", "1", "--methods", "octre", says="octre", next_says="octree")
        self.run_error(2, "compare", "noise.nrrd", "--tau", "1", "--methods", "octree,", says="no method")

    def test_studies(self):
        found = self.run_json("compare", "noise.nrrd", "--tau", "31.5", "--methods", "searches", "--isovalues", "4", "--sizes", "2")
        self.assertEqual(found["sizes"], [])   # every 2nd sample would be fewer than 8
        taus = [at["tau"] for at in found["isovalues"]]
        self.assertEqual(taus, sorted(set(taus)))
        self.assertGreaterEqual(len(taus), 2)
        for at in found["isovalues"]:
            alone = self.run_json("compare", "noise.nrrd", "--tau", str(at["tau"]), "--methods", "octree")
            self.assertEqual(at["active_cells"], alone["active_cells"])
            self.assertEqual([each["cells"] for each in at["searches"] if each["name"] == "octree"], [alone["searches"][1]["cells"]])
        self.assertEqual(self.run_json("compare", "noise.nrrd", "--tau", "31.5")["isovalues"], [])
        sizes = self.run_json("compare", "smooth.nrrd", "--tau", "45.01", "--methods", "octree", "--sizes", "4")["sizes"]
        self.assertEqual([(at["step"], at["dims"]) for at in sizes], [(4, [8, 8, 8]), (2, [16, 16, 16]), (1, [32, 32, 32])])
        self.assertEqual([at["cells"] for at in sizes], [7 ** 3, 15 ** 3, 31 ** 3])
        text = self.run_ok("compare", "smooth.nrrd", "--tau", "45.01", "--methods", "octree,interval-tree", "--sizes", "3", "--isovalues", "5").stdout
        self.assertRegex(text, r"Interval tree +\d\.\d\d")   # a fitted exponent

    def test_little_memory_leaves_searches_out(self):
        self.run_ok("phantom", "noise", "--size", "150", "-o", "large.nrrd")
        found = self.run_json("compare", "large.nrrd", "--tau", "0.9999", "--methods", "octree,interval-tree", "--sizes", "2", "--memory", "80M")
        missing = {each["name"]: each["missing_memory"] for each in found["searches"]}
        self.assertIsNone(missing["brute-force"])
        self.assertGreater(missing["interval-tree"], 80 << 20)
        self.assertEqual([each["missing_memory"] for each in found["sizes"][0]["searches"]], [None] * 3)

    def test_a_search_that_refuses_is_left_out(self):
        self.run_ok("phantom", "noise", "--size", "100", "-o", "large.nrrd")
        told = self.run_ok("compare", "large.nrrd", "--tau", "0.1", "--methods", "octree,zone-files-by-zone").stdout
        self.assertRegex(told, "left out: the lists would have more than .* entries")
        found = self.run_json("compare", "large.nrrd", "--tau", "0.1", "--methods", "octree,zone-files-by-zone", "-o", "refused.html", "--sizes", "1")
        refusals = {each["name"]: each["refusal"] for each in found["searches"]}
        self.assertEqual((refusals["brute-force"], refusals["octree"]), (None, None))
        self.assertIn("entries", refusals["zone-files-by-zone"])
        self.assertIn("left out: the lists", (self.folder / "refused.html").read_text())

    def test_surfaces_of_more_than_a_million_cells_are_those_of_the_middle(self):
        self.run_ok("phantom", "noise", "--size", "110", "-o", "large.nrrd")
        run = lambda *options: self.run_json("compare", "large.nrrd", "--tau", "0.5001", "--methods", "trilinear", *options)
        part = run()
        box = ",".join(f"{begin}:{end}" for begin, end in part["surface_part"])
        chosen = run("--box", box)
        self.assertIsNone(chosen["surface_part"])
        self.assertEqual(chosen["surfaces"][0]["triangles"], part["surfaces"][0]["triangles"])
        self.assertGreater(run("--box", "0:110,0:110,0:110")["surfaces"][0]["triangles"], 3 * part["surfaces"][0]["triangles"])
        self.assertIn(f"the part {box} in the middle", self.run_ok("compare", "large.nrrd", "--tau", "0.5001", "--methods", "trilinear").stdout)

    def test_the_page(self):
        name = 'a<b>&"c".nrrd'
        before = self.run_json("compare", name, "--tau", "0.5")
        self.run_ok("compare", name, "--tau", "0.5", "-o", "compare.html")
        text = (self.folder / "compare.html").read_text()
        page = Page(text)
        self.assertEqual((page.loads, page.open), ([], []))
        self.assertNotRegex(re.sub(r'xmlns="[^"]*"', "", text), r"https?://|url\(|@import")
        self.assertIn("a&lt;b&gt;&amp;&quot;c&quot;.nrrd", text)
        self.assertNotIn("a<b>", text)
        self.assertLessEqual(set(page.leads), page.ids)
        surfaces = {row[0]: row for row in page.tables["What each method makes, and at what cost"]}
        searches = {row[0]: row for row in page.tables["How each method finds the active cells"]}
        for each in before["surfaces"]:
            self.assertTrue(any(alternative.startswith(each["title"]) for alternative in page.alternatives), each["title"])
            shown = [cell.replace(",", "") for cell in surfaces[each["title"]]]
            count = lambda name: "–" if each[name] is None else str(each[name])
            self.assertEqual((shown[3], shown[4]), ("–" if each["makes_points"] else count("triangles"), count("points")))
            self.assertEqual(shown[7:14], [count(name) for name in ("components", "wrong_components", "euler", "genus", "hole_edges", "non_manifold_edges", "zero_area_triangles")])
        for each in before["searches"]:
            shown = [cell.replace(",", "") for cell in searches[each["title"]]]
            self.assertEqual(shown[6:8], [str(each["cells"]), str(each["nodes"])])
        self.assertEqual(page.alternatives[0].split(":")[0], "Ray casting")
        volume = self.run_json("compare", name, "--tau", "0.5", "--methods", "trilinear", "-o", "compare.html")
        self.assertEqual([each["name"] for each in volume["optical_models"]],
                         ["absorption", "emission", "absorption-emission", "single-scattering", "multiple-scattering"])
        self.assertEqual([each["name"] for each in volume["projections"]], ["ray-casting", "splatting", "shear-warp"])
        self.assertLess(volume["projections"][0]["rms_error"], volume["projections"][2]["rms_error"])
        self.assertEqual(before["optical_models"] + before["projections"], [])
        projected = page.tables["Image order and object order: absorption and emission against the integral"]
        self.assertEqual([row[0] for row in projected[1:]], [each["title"] for each in volume["projections"]])
        self.assertIn("3.8.5", text)
        self.assertTrue(all(row[0] in searches for row in page.tables["query, ms over active cells, k"][1:]))

    def test_every_method_is_described(self):
        self.run_ok("compare", "noise.nrrd", "--tau", "31.5", "--methods", "all", "-o", "all.html", "--isovalues", "0", "--sizes", "0")
        page = Page((self.folder / "all.html").read_text())
        rows = page.tables["What each method makes, and at what cost"][1:] + page.tables["How each method finds the active cells"][1:]
        self.assertGreaterEqual(len(page.leads), len(rows))   # each title leads to what docs/methods.md says of it
        self.assertNotIn("query, ms over active cells, k", page.tables)
        self.assertNotIn("![", (self.folder / "all.html").read_text())   # figures of the document are files beside it
        self.assertNotIn("|---", (self.folder / "all.html").read_text())  # its tables are tables, its lists are lists
        self.assertIn("travel utility, %</th>", (self.folder / "all.html").read_text())
        self.assertIn("<ul><li>By zone", (self.folder / "all.html").read_text())

    def test_an_image_and_a_volume_without_a_surface(self):
        self.run_ok("convert", "noise.nrrd", "--box", "0:14,0:14", "-o", "image.npy")
        self.run_ok("compare", "image.npy", "--tau", "31.5", "-o", "image.html")
        self.assertEqual(Page((self.folder / "image.html").read_text()).alternatives, [])
        found = self.run_json("compare", "one.npy", "--tau", str(self.run_json("info", "one.npy")["values"]["low"]), "-o", "one.html")
        self.assertEqual((found["cells"], found["surfaces"][-1]["triangles"]), (0, 0))
        self.assertEqual(Page((self.folder / "one.html").read_text()).alternatives, [])

    def test_the_table(self):
        found = self.run_json("compare", "noise.nrrd", "--tau", "31.5", "--isovalues", "3", "--sizes", "1", "--csv", "compare.csv")
        rows = list(csv.DictReader(io.StringIO((self.folder / "compare.csv").read_text())))
        self.assertTrue(all(None not in row and None not in row.values() for row in rows))   # as many cells as titles
        of = lambda table: [row for row in rows if row["table"] == table]
        for row, each in zip(of("surface"), found["surfaces"], strict=True):
            self.assertEqual((row["method"], int(row["points"])), (each["name"], each["points"]))
            if not each["makes_points"]:
                for name in ("triangles", "components", "wrong_components", "euler", "hole_edges", "non_manifold_edges", "zero_area_triangles"):
                    self.assertEqual(int(row[name]), each[name], name)
        for row, each in zip(of("search"), found["searches"], strict=True):
            self.assertEqual((row["method"], int(row["cells_looked_at"]), int(row["file_bytes"])), (each["name"], each["cells"], each["file_bytes"]))
        self.assertEqual(len(of("isovalue")), len(found["isovalues"]) * len(found["searches"]))

    def test_a_part_of_it_low_values_and_a_store(self):
        self.run_ok("build", "noise.nrrd", "-o", "noise.atlas")
        volume = self.run_json("compare", "noise.nrrd", "--tau", "32", "--box", "1:9,0:5,2:6")
        self.assertEqual(volume["cells"], 7 * 4 * 3)
        self.assertEqual(self.run_json("compare", "noise.atlas", "--tau", "32")["active_cells"],
                         self.run_json("compare", "noise.nrrd", "--tau", "32")["active_cells"])
        self.assertEqual(self.run_json("compare", "noise.nrrd", "--tau", "31.5", "--polarity", "low")["active_cells"],
                         self.run_json("compare", "noise.nrrd", "--tau", "31.5")["active_cells"])

    def test_errors(self):
        self.run_error(2, "compare", "noise.nrrd", says="which isovalue", next_says="isoatlas objects")
        self.run_error(2, "compare", "noise.nrrd", "--tau", "x", says="--tau")
        self.run_error(2, "compare", "noise.nrrd", "--tau", "1", "-o", "compare.htm", says=".html")
        self.run_error(2, "compare", "noise.nrrd", "--tau", "1", "--csv", "compare.txt", says=".csv")
        self.run_error(3, "compare", "none.nrrd", "--tau", "1", says="none.nrrd")


if __name__ == "__main__":
    harness.main()
