"""Which sources of this repository include which, and which differ from a revision: for the scripts that look at a part of them."""
import os.path
import re
import subprocess

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.M)
PLACES = ("src/", "include/", "apps/isoatlas/")  # of names in #include, beside the folder of the file
SOURCES = (".h", ".cpp")


def tree_files(root, folders=("src", "include")):
    """path -> text of the sources in folders of a working tree."""
    return {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for folder in folders
            for p in sorted((root / folder).rglob("*")) if p.suffix in SOURCES}


def commit_files(root, commit):
    """As tree_files, of a commit."""
    def git(*arguments, **options):
        return subprocess.run(["git", "-C", root, *arguments], check=True, capture_output=True, **options).stdout
    paths = [p for p in git("ls-tree", "-r", "--name-only", commit, "src", "include").decode().split("\n") if p.endswith(SOURCES)]
    blobs, files, at = git("cat-file", "--batch", input="".join(f"{commit}:{p}\n" for p in paths).encode()), {}, 0
    for path in paths:
        end = blobs.index(b"\n", at)
        size = int(blobs[at:end].split()[-1])
        files[path] = blobs[end + 1:end + 1 + size].decode()
        at = end + size + 2
    return files


def included(files):
    """path -> the paths among files that it names."""
    found = {}
    for path, text in files.items():
        places = (os.path.dirname(path) + "/", *PLACES)
        found[path] = sorted({place + name for name in INCLUDE.findall(text) for place in places if place + name in files} - {path})
    return found


def reached(graph, starts):
    """These paths, and all that a graph reaches from them: what they include by included(), what includes them by users()."""
    seen, todo = set(), list(starts)
    while todo:
        path = todo.pop()
        if path not in seen:
            seen.add(path)
            todo += graph.get(path, ())
    return seen


def users(graph):
    """path -> the paths that name it."""
    found = {}
    for path, names in graph.items():
        for name in names:
            found.setdefault(name, []).append(path)
    return found


def changed_since(root, revision):
    """Paths that differ from a revision, those that git does not know yet included; None where git does not know the revision."""
    paths = set()
    for command in (["diff", "--name-only", revision], ["ls-files", "--others", "--exclude-standard"]):
        done = subprocess.run(["git", "-C", root, *command], capture_output=True, text=True)
        if done.returncode != 0:
            return None
        paths |= set(done.stdout.splitlines())
    return paths
