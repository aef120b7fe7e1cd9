"""Numbers as people and scripts type them, and those that hardly are: nothing is read as 0 that is not, and the system's refusals are told."""
import os
import re
import resource
import struct
import subprocess

import harness

VERBS = ["info", "objects", "extract", "render", "animate", "label", "tree", "verify", "build", "atlas", "view", "handles", "spectrum", "table131", "compare",
         "convert", "phantom"]
OUTPUTS = {"extract": "x.ply", "render": "x.png", "animate": "x.gif", "label": "x.nrrd", "build": "x.atlas", "convert": "x.nrrd"}
NUMBERS = {"T", "SIGMA", "H", "V", "N", "ID", "BYTES", "P", "F", "A", "B", "VALUE"}


class Numbers(harness.CliTest):
    phantoms = {"v.nrrd": ["demo", "--size", "32"]}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (6, 6, 6), }".ljust(117) + b"\n"
        values = [(1 + (x * 7 + y * 5 + z * 3) % 40) * 5e-324 for z in range(6) for y in range(6) for x in range(6)]
        (cls.folder / "den.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + struct.pack("<216d", *values))

    def options(self, verb):
        """[(name, type)] of all options that take a value."""
        return re.findall(r"^  (?:-\w,)?(--[a-z-]+) ([A-Z](?!xcludes)[^ \n]*)", self.run_ok(verb, "--help").stdout, re.MULTILINE)

    def test_no_option_takes_an_empty_word(self):
        seen = 0
        for verb in VERBS:
            for name, _ in self.options(verb):
                for words in ([name, ""], [name + "="]):
                    error = self.run_error(2, verb, "v.nrrd", *words, says="empty")
                    self.assertIn(name, error["what"])
                    seen += 1
        self.assertGreater(seen, 250)
        self.run_error(2, "tree", "v.nrrd", "-o", "", says="-o has an empty value")
        self.run_error(2, "extract", "v.nrrd", "--tau=", "-o", "x.ply", says="--tau has an empty value")
        self.run_error(2, "", says="empty word")

    def test_nor_does_a_list_hold_one(self):
        for option, value in (("--spacing", "1,,1"), ("--spacing", ","), ("--origin", "1,2,"), ("--dims", "4xx4"), ("--dims", "x4")):
            self.run_error(2, "info", "v.nrrd", option, value, says=option)
        self.run_error(2, "render", "v.nrrd", "--tau", "100", "", "-o", "x.png", says='""')
        self.run_error(2, "render", "v.nrrd", "--tau", "100", "--opacity", "1", "", "-o", "x.png", says='""')
        self.run_error(2, "extract", "v.nrrd", "--tau", "100", "--object", "1", "", "-o", "x.ply", says='""')
        self.run_error(2, "render", "v.nrrd", "--object", "1@", "-o", "x.png", says="1@")
        self.run_error(2, "convert", "v.nrrd", "--box", "0:4,0:,0:4", "-o", "x.nrrd", says="--box")

    def test_what_is_no_number_or_only_rounds_to_one(self):
        seen = 0
        for verb in VERBS:
            output = ["-o", OUTPUTS[verb]] if verb in OUTPUTS else []
            for name, kind in self.options(verb):
                if kind.split("|")[0] not in NUMBERS or name == "--type":
                    continue
                word = ("1e-400", "-1e-400", "1e400", "1x", "0x10", "--", "1e", " 1")[seen % 8]  # each of them with many options
                self.run_error(2, verb, "v.nrrd", name + "=" + word, *output, says=name)
                seen += 1
        self.assertGreater(seen, 75)
        self.run_error(2, "render", "v.nrrd", "--cut", "x>1e-400", "-o", "x.png", says="--cut")
        self.run_error(2, "render", "v.nrrd", "--object", "1@1e-400", "-o", "x.png", says="1e-400")

    def test_denormals_are_exact(self):
        table = self.run_json("objects", "den.npy", "--all")["objects"]
        self.assertGreater(len(table), 0)
        for entry in table:
            self.assertGreaterEqual(entry["appears"], 5e-324)
        for line in self.run_ok("objects", "den.npy", "--all").stdout.splitlines()[1:]:
            self.assertRegex(line, r"e-32\d")
        for tau in ("5e-324", "1e-322", "0.1e-321"):
            self.assertEqual(self.run_json("objects", "den.npy", "--tau", tau)["tau"], float(tau))
        self.run_error(2, "objects", "den.npy", "--tau", "2e-324", says="2e-324")   # nearer to 0
        self.run_error(6, "objects", "den.npy", "--tau", "0e-999", says="below every sample")
        self.run_ok("render", "den.npy", "--tau", "1e-322", "--size", "64x64", "--samples", "1", "-o", "den.png")
        self.assertEqual(self.run_json("extract", "den.npy", "--tau", "1e-322", "-o", "den.ply")["tau"], 1e-322)
        self.assertIn(b"1e-322", (self.folder / "den.ply").read_bytes()[:2000])
        self.run_ok("verify", "den.ply")

    def test_numbers_are_the_nearest_that_there_are(self):
        word = "100.00000000000000710542735760100185871124267578126"   # just above half-way: twice rounded it would be 100
        told = self.run_json("objects", "v.nrrd", "--tau", word)
        self.assertEqual(told["tau"], float(word))
        self.assertNotEqual(told["tau"], 100)

    # 5: what the system refuses

    def under_a_limit(self, bytes_, *words):
        done = subprocess.run([harness.CLI, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=300,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (bytes_, bytes_)))
        return done.returncode, done.stderr

    def test_memory_and_threads_that_the_system_refuses(self):
        megabyte = 2 ** 20
        if self.under_a_limit(4096 * megabyte, "--version")[0] != 0:
            self.skipTest("this program needs too much address space, as with sanitizers")
        least, enough = 1, 4096   # megabytes: where the libraries cannot be loaded, and where they can
        while enough - least > 1:
            middle = (least + enough) // 2
            least, enough = (least, middle) if self.under_a_limit(middle * megabyte, "--version")[0] == 0 else (middle, enough)
        refused = 0
        for words in (["objects", "v.nrrd"], ["build", "v.nrrd", "-o", "v.atlas", "--memory", "80M"]):
            for limit in range(enough, enough + 24):
                code, said = self.under_a_limit(limit * megabyte, *words)
                self.assertIn(code, (0, 5), f"{limit} MB: {said}")
                if code == 5:
                    refused += 1
                    self.assertRegex(said, "memory|refuses")
                    self.assertIn("Next: ", said)
        self.assertGreater(refused, 0)
        print(f"starts with {enough} MB; {refused} refusals")


if __name__ == "__main__":
    harness.main()
