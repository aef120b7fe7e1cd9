// isoatlas animate -o FILE.vtkhdf: the surfaces of an evolution, one step each, in one file.
#include <algorithm>

#include "data/sides.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

struct Step {
    double tau;  ///< stored
    std::int64_t points, triangles, segments;
};

void check_steps(const Arguments& arguments) {
    const AnimationArguments& wanted = arguments.picture.animation;
    if (!wanted.from || !wanted.to) {
        throw Error(ErrorKind::usage, {.file = arguments.output,
                                       .what = "which isovalues?",
                                       .expected = "--from A --to B, and --steps N",
                                       .next = "give both isovalues, or one surface by isoatlas extract --tau T"});
    }
    if (!wanted.picture_option.empty()) {
        throw Error(ErrorKind::usage,
                    {.file = arguments.output,
                     .what = wanted.picture_option + " does not apply to .vtkhdf, which has the whole surface of each isovalue",
                     .next = "omit it, or write .webp, .gif or .mp4"});
    }
}

/// Each once, in the order of the reported values: readers of the file search in them.
std::vector<double> ascending(std::vector<double> taus, const Scale& scale) {
    std::ranges::sort(taus, {}, [&](double tau) { return scale.reported(tau); });
    const auto same = [&](double a, double b) { return scale.reported(a) == scale.reported(b); };
    taus.erase(std::unique(taus.begin(), taus.end(), same), taus.end());
    return taus;
}

std::vector<Step> write_steps(const Arguments& arguments, Source& source, const std::vector<double>& taus) {
    std::vector<Step> steps;
    EvolutionFile file(arguments.output);
    for (const double tau : taus) {
        stop_if_interrupted();
        const Surface surface = source.extract(tau, {});
        const auto size = [](const auto& array) { return static_cast<std::int64_t>(array.size()); };
        steps.push_back({tau, size(surface.points), size(surface.triangles), size(surface.segments)});
        file.add(surface);
    }
    const WritingGuard guard;
    file.commit();
    return steps;
}

void print_json(const Arguments& arguments, Terminal& terminal, Source& source, const std::vector<Step>& steps) {
    Json head = document("animate-surfaces", source.info(), source.interpolant(), source.tunnel_height());
    head["output"] = arguments.output;
    head["space"] = space_in_file(arguments.output, source.info().geometry.space);
    add_reads(head, source.reads());
    const Scale scale(source.info());
    print(terminal, head, "steps", static_cast<std::int64_t>(steps.size()), [&](std::int64_t i) -> Json {
        const Step& step = steps[static_cast<std::size_t>(i)];
        return {{"tau", scale.reported(step.tau)}, {"points", step.points}, {"triangles", step.triangles}, {"segments", step.segments}};
    });
}

void print_text(const Arguments& arguments, Terminal& terminal, Source& source, const std::vector<Step>& steps) {
    const Scale scale(source.info());
    std::int64_t triangles = 0, segments = 0;
    for (const Step& step : steps) triangles += step.triangles, segments += step.segments;
    terminal.out() << shown_name(arguments.output) << ": " << counted(static_cast<std::int64_t>(steps.size()), "step") << ", isovalues "
                   << scale.text(steps.front().tau) << " to " << scale.text(steps.back().tau) << ", "
                   << (segments > 0 ? counted(segments, "segment") : counted(triangles, "triangle")) << '\n';
}

}  // namespace

int animate_surfaces(const Arguments& arguments, Terminal& terminal, const std::function<std::vector<double>(Source&)>& isovalues) {
    check_steps(arguments);
    Sides sides(arguments, terminal);
    Source& source = sides.main();
    const std::vector<Step> steps = write_steps(arguments, source, ascending(isovalues(source), Scale(source.info())));
    if (arguments.json) {
        print_json(arguments, terminal, source, steps);
    } else {
        print_text(arguments, terminal, source, steps);
    }
    return 0;
}

}  // namespace isoatlas::cli
