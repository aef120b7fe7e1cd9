"""Files in the way of an output: what is not ours is neither changed nor removed, and what cannot be replaced is told before the work."""
import os
import shutil
import signal
import socket
import stat
import subprocess
import time
import unittest

import harness

TEMPORARY = ".isoatlas-*"

# The words of every verb that writes, with its output last. The volume is not there: refusals come before anything is read.
WRITERS = {
    "extract": ["extract", "none.nrrd", "--tau", "100", "-o", "x.ply"],
    "label": ["label", "none.nrrd", "--tau", "100", "-o", "x.nrrd"],
    "tree": ["tree", "none.nrrd", "-o", "x.json"],
    "simplified tree": ["tree", "none.nrrd", "--keep", "3", "-o", "x.graphml"],
    "curve": ["objects", "none.nrrd", "--curve", "x.csv"],
    "spectrum": ["spectrum", "none.nrrd", "-o", "x.svg"],
    "render": ["render", "none.nrrd", "--tau", "100", "-o", "x.png"],
    "animate": ["animate", "none.nrrd", "-o", "x.gif"],
    "convert": ["convert", "none.nrrd", "-o", "x.npy"],
    "convert raw": ["convert", "none.nrrd", "-o", "x.raw"],
    "build": ["build", "none.nrrd", "-o", "x.atlas"],
    "atlas": ["atlas", "none.nrrd", "-o", "x.html"],
    "ask": ["ask", "http://127.0.0.1:1", "/api/atlas", "-o", "x.bin"],
    "phantom": ["phantom", "none", "-o", "x.mha"],
}


class Outputs(harness.CliTest):
    phantoms = {"v.nrrd": ["demo", "--size", "32"]}

    def setUp(self):
        self.before = sorted(path.name for path in self.folder.iterdir())
        self.precious = self.folder / "precious.txt"
        self.precious.write_text("precious")

    def tearDown(self):
        self.assertEqual(self.precious.read_text(), "precious")
        self.assertEqual(list(self.folder.rglob(TEMPORARY)), [])
        for path in self.folder.iterdir():
            if path.name in self.before:
                continue
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()

    def make_pipe(self, path):
        os.mkfifo(path)

    def make_socket(self, path):
        before = os.getcwd()
        os.chdir(path.parent)   # names of sockets are short
        try:
            with socket.socket(socket.AF_UNIX) as made:
                made.bind(path.name)
        finally:
            os.chdir(before)

    def make_link_to_a_device(self, path):
        path.symlink_to("/dev/full")

    def make_link_to_nowhere(self, path):
        path.symlink_to("nowhere")

    def make_circle(self, path):
        path.symlink_to(path.name)

    def make_read_only(self, path):
        path.write_text("mine")
        path.chmod(0o444)

    def make_link_to_read_only(self, path):
        other = path.parent / "read-only"
        if not other.exists():
            self.make_read_only(other)
        path.symlink_to(other.name)

    def test_what_cannot_be_replaced_is_refused_before_the_work(self):
        says = {"pipe": "a pipe", "socket": "a socket", "link_to_a_device": "link to /dev/full", "link_to_nowhere": "not there", "circle": "links",
                "read_only": "0444", "link_to_read_only": "0444"}
        for name, words in WRITERS.items():
            path = self.folder / words[-1]
            for kind, part in says.items():
                with self.subTest(verb=name, kind=kind):
                    getattr(self, "make_" + kind)(path)
                    was = path.lstat()
                    self.run_error(5, *words, says=part)
                    self.assertEqual((path.lstat().st_ino, path.lstat().st_size), (was.st_ino, was.st_size))
                    self.assertFalse((self.folder / (words[-1] + ".build")).exists())
                    path.unlink()

    def test_pages_and_stores_that_are_not_named_are_checked_too(self):
        (self.folder / "v.atlas.html").symlink_to("nowhere")
        self.run_error(5, "atlas", "v.nrrd", says="v.atlas.html")
        self.assertFalse((self.folder / "v.atlas").exists())
        (self.folder / "v.atlas.html").unlink()
        (self.folder / "v.atlas").symlink_to("nowhere")
        self.run_error(5, "atlas", "v.nrrd", says="v.atlas")
        self.assertFalse((self.folder / "v.atlas.build").exists())

    def test_the_file_beside_raw_samples_is_an_output(self):
        (self.folder / "x.raw.json").symlink_to(self.precious.name)
        self.precious.chmod(0o400)
        self.run_error(5, "convert", "v.nrrd", "-o", "x.raw", says="x.raw.json")
        self.assertFalse((self.folder / "x.raw").exists())
        (self.folder / "x.raw.json").unlink()
        (self.folder / "x_32x32x32_float32.raw.json").write_text("{}")
        self.run_ok("convert", "v.nrrd", "--voxel", "-o", "x_32x32x32_float32.raw")
        self.assertEqual(self.run_json("info", "x_32x32x32_float32.raw")["volume"]["dims"], [32, 32, 32])

    def test_the_attack_by_a_name_that_can_be_foretold(self):
        for words in (["extract", "v.nrrd", "--tau", "100", "-o", "x.ply"], ["build", "v.nrrd", "-o", "x.atlas"],
                      ["label", "v.nrrd", "--tau", "100", "-o", "x.nrrd"], ["tree", "v.nrrd", "-o", "x.json"],
                      ["atlas", "v.nrrd", "-o", "x.html"], ["convert", "v.nrrd", "-o", "x.mha"]):
            partial = self.folder / (words[-1] + ".partial")
            for make in (lambda: partial.symlink_to(self.precious.name), lambda: os.link(self.precious, partial), lambda: partial.write_text("mine")):
                make()
                was = partial.read_text()
                self.run_ok(*words)
                self.assertEqual(partial.read_text(), was)
                self.assertFalse((self.folder / words[-1]).is_symlink())
                partial.unlink()

    def test_links_of_the_user_stay_and_their_files_are_replaced(self):
        (self.folder / "other").mkdir()
        real = self.folder / "other" / "real.ply"
        real.write_text("old")
        real.chmod(0o640)
        (self.folder / "link.ply").symlink_to("other/real.ply")
        self.run_ok("extract", "v.nrrd", "--tau", "100", "-o", "link.ply")
        self.assertTrue((self.folder / "link.ply").is_symlink())
        self.assertEqual(real.read_bytes()[:3], b"ply")
        self.assertEqual(stat.S_IMODE(real.stat().st_mode), 0o640)
        os.link(self.precious, self.folder / "hard.ply")
        self.run_ok("extract", "v.nrrd", "--tau", "100", "-o", "hard.ply")   # precious.txt keeps its content: tearDown

    def test_new_files_have_the_permissions_of_the_umask(self):
        before = os.umask(0o027)
        try:
            self.run_ok("extract", "v.nrrd", "--tau", "100", "-o", "x.ply")
        finally:
            os.umask(before)
        self.assertEqual(stat.S_IMODE((self.folder / "x.ply").stat().st_mode), 0o640)

    @unittest.skipIf(os.geteuid() != 0, "only the superuser can make files of others")
    def test_links_and_files_of_other_users(self):
        link = self.folder / "x.ply"
        link.symlink_to(self.precious.name)
        os.lchown(link, 12345, 12345)
        self.run_error(5, *WRITERS["extract"], says="another user made")
        os.lchown(link, 0, 0)
        os.chown(self.precious, 12345, 12345)
        self.run_error(5, *WRITERS["extract"], says="belongs to another user")

    # The folder of a build

    def attack(self, says):
        folder = self.folder / "s.atlas.build"
        held = {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()} if folder.is_dir() else None
        for words in (["build", "v.nrrd", "-o", "s.atlas"], ["build", "v.nrrd", "-o", "s.atlas", "--restart"], ["atlas", "v.nrrd", "-o", "s.html"]):
            self.run_error(5, *words, says=says, next_says="-o")
            self.assertFalse((self.folder / "s.atlas").exists())
        if held is not None:
            self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}, held)

    def test_a_folder_of_the_user(self):
        folder = self.folder / "s.atlas.build"
        folder.mkdir()
        for name in ("notes", "trees", "zones", "x.partial"):
            (folder / name).write_text("mine")
        self.attack("was not made by a build")
        (folder / "lock").write_text("123\n")   # of an earlier version
        self.attack("was not made by a build")

    def test_a_link_as_folder(self):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        (elsewhere / "trees").write_text("mine")
        (self.folder / "s.atlas.build").symlink_to("elsewhere")
        self.attack("is a link")

    def test_a_link_as_lock(self):
        folder = self.folder / "s.atlas.build"
        folder.mkdir()
        (folder / "lock").symlink_to("../precious.txt")
        self.attack("lock")
        (folder / "lock").unlink()
        os.link(self.precious, folder / "lock")
        self.attack("lock")

    def test_files_of_the_user_in_the_folder_of_a_build(self):
        builder = subprocess.Popen([harness.CLI, "build", "v.nrrd", "-o", "s.atlas"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        lock = self.folder / "s.atlas.build" / "lock"
        while builder.poll() is None and not (lock.exists() and lock.read_bytes()):
            pass
        builder.send_signal(signal.SIGKILL)
        builder.communicate()
        (self.folder / "s.atlas.build").mkdir(exist_ok=True)   # it may have been done
        (self.folder / "s.atlas").unlink(missing_ok=True)
        if not lock.exists():
            self.skipTest("too fast to be stopped")
        (self.folder / "s.atlas.build" / "notes").write_text("mine")
        for _ in range(2):   # it is still the folder of a build
            told = self.run_ok("build", "v.nrrd", "-o", "s.atlas", "--restart")
            self.assertIn("s.atlas.build stays: it holds notes", told.stderr)
            self.assertEqual(sorted(path.name for path in lock.parent.iterdir()), ["lock", "notes"])

    def test_pictures_of_a_film_have_a_folder_of_their_own(self):
        programs = self.folder / "programs"
        programs.mkdir()
        (programs / "ffmpeg").write_text('#!/bin/sh\nfor last; do :; done\nls -a "$(dirname "$last")" > "$last"\n')   # what it was given
        (programs / "ffmpeg").chmod(0o755)
        frames = self.folder / "x.mp4.frames"
        frames.mkdir()
        (frames / "000000.png").write_text("mine")
        (self.folder / "real.mp4").write_text("old")
        (self.folder / "x.mp4").symlink_to("real.mp4")
        words = ["animate", "v.nrrd", "--steps", "2", "--size", "64x64", "--samples", "1", "-o", "x.mp4"]
        done = self.start(words, environment={"PATH": f"{programs}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((frames / "000000.png").read_text(), "mine")
        self.assertTrue((self.folder / "x.mp4").is_symlink())
        self.assertEqual((self.folder / "real.mp4").read_text().split(), [".", "..", "000000.png", "000001.png", "film.mp4"])

    # Ends that nobody can prepare for

    def test_killed_while_writing_leaves_nothing(self):
        self.run_ok("phantom", "noise", "--size", "160", "-o", "big.nrrd")
        writer = subprocess.Popen([harness.CLI, "tree", "big.nrrd", "-o", "x.json"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        while not harness.writes_in(writer, self.folder):
            self.assertIsNone(writer.poll(), "it was never seen writing")
            time.sleep(0.001)
        writer.send_signal(signal.SIGKILL)
        writer.communicate()
        self.assertFalse((self.folder / "x.json").exists())
        self.run_ok("extract", "v.nrrd", "--tau", "100", "-o", "x.ply")   # where it had a name this one tidies up: tearDown


if __name__ == "__main__":
    harness.main()
