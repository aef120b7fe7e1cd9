"""Runs the command line in a folder of its own and looks at exit code, standard output and standard error."""
import json
import os
import pathlib
import pty
import subprocess
import tempfile
import unittest

CLI = os.environ["ISOATLAS_CLI"]
SANITIZED = bool(os.environ.get("ISOATLAS_SANITIZE"))  # then memory is mostly that of the sanitizer: its size says nothing
MESHES = [".ply", ".stl", ".obj", ".vtp", ".glb"]


TYPES = {"object": dict, "array": list, "string": str, "integer": int, "number": (int, float), "boolean": bool, "null": type(None)}


def schema_problems(value, schema, where="$"):
    """Where and why a value breaks a schema of docs/schema."""
    found = []
    types = schema.get("type", list(TYPES))
    types = types if isinstance(types, list) else [types]
    if not any(isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool)) for name in types):
        return [f"{where} is no {types}: {value!r}"]
    if "const" in schema and value != schema["const"] or "enum" in schema and value not in schema["enum"]:
        found.append(f"{where} cannot be {value!r}")
    if value is None:
        return found
    if "minimum" in schema and value < schema["minimum"]:
        found.append(f"{where} is below {schema['minimum']}: {value!r}")
    for name in schema.get("required", []) if isinstance(value, dict) else []:
        if name not in value:
            found.append(f"{where} has no {name}")
    for name, inner in schema.get("properties", {}).items():
        if isinstance(value, dict) and name in value:
            found += schema_problems(value[name], inner, f"{where}.{name}")
    if isinstance(value, list) and not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
        found.append(f"{where} has {len(value)} items")
    if isinstance(value, list) and "items" in schema:
        for i, item in enumerate(value):
            found += schema_problems(item, schema["items"], f"{where}[{i}]")
    return found


class CliTest(unittest.TestCase):
    """Phantoms are made once per class in `self.folder`."""

    phantoms = {}   # file name -> arguments of `isoatlas phantom`

    @classmethod
    def setUpClass(cls):
        cls.held = tempfile.TemporaryDirectory(prefix="isoatlas-cli-")
        cls.folder = pathlib.Path(cls.held.name)
        for name, arguments in cls.phantoms.items():
            done = cls.start(["phantom", *arguments, "-o", name])
            assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.held.cleanup()

    @classmethod
    def start(cls, arguments, **options):
        options.setdefault("stdout", subprocess.PIPE)
        path = f"{pathlib.Path(CLI).parent}:{os.environ['PATH']}"   # hints begin with the name alone then
        environment = {**os.environ, "PATH": path, **options.pop("environment", {})}
        return subprocess.run([CLI, *map(str, arguments)], cwd=cls.folder, stderr=subprocess.PIPE, text=True, env=environment,
                              timeout=1800 if SANITIZED else 300, **options)

    def on_a_terminal(self, arguments, **environment):
        """Standard error (and output) connected to a pseudo terminal. Returns what it showed."""
        try:
            leader, follower = pty.openpty()
        except OSError as error:   # a container without /dev/pts
            self.skipTest(f"no pseudo terminal here: {error}")
        process = subprocess.Popen([CLI, *arguments], cwd=self.folder, stdout=follower, stderr=follower, stdin=subprocess.DEVNULL,
                                   env=dict(os.environ, TERM="xterm", **environment))
        os.close(follower)
        shown = b""
        while True:
            try:
                block = os.read(leader, 65536)
            except OSError:   # Linux: the other side is closed
                break
            if not block:
                break
            shown += block
        os.close(leader)
        self.assertEqual(process.wait(), 0, shown)
        return shown.decode()

    def run_ok(self, *arguments):
        done = self.start(arguments)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
        return done

    def run_json(self, *arguments, code=0):
        done = self.start([*arguments, "--json"])
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr}")
        return json.loads(done.stdout, parse_constant=lambda word: self.fail(f"{word} is not JSON"))

    def assert_schema(self, document, name):
        """The document is what docs/schema/NAME.schema.json says, as far as the words that our schemas use."""
        self.assertEqual(schema_problems(document, self.schema(name)), [])

    @staticmethod
    def schema(name):
        return json.loads((pathlib.Path(os.environ["ISOATLAS_SOURCE"]) / "docs" / "schema" / f"{name}.schema.json").read_text())

    def run_error(self, code, *arguments, says="", next_says=""):
        """The failure is told once on standard error, nothing on standard output; with --json it is a document. Returns its error."""
        plain = self.start(arguments)
        self.assertEqual(plain.returncode, code, f"{arguments}: {plain.stdout}{plain.stderr}")
        self.assertEqual(plain.stdout, "", arguments)
        messages = [line for line in plain.stderr.splitlines() if line.startswith("isoatlas: ")]
        self.assertEqual(len(messages), 1, plain.stderr)
        self.assertIn(says, messages[0])
        document = self.run_json(*arguments, code=code)
        self.assertEqual(document["schema"], "isoatlas/error/1")
        error = document["error"]
        self.assertEqual(error["exit_code"], code)
        self.assertEqual(set(error), {"kind", "exit_code", "message", "file", "where", "what", "expected", "next", "reason", "value",
                                      "choices"})
        self.assertEqual("isoatlas: " + error["message"], messages[0])
        self.assertIn(next_says, error["next"])
        self.assertNotEqual(error["what"], "")
        self.assertNotEqual(error["next"], "", f"no next step: {messages[0]}")
        return error

    def assert_no_partial(self):
        self.assertEqual([str(path) for path in self.folder.rglob("*.partial")], [])


def writes_in(process, folder):
    """Is a process writing a file in a folder: one without a name, or with a temporary one?"""
    descriptors = pathlib.Path(f"/proc/{process.pid}/fd")
    try:
        opened = [os.readlink(descriptor) for descriptor in descriptors.iterdir()]
    except OSError:   # it has ended, or one has been closed meanwhile
        return False
    unnamed = str(folder.resolve()) + "/#"
    return any(path.startswith(unnamed) or pathlib.Path(path).name.startswith(".isoatlas-") for path in opened)


def main():
    unittest.main(verbosity=2)
