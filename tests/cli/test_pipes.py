"""`-` as a volume and as an output; messages stand where they belong; commands that can be pasted."""
import os
import pathlib
import pty
import re
import shutil
import subprocess

from harness import CLI, CliTest, main


class Pipes(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for words in (["phantom", "demo", "--size", "32", "-o", "v.nrrd"], ["convert", "v.nrrd", "-o", "v.npy"], ["convert", "v.nrrd", "-o", "v.nii.gz"],
                      ["convert", "v.nrrd", "-o", "v.mha"], ["convert", "v.nrrd", "-o", "v.vti"], ["convert", "v.nrrd", "-o", "v.tif"],
                      ["build", "v.nrrd", "-o", "v.atlas"]):
            done = cls.start(words)
            assert done.returncode == 0, done.stderr
        (cls.folder / "own.csv").write_text("no,volume\n")
        cls.temporary = cls.folder / "temporary"
        cls.temporary.mkdir()

    def piped(self, name, *words, code=0):
        """Bytes of standard output, text of standard error; nothing is left in TMPDIR."""
        with open(self.folder / name, "rb") if name else open(os.devnull, "rb") as source:
            done = subprocess.run([CLI, *words], cwd=self.folder, stdin=source, capture_output=True, env=dict(os.environ, TMPDIR=str(self.temporary)))
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(list(self.temporary.iterdir()), [])
        return done.stdout, done.stderr.decode()

    def test_a_volume_from_standard_input(self):
        expected = self.run_json("objects", "v.nrrd")["objects"]
        for name in ("v.nrrd", "v.npy", "v.nii.gz", "v.mha", "v.vti", "v.tif", "v.atlas"):
            out, err = self.piped(name, "objects", "-", "--json")
            self.assertEqual(out.count(b'"reference"'), len(expected), name)
            self.assertNotIn("next:", err)
        out, _ = self.piped("v.nrrd", "extract", "-", "--tau", "0.5", "-o", "-")
        self.run_ok("extract", "v.nrrd", "--tau", "0.5", "-o", "own.ply")
        self.assertEqual(out, (self.folder / "own.ply").read_bytes())
        self.piped("v.nrrd", "atlas", "-", "-o", "page.html", "--top", "1")
        self.assertIn("<html", (self.folder / "page.html").read_text())
        for words in (["view", "-"], ["atlas", "-"], ["build", "-"], ["name", "-"]):
            self.piped("v.nrrd", *words, code=2)
        self.piped(None, "objects", "-", code=3)   # nothing comes

    def test_a_terminal_is_no_volume(self):
        leader, follower = pty.openpty()
        try:
            done = subprocess.run([CLI, "objects", "-"], stdin=follower, capture_output=True, text=True)
        finally:
            os.close(leader), os.close(follower)
        self.assertEqual(done.returncode, 2)
        self.assertIn("terminal", done.stderr)

    def test_results_to_standard_output(self):
        cases = [(["extract", "v.nrrd", "--tau", "0.5"], "ply"), (["extract", "v.nrrd", "--tau", "0.5"], "stl"), (["measure", "v.nrrd"], "csv"),
                 (["label", "v.nrrd", "--tau", "0.5"], "nrrd"), (["convert", "v.nrrd"], "nrrd"), (["convert", "v.nrrd"], "npy"), (["tree", "v.nrrd"], "json"),
                 (["tree", "v.nrrd"], "graphml"), (["spectrum", "v.nrrd"], "csv"), (["phantom", "torus-chain", "--size", "24"], "nrrd"),
                 (["render", "v.nrrd", "--tau", "0.5", "--size", "32x32"], "png"), (["build", "v.nrrd"], "atlas")]
        for words, extension in cases:
            self.run_ok(*words, "-o", f"file.{extension}")
            for flag in (["-o"], ["--output"]):
                out, err = self.piped(None, *words, *flag, f"-.{extension}")
                self.assertEqual(out, (self.folder / f"file.{extension}").read_bytes(), words)
                self.assertNotIn(str(self.temporary), err)
        for words, extension in cases[:1] + cases[2:5]:
            out, err = self.piped(None, *words, "-o", "-")
            self.run_ok(*words, "-o", f"file.{extension}")
            self.assertEqual(out, (self.folder / f"file.{extension}").read_bytes())
        self.assertIn("standard output: ", self.piped(None, "extract", "v.nrrd", "--tau", "0.5", "-o", "-")[1])
        for words, says in ((["--tau", "0.5", "-o", "-.xyz"], "isoatlas: standard output: unknown extension .xyz"), (["--top", "2", "--split", "-o", "-"], "one file")):
            self.assertIn(says, self.piped(None, "extract", "v.nrrd", *words, code=2)[1])
        self.assertIn("isoatlas: standard input: ", self.piped("own.csv", "objects", "-", code=4)[1])
        self.assertEqual(self.start(["measure", "v.nrrd", "--json", "-o", "-"]).returncode, 2)

    def test_nothing_is_written_where_it_fails(self):
        out, err = self.piped(None, "extract", "v.nrrd", "--tau", "999", "-o", "-", code=6)
        self.assertEqual(out, b"")

    def test_messages_stay_behind_what_they_follow(self):
        both = subprocess.run([CLI, "objects", "v.nrrd"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout.splitlines()
        table = next(i for i, line in enumerate(both) if "best tau" in line)
        next_line = next(i for i, line in enumerate(both) if line.startswith("next: "))
        listed = next(i for i, line in enumerate(both) if " listed" in line)
        self.assertLess(listed, table)
        self.assertLess(table + 1, next_line)
        self.assertEqual(next_line, len(both) - 1)

    def test_hints_can_be_pasted(self):
        for path, known in (("", False), (str(pathlib.Path(CLI).parent), True)):
            done = subprocess.run([CLI, "objects", "v.nrrd"], cwd=self.folder, capture_output=True, text=True,
                                  env=dict(os.environ, PATH=f"{path}:/usr/bin:/bin"))
            command = re.search(r"(?m)^next: (.*)$", done.stderr)[1]
            self.assertEqual(command.startswith("isoatlas "), known, command)
            again = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, env=dict(os.environ, PATH=f"{path}:/usr/bin:/bin"))
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertTrue((self.folder / "object.ply").exists())
            (self.folder / "object.ply").unlink()


if __name__ == "__main__":
    main()
