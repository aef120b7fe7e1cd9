"""Links to `isoatlas view` outlive it: its port and its secrets are those of the store."""
import os
import pathlib
import re
import urllib.request

import harness
import served

FOLDER = served.STATE / "isoatlas"


class Links(harness.CliTest):
    phantoms = {"demo.nrrd": ["demo", "--size", "32"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        done = cls.start(["build", "demo.nrrd", "-o", "demo.atlas"])
        assert done.returncode == 0, done.stderr

    def tearDown(self):
        for file in FOLDER.iterdir() if FOLDER.is_dir() else []:
            file.unlink()

    def viewed(self, *arguments, **environment):
        """Port, token, what the browser gets, and what was said."""
        viewer = served.Viewer(self.folder, "demo.atlas", *arguments, env={**os.environ, **environment})
        with urllib.request.urlopen(viewer.document["address"], timeout=60) as answer:
            cookie, key = answer.headers["Set-Cookie"], re.search(r'"isoatlas","(\w+)"', answer.read().decode()).group(1)
        code, said = viewer.stop()
        self.assertEqual(code, 0, said)
        return viewer.port, viewer.token, cookie.partition("=")[2].partition(";")[0], key, said

    def kept(self):
        [file] = FOLDER.iterdir()
        return file

    def test_two_runs_have_the_same(self):
        first, second = self.viewed(), self.viewed()
        self.assertEqual(first[:4], second[:4])
        self.assertEqual(len(set(first[1:4])), 3)
        self.assertTrue(49152 <= first[0] <= 65535)
        self.assertNotIn("link", first[4] + second[4])
        self.assertEqual((self.kept().stat().st_mode & 0o777, FOLDER.stat().st_mode & 0o777), (0o600, 0o700))
        os.symlink(self.folder, self.folder / "other")   # another name of the folder
        again = served.Viewer(self.folder, "other/demo.atlas")
        self.assertEqual((again.port, again.token), first[:2])
        self.assertEqual(again.stop()[0], 0)

    def test_the_browser_may_still_ask_after_a_restart(self):
        port, _, cookie, key, _ = self.viewed()
        again = served.Viewer(self.folder, "demo.atlas")
        self.assertEqual(again.port, port)
        page = {"Cookie": f"isoatlas-{port}={cookie}", "Sec-Fetch-Site": "none"}
        self.assertEqual(again.ask("/", token="", **page)[0], 200)
        self.assertEqual(again.ask("/api/atlas", token=key, **page)[0], 200)
        self.assertEqual(again.ask("/api/atlas", token="", **page)[0], 403)
        self.assertEqual(again.stop()[0], 0)

    def test_new_link(self):
        first, new, after = self.viewed(), self.viewed("--new-link"), self.viewed()
        self.assertEqual(first[0], new[0])
        self.assertEqual(set(first[1:4]) & set(new[1:4]), set())
        self.assertEqual(new[:4], after[:4])

    def test_stores_have_links_of_their_own(self):
        (self.folder / "copy.atlas").write_bytes((self.folder / "demo.atlas").read_bytes())
        other = served.Viewer(self.folder, "copy.atlas")
        self.assertEqual(other.stop()[0], 0)
        first = self.viewed()
        self.assertNotEqual((first[0], first[1]), (other.port, other.token))
        self.assertEqual(len(list(FOLDER.iterdir())), 2)

    def test_a_port_that_is_taken(self):
        first = served.Viewer(self.folder, "demo.atlas")
        port, token, _, _, said = self.viewed()
        self.assertNotEqual(port, first.port)
        self.assertEqual(token, first.token)
        self.assertIn(f"note: port {first.port}, to which links to this store lead, is in use; this viewer has port {port}", said)
        self.assertEqual(first.stop()[0], 0)

    def test_the_token_of_the_environment_wins(self):
        first = self.viewed()
        told = self.viewed(ISOATLAS_TOKEN="abcdefghijklmnop")
        self.assertEqual(told[1], "abcdefghijklmnop")
        self.assertEqual(told[2:4], first[2:4])
        self.assertNotIn("abcdefghijklmnop", self.kept().read_text())

    def replaced(self, why):
        before = self.secrets
        after = self.viewed()
        self.assertEqual(set(before) & set(after[1:4]), set())
        self.assertIn(why + " and is replaced", after[4])
        self.assertEqual(self.kept().stat().st_mode & 0o777, 0o600)
        self.assertFalse(self.kept().is_symlink())
        self.secrets = after[1:4]

    def test_a_file_that_must_not_be_used_is_replaced(self):
        self.secrets = self.viewed()[1:4]
        self.kept().chmod(0o644)
        self.replaced("is open to other users")
        text = self.kept().read_text()
        for bad in ("", "x", text[:40], text.replace("\n", " "), text.replace("demo", "memo"), text + "more\n", text.upper(), "\0" * 300):
            self.kept().write_text(bad)
            self.replaced("is malformed" if bad else "is empty")
        target = self.folder / "target"
        target.write_text(self.kept().read_text())
        target.chmod(0o600)
        before = target.read_text()
        file = self.kept()
        file.unlink()
        file.symlink_to(target)
        self.replaced("is a symbolic link")
        self.assertEqual(target.read_text(), before)

    def test_no_folder_for_links(self):
        target = self.folder / "elsewhere"
        target.mkdir()
        linked = self.folder / "linked"
        linked.mkdir()
        (linked / "isoatlas").symlink_to(target)
        for state in ("/dev/null", str(linked)):
            first, second = self.viewed(XDG_STATE_HOME=state), self.viewed(XDG_STATE_HOME=state)
            self.assertEqual(first[0], second[0])
            self.assertEqual(set(first[1:4]) & set(second[1:4]), set())
            self.assertIn("note: links to this viewer end with it: ", first[4])
        self.assertEqual(list(target.iterdir()), [])

    def test_the_folder_in_the_home(self):
        home = self.folder / "home"
        home.mkdir()
        environment = {name: text for name, text in os.environ.items() if name != "XDG_STATE_HOME"}
        viewer = served.Viewer(self.folder, "demo.atlas", env={**environment, "HOME": str(home)})
        self.assertEqual(viewer.stop()[0], 0)
        folder = pathlib.Path(home, ".local", "state", "isoatlas")
        self.assertEqual((folder.stat().st_mode & 0o777, len(list(folder.iterdir()))), (0o700, 1))


if __name__ == "__main__":
    harness.main()
