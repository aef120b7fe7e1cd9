#include "options/verb_options.h"

#include <map>
#include <string_view>

namespace isoatlas::cli {
namespace {

void add_output(CLI::App& app, Arguments& arguments, const std::string& formats, bool required) {
    CLI::Option* option =
        app.add_option("-o,--output", arguments.output, "Write to FILE (" + formats + "); an existing file is overwritten");
    option->type_name("FILE");
    if (required) option->required();
}

CLI::Option* add_tau(CLI::App& app, Typed& typed, const std::string& meaning) {
    return add_number(app, "--tau,--isovalue,--threshold", typed.tau, meaning + ", in the file's (calibrated) values")->type_name("T");
}

void add_build(CLI::App& app, Arguments& arguments, Typed& typed) {
    app.add_option("--memory", typed.memory, "Memory budget, such as 1G or 500M; default: half of the available memory")->type_name("SIZE");
    app.add_flag("--restart", arguments.restart, "Discard the phases of an earlier build");
}

/// References: options/object_reference.h.
CLI::Option* add_objects(CLI::App& app, Typed& typed, const std::string& meaning) {
    return app.add_option("--object", typed.objects, meaning + ". 2: of the table, c3: cavity, v81275: voxel, or a name")
        ->type_name("REF[@T]");
}

CLI::Option* add_shell(CLI::App& app, Typed& typed) {
    return app.add_option("--shell", typed.shell, "outer: outer shells, inner: walls of cavities, all")->type_name("outer|inner|all");
}

CLI::Option* add_style(CLI::App& app, Typed& typed) {
    return app.add_option("--style", typed.style, "compact: fewer triangles, full: an articulation point in every hit set")
        ->type_name("compact|full");
}

CLI::Option* add_boundary(CLI::App& app, Typed& typed) {
    return app.add_option("--boundary", typed.boundary, "closed: caps at the border of the volume, open: no caps")
        ->type_name("closed|open");
}

CLI::Option* add_space(CLI::App& app, Typed& typed) {
    return app.add_option("--space", typed.space, "Coordinates of medical volumes: lps (as Slicer), ras, or file: those of the volume")
        ->type_name("lps|ras|file");
}

void tree_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    app.add_option("--detail", typed.detail, "events, levels, elements or contours")->type_name("events|levels|elements|contours");
    app.add_flag("--all", arguments.all, "Events as JSON: also columns that follow from others, and the genera of contours");
    add_selection(app, typed.selection, true);
    add_output(app, arguments, ".json .graphml .csv .vtu", false);
}

void info_options(CLI::App& app, Arguments& /*arguments*/, Typed& typed) {
    add_tau(app, typed, "Size of the surface at this isovalue and cost of reading it (stores)");
}

void objects_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_tau(app, typed, "List every object at this isovalue");
    app.add_option("--top", typed.selection.top,
                   "At most N lines (without --tau: 24); with a percent sign: keep the first P percent of all objects")
        ->type_name("N|P%");
    add_selection(app, typed.selection, false);
    app.add_option("--curve", arguments.curve, "Write the number of objects for every threshold (.csv .svg .json)")->type_name("FILE");
    app.add_flag("--all", arguments.all, "All objects, also those that noise alone may explain");
    CLI::Option* cavities = app.add_flag("--cavities", arguments.cavities, "Cavities instead: voids and low-value regions inside objects");
    app.add_flag("--both", arguments.both, "Objects and cavities")->excludes(cavities);
}

void measure_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_tau(app, typed, "Measure every object at this isovalue");
    add_objects(app, typed, "Only these objects, each at an isovalue; default: its best one");
    app.add_option("--top", typed.selection.top,
                   "At most N objects (without --tau: 24); with a percent sign: keep the first P percent of all objects")
        ->type_name("N|P%");
    add_selection(app, typed.selection, false);
    app.add_flag("--no-percolation", arguments.no_percolation, "Do not look for the isovalues at which a phase percolates");
    app.add_flag("--thickness", arguments.thickness, "Also how thick objects are: their walls, struts, and with --polarity low pores");
    add_output(app, arguments, ".csv", false);
}

void extract_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_tau(app, typed, "Isovalue; default: the best isovalue of the object");
    add_objects(app, typed, "Only these objects, each at an isovalue; default: its best one");
    app.add_option("--contour", typed.contours, "Only these contours: cavities (c3), or ids of `objects --tau`")->type_name("REF[@T]");
    add_number(app, "--top", arguments.top, "The first N objects of the table, each at its best isovalue")
        ->check(in_range(1, 1000))
        ->type_name("N");
    app.add_flag("--split", arguments.split, "One file for each object, with its number and name behind that of FILE");
    app.add_flag("--for-print", arguments.for_print,
                 "For a 3D printer: outer shells alone, in mm, without specks; says how thick walls are");
    add_number(app, "--min-wall", arguments.min_wall, "With --for-print: warn of walls thinner than this (0.8)")
        ->check(in_range(0.0, 1e6))
        ->type_name("MM");
    CLI::Option* voxels = add_number(app, "--simplify", arguments.simplification.voxels,
                                     "Fewer triangles, at most so many voxels from the exact surface and back, with the same topology");
    voxels->check(in_range(1e-6, 1e6))->type_name("VOXELS");
    add_number(app, "--simplify-error", arguments.simplification.length, "The same as a length in the unit of the volume")
        ->check(in_range(1e-300, 1e300))
        ->type_name("LENGTH")
        ->excludes(voxels);
    add_number(app, "--triangles", arguments.simplification.triangles, "Simplify to this number of triangles, not fewer")
        ->check(in_range(4, 1'000'000'000))
        ->type_name("N");
    add_number(app, "--octree", arguments.octree.cells,
               "Coarse at once, with the same topology: blocks of up to so many cells (2, 4, 8, 16, 32) where it allows them")
        ->check(in_range(2, 32))
        ->type_name("CELLS");
    add_number(app, "--octree-error", arguments.octree.error,
               "With --octree: smaller blocks where points of the exact surface are farther away")
        ->check(in_range(1e-6, 1e6))
        ->type_name("VOXELS");
    app.add_option("--eye", arguments.octree.eye, "With --octree: smaller blocks near this point, physical, from where it is looked at")
        ->type_name("X,Y,Z");
    add_number(app, "--octree-pixels", arguments.octree.pixels,
               "With --eye: how far the exact surface may be, seen from there: pixels of a picture of 1080 lines and 30 degrees (1)")
        ->check(in_range(1e-6, 1e6))
        ->type_name("N");
    add_number(app, "--coarser", arguments.coarser, "With .glb: so many coarser versions, for viewers to draw where it is small")
        ->check(in_range(1, 16))
        ->type_name("N");
    add_shell(app, typed);
    add_style(app, typed);
    add_boundary(app, typed);
    add_space(app, typed);
    app.add_flag("--best", arguments.best, "The first object of the table at its best isovalue");
    add_output(app, arguments, ".ply .stl .obj .vtp .glb .vtkhdf; .precomputed: a folder for Neuroglancer", true);
}

void render_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_picture(app, arguments, typed.picture);
    add_camera(app, typed.picture);
    add_output(app, arguments, ".png .webp", true);
}

void animate_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_animation(app, arguments);
    add_selection(app, typed.selection, false);
    add_picture(app, arguments, typed.picture);
    add_output(app, arguments, ".gif .webp .png .apng .mp4; .vtkhdf: the surfaces of an evolution", true);
}

void label_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_tau(app, typed, "Label the objects at this isovalue: 1 is the largest");
    app.add_flag("--cavities", arguments.cavities, "With --tau: label the cavities instead, 1 is the largest");
    app.add_flag("--zones", arguments.zones, "Label every voxel with its zone: event id + 1");
    add_objects(app, typed, "Label these objects, each at an isovalue, by their numbers; default: its best one");
    app.add_option("--top", typed.selection.top,
                   "Label the first N objects of the table, each at its best isovalue; with --zones: keep the first P percent")
        ->type_name("N|P%");
    add_selection(app, typed.selection, false);
    add_output(app, arguments, ".seg.nrrd .nrrd .nii .nii.gz .tif .mrc .vdb .h5 .ome.zarr", true);
}

void name_options(CLI::App& app, Arguments& /*arguments*/, Typed& typed) {
    app.add_option("--remove", typed.removed_names, "Take the names of these objects away")->type_name("REF");
}

void build_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_output(app, arguments, ".atlas", false);
    add_build(app, arguments, typed);
    app.add_flag("--all", arguments.all, "Every channel and time step: -o is a folder that gets a store of each, and an index");
    app.add_flag("--dry-run", arguments.dry_run, "Only estimate memory, disk and time; needs no --output");
}

void atlas_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_number(app, "--top", arguments.top, "At most N objects (24)")->check(in_range(1, 1000))->type_name("N");
    add_output(app, arguments, ".html", false);
    add_build(app, arguments, typed);
}

void view_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_number(app, "--port", arguments.port,
               "Listen on this port of 127.0.0.1 (default: always the same one for this store, if it is free)")
        ->check(in_range(1, 65535))
        ->type_name("N");
    app.add_flag("--new-link", arguments.new_link, "Earlier links to views of this store do not open any more");
    app.add_option("--scene", arguments.scene, "Begin with the scene of FILE, which the viewer saved")->type_name("FILE");
    app.add_flag("--no-browser", arguments.no_browser, "Only print the address");
    app.add_flag("--read-only", arguments.read_only, "Write nothing, not even a store");
    add_build(app, arguments, typed);
}

void serve_options(CLI::App& app, Arguments& arguments, Typed& /*typed*/) {
    app.add_option("--allow-origin", arguments.reader,
                   "Pages of this site may read the files in a browser (CORS): https://HOST; '*': of every site")
        ->type_name("ORIGIN");
    add_number(app, "--port", arguments.port, "Listen on this port of 127.0.0.1 (default: any that is free)")
        ->check(in_range(1, 65535))
        ->type_name("N");
}

void ask_options(CLI::App& app, Arguments& arguments, Typed& /*typed*/) { add_output(app, arguments, "the response", false); }

void handles_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    app.add_flag("--exact", arguments.exact, "Exact pairs by persistent homology (slower)");
    app.add_option("--object", typed.objects, "With --exact: only the largest object with the highest voxel of this one")->type_name("REF");
    app.add_option("--top", typed.selection.top, "At most N tunnels (24)")->type_name("N");
    app.add_option("--persistence", typed.selection.persistence, "Only tunnels of at least this persistence, or P percent of the range")
        ->type_name("H|P%");
}

void spectrum_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_number(app, "--samples", arguments.samples, "Measure the surface at N isovalues, evenly spread (24); 0: none")
        ->check(in_range(std::int64_t{0}, std::int64_t{100000}))
        ->type_name("N");
    app.add_flag("--all", arguments.all, "JSON: every interval; without it neighbouring ones are merged above 512");
    add_selection(app, typed.selection, true);
    add_output(app, arguments, ".csv .svg .json", false);
}

void compare_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_tau(app, typed, "The isovalue of the surfaces, whose active cells are searched");
    app.add_option("--methods", arguments.methods, "Only these: names as in --json, separated by commas; surfaces, searches, or all")
        ->type_name("LIST");
    add_number(app, "--isovalues", arguments.samples, "Also search at N isovalues, to see how times grow (with a page 9; 0: none)")
        ->check(in_range(std::int64_t{0}, std::int64_t{1000}))
        ->type_name("N");
    add_number(app, "--sizes", arguments.sizes, "Also search N - 1 coarser volumes, of every 2nd, 4th, ... sample (with a page 4; 0: none)")
        ->check(in_range(std::int64_t{0}, std::int64_t{16}))
        ->type_name("N");
    app.add_option("--csv", arguments.curve, "Write all numbers as a table (.csv)")->type_name("FILE");
    app.add_option("--memory", typed.memory, "Leave out searches that would need more, such as 1G or 500M; default: half of the memory")
        ->type_name("SIZE");
    add_output(app, arguments, ".html: pictures, tables and plots; .webp .png: pictures alone", false);
}

void convert_options(CLI::App& app, Arguments& arguments, Typed& /*typed*/) {
    add_output(app, arguments, ".nrrd .npy .raw .mha .mrc .vdb .h5 .nii .nii.gz .vti .tif .ome.zarr", true);
}

void phantom_options(CLI::App& app, Arguments& arguments, Typed& /*typed*/) {
    app.add_flag("--list", arguments.list, "List the phantoms");
    add_number(app, "--size", arguments.phantom.size, "Samples per axis")
        ->check(in_range(std::int64_t{1}, std::int64_t{1} << 20))
        ->type_name("N");
    add_number(app, "--seed", arguments.phantom.seed, "Seed of random phantoms")->type_name("N");
    add_number(app, "--genus", arguments.phantom.genus, "Number of handles (torus-chain)")->type_name("N");
    add_number(app, "--shells", arguments.phantom.shells, "Number of shells (nested-shells)")->type_name("N");
    add_number(app, "--noise", arguments.phantom.noise, "Uniform noise of +- this fraction of the range")->type_name("F");
    add_number(app, "--quantise", arguments.phantom.quantise, "Number of grey levels, 2..65536")->type_name("N");
    add_output(app, arguments, ".nrrd .npy .raw .mha .nii", false);
}

void verify_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_number(app, "--levels", arguments.levels, "Isovalues at which tree, cut and surface are compared")
        ->check(in_range(1, 100000))
        ->type_name("N");
    app.add_flag("--full", arguments.full, "Stores: every object at every isovalue, and the tree recomputed from the samples");
    add_number(app, "--seed", arguments.seed, "Stores: seed for drawing isovalues and objects (1)")->type_name("N");
    CLI::Option* against = app.add_option("--against", typed.against, "MESH: compare it with the exact surface of this volume or store");
    against->type_name("VOLUME");
    const auto add = [&](CLI::Option* option) { option->needs(against); };
    add(add_tau(app, typed, "With --against: isovalue of the exact surface"));
    add(add_objects(app, typed, "With --against: the surface of these objects alone, each at an isovalue"));
    add(app.add_option("--contour", typed.contours, "With --against: these contours alone")->type_name("REF[@T]"));
    add(add_shell(app, typed));
    add(add_style(app, typed));
    add(add_boundary(app, typed));
    add(add_space(app, typed));
    CLI::Option* voxels = add_number(app, "--max-distance", arguments.max_distance,
                                     "With --against: the mesh is to be at most so many voxels away, in both directions");
    add(voxels->check(in_range(1e-6, 1e6))->type_name("VOXELS"));
    CLI::Option* error = add_number(app, "--max-error", arguments.max_error, "The same as a length in the unit of the volume");
    add(error->check(in_range(1e-300, 1e300))->type_name("LENGTH")->excludes(voxels));
}

void levels_options(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_objects(app, typed, "These objects and cavities, each at its isovalue");
    add_number(app, "--top", arguments.top, "The first N objects of the table, each at its best isovalue (8)")
        ->check(in_range(1, 1000))
        ->type_name("N");
    app.add_option("-o,--output", arguments.output, "The file (STORE.lod)")->type_name("FILE");
    app.add_option("--memory", typed.memory, "Memory budget, such as 1G or 500M; default: half of the available memory")->type_name("SIZE");
}

}  // namespace

void add_talking(CLI::App& app, Arguments& arguments) {
    app.add_flag("--json", arguments.json, "One JSON document on standard output, errors included")->group("Output options");
    app.add_flag("-q,--quiet", arguments.quiet, "No progress, no hints")->group("Output options");
    app.add_flag("-v,--verbose", arguments.verbose, "Print time and memory")->group("Output options");
    app.add_flag("--no-color", arguments.no_color, "No colours (also: NO_COLOR in the environment)")->group("Output options");
    add_number(app, "--threads", arguments.threads, "Number of threads; 0: one per processor. Results do not depend on it")
        ->check(in_range(0, 4096))
        ->type_name("N")
        ->group("Output options");
}

void add_reading(CLI::App& app, Arguments& arguments, Typed& typed) {
    const char* group = "Input options";
    app.add_option("--dims", typed.dims, "Samples per axis of a RAW file, x fastest: 512x512x100")->type_name("NX[xNY[xNZ]]")->group(group);
    app.add_option("--type", typed.type, "Sample type of a RAW file: uint8 int8 uint16 int16 uint32 int32 float32 float64")
        ->type_name("T")
        ->group(group);
    app.add_option("--endian", typed.endian, "Byte order of a RAW file: little or big")->type_name("little|big")->group(group);
    add_number(app, "--skip", typed.skip, "Bytes before the samples of a RAW file")->type_name("BYTES")->group(group);
    app.add_option("--spacing", typed.spacing, "Spacing of the samples per axis: 0.7,0.7,1.5; instead of the header's")
        ->type_name("X,Y[,Z]")
        ->group(group);
    app.add_option("--origin", typed.origin, "Position of the first sample, instead of the header's")->type_name("X,Y[,Z]")->group(group);
    app.add_option("--unit", typed.unit, "Unit of spacing and origin: mm, um, nm, m, ...; no number is converted")
        ->type_name("NAME")
        ->group(group);
    app.add_option("--value-unit", typed.value_unit, "Unit of the values: HU, SUV, Bq/ml, ...")->type_name("NAME")->group(group);
    add_number(app, "--time-step", typed.time_step, "Which volume of a time series, from 0")->type_name("N")->group(group);
    app.add_option("--channel", typed.channel, "Which channel of several: its name, or its number from 0")
        ->type_name("NAME|N")
        ->group(group);
    app.add_option("--series", typed.series,
                   "Which series of a DICOM folder, or image of an OME-TIFF: its identifier or name, or its number from 0")
        ->type_name("NAME|N")
        ->group(group);
    add_number(app, "--level", typed.level, "Which level of a resolution pyramid, 0 (default) the finest")->type_name("N")->group(group);
    app.add_option("--box", typed.box, "Only the samples FIRST:END (END not included) of each axis")
        ->type_name("X:X,Y:Y[,Z:Z]")
        ->group(group);
    app.add_option("--cache", typed.cache, "Of addresses (https://...): what is kept on disk for the next time, such as 1G (default) or 0")
        ->type_name("SIZE")
        ->group(group);
    app.add_flag("--skip-rest", arguments.open.skip_rest, "Ignore bytes after the samples; without it they are an error")->group(group);
    app.add_flag("--follow-links", arguments.open.follow_links, "Follow headers and links to files outside their folder")->group(group);
    app.add_option("--missing", typed.missing, "Replace NaN and infinite samples by VALUE; below: less than every value")
        ->type_name("VALUE|below")
        ->group(group);
    app.add_option("--no-data", typed.no_data, "Stored value that marks missing samples; auto (default): what looks like one; none")
        ->type_name("VALUE|auto|none")
        ->group(group);
    app.add_option("--labels", typed.labels, "Samples are labels, an object each; auto (default): when they look like it; yes; no")
        ->type_name("auto|yes|no")
        ->group(group);
    app.add_option("--gaussian", typed.gaussian, "Gaussian filter first: standard deviation in the unit of the spacing; auto: by the noise")
        ->type_name("SIGMA|auto")
        ->group(group);
    app.add_flag("--voxel", arguments.voxel_units, "Measure in voxels, not in the units of the file")->group(group);
}

void add_interpolant(CLI::App& app, Typed& typed) {
    app.add_option("--interpolant", typed.interpolant, "Connectivity inside cells: trilinear (default), or faces for the face rule alone")
        ->type_name("trilinear|faces")
        ->group("Input options");
    app.add_option("--tunnel-height", typed.tunnel_height, "Ignore tunnels through cells of at most this height (trilinear)")
        ->type_name("H|P%")
        ->group("Input options");
}

void add_polarity(CLI::App& app, Typed& typed) {
    app.add_option("--polarity", typed.polarity,
                   "Objects of high values (default), of low values (lungs, pores, channels; also where they reach the border), or both")
        ->type_name("high|low|both")
        ->group("Input options");
}

void add_options_of(const std::string& verb, CLI::App& app, Arguments& arguments, Typed& typed) {
    using Add = void (*)(CLI::App&, Arguments&, Typed&);
    static const std::map<std::string_view, Add> list{
        {"tree", tree_options},       {"info", info_options},       {"objects", objects_options},   {"measure", measure_options},
        {"extract", extract_options}, {"render", render_options},   {"animate", animate_options},   {"label", label_options},
        {"build", build_options},     {"atlas", atlas_options},     {"view", view_options},         {"ask", ask_options},
        {"serve", serve_options},     {"handles", handles_options}, {"spectrum", spectrum_options}, {"convert", convert_options},
        {"phantom", phantom_options}, {"verify", verify_options},   {"name", name_options},         {"compare", compare_options},
        {"levels", levels_options},
    };
    if (const auto found = list.find(verb); found != list.end()) found->second(app, arguments, typed);
}

}  // namespace isoatlas::cli
