// isoatlas spectrum: topology and size at every isovalue.
#include <cmath>

#include <fmt/format.h>

#include "data/source.h"
#include "text/interrupt.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kDefaultSamples = 24;

std::string voxels_text(const Bounds& voxels) {
    return voxels.min == voxels.max ? count_text(voxels.min) : count_text(voxels.min) + " to " + count_text(voxels.max);
}

std::string size_text(double size) { return size < 1e6 ? fmt::format("{:.5g}", size) : count_text(std::llround(size)); }

void print_text(Terminal& terminal, const VolumeInfo& info, const Spectrum& spectrum) {
    const bool flat = info.extent.rank == 2;
    const Scale scale(info);
    Table table({{"tau"},
                 {"objects"},
                 {spectrum.selected ? "selected" : "significant"},
                 {"contours"},
                 {flat ? "holes" : "tunnels"},
                 {"cavities"},
                 {"voxels"},
                 {flat ? "segments" : "triangles"},
                 {flat ? "length" : "area"},
                 {flat ? "area" : "volume"}});
    for (const SpectrumSize& size : spectrum.sizes) {
        const SpectrumInterval at = counts_at(spectrum, size.tau);
        table.add({scale.brief(size.tau), count_text(at.all.objects), count_text(at.significant.objects), count_text(at.all.contours),
                   count_text(at.all.tunnels), count_text(at.all.cavities), voxels_text(size.voxels), count_text(size.facets),
                   size_text(size.area), size_text(size.measure)});
    }
    table.print(terminal);
    terminal.out() << '\n'
                   << counted(static_cast<std::int64_t>(spectrum.intervals.size()), "interval")
                   << " in which no count changes (--json, -o spectrum.csv); "
                   << interpolant_text(info, spectrum.interpolant, spectrum.tunnel_height) << '\n';
}

}  // namespace

int run_spectrum(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.output.empty()) check_output(arguments, {".csv", ".svg", ".json"});
    Source source(arguments, terminal);
    SpectrumOptions options{.samples = arguments.samples.value_or(kDefaultSamples)};
    if (arguments.selects) options.selection = source.selection();
    const Spectrum spectrum = source.spectrum(options);
    stop_if_interrupted();
    SpectrumOutput output;
    if (arguments.all) output.max_intervals = 0;
    if (!arguments.output.empty()) {
        const WritingGuard guard;
        write_spectrum(arguments.output, source.info(), spectrum, output);
    }
    if (arguments.json) {
        write_spectrum_json(terminal.out(), source.info(), spectrum, output);
        return 0;
    }
    print_text(terminal, source.info(), spectrum);
    if (arguments.output.empty())
        terminal.next(
            fmt::format("isoatlas spectrum {}{} -o spectrum.svg    # as a plot", shell_word(arguments.file), reading_options(arguments)));
    return 0;
}

}  // namespace isoatlas::cli
