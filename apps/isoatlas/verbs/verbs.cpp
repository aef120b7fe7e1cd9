#include "verbs/verbs.h"

#include <fmt/format.h>
#include <isoatlas/version.h>

namespace isoatlas::cli {

namespace {

/// docs/cli.md#the-page, "Why there".
const char* const kReasons =
    "\nReasons for an isovalue:\n"
    "  stable    the size hardly depends on the isovalue here: the boundary is sharp\n"
    "  outline   everything that is not background\n"
    "  outer     the outside alone, with cavities filled, is sharpest here\n"
    "  inner     the wall of a cavity is sharpest here\n"
    "  merge     just above the value where it merges: no isovalue is prominent\n"
    "  middle    of the range of the object that never merges: no isovalue is prominent\n";

const std::vector<Verb> kVerbs{
    {"atlas",
     "VOLUME",
     "Write a page with pictures of the significant objects of a volume. `isoatlas FILE` does the same.",
     {"isoatlas atlas scan.nii.gz", "isoatlas atlas scan.nii.gz -o scan.html --top 10", "isoatlas atlas scan.atlas --json"},
     run_atlas},
    {"view",
     "VOLUME",
     "Explore a volume in a browser: its objects, isovalues and measures.",
     {"isoatlas view scan.nii.gz", "isoatlas view scan.atlas --port 8080 --no-browser", "isoatlas view scan.atlas --json"},
     run_view},
    {"serve",
     "FOLDER",
     "Serve the files of a folder by HTTP, so that isoatlas reads parts of them from elsewhere. Any web server with range requests does, "
     "too.",
     {"isoatlas serve /data/scans", "isoatlas serve . --port 8000", "isoatlas serve . --json",
      "isoatlas serve . --allow-origin https://neuroglancer-demo.appspot.com"},
     run_serve},
    {"ask",
     "ADDRESS",
     "Send a request to a running viewer; the response goes to standard output or a file.",
     {"isoatlas ask http://127.0.0.1:8080 '/api/objects?tau=300'", "isoatlas ask 8080 '/api/surface?tau=300&format=stl' -o bone.stl",
      "isoatlas ask 8080 /api/address"},
     run_ask},
    {"info",
     "VOLUME",
     "Describe a file and estimate the cost of an analysis.",
     {"isoatlas info scan.nii.gz", "isoatlas info head.raw --dims 256x256x128 --type uint16 --endian big", "isoatlas info scan.nrrd --json",
      "isoatlas info scan.atlas --tau 300"},
     run_info},
    {"objects",
     "VOLUME",
     "List the objects of a volume and the isovalues that show them.",
     {"isoatlas objects scan.nii.gz", "isoatlas objects scan.nii.gz --tau 300", "isoatlas objects scan.nii.gz --top 5 --json",
      "isoatlas objects scan.nii.gz --keep 10 --both"},
     run_objects,
     kReasons},
    {"measure",
     "VOLUME",
     "Measure objects: volume, area, shape, values; porosity, percolation, distribution of sizes.",
     {"isoatlas measure scan.nii.gz", "isoatlas measure rock.nrrd --tau 90 -o grains.csv", "isoatlas measure scan.atlas --top 5 --json"},
     run_measure},
    {"extract",
     "VOLUME",
     "Write the surface at an isovalue: everything, some objects, or some shells.",
     {"isoatlas extract scan.nii.gz --tau 300 -o bone.ply", "isoatlas extract scan.nii.gz --object 2 -o part.stl",
      "isoatlas extract scan.nii.gz --object 2 --object 5@1367 -o head.glb", "isoatlas extract scan.nii.gz --top 10 --split -o part.stl",
      "isoatlas extract scan.nii.gz --tau 300 --shell outer -o skin.glb"},
     run_extract},
    {"render",
     "VOLUME",
     "Render a picture: objects at their isovalues, nested, transparent or clipped.",
     {"isoatlas render scan.nii.gz -o best.png", "isoatlas render scan.nii.gz --tau 300 --tau 1200 --cut octant -o head.png",
      "isoatlas render scan.atlas --object 2 --object 5@150 --view front -o parts.png"},
     run_render},
    {"animate",
     "VOLUME",
     "Render an animation: a turntable, or the evolution of objects over the isovalue, also as surfaces.",
     {"isoatlas animate scan.nii.gz --tau 300 -o turn.gif", "isoatlas animate scan.atlas --from 1200 --to 300 --steps 48 -o evolution.webp",
      "isoatlas animate scan.nii.gz --top 3 --cut half --steps 72 --fps 24 -o turn.mp4",
      "isoatlas animate scan.nii.gz --from 1200 --to 300 --steps 24 -o evolution.vtkhdf"},
     run_animate},
    {"tree",
     "VOLUME",
     "Show or write the criticality tree: every topological change of the volume.",
     {"isoatlas tree scan.nii.gz", "isoatlas tree scan.nii.gz -o tree.graphml", "isoatlas tree scan.nii.gz --detail levels --json",
      "isoatlas tree scan.nii.gz --keep 10"},
     run_tree},
    {"label",
     "VOLUME",
     "Write a label volume: objects, each at its best isovalue or all at one, or the zone of every voxel.",
     {"isoatlas label scan.nii.gz --top 24 -o objects.seg.nrrd", "isoatlas label scan.nii.gz --tau 300 -o objects.nii.gz",
      "isoatlas label scan.nii.gz --zones -o zones.nrrd", "isoatlas label stack.tif --tau 90 -o labels.tif"},
     run_label},
    {"name",
     "VOLUME",
     "Give objects names, which all verbs know; list them, or take them away.",
     {"isoatlas name scan.atlas 2 skull", "isoatlas name scan.atlas c1 \"frontal sinus\"", "isoatlas name scan.atlas --remove skull",
      "isoatlas name scan.atlas --json"},
     run_name},
    {"spectrum",
     "VOLUME",
     "Show objects, contours, tunnels, cavities and surface size at every isovalue.",
     {"isoatlas spectrum scan.nii.gz", "isoatlas spectrum scan.nii.gz -o spectrum.svg",
      "isoatlas spectrum scan.atlas --samples 100 --json"},
     run_spectrum},
    {"handles",
     "VOLUME",
     "List the tunnels of all objects and the isovalues between which each is open.",
     {"isoatlas handles scan.nii.gz", "isoatlas handles scan.nii.gz --persistence 10%", "isoatlas handles scan.nii.gz --exact",
      "isoatlas handles scan.atlas --top 100 --json"},
     run_handles},
    {"build",
     "VOLUME",
     "Write a store: a volume, its trees and its bricks in one file that all verbs read.",
     {"isoatlas build scan.nii.gz -o scan.atlas", "isoatlas build scan.nii.gz -o smooth.atlas --gaussian 1.5",
      "isoatlas build cells.ome.zarr --all -o cells.atlases", "isoatlas build scan.nii.gz -o scan.atlas --json"},
     run_build},
    {"levels",
     "STORE",
     "Make levels of detail of objects of a store, beside it: surfaces with fewer triangles and the same topology, also for viewers "
     "elsewhere.",
     {"isoatlas levels scan.atlas", "isoatlas levels scan.atlas --top 20", "isoatlas levels scan.atlas --object 2 --object 5@1367",
      "isoatlas levels scan.atlas --json"},
     run_levels},
    {"convert",
     "VOLUME",
     "Write the samples of a volume or of a store as a volume file.",
     {"isoatlas convert scan.atlas -o scan.nrrd", "isoatlas convert scan.nii.gz -o smooth.nrrd --gaussian 1.5",
      "isoatlas convert scan.nrrd -o part.npy --box 40:60,50:70,30:50"},
     run_convert},
    {"phantom",
     "NAME",
     "Generate a volume with known answers.",
     {"isoatlas phantom --list", "isoatlas phantom torus-chain --genus 4 -o chain.nrrd",
      "isoatlas phantom nested-shells --shells 5 --size 96 --quantise 256 -o shells.mha"},
     run_phantom},
    {"verify",
     "MESH|VOLUME",
     "Check the guarantees of a surface file, a volume or a store; exit code 7 when one fails.",
     {"isoatlas verify bone.ply", "isoatlas verify scan.nii.gz --levels 20", "isoatlas verify scan.atlas --full",
      "isoatlas verify light.ply --against scan.nii.gz --tau 300 --max-distance 0.5", "isoatlas verify part.stl --json"},
     run_verify},
    {"table131",
     "VOLUME",
     "Print table 13.1 of the dissertation for a volume: what a search for active cells visits and loads, over all isovalues.",
     {"isoatlas table131 scan.nii.gz", "isoatlas table131 scan.nii.gz --gaussian 1.5 --box 40:60,50:70,30:50",
      "isoatlas table131 scan.nii.gz --json"},
     run_table131},
    {"compare",
     "VOLUME",
     "Run the methods of the literature on a volume: the surfaces that they make, with their holes, and what they look at to find active "
     "cells.",
     {"isoatlas compare scan.nii.gz --tau 300", "isoatlas compare scan.nii.gz --tau 300 -o compare.html",
      "isoatlas compare scan.nii.gz --tau 300 --methods octree,interval-tree --isovalues 20 --csv compare.csv",
      "isoatlas compare scan.atlas --tau 300 --box 40:60,50:70,30:50 --json"},
     run_compare},
    {"dump",
     "STORE",
     "Print any part of a store: header, contents, an array or some of its numbers, a brick.",
     {"isoatlas dump scan.atlas", "isoatlas dump scan.atlas elements/value[10:20]", "isoatlas dump scan.atlas brick 17",
      "isoatlas dump scan.atlas voxel 40,41,42 --json"},
     run_dump},
    {"completion",
     "SHELL",
     "Print a completion script for bash, zsh or fish.",
     {"source <(isoatlas completion bash)", "isoatlas completion zsh > ~/.zfunc/_isoatlas",
      "isoatlas completion fish > ~/.config/fish/completions/isoatlas.fish"},
     run_completion},
    {"manual",
     "[VERB]",
     "Print the manual page of isoatlas or of a verb, for man.",
     {"isoatlas manual | man -l -", "isoatlas manual extract | man -l -", "isoatlas manual view > isoatlas-view.1"},
     run_manual},
};

/// Of the help.
const std::vector<VerbGroup> kGroups{
    {"Explore", {"atlas", "view", "info", "objects", "measure", "spectrum", "tree", "handles", "name"}},
    {"Export", {"extract", "label", "render", "animate", "convert", "build", "levels", "serve"}},
    {"Check", {"verify"}},
    {"For experts", {"ask", "dump", "table131", "compare", "phantom", "completion", "manual"}},
};

}  // namespace

const std::vector<Verb>& verbs() { return kVerbs; }
const std::vector<VerbGroup>& verb_groups() { return kGroups; }

const Verb* find_verb(const std::string& name) {
    for (const Verb& verb : verbs()) {
        if (verb.name == name) return &verb;
    }
    return nullptr;
}

std::string greeting() {
    return "isoatlas " ISOATLAS_VERSION
           ": which objects are in a volume, and at which isovalues?\n"
           "\n"
           "  isoatlas scan.nii.gz                                  write a page of them\n"
           "  isoatlas objects scan.nii.gz                          list them\n"
           "  isoatlas extract scan.nii.gz --tau 300 -o bone.ply    write a watertight surface\n"
           "  isoatlas phantom --list                               list of test volumes\n"
           "\n"
           "All verbs: isoatlas --help. One verb: isoatlas help VERB.\n";
}

std::string overview() {
    std::string text = greeting();
    for (const VerbGroup& group : kGroups) {
        text += fmt::format("\n{}:\n", group.title);
        for (const char* name : group.verbs) {
            const Verb& verb = *find_verb(name);
            text += fmt::format("  {:<11} {:<12} {}\n", verb.name, verb.operand, verb.summary);
        }
    }
    text +=
        "\nEvery verb has --help with examples, --json for one JSON document on standard output, --quiet and --threads N.\n"
        "Results go to standard output, messages and progress to standard error.\n"
        "Reads DICOM, NIfTI, NRRD, MetaImage, OME-Zarr, OME-TIFF, HDF5 (NeXus, Imaris, BigDataViewer, VTKHDF), NetCDF, MRC, VTK,\n"
        "Amira, Analyze, BOV, OpenVDB, NumPy, RAW, pictures (PNG, JPEG, BMP): files, folders, and addresses (https://...).\n"
        "\nExit codes: 0 done, 1 bug, 2 usage, 3 input damaged or missing, 4 format not supported, 5 cannot write or out of memory,\n"
        "6 no such object or isovalue, 7 a guarantee does not hold, 130 interrupted.\n";
    return text;
}

}  // namespace isoatlas::cli
