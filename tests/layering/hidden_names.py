#!/usr/bin/env python3
"""Functions of unnamed namespaces that ISOATLAS_UNITY would call in place of a function of a header: hidden_names.py ROOT, or --self-test.

With ISOATLAS_UNITY, as in releases, the sources of a folder are one translation unit. There a function in the unnamed namespace of one file
hides one of a header from the unnamed namespaces of the files behind it. With other parameters that does not compile; with the same ones
another function is called, which no test of a build without ISOATLAS_UNITY sees."""
import collections
import pathlib
import re
import sys

FUNCTION = re.compile(r"^(?=[\w\[])(?!return|else|namespace|using|struct|class|enum|case|throw|template|\[\[noreturn\]\] inline)"
                      r"(?:\[\[\w+\]\] )?[\w:<>,&*. ]+?[ &*](\w+)\(((?:[^()]|\([^()]*\))*)\)", re.M)
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.M | re.S)


def without_comments_and_strings(text):
    text = re.sub(r"//(?! namespace)[^\n]*|/\*.*?\*/", "", text, flags=re.S)
    return re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)


def kinds(parameters):
    """The types of parameters, so that what converts to each other is the same: texts, numbers."""
    found = []
    for one in re.split(r",(?![^<]*>)", parameters):
        kind = re.sub(r"\s*=.*", "", one.strip(), flags=re.S)
        kind = re.sub(r"\bconst |[&\[\]]|\bstd::", "", re.sub(r"(?<=[\w>&*\]])\s+\w+$", "", kind)).strip()
        kind = "text" if re.fullmatch(r"string(_view)?|char ?\*", kind) else kind
        found.append("number" if re.fullmatch(r"u?int(\d+_t)?|size_t|bool|double|float|char|unsigned", kind) else kind)
    return tuple(found)


def functions(text):
    return {(found[1], kinds(found[2])) for found in FUNCTION.finditer(text)}


def findings(texts):
    """texts: path -> text, of headers and sources."""
    plain = {path: without_comments_and_strings(text) for path, text in texts.items()}
    declared = collections.defaultdict(set)
    for path, text in plain.items():
        if path.endswith(".h"):
            for function in functions(text):
                declared[function].add(path)
    local = {path: set().union(*map(functions, UNNAMED.findall(text))) for path, text in plain.items() if path.endswith(".cpp")}
    for path in sorted(local):
        for function in sorted(local[path] & declared.keys()):
            call = re.compile(rf"(?<![\w.>:]){function[0]}\(")
            behind = [other for other in sorted(local) if other > path and pathlib.PurePath(other).parent == pathlib.PurePath(path).parent
                      and function not in local[other] and any(map(call.search, UNNAMED.findall(plain[other])))]
            if behind:
                yield f"{path}: {function[0]}() hides that of {', '.join(sorted(declared[function]))} from {', '.join(behind)}: rename it"


def check(root):
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
             for folder in ("src", "include", "apps") for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp")}
    found = list(findings(texts))
    for one in found:
        print(one)
    print(f"hidden_names: {len(texts)} files, {len(found)} findings")
    return 1 if found or len(texts) < 20 else 0


def self_test():
    header = "[[nodiscard]] std::string unit_name(std::string_view name);\n"
    local = "namespace {{\n\nstd::string unit_name({}) {{\n    return \"\";\n}}\n\n}}  // namespace\n"
    use = "namespace {\n\nint f() {\n    return unit_name(x).size();\n}\n\n}  // namespace\n"
    cases = [({"a.h": header, "s/a.cpp": local.format("const std::string& word"), "s/b.cpp": use}, 1),
             ({"a.h": header, "s/b.cpp": local.format("std::string_view word"), "s/a.cpp": use}, 0),  # not behind it
             ({"a.h": header, "s/a.cpp": local.format("std::string_view word"), "t/b.cpp": use}, 0),  # of another folder
             ({"a.h": header, "s/a.cpp": local.format("const VolumeInfo& info"), "s/b.cpp": use}, 0),  # g++ says it
             ({"a.h": header, "s/a.cpp": local.format("std::string_view word"), "s/b.cpp": use.replace("unit_name", "file.unit_name")}, 0),
             ({"a.h": "int twice(int n);\n", "s/a.cpp": "namespace {\nint twice(double n) { return n; }\n}  // namespace\n",
               "s/b.cpp": "namespace {\nint g() { return twice(3); }\n}  // namespace\n"}, 1)]
    for texts, wanted in cases:
        found = list(findings(texts))
        if len(found) != wanted:
            sys.exit(f"hidden_names: {texts} gives {found}, not {wanted} findings")


def main():
    if sys.argv[1] == "--self-test":
        self_test()
        return 0
    return check(pathlib.Path(sys.argv[1]))


if __name__ == "__main__":
    sys.exit(main())
