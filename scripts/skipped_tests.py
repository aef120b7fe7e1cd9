#!/usr/bin/env python3
"""Counts and names what a run of ctest skipped: skipped_tests.py LastTest.log; skipped_tests.py --self-test.

A test that skips a case passes, for ctest. Known: GoogleTest, unittest of Python, Vitest, and lines "SKIPPED: why" of our own scripts."""
import pathlib
import re
import sys

TEST = re.compile(r"^\d+/\d+ Test(?:ing)?: (\S+)")
GTEST = re.compile(r"^\[  SKIPPED \] (\w[\w/]*\.[\w/]+)(?: \(|$)")
UNITTEST = re.compile(r"^(test_\w+) .*\.\.\. skipped '(.*)'$")
VITEST = re.compile(r"^\s*Tests .*?(\d+) skipped")
OURS = re.compile(r"^(?:-- )?SKIPPED: (.*)$")


def skipped(lines):
    """Texts, in order, each once."""
    test, found = "", {}
    for line in lines:
        line = re.sub(r"\x1b\[[0-9;]*m", "", line.rstrip("\n"))
        if match := TEST.match(line):
            test = match[1]
        elif match := GTEST.match(line):
            found[f"{test}: {match[1]}"] = 1
        elif match := UNITTEST.match(line):
            found[f"{test}: {match[1]}: {match[2]}"] = 1
        elif match := OURS.match(line):
            found[f"{test}: {match[1]}"] = 1
        elif match := VITEST.match(line):
            found[f"{test}: {match[1]} of its tests"] = int(match[1])
    return found


def self_test():
    text = """1/4 Testing: unit_a
[  SKIPPED ] Readers.OtherAgree (3 ms)
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Readers.OtherAgree
2/4 Testing: cli_b
test_x (__main__.B.test_x) ... skipped 'root may write everywhere'
test_y (__main__.B.test_y) ... ok
3/4 Testing: web
      Tests  2 skipped | 186 passed (188)
4/4 Testing: install
SKIPPED: dpkg-shlibdeps is not installed
""".splitlines()
    expected = {"unit_a: Readers.OtherAgree": 1, "cli_b: test_x: root may write everywhere": 1, "web: 2 of its tests": 2,
                "install: dpkg-shlibdeps is not installed": 1}
    assert skipped(text) == expected, skipped(text)


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    found = skipped(pathlib.Path(sys.argv[1]).read_text(errors="replace").splitlines())
    print(f"{sum(found.values())} test cases were skipped" + (":" if found else ""))
    for text in found:
        print(f"  {text}")


if __name__ == "__main__":
    main()
