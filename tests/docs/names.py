"""Compares the documents with the names of the code.

    names.py check ROOT   prints one line per finding, exits 1 when there is one
    names.py self-test    breaks a small checkout in many ways and fails when one of them is not found

Every public type (include/isoatlas/*.h) is in backticks in docs/glossary.md, or its name is made of PLAIN words. docs/architecture.md has
one line for each room of tests/layering/layering.py, in its order, with library and public headers. Every decision is in the index
docs/decisions/README.md under its number, with its title.
"""
import ast
import re

from links import Checkout, line_of, main

TYPE = re.compile(r"^(?:template <[^\n]*>\n?)?(?:class|struct|enum class|concept|using) (?!std::)(\w+)(?=[^;\n:]*[{=]|[^;\n]* : )", re.M)
WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z][a-z]*\d*|[a-z]+")
# words of plain English, and those that every programmer knows
PLAIN = set("""
    Allocator Analysis Animation Array Atlas Background Bar Build Camera Check Clock Coarse Colour Context Contour Cut Detail
    Environment Error Estimate Extent Extract Geometry Image Index3 Info Kind Label Mat3 Material Mesh Missing Number Numbers Object Open
    Options Origin Output Page Phantom Policy Preview Progress Projection Rank Reader Reason Render Report Result Scale Scene Server Sink Slice
    Spectrum State Store Surface Text Tree Type Value Vec3 Verify View Volume
""".split())
ROOM = re.compile(r"^\| ([\w ]+) \| `([\w/]+)` \|(?:[^|]*\|){4} ([\w, ]*?) ?\|$", re.M)
DECISION = re.compile(r"^\| (\d+) \| \[([^\]]+)\]\(([\w.-]+)\) \|", re.M)


def type_findings(checkout):
    glossary = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`]+)`", checkout.text("docs/glossary.md")))))
    for name in sorted(checkout.files):
        if not re.fullmatch(r"include/isoatlas/\w+\.h", name):
            continue
        text = checkout.text(name)
        for match in TYPE.finditer(text):
            if match[1] not in glossary and not set(WORD.findall(match[1])) <= PLAIN:
                yield f"{name}:{line_of(text, match.start(1))}: {match[1]} is not in docs/glossary.md"


def constant(text, name):
    """The value of `name = ...` in a Python source, without running it."""
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == name:
            return ast.literal_eval(node.value)
    return {}


def room_findings(checkout):
    layering = checkout.text("tests/layering/layering.py")
    public = constant(layering, "PUBLIC")
    expected = [(library, room, sorted(public.get(room, "").split()))
                for library, (_, rooms) in constant(layering, "LIBRARIES").items()
                for room in rooms + [room for room, of in constant(layering, "OF_PROGRAMS").items() if of == library]]
    shown = [(library, room, sorted(re.findall(r"\w+", headers)))
             for library, room, headers in ROOM.findall(checkout.text("docs/architecture.md"))]
    for line in [each for each in expected if each not in shown] + [each for each in shown if each not in expected]:
        yield f"docs/architecture.md: {line}: rooms and public headers are {'to be listed' if line in expected else 'otherwise'}"
    if sorted(shown) == sorted(expected) and shown != expected:
        yield "docs/architecture.md: rooms stand in the order of tests/layering/layering.py"


def decision_findings(checkout):
    index = {path: (number, title) for number, title, path in DECISION.findall(checkout.text("docs/decisions/README.md"))}
    for name in sorted(checkout.files):
        head = re.match(r"# (\d+)\. (.*)", checkout.text(name)) if re.match(r"docs/decisions/\d{4}-", name) else None
        if head and index.get(name.rsplit("/", 1)[1]) != (head[1], head[2]):
            yield f"{name}: its line in docs/decisions/README.md is missing or another one"


def findings_of(root):
    """Returns the findings and how many public types there are."""
    checkout = Checkout(root)
    types = sum(len(TYPE.findall(checkout.text(name))) for name in checkout.files if name.startswith("include/isoatlas/"))
    return [*type_findings(checkout), *room_findings(checkout), *decision_findings(checkout)], types


GOOD = {
    "include/isoatlas/a.h": "struct Locator {\n    int x;\n};\nclass Later;\n"
                            "enum class TreeKind : int { a };\ntemplate <class T>\nusing Array = T;\n",
    "docs/glossary.md": "| | `Locator::at` | point location |\n",
    "tests/layering/layering.py": 'LIBRARIES = {"core": ([], ["base", "a/b"]), "render": (["core"], ["image"])}\nPUBLIC = {"a/b": "a"}\n',
    "docs/architecture.md": "| library | room | s | m | m | s | headers |\n|---|---|---|---|---|---|---|\n"
                            "| core | `base` | s | m | - | `a.h` | |\n| core | `a/b` | s | m | - | `a.h` | a |\n"
                            "| render | `image` | s | m | - | | |\n",
    "docs/decisions/README.md": "| 7 | [B](0007-b.md) | 2026-01-02 |\n",
    "docs/decisions/0007-b.md": "# 7. B\n",
}
# file, what is there, what comes in its place: one finding or more each
BAD = (
    ("include/isoatlas/a.h", "struct Locator", "struct Holder"),
    ("include/isoatlas/a.h", "TreeKind", "TreeKid"),
    ("include/isoatlas/a.h", "using Array", "using Arrow"),
    ("docs/glossary.md", "`Locator::at`", "Locator"),
    ("docs/architecture.md", "| core | `base`", "| store | `base`"),
    ("docs/architecture.md", "`a/b`", "`a/c`"),
    ("docs/architecture.md", "`a.h` | a |", "`a.h` | a, b |"),
    ("docs/architecture.md", "| render | `image` | s | m | - | | |\n", ""),
    ("docs/architecture.md", "| core | `base` | s | m | - | `a.h` | |\n| core | `a/b` | s | m | - | `a.h` | a |\n",
     "| core | `a/b` | s | m | - | `a.h` | a |\n| core | `base` | s | m | - | `a.h` | |\n"),
    ("tests/layering/layering.py", '"image"', '"image", "render"'),
    ("docs/decisions/README.md", "[B]", "[C]"),
    ("docs/decisions/README.md", "| 7 |", "| 8 |"),
    ("docs/decisions/0008-c.md", "", "# 8. C\n"),
)


if __name__ == "__main__":
    main("names", findings_of, GOOD, 3, BAD, "public types", 50)
