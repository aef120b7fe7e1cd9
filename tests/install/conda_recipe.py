#!/usr/bin/env python3
"""The recipe in packaging/conda without conda: conda_recipe.py ROOT. Needs python3-yaml, and says so where it is missing."""
import pathlib
import re
import subprocess
import sys

try:
    import yaml
except ImportError:
    print("SKIPPED: python3-yaml is not installed")
    sys.exit(0)

# packages of scripts/bootstrap.sh demo -> where in the recipe their counterparts are, and their names there; None: conda-build brings them
COUNTERPARTS = {
    "make": None, "npm": ("build", "nodejs"), "nodejs": ("build", "nodejs"), "g++": ("build", "compiler_cxx"), "cmake": ("build", "cmake"),
    "ninja-build": ("build", "ninja"), "libtbb-dev": ("host", "tbb-devel"), "zlib1g-dev": ("host", "zlib"), "libtiff-dev": ("host", "libtiff"),
    "libpng-dev": ("host", "libpng"), "libjpeg-dev": ("host", "libjpeg-turbo"),
    "libpugixml-dev": ("host", "pugixml"), "libhdf5-dev": ("host", "hdf5"), "libxxhash-dev": ("host", "xxhash"),
    "libcurl4-openssl-dev": ("host", "libcurl"),
    "libgdcm-dev": ("host", "gdcm"),
    "libopenvdb-dev": ("host", "openvdb"),
    "libdeflate-dev": ("host", "libdeflate"), "libqhull-dev": ("host", "qhull"), "libembree-dev": ("host", "embree"),
    "libwebp-dev": ("host", "libwebp-base"), "libboost-dev": ("host", "libboost-headers"), "libmeshoptimizer-dev": ("host", "meshoptimizer"),
    "libzstd-dev": ("host", "zstd"), "libblosc-dev": ("host", "blosc"), "liblz4-dev": ("host", "lz4-c"),
    "libbz2-dev": ("host", "bzip2"),
    "libdraco-dev": ("host", "draco"),
    "libcli11-dev": ("host", "cli11"), "pybind11-dev": ("host", "pybind11"), "python3-dev": ("host", "python"),
    "python3-numpy": ("host", "numpy"), "libfmt-dev": ("host", "fmt"), "nlohmann-json3-dev": ("host", "nlohmann_json"),
}
REQUIRED = {"package": ["name", "version"], "source": ["path"], "build": ["number"], "requirements": ["build", "host", "run"],
            "test": ["imports", "commands"], "about": ["home", "summary", "license", "license_file"], "extra": ["recipe-maintainers"]}


def recipe_of(text):
    """The document behind the expressions: variables by value, compiler('cxx') as the word compiler_cxx."""
    variables = dict(re.findall(r'^\{% set (\w+) = "([^"]*)" %\}$', text, re.M))
    text = re.sub(r"^\{%.*%\}$", "", text, flags=re.M)
    text = re.sub(r"\{\{ (\w+)\('(\w+)'\) \}\}", r"\1_\2", text)
    return yaml.safe_load(re.sub(r"\{\{ (\w+) \}\}", lambda match: variables[match[1]], text))


def findings(recipe, root):
    for section, keys in REQUIRED.items():
        for key in keys:
            if not recipe.get(section, {}).get(key) and recipe.get(section, {}).get(key) != 0:
                yield f"{section}/{key} is missing"
                return
    version = re.search(r'ISOATLAS_VERSION "([0-9.]+)"', (root / "include/isoatlas/version.h").read_text())[1]
    if str(recipe["package"]["version"]) != version:
        yield f"version {recipe['package']['version']}, but include/isoatlas/version.h says {version}"
    names = {part: {re.split(r"[ <>=]", one)[0] for one in recipe["requirements"][part]} for part in ("build", "host", "run")}
    listed = subprocess.run([root / "scripts/bootstrap.sh", "--list", "demo"], check=True, capture_output=True, text=True).stdout
    for line in listed.splitlines():
        package = line.split()[0]
        if package not in COUNTERPARTS:
            yield f"{package} of scripts/bootstrap.sh has no counterpart: name it in COUNTERPARTS and in the recipe"
        elif COUNTERPARTS[package] and COUNTERPARTS[package][1] not in names[COUNTERPARTS[package][0]]:
            yield f"{COUNTERPARTS[package][1]}, for {package}, is not in requirements/{COUNTERPARTS[package][0]}"
    known = {one[1] for one in COUNTERPARTS.values() if one} | {"stdlib_c"}
    for part, given in names.items():
        for name in sorted(given - known):
            yield f"requirements/{part} names {name}, which nothing here needs"
    project = (root / "pyproject.toml").read_text()
    for name in re.findall(r'"(\w+)[^"]*"', re.search(r"^dependencies = \[(.*)\]$", project, re.M)[1]):
        if name not in names["run"]:
            yield f"requirements/run lacks {name} of pyproject.toml"
    folder = root / "packaging/conda"
    if (folder / recipe["source"]["path"]).resolve() != root.resolve():
        yield "source/path is not the checkout"
    if not (root / recipe["about"]["license_file"]).is_file():
        yield "about/license_file is not there"
    if not (root / "LICENSE").read_text().startswith("BSD 3-Clause") or recipe["about"]["license"] != "BSD-3-Clause":
        yield "about/license is not that of LICENSE"
    for option in re.findall(r"-D(ISOATLAS_\w+)", (folder / "build.sh").read_text()):
        if not any(re.search(rf"\b{option}\b", path.read_text()) for path in [root / "CMakeLists.txt", *(root / "cmake").glob("*.cmake")]):
            yield f"build.sh sets {option}, which CMake does not know"


def self_test(recipe, root):
    """Each finding is found."""
    def broken(change):
        other = yaml.safe_load(yaml.safe_dump(recipe))
        change(other)
        return list(findings(other, root))
    for change in (lambda r: r["package"].update(version="9.9.9"), lambda r: r["requirements"]["host"].remove("hdf5"),
                   lambda r: r["requirements"]["host"].append("vtk"), lambda r: r["about"].pop("license_file"),
                   lambda r: r["about"].update(license_file="COPYING"), lambda r: r["source"].update(path="."),
                   lambda r: r["requirements"]["run"].remove("numpy >=1.20")):
        if len(broken(change)) != 1:
            sys.exit(f"conda_recipe: a broken recipe gives {broken(change)}")


def main():
    root = pathlib.Path(sys.argv[1])
    recipe = recipe_of((root / "packaging/conda/meta.yaml").read_text())
    found = list(findings(recipe, root))
    for one in found:
        print(f"packaging/conda/meta.yaml: {one}")
    self_test(recipe, root)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
