"""isoatlas FILE: a page from a volume, whole, self-contained, with data as described and commands that run."""
import json
import os
import re
import shlex

import harness

DATA = re.compile(r'<script id="atlas-data" type="application/json">(.*?)</script>', re.S)


class Atlas(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "40"], "flat.nrrd": ["noise", "--size", "1"], "noise.nrrd": ["noise", "--size", "16"]}

    def page(self, name):
        text = (self.folder / name).read_text()
        found = DATA.findall(text)
        self.assertEqual(len(found), 1)
        page = json.loads(found[0], parse_constant=lambda word: self.fail(f"{word} is not JSON"))
        self.assert_schema(page, "page")
        return text, page

    def test_a_page_from_a_volume(self):
        told = self.run_ok("demo.nrrd")
        self.assertIn("demo.atlas.html", told.stdout)
        text, page = self.page("demo.atlas.html")
        self.assertTrue((self.folder / "demo.atlas").is_file())
        table = self.run_json("objects", "demo.atlas")["objects"]
        self.assertEqual([entry["id"] for entry in page["objects"]], [entry["id"] for entry in table])
        self.assertEqual([entry["tunnels"] for entry in page["objects"]], [entry["tunnels"] for entry in table])
        for entry in page["objects"]:
            self.assertTrue(entry["picture"]["image"].startswith("data:image/webp;base64,"))
            self.assertLess(entry["into"], len(page["objects"]))
        self.assertEqual(re.findall(r"""(?:src|href)=["']?(?!data:)[a-z]+:""", text), [])
        self.assertNotRegex(text, r"""@import|url\((?!data:)""")
        samples = 1
        for size in page["volume"]["size"]:
            samples *= size
        self.assertLess(abs(sum(page["histogram"]["counts"]) - samples), samples / 20)

    def test_objects_merge_into_others_of_the_page(self):
        self.run_ok("demo.nrrd", "-o", "merge.html")
        entries = self.page("merge.html")[1]["objects"]
        for entry in entries:
            self.assertEqual(entry["merges"] is None, entry["into"] == -1, entry["id"])
            if entry["into"] >= 0:
                other = entries[entry["into"]]
                self.assertTrue(other["merges"] is None or other["merges"] < entry["merges"])

    def test_commands_of_the_page_run(self):
        self.run_ok("atlas", "demo.nrrd", "--top", "2", "-o", "two words.html")
        entries = self.page("two words.html")[1]["objects"]
        self.assertEqual(len(entries), 2)
        for command in entries[1]["commands"]:
            words = shlex.split(command["line"])
            self.assertEqual(words[0], "isoatlas")
            self.run_ok(*words[1:])
            self.assertTrue((self.folder / words[-1]).is_file(), command)

    def test_the_store_is_used_again(self):
        told = self.run_json("demo.nrrd", "-o", "again.html", "--top", "1")
        self.assert_schema(told, "atlas")
        self.assertEqual((told["store"], told["output"]), ("again.atlas", "again.html"))
        before = os.stat(self.folder / "again.atlas").st_mtime_ns
        self.assertIn("already", self.run_ok("demo.nrrd", "-o", "again.html", "--top", "1").stderr)
        self.assertEqual(os.stat(self.folder / "again.atlas").st_mtime_ns, before)
        self.run_ok("demo.nrrd", "-o", "again.html", "--restart", "--top", "1")
        self.assertGreater(os.stat(self.folder / "again.atlas").st_mtime_ns, before)
        self.assertEqual(self.run_json("again.atlas", "-o", "other.html", "--top", "1")["store"], "again.atlas")

    def test_volumes_with_nothing_in_them(self):
        for name in ("flat", "noise"):
            self.run_ok(name + ".nrrd")
            self.page(name + ".atlas.html")
        self.run_error(2, "demo.nrrd", "-o", "page.txt", says=".txt")
        self.run_error(2, "no such file.nrrd", says="no verb")


if __name__ == "__main__":
    harness.main()
