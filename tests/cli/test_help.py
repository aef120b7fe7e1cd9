"""isoatlas, --help, help VERB, --version, did you mean, completion."""
import os
import pathlib
import re
import shlex
import subprocess

from harness import CLI, CliTest, main

SOURCE = pathlib.Path(os.environ["ISOATLAS_SOURCE"])
VERBS = ["atlas", "view", "ask", "info", "objects", "measure", "extract", "render", "animate", "tree", "label", "build", "convert", "handles", "spectrum", "table131", "dump", "phantom",
         "verify", "completion", "name"]


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
        for words in (["--version"], ["info", "--version"]):
            self.assertRegex(self.run_ok(*words).stdout, r"^isoatlas \d+\.\d+\.\d+\n$")

    def test_did_you_mean(self):
        self.run_error(2, "ojects", "x.nrrd", next_says="isoatlas objects")
        self.run_error(2, "zzzzzzzzzz", next_says="--help")
        self.run_error(2, "help", "extrct", next_says="isoatlas extract")
        self.run_error(2, "extract", "x.nrrd", "--ojbect", "5", "-o", "x.ply", says="--ojbect", next_says="--object")
        self.run_error(2, "phantom", "gyroyd", "-o", "x.nrrd", next_says="gyroid")

    def test_a_file_instead_of_a_verb(self):
        """It is shown: what is said is about the file."""
        (self.folder / "some.nrrd").write_text("x")
        self.run_error(3, "some.nrrd", says="some.nrrd")
        self.run_error(2, "some.nrdd", says="no verb")

    def test_options_before_the_verb(self):
        self.assertIn('"schema"', self.run_ok("--json", "phantom", "--list").stdout)
        self.assertIn('"schema"', self.run_ok("--threads", "1", "--json", "phantom", "--list").stdout)
        self.run_error(2, "--threads", "2", next_says="--help")

    def test_completion_is_a_script_that_bash_accepts_and_that_completes(self):
        script = self.run_ok("completion", "bash").stdout
        probe = script + '\nCOMP_WORDS=(isoatlas extract --ob); COMP_CWORD=2; _isoatlas; echo "${COMPREPLY[@]}"\n'
        done = subprocess.run(["bash", "-eu", "-c", probe], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "--object\n", ""))
        self.run_error(2, "completion", "tcsh", says="tcsh")


if __name__ == "__main__":
    main()
