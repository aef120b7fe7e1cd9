"""Runs the marked blocks of a Markdown file.

    <!-- run -->       before ```sh:   run by bash in one empty folder for the whole file, `isoatlas` on the PATH; must succeed
    <!-- run as python -->  before ```python: run in the same folder
    <!-- run with h5py -->  before ```python: run in the same folder; left out, and said so, where h5py is not installed
    <!-- prints -->    before ```text: exactly what the block before it printed on standard output
    <!-- program -->   before ```cpp:  printed by `blocks.py program FILE`
    <!-- data lung_ct/lung_hi.nrrd -->  anywhere: this file of ../shared/data lies in the folder. Without the data, nothing of the file runs

`blocks.py pictures FILE` runs them too, and copies the pictures that the file shows from that folder to beside it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MARK = r"<!-- (run with h5py|run as python|run|prints|program) -->"
BLOCK = re.compile(MARK + r"\n+```(\w+)\n(.*?)^```$", re.S | re.M)
LANGUAGE = {"run": "sh", "run as python": "python", "run with h5py": "python", "prints": "text", "program": "cpp"}
DATA = re.compile(r"^<!-- data ([\w./-]+) -->$", re.M)
PICTURE = re.compile(r"!\[[^\]]*\]\(([\w-]+\.\w+)\)")
SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data"
PYTHON = "/usr/bin/python3"   # the one that Debian's packages are for


def blocks_of(text):
    found = [(match[1], match[2], match[3]) for match in BLOCK.finditer(text)]
    marks = len(re.findall(MARK, text))
    if len(found) != marks:
        raise SystemExit(f"{marks} marks but {len(found)} blocks: a mark stands right before its fence")
    for mark, language, _ in found:
        if LANGUAGE[mark] != language:
            raise SystemExit(f"a block marked {mark} is {language}, not {LANGUAGE[mark]}")
    return found


def start(mark, body, folder, environment):
    """Runs a block. Returns what it prints, None where it cannot run; raises AssertionError when it fails."""
    if mark == "run":
        command = ["bash", "-euo", "pipefail", "-c", body]
    else:
        command = [PYTHON, "-c", body]
        if mark == "run with h5py" and subprocess.run([PYTHON, "-c", "import h5py"], capture_output=True).returncode != 0:
            print("a block is left out: h5py is not installed")
            return None
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, f"exit code {done.returncode}:\n{body}\n{done.stderr}"
    return done.stdout


def run(text, pictures=None):
    """Returns the number of blocks run; raises AssertionError with what went wrong. pictures: the folder that they are copied to."""
    count, printed = 0, None
    data = [SHARED / name for name in DATA.findall(text)]
    with tempfile.TemporaryDirectory(prefix="isoatlas-docs-") as folder:
        bin_folder = pathlib.Path(folder, "bin")
        work = pathlib.Path(folder, "work")
        bin_folder.mkdir()
        work.mkdir()
        (bin_folder / "isoatlas").symlink_to(os.environ["ISOATLAS_CLI"])
        for file in data:
            (work / file.name).symlink_to(file)
        environment = dict(os.environ, PATH=f"{bin_folder}:{os.environ['PATH']}", XDG_STATE_HOME=folder)
        for mark, _, body in blocks_of(text):
            if mark.startswith("run"):
                printed = start(mark, body, work, environment)
                count += 1
            elif mark == "prints" and printed is not None:
                assert printed == body, f"the document shows\n{body}\nbut the command prints\n{printed}"
        for name in PICTURE.findall(text) if pictures else []:
            shutil.copyfile(work / name, pathlib.Path(pictures, name))
    return count


def self_test():
    os.environ["ISOATLAS_CLI"] = "/bin/echo"
    fence = "```"
    good = f"<!-- run -->\n{fence}sh\nisoatlas 1 | tee x\ncat x\n{fence}\n<!-- prints -->\n{fence}text\n1\n1\n{fence}\n"
    assert run(good) == 1
    for bad in (good.replace("1\n1", "2\n1"), good.replace("cat x", "cat y"), good.replace("cat x", "false | true")):
        try:
            run(bad)
        except AssertionError:
            continue
        raise SystemExit(f"nothing noticed in\n{bad}")
    with tempfile.NamedTemporaryFile("w", suffix=".md") as page:   # nothing of it runs where a volume is missing
        page.write("<!-- data none/of/this.nrrd -->\n" + good.replace("cat x", "false"))
        page.flush()
        main("run", page.name)


def main(action, *files):
    if action == "self-test":
        self_test()
        return
    text = pathlib.Path(files[0]).read_text()
    if action == "program":
        programs = [body for mark, _, body in blocks_of(text) if mark == "program"]
        if len(programs) != 1:
            raise SystemExit(f"{files[0]}: {len(programs)} programs, expected one")
        print(programs[0], end="")
        return
    missing = [name for name in DATA.findall(text) if not (SHARED / name).exists()]
    if missing and action == "run":
        print(f"{files[0]}: left out, there is no {SHARED / missing[0]}")
        return
    try:
        count = run(text, pathlib.Path(files[0]).resolve().parent if action == "pictures" else None)
    except AssertionError as problem:
        raise SystemExit(f"{files[0]}: {problem}")
    if count == 0:
        raise SystemExit(f"{files[0]}: nothing is marked to run")
    print(f"{files[0]}: {count} blocks ran")


if __name__ == "__main__":
    main(*sys.argv[1:])
