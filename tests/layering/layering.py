#!/usr/bin/env python3
"""Reads every source of src, include, apps, tests and bench and fails where the layers are broken.

    layering.py ROOT         checks a checkout, prints one line per finding, exits 1 when there is one
    layering.py --self-test  feeds bad snippets to each rule and fails when one of them is not found

The rules are CONTRIBUTING.md's: a stage includes `base`, itself, earlier stages and isoatlas/*.h; libraries and threads
have one door each; mathematics does not print, exit or use assert; files stay short; nothing is left for later.
"""
import re
import sys
from pathlib import Path

# library -> the libraries it needs, and its rooms (folders of src) in the order in which data flows through them
LIBRARIES = {
    "core": ([], ["base", "geometry", "field", "critical", "tree", "zones", "analysis", "features", "persistence", "levelset", "mesh",
                  "octree_front", "level_of_detail"]),
    "formats": (["core"], ["formats/common", "formats/zarr", "formats/volume", "formats/mesh", "formats/tree"]),
    "remote": (["formats"], ["remote"]),
    "store": (["formats"], ["codec", "store", "bricks", "census", "atlas", "levels"]),
    "measures": (["store"], ["measures"]),
    "render": (["core"], ["image", "render"]),
    "methods": (["store", "render"], ["methods/search", "methods/disk", "methods/zones", "methods/surfaces", "methods/projection"]),
    "server": (["store", "measures", "render", "methods"], ["preview", "catalogue", "page", "server"]),
    "phantom": (["core"], ["phantom"]),
    "verify": (["store"], ["verify"]),
}
LIBRARY_OF = {room: library for library, (_, rooms) in LIBRARIES.items() for room in rooms}
OF_PROGRAMS = {"formats/on_demand": "formats"}  # rooms that programs compile, behind those of a library
LIBRARY_OF |= OF_PROGRAMS
FOLDERS = {room.split("/")[0] for room in LIBRARY_OF}
# room -> public headers (isoatlas/NAME.h) that belong to it: rooms before it do not include them, as they do not include its own
PUBLIC = {
    "base": "array bounds context environment error id index3 output_file sink text vec3 version",
    "geometry": "viewpoint",
    "field": "filter interpolant isovalue polarity sample_bytes samples_wanted shell units volume",
    "tree": "criticality",
    "analysis": "active analysis",
    "features": "both_polarities cards cavities objects selection simplify spectrum survey",
    "persistence": "handles persistence",
    "levelset": "cut nested_labels",
    "mesh": "labels print surface",
    "octree_front": "octree_front",
    "level_of_detail": "cluster_hierarchy level_of_detail octree_mesh",
    "formats/common": "object_names output segmentation shell_word",
    "formats/volume": "dataset_path",
    "formats/mesh": "evolution_file precomputed_meshes",
    "remote": "remote",
    "census": "search_table",
    "atlas": "atlas build collection dump locate navigator",
    "levels": "levels",
    "measures": "measures thickness",
    "image": "image",
    "render": "render",
    "methods/search": "cell_search method_info",
    "methods/disk": "brick_search disk_search",
    "methods/zones": "zone_files",
    "methods/surfaces": "surface_defects surface_methods surface_points trilinear_distance",
    "methods/projection": "projection_methods",
    "catalogue": "page",
    "page": "label_page",
    "server": "client folder_server server",
    "phantom": "phantom",
    "verify": "verify",
}
OWNER = {name: room for room, names in PUBLIC.items() for name in names.split()}
MAX_LINES = 400

# header (regular expression on the text between the brackets) -> files that may include it (regular expression on the path)
DOORS = {
    r"tbb/.*|oneapi/.*": r"src/base/(parallel\.cpp|shared_vector\.h)",
    r"future|condition_variable|stop_token": r"(apps|tests|bench)/.*|src/base/memory_budgets\.h|src/base/workers\.h|src/remote/remote_file\.cpp|src/server/(job_queue|version_counter|shared_once)\.h",
    r"thread": r"(apps|tests|bench)/.*|src/base/parallel.*\.cpp|src/base/cancel\.h|src/base/memory_(budgets\.h|limit\.cpp)|src/base/workers\.h",  # asks which thread it is on; watches memory, computes nothing
    r"mutex": r"(apps|tests|bench|src/base)/.*|src/analysis/analysis_data\.h|src/zones/open_voxels\.h|src/methods/zones/filing_runs\.h|src/formats/common/hdf5_(handle\.h|layout\.cpp)|src/formats/common/read_ahead\.cpp|src/formats/volume/hdf5_(file|samples|storage|driver|object)\.cpp|src/bricks/(stored_samples|brick_cache|brick_histogram)\.(h|cpp)|src/atlas/atlas\.cpp|src/remote/.*|src/server/(job_queue|version_counter|store_state|store_levels|event_stream|shared_once|access_control|naming|shared_scene|volume_services)\.h",  # std::once_flag: the index is made when first asked for
    r"mpi\.h": r"(?!)",
    r"tiff.*\.h": r"src/formats/volume/.*tiff.*|tests/.*",
    r"png\.h": r"src/formats/volume/png_picture\.cpp",
    r"jpeglib\.h|jerror\.h": r"src/formats/volume/jpeg_picture\.cpp",
    r"csetjmp|setjmp\.h": r"src/formats/volume/picture_input\.h",
    r"pugixml\.hpp": r"src/formats/.*|tests/.*",
    r"zlib\.h": r"src/formats/.*|tests/.*",
    r"iostream|print": r"apps/.*|tests/.*|bench/.*",
    r"cassert|assert\.h": r"(?!)",
    r"CLI/.*|fmt/.*": r"apps/.*",
    r"nlohmann/.*": r"apps/.*|tests/.*|bench/.*|src/formats/.*|src/store/contents\.cpp|src/server/(?:client|scene_file)\.cpp",
    r"libdeflate\.h": r"src/codec/chunk_codec\.cpp|src/image/png\.cpp|src/server/coding\.cpp",
    r"zstd\.h": r"src/server/coding\.cpp|src/formats/zarr/codecs\.cpp|tests/.*",
    r"blosc\.h": r"src/formats/zarr/codecs\.cpp|tests/.*",
    r"lz4\.h": r"src/formats/(zarr/codecs|common/vtk_array)\.cpp|tests/.*",
    r"bzlib\.h": r"src/formats/(common/bzip2_source|zarr/codecs)\.cpp|tests/.*",
    r"boost/(asio|beast)/.*": r"src/server/(network|request_head|response_reader)\.cpp|tests/.*",
    r"meshoptimizer\.h": r"src/preview/(wire_mesh|coarse_surface)\.cpp|(tests|bench)/.*",
    r"webp/.*": r"src/image/webp\.cpp",
    r"embree3/.*": r"src/render/ray_surfaces\.cpp|src/measures/solid_rays\.cpp",
    r"fcntl\.h|sys/(stat|file)\.h|fstream": r"src/base/.*|(apps|tests|bench)/.*",
    r"libqhull_r/.*": r"src/measures/convex_hull\.cpp",
    r"hdf5\.h": r"src/formats/common/hdf5_(handle\.h|layout\.cpp)|src/formats/volume/hdf5_(file|heap|samples|storage|driver|object)\.(h|cpp)|tests/.*",
    r"xxhash\.h": r"src/codec/checksum\.h|src/remote/disk_cache\.cpp",
    r"curl/.*": r"src/remote/(address|transfer|http_client)\.(h|cpp)",
    r"dlfcn\.h": r"src/formats/on_demand/load_part\.cpp",
    r"openvdb/.*": r"src/formats/volume/vdb_openvdb\.cpp",
    r"gdcm.*\.h": r"src/formats/volume/dicom_gdcm\.cpp",
    r"draco/.*": r"src/formats/mesh/draco_mesh\.cpp|tests/.*",
    r"gtest/.*|gmock/.*|rapidcheck.*": r"tests/.*",
    r"benchmark/.*": r"bench/.*",
}

# what no line of src/ may contain, with the reason
FORBIDDEN_IN_SOURCE = {
    r"\bstd::(cout|cerr|clog)\b": "src does not print; results go back to the caller",
    r"(?<![\w:.>])(std::)?(printf|fprintf|puts|perror)\s*\(": "src does not print; results go back to the caller",
    r"(?<![\w.>])(std::|::)?_?(exit|quick_exit|abort)\s*\(": "src does not end the program; throw isoatlas::Error",
    r"(?<![\w.>])assert\s*\(": "input is checked with isoatlas::Error, our own logic with ISOATLAS_CHECK",
    r"\bstd::(jthread|thread(?!::id)|async)\b": "threads only through base/parallel.h",
    r"\b(rand|srand|random_device)\s*\(": "results are the same on every run",
}
# what no line of a room behind base may contain
FORBIDDEN_BEHIND_BASE = {r"\b(BudgetPoll|check_memory)\b": "loops over large arrays are those of base/streamed.h"}
LATER = re.compile(r"\b(" + "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X", "HA" + "CK"]) + r")\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def without_comments_and_strings(text):
    """The same lines with comments and string contents blanked, so that prose cannot trip a rule."""
    def blank(match):
        token = match.group(0)
        if token.startswith(("//", "/*")):
            return re.sub(r"[^\n]", " ", token)
        return '""' if token.startswith('"') else "''"
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])\''
    return re.sub(pattern, blank, text, flags=re.S)


def room_of(path):
    """The room of a file of src or of a public header, None elsewhere: src/formats/mesh/a.cpp -> formats/mesh."""
    parts = path.split("/")
    if path.startswith("include/isoatlas/"):
        return OWNER.get(parts[-1].removesuffix(".h"))
    if parts[0] != "src" or len(parts) < 3:
        return None
    return "/".join(parts[1:-1])


def needed(library):
    """The libraries that a library may include, itself among them."""
    found = {library}
    for other in LIBRARIES[library][0]:
        found |= needed(other)
    return found


def may_include(room, target):
    own, other = LIBRARY_OF[room], LIBRARY_OF[target]
    if own != other:
        return other in needed(own)
    rooms = LIBRARIES[own][1] + list(OF_PROGRAMS)
    return rooms.index(target) <= rooms.index(room)


def include_findings(path, bracket, header):
    room = room_of(path)
    for door, allowed in DOORS.items():
        if re.fullmatch(door, header) and not re.fullmatch(allowed, path):
            yield f"includes <{header}>, which only {allowed} may"
    if path.startswith(("apps/", "include/")):
        if header.split("/")[0] in FOLDERS and bracket == '"' and "/" in header:
            yield f"includes {header}: outside src only the public headers isoatlas/*.h are used"
    if room not in LIBRARY_OF or bracket == "<":
        return
    public = re.fullmatch(r"isoatlas/(\w+)\.h", header)
    if public:
        target = OWNER.get(public[1])
        if target is None or not may_include(room, target):
            yield f"includes {header}, which belongs to {target}: that comes after {room}, or {LIBRARY_OF[room]} does not need it"
        return
    if path.startswith("include/"):
        return
    if "/" not in header:
        yield f'includes "{header}": write the folder, "{room}/{header}"'
        return
    target = header.rsplit("/", 1)[0]
    if target not in LIBRARY_OF:
        yield f"includes {header}: not a room"
    elif not may_include(room, target):
        yield f"includes {header}: {target} comes after {room}, or belongs to a library that {LIBRARY_OF[room]} does not need"


def findings_of(path, text):
    """Yields (line, message) for one file; path is relative to the root of the checkout."""
    lines = text.splitlines()
    if len(lines) > MAX_LINES:
        yield len(lines), f"{len(lines)} lines; one idea per file, at most {MAX_LINES}"
    if path.startswith("src/") and room_of(path) not in LIBRARY_OF:
        yield 1, f"not in a room: {' '.join(LIBRARY_OF)}"
    if path.startswith("include/") and room_of(path) is None and path != "include/isoatlas/isoatlas.h":
        yield 1, "belongs to no room: name it in PUBLIC"
    if path.startswith(("src/", "include/")):
        for number, line in enumerate(lines, 1):
            if re.match(r"(inline )?namespace (?!isoatlas \{|pugi \{)[a-z]", line) and not line.endswith(("}", ";")) and " = " not in line:
                yield number, "one namespace for all rooms: isoatlas"
    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        if include:
            for message in include_findings(path, include.group(1), include.group(2)):
                yield number, message
        if LATER.search(line):
            yield number, "something is left for later; do it or open an issue"
    if path.startswith(("src/", "include/")):
        for number, line in enumerate(without_comments_and_strings(text).splitlines(), 1):
            for pattern, reason in ({} if path.startswith("src/base/") else FORBIDDEN_BEHIND_BASE).items():
                if re.search(pattern, line):
                    yield number, f"{re.search(pattern, line).group(0)}: {reason}"
            for pattern, reason in FORBIDDEN_IN_SOURCE.items():
                if re.search(pattern, line) and not path.startswith(("src/base/parallel", "src/base/memory_", "src/base/workers")):
                    yield number, f"{re.search(pattern, line).group(0).strip()}: {reason}"


PUBLIC_CALL = re.compile(r"^(?:class|struct) (\w+)[^;{]*\{|^\}|^[^/\n]*?\b(\w+)\((?:[^()]|\([^()]*\))*?const Context& context = \{\}", re.M)


def without_scope(headers, sources):
    """Public functions with a Context that do not begin with its environment; a Server keeps its context."""
    for text in headers.values():
        inside = None
        for found in PUBLIC_CALL.finditer(text):
            inside = found[1] if not found[2] else inside
            if not found[2] or inside == "Server":
                continue
            name = f"{inside}::{found[2]}" if inside else found[2]
            definition = re.compile(r"^(?:\S[^\n;={}]*[ &])?" + re.escape(name) + r"\(((?:[^;{}]|\{\})*?const Context& context[^;{}]*?\)[^;{}]*?)\{\n", re.M)
            for path, source in sources.items():
                for begin in definition.finditer(source):
                    is_inner = "VolumeView&" in begin[1] or path.startswith("src/server/")
                    if not is_inner and not source[begin.end():].startswith("    const EnvironmentScope scope(context);"):
                        yield path, source.count("\n", 0, begin.start()) + 1, name


def sources_of(root):
    for folder in ["src", "include", "apps", "tests", "bench"]:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp", ".hpp", ".cc"):
                yield path


def headers_in_cmake(root):
    """library -> its public headers, from the CMakeLists.txt."""
    text = (root / "CMakeLists.txt").read_text()
    return {name: sorted(headers.split()) for name, headers in re.findall(r"^isoatlas_library\((\w+)[^)]*HEADERS([^)]*)\)", text, flags=re.M)}


def libraries_in_cmake(root):
    """As LIBRARIES, from the CMakeLists.txt."""
    found = {}
    for word, name, rest in re.findall(r"^isoatlas_(library|room)\(([\w/]+)([^)]*)\)", (root / "CMakeLists.txt").read_text(), flags=re.M):
        if word == "room":
            found[list(found)[-1]][1].append(name)
        else:
            needs = re.search(r"NEEDS ((?:[a-z]+ ?)*)", rest)
            found[name] = (needs[1].split() if needs else [], [])
    return found


TYPE = re.compile(r"^(?:template <[^\n]*>\n?)?(?:class|struct|enum class|concept|using) (\w+)\b(?!<)(?=[^;\n:]*[{=]|[^;\n]* : )", re.M)


def twice(headers):
    """Types that two headers declare under one name; a specialisation declares none. headers: path -> text."""
    seen = {}
    for path, text in headers.items():
        for name in set(TYPE.findall(without_comments_and_strings(text))):
            if name in seen:
                yield f"{path}: {name} is a type of {seen[name]} too"
            seen.setdefault(name, path)


def check(root):
    findings = []
    headers = {p.relative_to(root).as_posix(): p.read_text(encoding="utf-8") for p in sources_of(root)
               if p.suffix == ".h" and p.relative_to(root).parts[0] in ("src", "include")}
    findings += twice(headers)
    missing = [name for name in OWNER if f"include/isoatlas/{name}.h" not in headers]
    if missing:
        findings.append(f"tests/layering: PUBLIC names headers that are not there: {missing}")
    if libraries_in_cmake(root) != LIBRARIES:
        findings.append(f"CMakeLists.txt: the libraries are {libraries_in_cmake(root)}, this test knows {LIBRARIES}")
    public = {library: sorted(name for name, room in OWNER.items() if LIBRARY_OF[room] == library) for library in LIBRARIES}
    if headers_in_cmake(root) != public:
        findings.append(f"CMakeLists.txt: the public headers are {headers_in_cmake(root)}, this test knows {public}")
    count = 0
    for path in sources_of(root):
        count += 1
        relative = path.relative_to(root).as_posix()
        findings += [f"{relative}:{line}: {message}" for line, message in findings_of(relative, path.read_text(encoding="utf-8"))]
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in sources_of(root)}
    headers = {path: text for path, text in texts.items() if path.startswith("include/")}
    sources = {path: text for path, text in texts.items() if path.startswith("src/") and path.endswith(".cpp")}
    findings += [f"{path}:{line}: {name}: begin with const EnvironmentScope scope(context);"
                 for path, line, name in without_scope(headers, sources)]
    for finding in findings:
        print(finding)
    print(f"layering: {count} files, {len(findings)} findings")
    return 1 if findings or count < 20 else 0


# path, text, how many findings there must be
SNIPPETS = [
    ("src/critical/a.cpp", '#include "tree/sweep.h"\n', 1),
    ("src/tree/a.cpp", '#include "critical/bytes.h"\n#include "tree/a.h"\n#include "base/check.h"\n#include "isoatlas/volume.h"\n', 0),
    ("src/base/a.cpp", '#include "field/bytes.h"\n', 1),
    ("src/base/a.cpp", '#include "check.h"\n', 1),
    ("src/tree/a.cpp", '#include "store/file.h"\n', 1),
    ("src/formats/volume/a.cpp", '#include "formats/common/a.h"\n#include "mesh/a.h"\n', 0),
    ("src/formats/volume/a.cpp", '#include "formats/tree/a.h"\n', 1),
    ("src/render/a.cpp", '#include "mesh/a.h"\n#include "image/a.h"\n', 0),
    ("src/render/a.cpp", '#include "store/a.h"\n', 1),  # an earlier library that it does not need
    ("src/server/a.cpp", '#include "formats/volume/a.h"\n', 0),  # needed by one that it needs
    ("src/verify/a.cpp", '#include "phantom/a.h"\n', 1),
    ("src/tree/a.cpp", '#include "isoatlas/cut.h"\n', 1),
    ("src/mesh/a.cpp", '#include "isoatlas/cut.h"\n', 0),
    ("src/mesh/a.cpp", '#include "isoatlas/isoatlas.h"\n', 1),
    ("include/isoatlas/analysis.h", '#include "isoatlas/atlas.h"\n', 1),
    ("include/isoatlas/unknown.h", "int x;\n", 1),
    ("src/mesh/a.cpp", "namespace mesh {\n", 1),
    ("src/mesh/a.cpp", "namespace isoatlas {\nnamespace {\n", 0),
    ("src/critical/a.cpp", "#include <tbb/parallel_for.h>\n", 1),
    ("src/base/parallel.cpp", "#include <tbb/parallel_for.h>\n", 0),
    ("src/zones/a.cpp", "#include <thread>\n", 1),
    ("src/mesh/a.cpp", "#include <iostream>\n", 1),
    ("src/mesh/a.cpp", "#include <cassert>\n", 1),
    ("src/mesh/a.cpp", "#include <tiffio.h>\n", 1),
    ("src/mesh/a.cpp", "#include <pugixml.hpp>\n", 1),
    ("src/tree/a.cpp", "#include <mpi.h>\n", 1),
    ("apps/isoatlas/a.cpp", '#include "tree/sweep.h"\n', 1),
    ("apps/isoatlas/a.cpp", '#include <isoatlas/isoatlas.h>\n#include <iostream>\n#include "table.h"\n', 0),
    ("include/isoatlas/cut.h", '#include "field/order.h"\n', 1),
    ("src/tree/a.cpp", 'int f() { std::cout << 1; }\n', 1),
    ("src/tree/a.cpp", 'int f() { printf("x"); }\n', 1),
    ("src/tree/a.cpp", 'int f() { std::snprintf(b, 2, "x"); }\n', 0),
    ("src/tree/a.cpp", "int f() { std::exit(1); }\n", 1),
    ("src/tree/a.cpp", "int f() { assert(x > 0); }\n", 1),
    ("src/tree/a.cpp", "static_assert(sizeof(int) == 4);\n", 0),
    ("src/tree/a.cpp", "#include <mutex>\n", 1),
    ("src/tree/a.cpp", "BudgetPoll memory;\n", 1),
    ("src/tree/a.cpp", "check_memory();\n", 1),
    ("src/base/a.h", "BudgetPoll memory;\n", 0),
    ("src/tree/a.cpp", "std::thread worker(run);\n", 1),
    ("src/tree/a.cpp", '// never std::cout or exit(1) here\nconst char* s = "abort()";\n', 0),
    ("src/tree/a.cpp", "// TO" + "DO: the rest\n", 1),
    ("src/tree/a.cpp", "int x;\n" * (MAX_LINES + 1), 1),
    ("src/tree/a.cpp", "int x;\n" * MAX_LINES, 0),
    ("src/other/a.cpp", "int x;\n", 1),
    ("src/tree/a.cpp", '#include <gtest/gtest.h>\n', 1),
    ("src/formats/mesh/a.cpp", "#include <fstream>\n#include <fcntl.h>\n", 2),
    ("src/base/a.cpp", "#include <fcntl.h>\n", 0),
]


def self_test():
    wrong = 0
    for path, text, expected in SNIPPETS:
        found = list(findings_of(path, text))
        if len(found) != expected:
            wrong += 1
            print(f"self-test: {path}: {text[:60]!r}: expected {expected} findings, got {found}")
    if len(list(twice({"a.h": "struct A {\n", "b.h": "template <class T>\nclass A {\n", "c.h": "struct A;\nstruct B : C {\n"}))) != 1:
        wrong += 1
        print("self-test: a type that is declared twice is not found, or one that is not is")
    header = "class A {\n    int f(int x, const Context& context = {}) const;\n};\nint g(const Context& context = {});\n"
    good = "int A::f(int x, const Context& context) const {\n    const EnvironmentScope scope(context);\n"
    if [name for *_, name in without_scope({"a.h": header}, {"a.cpp": good, "b.cpp": "int g(const Context& context) {\n    return 1;\n"})] != ["g"]:
        wrong += 1
        print("self-test: a call that leaves out its environment is not found, or one that does not is")
    print(f"layering self-test: {len(SNIPPETS)} snippets, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(self_test() if sys.argv[1] == "--self-test" else check(Path(sys.argv[1])))
