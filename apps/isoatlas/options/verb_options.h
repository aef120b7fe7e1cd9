// The options of the command line: those of every verb, those of all that read volumes, and those that a verb alone has.
#pragma once

#include <string>

#include "options/options.h"

namespace isoatlas::cli {

/// Options as typed; converted after parsing, so that all messages have one form.
struct Typed {
    std::string box, dims, type, endian, spacing, origin, missing, channel, series, cache,
        interpolant = "trilinear", tunnel_height, shell = "all", style = "compact", boundary = "closed", detail = "events", memory, space,
        polarity;
    std::vector<std::string> objects, contours, removed_names;
    TypedSelection selection;
    std::string against, unit, value_unit, gaussian, no_data, labels = "auto";
    double tau = 0;
    std::int64_t skip = 0, time_step = 0, level = 0;
    PictureWords picture;
};

/// JSON, progress, threads.
void add_talking(CLI::App& app, Arguments& arguments);
/// How a file is read.
void add_reading(CLI::App& app, Arguments& arguments, Typed& typed);
void add_interpolant(CLI::App& app, Typed& typed);
void add_polarity(CLI::App& app, Typed& typed);
/// The options that this verb has and not all others.
void add_options_of(const std::string& verb, CLI::App& app, Arguments& arguments, Typed& typed);

}  // namespace isoatlas::cli
