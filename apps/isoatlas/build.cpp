// isoatlas build: a volume, its trees and its bricks in one file that serves any surface without reading the rest.
#include <fmt/format.h>

#include "document.h"
#include "interrupt.h"
#include "source.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {

int run_build(const Arguments& arguments, Terminal& terminal) {
    check_output(arguments, {".atlas"});
    Source source(arguments, terminal);
    if (source.is_store()) {
        throw Error(ErrorKind::usage,
                    {.file = arguments.file, .what = "is a store already", .expected = "a volume", .next = "name the volume file"});
    }
    {
        const WritingGuard guard(arguments.output);
        build_atlas(arguments.output, source.volume(), source.analysis_options(), source.context());
    }
    const Atlas atlas(arguments.output);
    const auto voxels = static_cast<double>(source.info().extent.voxels()), bytes = static_cast<double>(atlas.file_bytes());
    const double raw = voxels * static_cast<double>(size_of(source.info().type));
    if (arguments.json) {
        Json json = document("build", source.info(), atlas.interpolant(), atlas.tunnel_height());
        json["output"] = arguments.output;
        json["bytes"] = atlas.file_bytes();
        json["sample_bytes"] = static_cast<std::int64_t>(raw);
        print(terminal, json);
        return 0;
    }
    terminal.out() << arguments.output << ": " << bytes_text(bytes) << ", " << fmt::format("{:.3g}", bytes / voxels) << " bytes a voxel ("
                   << bytes_text(raw) << " of samples), " << interpolant_text(source.info(), atlas.interpolant(), atlas.tunnel_height())
                   << '\n';
    terminal.next("isoatlas objects " + shell_word(arguments.output));
    return 0;
}

}  // namespace isoatlas::cli
