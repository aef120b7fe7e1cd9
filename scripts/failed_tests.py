#!/usr/bin/env python3
"""The last lines of every test that a run of ctest failed: failed_tests.py LastTest.log; failed_tests.py --self-test.

Runners say at their end what failed; ctest has printed much after it by then."""
import pathlib
import re
import sys

from skipped_tests import TEST

END = re.compile(r"^Test (Passed|Failed)\.")
KEPT = 80


def failed(lines):
    """(name, its last lines) of each, in order."""
    found, name, output = [], "", []
    for line in lines:
        line = line.rstrip("\n")
        if match := TEST.match(line):
            name, output = match[1], []
        elif (match := END.match(line)) and name:
            if match[1] != "Passed":
                found.append((name, output[-KEPT:]))
            name = ""
        else:
            output.append(line)
    return found


def self_test():
    text = ["1/2 Testing: a", "fine", "Test Passed.", "2/2 Testing: b", "2/2 Test: b", *map(str, range(100)), "Test Failed."]
    assert failed(text) == [("b", [str(i) for i in range(20, 100)])], failed(text)


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    for name, output in failed(pathlib.Path(sys.argv[1]).read_text(errors="replace").splitlines()):
        print(f"== {name} failed; its last lines:")
        print("\n".join(output))


main()
