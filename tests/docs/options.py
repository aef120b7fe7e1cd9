"""The library names no option and no verb of the command line: errors carry a reason, and the command line adds what to type.

    options.py check ROOT   prints one line per finding, exits 1 when there is one
    options.py self-test    breaks a small checkout in many ways and fails when one of them is not found

No string in src/ or include/ holds "--option", "-o" or "isoatlas VERB", a verb being a file of apps/isoatlas/verbs; EXEMPT has the files
that may, and why. docs/cli.md#reasons has one line for each value of Reason in include/isoatlas/error.h.
"""
import re

from links import Checkout, line_of, main

LITERAL = re.compile(r"//[^\n]*|/\*.*?\*/|#include[^\n]*|R\"(\w*)\((.*?)\)\1\"|\"((?:[^\"\\\n]|\\.)*)\"|'(?:[^'\\\n]|\\.)+'", re.S)
OPTION = r"(?<![\w<!-])--[a-z][\w-]*|(?<![\w\"'-])-[a-z](?![\w-])"
# their options are theirs
OTHER_PROGRAMS = re.compile(r"\b(?:unu|dcm2niix|mogrify) ")
EXEMPT = {
    "src/page/page_json.cpp": "the page shows its reader the commands that extract what it shows",
    "src/page/label_page.cpp": "likewise, the commands that write and draw a label",
    "src/phantom/phantom.cpp": "a summary names the parameters of its phantom; files of phantoms hold it",
    "src/atlas/lock_text.h": "the mark of the folder of a build: bytes on disk",
}
REASONS = re.compile(r"enum class Reason[^{]*\{(.*?)\n\};", re.S)
REASON = re.compile(r"^ *(\w+),?$", re.M)
ROW = re.compile(r"^\| `(\w+)` \|", re.M)


def literals_of(text):
    for match in LITERAL.finditer(text):
        content = match[2] if match[2] is not None else match[3]
        if content:
            yield match, content


def option_findings(checkout):
    verbs = [re.sub(r".*/|\.cpp", "", name) for name in checkout.files if re.fullmatch(r"apps/isoatlas/verbs/\w+\.cpp", name)]
    named = re.compile(OPTION + r"|(?<![\w/])isoatlas (?:" + "|".join(sorted(verbs)) + r")\b")
    for name in sorted(checkout.files):
        if not re.match(r"(?:src|include)/.*\.(?:h|cpp)$", name) or name in EXEMPT:
            continue
        text = checkout.text(name)
        lines = text.splitlines()
        for match, content in literals_of(text):
            found = named.search(content)
            line = line_of(text, match.start())
            if found and not OTHER_PROGRAMS.search(lines[line - 1]):
                yield f"{name}:{line}: {found[0]}: give the error a reason, and apps/isoatlas/text/advice.cpp the option"


def reasons_of(checkout):
    body = REASONS.search(checkout.text("include/isoatlas/error.h"))
    return REASON.findall(re.sub(r" *//[^\n]*", "", body[1])) if body else []


def reason_findings(checkout):
    page = checkout.text("docs/cli.md")
    shown = ROW.findall(page[page.find("## Reasons"):].split("\n## ")[0]) if "## Reasons" in page else []
    reasons = [reason for reason in reasons_of(checkout) if reason != "none"]
    for reason in [each for each in reasons if shown.count(each) != 1] + [each for each in shown if each not in reasons]:
        yield f"docs/cli.md: {reason} has {shown.count(reason)} lines in Reasons and {reasons.count(reason)} in include/isoatlas/error.h"


def findings_of(root):
    """Returns the findings and how many literals and reasons there are."""
    checkout = Checkout(root)
    sources = [name for name in checkout.files if re.match(r"(?:src|include)/.*\.(?:h|cpp)$", name)]
    count = sum(1 for name in sources for _ in literals_of(checkout.text(name))) + len(reasons_of(checkout))
    return [*option_findings(checkout), *reason_findings(checkout)], count


GOOD = {
    "apps/isoatlas/verbs/view.cpp": 'const char* text = "isoatlas view --port N";',
    "docs/cli.md": "# A\n\n## Reasons\n\n| reason | when |\n|---|---|\n| `disk_full` | |\n| `port_in_use` | |\n\n## JSON\n\n| `a` |\n",
    "include/isoatlas/error.h": "enum class Reason : int {\n    none,\n\n    // Disk\n    disk_full,  ///< no room, at all\n    port_in_use\n};\n",
    "src/a.cpp": '#include "a--b.h"\nint a = 1\'000;  // --port\nchar c = \'"\';\nconst char* text = "a store of isoatlas - viewer <!-- x -->";\n'
                 'const char* other = "with unu save -i IN -o OUT";\n',
    "src/page/page_json.cpp": 'const char* command = " --tau ";',
}
BAD = [
    ("src/a.cpp", "a store", "a --port"),
    ("src/a.cpp", "a store of isoatlas", "start isoatlas view"),
    ("src/a.cpp", "a store", "name it with -o"),
    ("src/a.cpp", "with unu", "with"),
    ("src/a.cpp", '"a store of isoatlas', 'R"(x --port)" "'),
    ("src/b.h", "", 'inline const char* b = "give --dims";'),
    ("include/isoatlas/b.h", "", 'inline const char* b = "a" "(--dims)";'),
    ("include/isoatlas/error.h", "port_in_use", "port_in_use,\n    no_token  ///< of a server"),
    ("include/isoatlas/error.h", "    disk_full,  ///< no room, at all\n", ""),
    ("docs/cli.md", "| `port_in_use` | |\n", "| `port_in_use` | |\n| `port_in_use` | |\n"),
    ("docs/cli.md", "## Reasons", "## Causes"),
]


if __name__ == "__main__":
    main("options", findings_of, GOOD, 6, BAD, "strings and reasons", 2000)
