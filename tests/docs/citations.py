"""Follows what comments point to.

    citations.py check ROOT   prints one line per finding, exits 1 when there is one
    citations.py self-test    breaks a small checkout in many ways and fails when one of them is not found

Sources cite pages of this checkout by their path from the root: docs/NAME.md leads to a file, docs/NAME.md#ANCHOR to a heading of it,
docs/decisions/NNNN to the one decision of that number. "NAME.md section 3" and "NAME.md T3" lead nowhere: a page has no numbered sections.
"""
import re

from links import Checkout, anchors_of, line_of, main

SOURCES = (".h", ".cpp", ".in", ".cmake", ".txt", ".py", ".sh", ".mjs", ".ts", ".css", ".html", ".rc", "Makefile")
OWN = ("tests/docs/citations.py", "tests/docs/links.py", "tests/docs/names.py")  # they show what they look for
PAGE = re.compile(r"(?<![\w./-])((?:[\w.-]+/)*[\w-]+\.md)\b(?:#([\w-]+))?")
DECISION = re.compile(r"(?<![\w./-])docs/decisions/(\d{4})(?![\w-])")
SECTION = re.compile(r"([\w-]+\.md)[\s/#*]+(T\d+|sections?)\b")


def findings_in(checkout, name):
    text = checkout.text(name)

    def finding(match, words):
        return f"{name}:{line_of(text, match.start())}: {match[0].split()[0]}: {words}"

    for match in PAGE.finditer(text):
        page, anchor = match.groups()
        if not page.startswith("docs/") and not anchor:
            continue  # a name of a file, not a place to read
        if page not in checkout.files:
            yield finding(match, f"there is no {page}")
        elif anchor and anchor not in anchors_of(checkout.text(page)):
            yield finding(match, f"{page} has no heading #{anchor}")
    for match in DECISION.finditer(text):
        pages = [page for page in checkout.files if page.startswith(f"docs/decisions/{match[1]}-")]
        if len(pages) != 1:
            yield finding(match, f"{len(pages)} decisions have this number")
    for match in SECTION.finditer(text):
        yield finding(match, "cite a page of docs/ by the #anchor of its heading")


def findings_of(root):
    """Returns the findings and how many citations of pages there are."""
    checkout = Checkout(root)
    names = [name for name in sorted(checkout.files) if name.endswith(SOURCES) and name not in OWN]
    citations = sum(len(PAGE.findall(checkout.text(name))) + len(DECISION.findall(checkout.text(name))) for name in names)
    return [finding for name in names for finding in findings_in(checkout, name)], citations


GOOD = {
    "README.md": "# One\n",
    "docs/a.md": "# A\n\n## Two words\n\n```sh\n# no heading\n```\n",
    "docs/theory/b.md": "# B: `b`\n",
    "docs/decisions/0007-b.md": "# 7. B\n",
    "src/a.h": "// docs/a.md#two-words, docs/theory/b.md#b-b; docs/theory/b.md. See docs/decisions/0007, other.md and\n// (README.md#one)\n",
    "web/a.ts": "/** docs/decisions/0007-b.md, docs/theory */\n",
    "Makefile": "page: ## writes docs/a.md\n",
    "src/data.bin": "docs/none.md",
    "build/a.h": "// docs/none.md",
}
# file, what is there (nothing: a new file), what comes in its place: one finding or more each
BAD = (
    ("src/a.h", "docs/a.md#two", "docs/c.md#two"),
    ("src/a.h", "#two-words", "#two-word"),
    ("src/a.h", "#two-words", "#no-heading"),
    ("src/a.h", "docs/theory/b.md.", "docs/b.md."),
    ("src/a.h", "theory/b.md#b-b", "theory/b.md#b"),
    ("src/a.h", "decisions/0007", "decisions/0008"),
    ("src/a.h", "README.md#one", "README.md#two"),
    ("src/a.h", "docs/a.md#two", "theory/b.md#two"),
    ("src/a.h", "other.md and", "other.md section 3 and"),
    ("src/a.h", "other.md and", "other.md\n// sections 3 to 4 and"),
    ("src/a.h", "other.md and", "other.md T3 and"),
    ("web/a.ts", "0007-b", "0007-c"),
    ("Makefile", "docs/a.md", "docs/b.md"),
    ("docs/a.md", "## Two words", "## Three words"),
    ("docs/decisions/0007-c.md", "", "# 7. C\n"),  # two of one number
)


if __name__ == "__main__":
    main("citations", findings_of, GOOD, 8, BAD, "in comments", 50)
