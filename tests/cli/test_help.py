"""isoatlas, --help, help VERB, --version, did you mean, completion."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess

from harness import CLI, CliTest, main

SOURCE = pathlib.Path(os.environ["ISOATLAS_SOURCE"])
VERBS = ["atlas", "view", "ask", "info", "objects", "measure", "extract", "render", "animate", "tree", "label", "build", "levels", "convert", "handles", "spectrum", "table131", "compare", "dump", "phantom",
         "verify", "completion", "manual", "name", "serve"]


class Help(CliTest):
    def test_alone_it_says_what_it_is(self):
        done = self.run_ok()
        self.assertLessEqual(len(done.stdout.splitlines()), 8)
        self.assertIn("which objects are in a volume", done.stdout)
        self.assertIn("--help", done.stdout)

    def test_overview_names_every_verb_and_exit_code(self):
        for words in (["--help"], ["-h"], ["help"]):
            text = self.run_ok(*words).stdout
            for verb in VERBS:
                self.assertRegex(text, rf"(?m)^  {verb}\b")
            for code in (0, 1, 2, 3, 4, 5, 6, 7, 130):
                self.assertRegex(text, rf"\b{code} \w+")

    def test_every_verb_has_three_examples(self):
        for verb in VERBS:
            texts = [self.run_ok(*words).stdout for words in (["help", verb], [verb, "--help"], [verb, "-h"])]
            self.assertEqual(len(set(texts)), 1)
            examples = texts[0].split("Examples:")[1]
            self.assertGreaterEqual(len(re.findall(rf"(?m)isoatlas {verb} ", examples)), 3, texts[0])
            self.assertIn("--json", texts[0])
            self.assertIn("--threads", texts[0])

    def test_examples_use_options_that_exist(self):
        for verb in VERBS:
            options, examples = self.run_ok("help", verb).stdout.split("Examples:")
            for option in re.findall(r"(?<!\S)--[a-z-]+", examples.split("Exit codes")[0]):
                self.assertIn(option, options)

    def test_messages_name_options_that_exist(self):
        known = set(re.findall(r"--[a-z][a-z0-9-]*", "".join(self.run_ok("help", verb).stdout for verb in VERBS)))
        named = 0
        for path in [*(SOURCE / "src").rglob("*.cpp"), *(SOURCE / "apps").rglob("*.cpp")]:
            for text in re.findall(r'"((?:[^"\\\n]|\\.)*)"', path.read_text()):
                for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text):
                    self.assertIn(option, known | {"--version"}, f"{path}: {text}")
                    named += 1
        self.assertGreater(named, 100)

    def test_phantom_examples_run(self):
        examples = self.run_ok("help", "phantom").stdout.split("Examples:")[1]
        for line in re.findall(r"(?m)^  isoatlas (phantom .*)$", examples):
            self.run_ok(*shlex.split(line))

    def test_version(self):
        for words in (["--version"], ["info", "--version"], ["-V"], ["-V", "info"]):
            self.assertRegex(self.run_ok(*words).stdout, r"^isoatlas \d+\.\d+\.\d+\n$")

    def test_did_you_mean(self):
        self.run_error(2, "ojects", "x.nrrd", next_says="isoatlas objects")
        self.run_error(2, "zzzzzzzzzz", next_says="--help")
        self.run_error(2, "help", "extrct", next_says="isoatlas extract")
        self.run_error(2, "extract", "x.nrrd", "--ojbect", "5", "-o", "x.ply", says="--ojbect", next_says="--object")
        self.run_error(2, "phantom", "gyroyd", "-o", "x.nrrd", next_says="gyroid")
        self.run_error(2, "obj", "x.nrrd", next_says="isoatlas objects")
        self.assertNotIn("did you mean", self.run_error(2, "objects", "x.nrrd", "--foo", says="--foo")["next"])

    def test_reasons_are_explained_where_they_are_listed(self):
        told = self.run_ok("objects", "--help").stdout.split("Reasons for an isovalue:")[1]
        schema = json.loads((SOURCE / "docs/schema/objects.schema.json").read_text())
        listed = schema["properties"]["objects"]["items"]["properties"]["reason"]["enum"]
        self.assertEqual(re.findall(r"(?m)^  (\w+) {2,}", told), [reason for reason in listed if reason])

    def test_a_file_instead_of_a_verb(self):
        """It is shown: what is said is about the file."""
        (self.folder / "some.nrrd").write_text("x")
        self.run_error(3, "some.nrrd", says="some.nrrd")
        for missing in ("some.nrdd", "data/scan", "./scan"):
            self.run_error(3, missing, says="there is no such")
        self.assertIn("some.nrrd", self.run_error(3, "some.nrdd")["next"])

    def test_words_of_other_programs(self):
        self.run_error(2, "list", "x.nrrd", next_says="isoatlas objects")
        self.run_error(2, "mesh", "x.nrrd", next_says="isoatlas extract")
        self.run_ok("phantom", "torus-chain", "--size", "24", "-o", "torus.nrrd")
        at = self.run_json("objects", "torus.nrrd", "--tau", "0.1")
        for name in ("--isovalue", "--threshold"):
            self.assertEqual(self.run_json("objects", "torus.nrrd", name, "0.1"), at)
        self.run_ok("render", "torus.nrrd", "--isovalue", "0.1", "--size", "16x16", "-o", "torus.png")

    def test_every_verb_is_in_one_group(self):
        listed = re.findall(r"(?m)^  (\w+) +[A-Z|\[\]]+ +[A-Z]", self.run_ok("--help").stdout)
        self.assertEqual(sorted(listed), sorted(VERBS))

    def test_what_cannot_be_parsed_is_said_in_our_words(self):
        cases = [(["extract", "-o", "x.ply"], "needs VOLUME"), (["extract", "x.nrrd"], "needs --output FILE"), (["objects", "x.nrrd", "y.nrrd"], "y.nrrd"),
                 (["objects", "x.nrrd", "--both", "--cavities"], "exclude each other"),
                 (["objects", "x.nrrd", "--threads", "99999"], "99999 is not from"), (["view", "x.nrrd", "--port", "0"], "0 is not from 1 to 65535"), (["verify", "x.nrrd", "--levels", "many"], "--levels")]
        for words, says in cases:
            error = self.run_error(2, *words, says=says)
            for raw in ("Could not convert", "required but received", "required T missing", "were not expected", "was not expected", " excludes ", "not in range"):
                self.assertNotIn(raw, error["message"], words)
        self.assertIn("--tau has no value", self.start(["objects", "x.nrrd", "--tau"]).stderr)

    def test_options_before_the_verb(self):
        self.assertIn('"schema"', self.run_ok("--json", "phantom", "--list").stdout)
        self.assertIn('"schema"', self.run_ok("--threads", "1", "--json", "phantom", "--list").stdout)
        self.run_error(2, "--threads", "2", next_says="--help")

    def test_manual_pages_are_without_a_warning(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        for words in ([], *([verb] for verb in VERBS)):
            page = self.run_ok("manual", *words).stdout
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-wall"], input=page, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            self.assertIn("EXIT STATUS", re.sub("\x1b\\[[0-9;]*m|.\b", "", done.stdout))
        self.run_error(2, "manual", "extrct", next_says="extract")

    def test_completions_of_other_shells(self):
        zsh, fish = (self.run_ok("completion", shell).stdout for shell in ("zsh", "fish"))
        for verb in VERBS:
            self.assertIn(f"'{verb}:", zsh)
            self.assertIn(f"-a {verb} ", fish)
        if shutil.which("zsh"):
            (self.folder / "_isoatlas").write_text(zsh)
            script = "fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -d $PWD/dump; autoload +X _isoatlas; print $_comps[isoatlas]"
            done = subprocess.run(["zsh", "-f", "-c", script], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "_isoatlas\n", ""))
        if shutil.which("fish"):
            for typed, expected in (("isoatlas extr", "extract"), ("isoatlas extract --ob", "--object"), ("isoatlas tree --polarity b", "both")):
                done = subprocess.run(["fish", "--no-config", "-c", fish + f"\ncomplete -C '{typed}'"], capture_output=True, text=True)
                self.assertIn(expected, [line.split("\t")[0] for line in done.stdout.splitlines()], done.stderr)

    def test_completion_is_a_script_that_bash_accepts_and_that_completes(self):
        script = self.run_ok("completion", "bash").stdout
        (self.folder / "scan.nrrd").write_text("")
        for typed, expected in (("extract --ob", "--object"), ("scan", "scan.nrrd"), ("tree --polarity b", "both"), ("extract sc", "scan.nrrd"),
                                ("extract scan.nrrd --shell o", "outer"), ("tree --detail l", "levels")):
            words = typed.split()
            probe = script + f'\nCOMP_WORDS=(isoatlas {typed}); COMP_CWORD={len(words)}; _isoatlas; echo "${{COMPREPLY[@]}}"\n'
            done = subprocess.run(["bash", "-u", "-c", probe], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, expected + "\n", ""))
        self.run_error(2, "completion", "tcsh", says="tcsh")


if __name__ == "__main__":
    main()
