// Arguments: the command line, checked and converted. Only parse() and the option files use CLI11.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/picture.h"
#include "options/object_reference.h"

namespace isoatlas::cli {

struct Several;

enum class LabelChoice : std::uint8_t { automatic, yes, no };

/// What is assumed about the samples, unless the user says it: looked for before the verb begins (data/assume_inputs.h).
struct InputChoices {
    bool seeks_no_data = true;    ///< --no-data auto
    bool seeks_gaussian = false;  ///< --gaussian auto
    LabelChoice labels = LabelChoice::automatic;
    bool are_labels = false;                      ///< found, or said by the user
    double noise = 0, range = 0;                  ///< stored values, where smoothing could be advised
    std::vector<std::string> assumed;             ///< sentences: what was assumed and how to undo it
    std::optional<MissingPolicy> missing_of_low;  ///< where a fill value was found: for objects of low values
};

/// extract: --simplify, --simplify-error, --triangles
struct SimplificationArguments {
    std::optional<double> voxels, length;
    std::optional<std::int64_t> triangles;
    [[nodiscard]] bool is_asked_for() const { return voxels || length || triangles; }
};

/// extract: --octree, --octree-error, --octree-pixels, --eye
struct OctreeArguments {
    int cells = 0;  ///< 0: not asked for
    std::optional<double> error, pixels;
    std::string eye;  ///< "X,Y,Z"
    [[nodiscard]] bool is_asked_for() const { return cells > 0; }
};

struct Arguments {
    std::string verb;
    std::string file;               ///< VOLUME, MESH, or the name of a phantom, verb or shell
    std::string output;             ///< -o; empty: none
    std::string mesh;               ///< verify --against: what is verified, against the surface of `file`; empty: `file` itself
    std::vector<std::string> part;  ///< name of a part of a store

    // Input
    OpenOptions open;
    std::shared_ptr<const Several> several;  ///< the volumes of the file, where there is a menu of them (data/several.h)
    MissingPolicy missing;
    std::optional<SampleBox> box;       ///< only this part of the volume
    std::optional<std::int64_t> cache;  ///< bytes on disk for files of other machines
    std::optional<double> gaussian;     ///< filter first: sigma in the unit of the spacing
    InputChoices inputs;
    bool voxel_units = false;                ///< measures in voxels, not in the units of the file
    std::optional<PolarityChoice> polarity;  ///< objects of high or low values; none: of high ones, or what a store holds
    bool has_default_polarity = false;       ///< of page and viewer: both, unless a store that is there holds one
    /// Of verbs that look at one side.
    [[nodiscard]] std::optional<Polarity> side() const {
        if (!polarity || *polarity == PolarityChoice::both) return std::nullopt;
        return *polarity == PolarityChoice::low ? Polarity::low : Polarity::high;
    }
    [[nodiscard]] bool is_low() const { return polarity == PolarityChoice::low; }

    // Running and messages
    Interpolant interpolant = Interpolant::trilinear;
    bool interpolant_given = false;
    double tunnel_height = 0;  ///< in reported units, or in percent of the range
    bool tunnel_height_in_percent = false;
    int threads = 0;
    bool json = false, quiet = false, no_color = false;
    int verbose = 0;

    // Building a store
    std::int64_t memory = 0;  ///< bytes; 0: not given
    bool dry_run = false, restart = false;

    // Selection
    std::optional<double> tau;  ///< in reported (calibrated) units, as typed
    std::vector<ObjectReference> objects, contours;
    bool exact = false;                        ///< handles: exact pairs
    bool no_percolation = false;               ///< measure: leave it out
    bool thickness = false;                    ///< measure
    bool split = false, for_print = false;     ///< extract
    std::optional<double> min_wall;            ///< extract --for-print: millimetres
    SimplificationArguments simplification{};  ///< extract
    OctreeArguments octree;
    std::int64_t coarser = 0;                    ///< extract: versions with fewer triangles
    std::vector<ObjectReference> removed_names;  ///< name
    bool best = false, all = false, zones = false, list = false, cavities = false, both = false;
    std::int64_t top = 0;  ///< 0: not given
    Selection selection;   ///< as typed: reported units
    bool selects = false, persistence_in_percent = false;
    std::string curve;                    ///< file; of compare: the table
    std::optional<std::int64_t> samples;  ///< number of isovalues to measure
    std::optional<std::int64_t> sizes;    ///< compare: number of volumes
    std::string methods;                  ///< compare: names, separated by commas
    int levels = 8;
    bool full = false;
    std::uint64_t seed = 1;
    std::optional<double> max_distance;  ///< verify --against: in voxels
    std::optional<double> max_error;     ///< the same, in the unit of the volume

    // Server
    int port = 0;        ///< 0: that of the links of the store, or any
    std::string reader;  ///< serve: origin of pages that may read
    std::string scene;   ///< file; empty: none
    bool no_browser = false, read_only = false, new_link = false;

    // Output
    ShellChoice shell = ShellChoice::all;
    SurfaceStyle style = SurfaceStyle::compact;
    Boundary boundary = Boundary::closed;
    std::optional<PointSpace> space;  ///< of points in files; none: not given
    TreeDetail detail = TreeDetail::events;
    PhantomOptions phantom;
    PictureArguments picture;
};

/// Result of parsing: run a verb, or print a text (help, version).
struct Parsed {
    Arguments arguments;
    std::string text;  ///< not empty: print it and exit 0
};

/// Throws Error{usage} with a next step (did you mean ...?) for an invalid command line.
[[nodiscard]] Parsed parse(const std::vector<std::string>& words);

/// An option as the help, completions and manual pages describe it.
struct DescribedOption {
    std::vector<std::string> short_names, long_names;  ///< without dashes
    std::string value;                                 ///< "T", "high|low|both"; empty: a flag
    std::string group;                                 ///< "Options", "Input options", ...
    std::string meaning;
    bool is_required = false;
};

/// The options of a verb.
[[nodiscard]] std::vector<DescribedOption> described_options(const std::string& verb);

}  // namespace isoatlas::cli
