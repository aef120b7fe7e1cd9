#!/usr/bin/env python3
"""Fails where a function of src, include or apps has more than 60 lines.

    function_lengths.py ROOT         checks a checkout, prints one line per finding, exits 1 when there is one
    function_lengths.py --self-test  counts known functions

Reads the layout that clang-format gives: what is opened at an indentation is closed by the first } at the same one.
"""
import re
import sys
from pathlib import Path

from layering import sources_of

MAX_LINES = 60
SCOPE = re.compile(r"(template <.*> )?(inline |extern )*(namespace|class|struct|enum|union|extern|concept)\b(?!.*\) (const |noexcept )*\{)")


def head_of(lines, last):
    """(first line, text) of the statement that ends with the { of lines[last]."""
    first = last
    while first > 0 and lines[first - 1].strip() and not lines[first - 1].rstrip().endswith((";", "{", "}", ":")):
        if lines[first - 1].lstrip().startswith(("#", "//")):
            break
        first -= 1
    return first, " ".join(line.strip() for line in lines[first:last + 1])


def functions_of(text):
    """[(first line, number of lines)] of the outermost functions, initialised tables among them."""
    lines = text.splitlines()
    found, opened = [], None  # (indentation, line) of the function that is open
    for number, line in enumerate(lines):
        code = line.rstrip()
        indentation = len(code) - len(code.lstrip())
        if opened and code.lstrip().startswith("}") and indentation <= opened[0]:
            found.append((opened[1] + 1, number - opened[1] + 1))
            opened = None
        if not opened and code.endswith("{") and not code.lstrip().startswith(("#", "//")):
            first, head = head_of(lines, number)
            if "(" in head and not SCOPE.match(head):
                opened = (len(lines[first]) - len(lines[first].lstrip()), first)
    return found


def check(root):
    count, findings = 0, 0
    for path in sources_of(root):
        name = path.relative_to(root).as_posix()
        if not name.startswith(("src/", "include/", "apps/")):
            continue
        for line, length in functions_of(path.read_text(encoding="utf-8")):
            count += 1
            if length > MAX_LINES:
                findings += 1
                print(f"{name}:{line}: a function of {length} lines; at most {MAX_LINES}")
    print(f"function lengths: {count} functions, {findings} too long")
    return 1 if findings or count < 1000 else 0


BODY = "    step();\n"
KNOWN = [
    ("int f() {\n" + BODY * 3 + "}\n", [(1, 5)]),
    ("namespace a {\n\nint f() {\n" + BODY + "}\n}  // namespace a\n", [(3, 3)]),
    ("class A {\npublic:\n    int f() const {\n    " + BODY + "    }\n};\n", [(3, 3)]),
    ("template <class T>\nstruct A : B<T> {\n    int x;\n};\n", []),
    ("int f(int a,\n      int b) {\n    if (a) {\n    " + BODY + "    }\n}\n", [(1, 6)]),
    ("void f() {\n    g([] {\n    " + BODY + "    });\n}\nint x;\n", [(1, 5)]),
    ("struct A f() {\n" + BODY + "}\n", [(1, 3)]),
]


def self_test():
    wrong = [text for text, expected in KNOWN if functions_of(text) != expected]
    for text in wrong:
        print(f"self-test: {text!r}: {functions_of(text)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(self_test() if sys.argv[1] == "--self-test" else check(Path(sys.argv[1])))
