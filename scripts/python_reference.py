#!/usr/bin/env python3
"""Writes docs/python.md, the reference of the Python package, from its docstrings: scripts/python_reference.py [--check]

The package must be importable: PYTHONPATH=build/dev/python. --check: says whether the page is current, and writes nothing."""
import inspect
import pathlib
import re
import sys

import isoatlas

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "python.md"
HEAD = """# Python

<!-- Written by scripts/python_reference.py from the docstrings: change them, and run it. -->

Arrays are (z, y, x), in the order of their axes, as numpy, scipy and scikit-image have them: shapes, indices, spacing, boxes.
Points are (x, y, z) in physical units, as files and the command line have them: points of meshes, positions, origins,
directions. Isovalues are calibrated. Options have the names that the command line has ([cli.md](cli.md)), and results are the
same bytes.

```python
import isoatlas
atlas = isoatlas.open("scan.nii.gz")          # a file, a store, an array with spacing=
atlas.objects                                 # the table, with the isovalue that shows each best
mesh = atlas.objects[3].surface()             # closed; points, triangles and normals are arrays
mesh.save("tooth.stl")                        # or .to_trimesh(), .to_pyvista(), .to_meshio()
labels = atlas.labels(keep=24)                # each object at its own best isovalue, in one label array
graph = atlas.tree.to_networkx()
pairs = atlas.persistence(dimension=0)
b0, b1, b2 = isoatlas.betti(labels > 0, 0.5)
points, triangles, normals, values = isoatlas.marching_cubes(atlas.volume, 0.5)
```

C-contiguous arrays in host byte order of 8, 16 or 32 bit integers, float32 or float64 are used where they are, without a copy;
others are copied once. Arrays of a result are views of the memory that the computation has filled, and keep it alive. Long calls
run without the interpreter's lock, stop at Ctrl-C with `KeyboardInterrupt`, and take `progress=` and `threads=`. `pandas`,
`networkx`, `trimesh`, `pyvista`, `meshio` and `tqdm` are used where a method names them, and needed by nothing else.
[Examples](../python/examples), [five tasks with pictures](python-gallery.md), [napari, ParaView, 3D Slicer](applications.md), [why it is
so](decisions/0052-python.md).
"""
GROUPS = [
    ("Opening and building", ["open", "build", "Atlas"]),
    ("Objects and surfaces", ["Table", "Object", "Isovalue", "Mesh", "Check", "read_mesh", "save_meshes"]),
    ("All isovalues", ["Tree", "SimplifiedTree", "Handles", "Spectrum", "Columns"]),
    ("Functions of one call", ["marching_cubes", "label", "betti", "euler_number", "label_regions", "label_surface", "verify"]),
    ("Files and generated volumes", ["read", "write", "info", "phantom", "phantoms"]),
    ("Pictures and notebooks", ["render", "save_image", "save_animation", "View"]),
    ("Exceptions", ["Error", "InputError", "NotFoundError", "ResourceError", "UnsupportedError", "VerificationError", "InternalError"]),
]


def signature_of(name, what):
    """As it is called, without annotations."""
    signature = inspect.signature(what)
    parameters = [one.replace(annotation=one.empty) for one in signature.parameters.values() if one.name != "self"]
    return f"{name}{signature.replace(parameters=parameters, return_annotation=signature.empty)}"


def body_of(text):
    """A numpydoc docstring as Markdown: sections in bold, each parameter on a line of its own."""
    lines = inspect.cleandoc(text or "").splitlines()
    out, i = [], 0
    while i < len(lines):
        if i + 1 < len(lines) and lines[i + 1] and set(lines[i + 1]) == {"-"}:
            section, block = lines[i], []
            i += 2
            while i < len(lines) and not (i + 1 < len(lines) and lines[i + 1] and set(lines[i + 1]) == {"-"}):
                block.append(lines[i])
                i += 1
            out += section_of(section, block)
        else:
            out.append(re.sub(r":(?:func|meth|class|attr):`(?:isoatlas\.)?([^`]+)`", r"`\1`", lines[i]).replace("``", "`"))
            i += 1
    return "\n".join(out).strip()


def section_of(section, block):
    if section == "Examples":
        return ["", f"**{section}**", "", "```python", *[line for line in block if line], "```"]
    items, text = [], []
    for line in block:
        if line and not line.startswith(" "):
            items.append([line, []])
        elif line.strip() and items:
            items[-1][1].append(line.strip())
        else:
            text.append(line)
    if section in ("Notes",):
        return ["", f"**{section}**", "", body_of("\n".join(block))]
    out = ["", f"**{section}**", ""]
    for head, about in items:
        name, _, kind = head.partition(" : ")
        described = body_of(" ".join(about))
        out.append(f"- `{name}`" + (f" ({kind.replace('``', '`')})" if kind else "") + (f": {described}" if described else ""))
    return out


def members_of(one):
    """Public methods and properties with their docstrings, in the order of the source."""
    for name, member in vars(one).items():
        if name.startswith("_"):
            continue
        function = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
        if inspect.isfunction(function) and function.__doc__:
            yield name, member, function


def entry_of(name):
    what = getattr(isoatlas, name)
    is_class = inspect.isclass(what)
    head = f"### {'class ' if is_class else ''}{name}"
    out = ["", head, ""]
    if not is_class:
        out += ["```python", signature_of(f"isoatlas.{name}", what), "```", ""]
    out.append(body_of(what.__doc__))
    if is_class:
        for member_name, member, function in members_of(what):
            call = member_name if isinstance(member, property) else signature_of(member_name, function).replace("(cls, ", "(")
            out += ["", f"#### `{name}.{call}`", "", body_of(function.__doc__)]
    return out


def page():
    named = [name for _, names in GROUPS for name in names]
    missing = set(isoatlas.__all__) ^ set(named)
    if missing:
        sys.exit(f"python_reference: in one of __all__ and GROUPS alone: {', '.join(sorted(missing))}")
    lines = [HEAD]
    for title, names in GROUPS:
        lines += ["", f"## {title}"]
        for name in names:
            lines += entry_of(name)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip() + "\n"


if __name__ == "__main__":
    text = page()
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(text)
    elif not PAGE.exists() or PAGE.read_text() != text:
        sys.exit("docs/python.md is not what the docstrings say. Next: PYTHONPATH=build/dev/python scripts/python_reference.py")
