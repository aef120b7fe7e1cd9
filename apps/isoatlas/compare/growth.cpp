// How times and costs grow, over the active cells of several isovalues and over the cells of coarser volumes.
#include <algorithm>

#include "compare/output.h"

namespace isoatlas::cli {
namespace {

using Take = double (*)(const SearchRun&, const SearchQuery&);

double time_of(const SearchRun&, const SearchQuery& query) { return 1e3 * query.seconds; }
double looked_at(const SearchRun&, const SearchQuery& query) { return static_cast<double>(query.cost.cells + query.cost.nodes); }
double blocks_of(const SearchRun&, const SearchQuery& query) { return static_cast<double>(query.cost.blocks); }
double build_time(const SearchRun& run, const SearchQuery&) { return 1e3 * run.build_seconds; }
double bytes_of(const SearchRun& run, const SearchQuery&) { return static_cast<double>(run.bytes + run.file_bytes); }

class Lines {
public:
    void add(std::size_t number, const std::string& name, double x, double y) {
        if (!(x > 0 && y > 0)) return;  // no place on a logarithmic axis
        const auto at = std::ranges::find(lines_, name, &Growth::Line::name);
        if (at == lines_.end())
            lines_.push_back({name, static_cast<int>(number), {{x, y}}, std::nullopt});
        else
            at->points.push_back({x, y});
    }
    std::vector<Growth::Line> take() {
        for (Growth::Line& line : lines_) {
            std::ranges::sort(line.points);
            line.exponent = fitted_exponent(line.points);
        }
        return std::move(lines_);
    }

private:
    std::vector<Growth::Line> lines_;
};

std::vector<Growth::Line> over_active(const Comparison& found, Take take) {
    Lines lines;
    for (std::size_t number = 0; number < found.searches.size(); ++number) {
        const SearchRun& run = found.searches[number];
        for (std::size_t i = 0; i < run.at_isovalue.size(); ++i)
            lines.add(number, run.method.title, static_cast<double>(found.active_at[i]), take(run, run.at_isovalue[i]));
    }
    return lines.take();
}

std::vector<Growth::Line> over_cells(const Comparison& found, Take take) {
    Lines lines;
    for (const SizeRun& size : found.sizes) {
        for (std::size_t number = 0; number < size.searches.size(); ++number) {
            const SearchRun& run = size.searches[number];
            if (run.has_run()) lines.add(number, run.method.title, static_cast<double>(size.cells), take(run, run.query));
        }
    }
    return lines.take();
}

}  // namespace

std::vector<Growth> growth_of(const Comparison& found) {
    std::vector<Growth> all;
    const auto add = [&all](Growth growth) {
        if (!growth.lines.empty()) all.push_back(std::move(growth));
    };
    const std::string active = "active cells, k", cells = "cells of the volume, n";
    add({"time over k", active, "query, ms", over_active(found, time_of)});
    add({"looked at over k", active, "cells and nodes looked at", over_active(found, looked_at)});
    add({"blocks over k", active, "blocks read", over_active(found, blocks_of)});
    add({"time over n", cells, "query, ms", over_cells(found, time_of)});
    add({"looked at over n", cells, "cells and nodes looked at", over_cells(found, looked_at)});
    add({"blocks over n", cells, "blocks read", over_cells(found, blocks_of)});
    add({"build over n", cells, "build, ms", over_cells(found, build_time)});
    add({"bytes over n", cells, "memory and file, bytes", over_cells(found, bytes_of)});
    return all;
}

}  // namespace isoatlas::cli
