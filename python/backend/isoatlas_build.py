"""The build backend of the wheel (PEP 517): CMake builds and installs the component python_package, which is zipped with its metadata.

What pyproject.toml says under [project] is the metadata, and under [tool.isoatlas.cmake] what CMake is told. `pip install .` takes
    --config-settings=build-dir=FOLDER      where it is built (build/wheel); what is there already is not built again
    --config-settings=NAME=VALUE            -D NAME=VALUE of CMake, e.g. ISOATLAS_WEB_DIST
"""
import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

try:
    import tomllib
except ModuleNotFoundError:   # before Python 3.11
    import tomli as tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
ABOUT = PROJECT["project"]
VERSION = re.search(r'ISOATLAS_VERSION "([0-9.]+)"', (ROOT / "include/isoatlas/version.h").read_text(encoding="utf-8")).group(1)
NAME = f"{ABOUT['name']}-{VERSION}"
DATE = (2020, 1, 1, 0, 0, 0)   # of all files: the same sources give the same wheel


def get_requires_for_build_wheel(config_settings=None):
    """Programs that pip can bring where the system has none."""
    return [f"{name}>={version}" for name, version in (("cmake", "3.25"), ("ninja", "1.10")) if shutil.which(name) is None]


def metadata():
    lines = ["Metadata-Version: 2.1", f"Name: {ABOUT['name']}", f"Version: {VERSION}", f"Summary: {ABOUT['description']}",
             f"Requires-Python: {ABOUT['requires-python']}", "License-File: LICENSE"]
    lines += [f"Classifier: {one}" for one in ABOUT["classifiers"]] + [f"Requires-Dist: {one}" for one in ABOUT["dependencies"]]
    for extra, needed in ABOUT["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}"] + [f"Requires-Dist: {one} ; extra == '{extra}'" for one in needed]
    readme = (ROOT / ABOUT["readme"]).read_text(encoding="utf-8")
    return "\n".join(lines) + "\nDescription-Content-Type: text/markdown\n\n" + readme


def entry_points():
    return "".join(f"[{group}]\n" + "".join(f"{name} = {what}\n" for name, what in entries.items())
                   for group, entries in ABOUT["entry-points"].items())


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def built(settings, stage):
    """Builds the package and installs it into a folder."""
    folder = pathlib.Path(settings.pop("build-dir", ROOT / "build" / "wheel")).resolve()
    defines = {**PROJECT["tool"]["isoatlas"]["cmake"], "Python3_EXECUTABLE": sys.executable, **settings}
    has_page = shutil.which("npm") is not None or bool(defines.get("ISOATLAS_WEB_DIST"))
    if not has_page:
        print("isoatlas: npm is missing, so this package has no page: Atlas.view() will say so", file=sys.stderr)
    defines.setdefault("ISOATLAS_WEB", "ON" if has_page else "OFF")
    if shutil.which("ccache"):
        defines["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
    try:
        import pybind11   # has its own copy of what CMake looks for
        defines["pybind11_DIR"] = pybind11.get_cmake_dir()
    except ImportError:
        pass
    run = [shutil.which("cmake") or "cmake"]
    subprocess.run([*run, "-G", "Ninja", "-S", ROOT, "-B", folder, *(f"-D{name}={value}" for name, value in defines.items())], check=True)
    subprocess.run([*run, "--build", folder, "--target", "_core", "_render", "_serve"], check=True)
    subprocess.run([*run, "--install", folder, "--component", "python_package", "--prefix", stage], check=True)
    if shutil.which("strip"):
        subprocess.run(["strip", "--strip-unneeded", *pathlib.Path(stage).glob("isoatlas/*.so")], check=True)


def about_wheel():
    return f"Wheel-Version: 1.0\nGenerator: isoatlas {VERSION}\nRoot-Is-Purelib: false\nTag: {tag()}\n"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """So that pip knows what is needed before it builds."""
    folder = pathlib.Path(metadata_directory) / f"{NAME}.dist-info"
    folder.mkdir()
    for file, text in (("METADATA", metadata()), ("WHEEL", about_wheel()), ("entry_points.txt", entry_points())):
        (folder / file).write_text(text, encoding="utf-8")
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name, records = f"{NAME}-{tag()}.whl", []
    with tempfile.TemporaryDirectory() as stage, zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(path, content, mode=0o644):
            entry = zipfile.ZipInfo(path, DATE)
            entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            records.append(f"{path},sha256={digest},{len(content)}\n")

        built(dict(config_settings or {}), stage)
        for path in sorted(pathlib.Path(stage).rglob("*")):
            if path.is_file() and not path.parent.name.endswith(".dist-info"):  # that of `make install`; a wheel has its own
                add(path.relative_to(stage).as_posix(), path.read_bytes(), 0o755 if path.suffix == ".so" else 0o644)
        add(f"{NAME}.dist-info/METADATA", metadata().encode())
        add(f"{NAME}.dist-info/WHEEL", about_wheel().encode())
        add(f"{NAME}.dist-info/entry_points.txt", entry_points().encode())
        add(f"{NAME}.dist-info/LICENSE", (ROOT / "LICENSE").read_bytes())
        record = f"{NAME}.dist-info/RECORD"
        wheel.writestr(zipfile.ZipInfo(record, DATE), "".join(records) + f"{record},,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    """The files that git knows, with PKG-INFO."""
    name = f"{NAME}.tar.gz"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    with tarfile.open(os.path.join(sdist_directory, name), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in filter(None, listed):
            archive.add(ROOT / path, f"{NAME}/{path}", recursive=False)
        about, content = tarfile.TarInfo(f"{NAME}/PKG-INFO"), metadata().encode()
        about.size = len(content)
        archive.addfile(about, io.BytesIO(content))
    return name
