"""Follows what the documents point to.

    links.py check ROOT   prints one line per finding, exits 1 when there is one
    links.py self-test    breaks a small checkout in many ways and fails when one of them is not found

In every .md file a relative link leads to a file of the checkout and #anchors to a heading of it. In the columns "code" and "test" of
docs/theory the names in backticks occur in the file linked beside them: `NAME` in [file](...), [file](...): `NAME`, or `NAME` in the
same. A decision is "# N. Title" with the number of its file, then "Date: YYYY-MM-DD. Status: ...". What comments cite is checked by
citations.py.
"""
import os
import pathlib
import re
import sys
import tempfile
import urllib.parse

FENCE = re.compile(r"^ {0,3}(`{3,}|~{3,}).*?(?:^ {0,3}\1[`~]*[ \t]*$|\Z)", re.S | re.M)
CODE = re.compile(r"(?<!`)(`+)(?!`)((?:(?!\n\s*\n).)+?)(?<!`)\1(?!`)", re.S)
LINK = re.compile(r"\]\(\s*<?([^\s)>]+)>?(?:\s+\"[^\"]*\")?\s*\)|^ {0,3}\[[^\]]+\]:\s*<?([^\s>]+)|<\w[^>]*\s(?:href|src)=\"([^\"]*)\"", re.M)
HEADING = re.compile(r"^ {0,3}#{1,6}[ \t]+(.*?)(?:[ \t]+#+)?[ \t]*$", re.M)
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+)", re.M)
CASE = re.compile(r"^case\s+(\S+)", re.M)
NAME_OR_LINK = re.compile(r"`([^`]+)`|\[[^\]]*\]\(([^)#]+)[^)]*\)(:?)|\b(?:in )?(the same)\b|(;)")


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def blanked(pattern, text):
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def files_of(root):
    """All files but hidden ones and what a build leaves, as paths relative to the root; no git, so that an exported tree can be checked."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if not re.match(r"\.|build$|build-|__pycache__$|node_modules$", name))
        for name in sorted(names):
            yield pathlib.Path(folder, name).relative_to(root).as_posix()


class Checkout:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.files = set(files_of(root))
        self.folders = {parent.as_posix() for name in self.files for parent in pathlib.PurePosixPath(name).parents}
        self.texts = {}

    def text(self, name):
        if name not in self.texts:
            self.texts[name] = (self.root / name).read_text(encoding="utf-8", errors="replace")
        return self.texts[name]

    def target(self, document, path):
        """What a relative link in a document leads to, relative to the root: the document itself for an empty path."""
        return os.path.normpath(os.path.join(os.path.dirname(document), urllib.parse.unquote(path))) if path else document


# --- links and anchors ------------------------------------------------------------------------------------------------------------------

def slug(heading):
    """GitHub's anchor of a heading: its words as shown, in lower case, without punctuation, spaces as hyphens."""
    shown = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    shown = re.sub(r"(?<!\w)(_+)(?=\S)(.+?)(?<=\S)\1(?!\w)", r"\2", re.sub(r"<[^>]+>", "", shown))
    return re.sub(r"[^\w\- ]", "", shown.strip().lower()).replace(" ", "-")


def anchors_of(text):
    text = blanked(FENCE, text)
    found = set(re.findall(r"<\w[^>]*\s(?:id|name)=\"([^\"]*)\"", text))
    for heading in HEADING.findall(text):
        first = name = slug(heading)
        again = 0
        while name in found:
            again += 1
            name = f"{first}-{again}"
        found.add(name)
    return found


def link_findings(checkout, document):
    text = blanked(CODE, blanked(FENCE, checkout.text(document)))
    for match in LINK.finditer(text):
        link = match[1] or match[2] or match[3] or ""
        where = f"{document}:{line_of(text, match.start())}"
        if re.match(r"[A-Za-z][A-Za-z0-9+.-]*:|//", link):
            continue
        path, _, anchor = link.partition("#")
        target = checkout.target(document, path)
        if path.startswith("/") or target not in checkout.files | checkout.folders:
            yield f"{where}: {link}: there is no {target}"
        elif anchor and target.endswith(".md") and urllib.parse.unquote(anchor) not in anchors_of(checkout.text(target)):
            yield f"{where}: {link}: {target} has no heading #{anchor}"
        elif anchor and not target.endswith(".md"):
            lines = re.fullmatch(r"L(\d+)(?:-L(\d+))?", anchor)
            if target in checkout.folders or not lines or int(lines[2] or lines[1]) > checkout.text(target).count("\n"):
                yield f"{where}: {link}: {target} has no lines #{anchor}"


# --- names beside links -----------------------------------------------------------------------------------------------------------------

def occurs(name, target, text):
    """Is NAME, Suite.NAME or START_... a test or a case of this file? Other files: do all parts of a::b occur as words?"""
    if target.endswith("_test.cpp"):
        known = {name for suite, test in TEST.findall(text) for name in (test, f"{suite}.{test}")}
    elif target.endswith(".txt"):
        known = set(CASE.findall(text))
    else:
        return all(re.search(rf"(?<!\w){re.escape(part)}(?!\w)", text) for part in name.split("::"))
    return any(each.startswith(name[:-3]) for each in known) if name.endswith("...") else name in known


def names_beside_links(cell, last):
    """Pairs (name, path of the link it belongs to, None: there is none), and the last link; `last` is the one of the cell above."""
    pairs, waiting, link, follow = [], [], last, False
    for match in NAME_OR_LINK.finditer(cell):
        name, path, colon, same, end = match.groups()
        if name and follow:
            pairs.append((name, link))
        elif name:
            waiting.append(name)
        elif path or same:
            link, follow = path or link, bool(colon)
            pairs += [(name, link) for name in waiting]
            waiting = []
        elif end:
            follow = False
    return pairs + [(name, None) for name in waiting], link


def cells_of(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def name_findings(checkout, document):
    columns, last = [], {}
    for number, line in enumerate(blanked(FENCE, checkout.text(document)).splitlines(), 1):
        if not line.startswith("|"):
            columns, last = [], {}
            continue
        if not columns:
            columns = cells_of(line)
        for column, cell in zip(columns, cells_of(line)):
            if column not in ("code", "test"):
                continue
            pairs, last[column] = names_beside_links(cell, last.get(column))
            for name, path in pairs:
                target = path and checkout.target(document, path)
                if target is None:
                    yield f"{document}:{number}: {name}: there is no link beside it"
                elif target in checkout.files and not occurs(name, target, checkout.text(target)):
                    yield f"{document}:{number}: {name}: not in {target}"


# --- heads of decisions -------------------------------------------------------------------------------------------------------------------

def head_findings(checkout, document):
    number = re.match(r"docs/decisions/(\d{4})-", document)
    if number and not re.match(rf"# {int(number[1])}\. \S.*\n\nDate: \d{{4}}-\d\d-\d\d\. Status: \S", checkout.text(document)):
        yield f"{document}:1: a decision begins with \"# {int(number[1])}. Title\" and \"Date: YYYY-MM-DD. Status: ...\""


# --- all of it ------------------------------------------------------------------------------------------------------------------------------

def findings_of(root):
    """Returns the findings and how many documents were read."""
    checkout = Checkout(root)
    documents = sorted(name for name in checkout.files if name.endswith(".md"))
    findings = [finding for document in documents for finding in link_findings(checkout, document)]
    findings += [finding for document in documents if document.startswith("docs/theory/") for finding in name_findings(checkout, document)]
    return findings + [finding for document in documents for finding in head_findings(checkout, document)], len(documents)


GOOD = {
    "README.md": """# Read *me*: [first](docs/theory/README.md)

[a](docs/theory/1.md#a-saddle_s--twice), [b](<docs/theory/1.md#twice-1> "again"), [c](docs), [d](https://example.org/none), [e](#read-me-first), [f](src/a.h#L1)
`[no](link)` <img src="docs/theory/1.md"> [reference][r]

[r]: LICENSE%20file

```sh
# not a heading, [not](a-link)
```
""",
    "LICENSE file": "",
    "docs/theory/README.md": """# Theory

[1. Twice](1.md#twice)
""",
    "docs/theory/1.md": """# One

## A `saddle_s` & _twice_
## Twice
## Twice

| statement | code | test |
|---|---|---|
| a | `field::face` in [a](../../src/a.h) | `Suite.First`, `Second` in [t](../../tests/a_test.cpp); `one_...` in [cases](../../tests/cases.txt) |
| b | | `one_two` in the same |
| c | | [t](../../tests/a_test.cpp): `Third`, `First`; `one_two` in [cases](../../tests/cases.txt) |
| `d` | | the same |
""",
    "docs/decisions/0007-b.md": "# 7. B\n\nDate: 2026-01-02. Status: accepted.\n",
    "src/a.h": "namespace field { int face(); }\n",
    "tests/a_test.cpp": "TEST(Suite, First) {}\nRC_GTEST_PROP(Suite, Second, ()) {}\nTEST_F(Suite, Third) {}\n",
    "tests/cases.txt": "case one_two\n",
    "build/notes.md": "[none](none)",
    ".hidden/notes.md": "[none](none)",
}
# file, what is there, what comes in its place: one finding or more each
BAD = (
    ("README.md", "docs/theory/1.md#a-", "docs/theory/2.md#a-"),
    ("README.md", "#a-saddle_s--twice", "#a-saddle_s-twice"),
    ("README.md", "#twice-1", "#twice-2"),
    ("README.md", "](docs)", "](/docs)"),
    ("README.md", "](docs)", "](../docs)"),
    ("README.md", "](docs)", "](build/notes.md)"),
    ("README.md", "](docs)", "](Docs)"),
    ("README.md", "](docs)", "](docs#theory)"),
    ("README.md", "#read-me-first", "#Read-me-first"),
    ("README.md", "#read-me-first", "#not-a-heading-nota-link"),
    ("README.md", "#L1", "#L9"),
    ("README.md", "`[no](link)`", "[no](link)"),
    ("README.md", 'src="docs', 'src="doc'),
    ("README.md", "LICENSE%20file", "LICENSE"),
    ("docs/theory/1.md", "## Twice\n## Twice", "## Twice"),
    ("docs/theory/1.md", "field::face", "field::edge"),
    ("docs/theory/1.md", "Suite.First", "Other.First"),
    ("docs/theory/1.md", "`Second`", "`Sec`"),
    ("docs/theory/1.md", "one_...", "two_..."),
    ("docs/theory/1.md", "`one_two` in the same", "`First` in the same"),
    ("docs/theory/1.md", "`one_two` in the same", "`one_two`"),
    ("docs/theory/1.md", "`Third`", "`one_two`"),
    ("docs/theory/1.md", "; `one_two`", ", `one_two`"),
    ("docs/theory/README.md", "#twice", "#thrice"),
    ("docs/decisions/0007-b.md", "# 7.", "# 8."),
    ("docs/decisions/0007-b.md", "# 7. ", "# "),
    ("docs/decisions/0007-b.md", "-01-02.", "."),
    ("docs/decisions/0007-b.md", "Status: accepted.", ""),
    ("src/a.h", "face()", "faces()"),
    ("tests/a_test.cpp", "TEST_F(", "// TEST_F("),
    ("tests/cases.txt", "case one_two", "# case one_two"),
)


def self_test(name, findings_of, good, count, bad):
    """Lays out the files of `good`, which have no fault and `count` of what is counted, and notices each fault of `bad`: files that change."""
    def findings_in(files):
        with tempfile.TemporaryDirectory(prefix=f"isoatlas-{name}-") as folder:
            for path, text in files.items():
                path = pathlib.Path(folder, path)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return findings_of(folder)

    findings, counted = findings_in(good)
    if findings or counted != count:
        raise SystemExit(f"{name}: {counted} without a fault, expected {count}, but found\n" + "\n".join(findings))
    for path, old, new in bad:
        if old not in good.get(path, ""):
            raise SystemExit(f"{path} has no {old}")
        if not findings_in({**good, path: good[path].replace(old, new) if old else new})[0]:
            raise SystemExit(f"nothing noticed in {path} with {new} for {old}")
    print(f"{name}: {len(bad)} faults noticed")


def main(name, findings_of, good, count, bad, counted, least):
    """What the command line asks of a test of documents: its self-test, or the findings in a checkout, which has at least so many `counted`."""
    if sys.argv[1] == "self-test":
        self_test(name, findings_of, good, count, bad)
        return
    findings, number = findings_of(sys.argv[2])
    for finding in findings:
        print(finding)
    print(f"{name}: {number} {counted}, {len(findings)} findings")
    if findings or number < least:
        raise SystemExit(1)


if __name__ == "__main__":
    main("links", findings_of, GOOD, 4, BAD, "documents", 10)
