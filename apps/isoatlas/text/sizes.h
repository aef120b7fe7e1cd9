// Columns for the sizes of objects, the same in all tables.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "text/table.h"
#include "text/values.h"

namespace isoatlas::cli {

/// Voxel counts, and physical sizes where they differ.
class Sizes {
public:
    Sizes(const VolumeInfo& info, double largest) : unit_(measure_unit(info, largest)), flat_(info.extent.rank == 2) {}

    /// inner: title of the inner components; 2D objects have no cavities.
    void add_titles(std::vector<Table::Column>& columns, const std::string& inner = "cavities") const {
        columns.push_back({"voxels"});
        if (is_physical()) columns.push_back({std::string(flat_ ? "area" : "volume") + " [" + unit_.name + "]"});
        columns.push_back({flat_ ? "holes" : "tunnels"});
        if (!flat_) columns.push_back({inner});
    }
    void add(std::vector<std::string>& row, std::int64_t voxels, double measure, std::int64_t b1, std::int64_t b2) const {
        row.push_back(count_text(voxels));
        if (is_physical()) row.push_back(measure_text(measure * unit_.factor));
        row.push_back(dashed(b1));
        if (!flat_) row.push_back(dashed(b2));
    }

private:
    [[nodiscard]] bool is_physical() const { return unit_.name != "voxels"; }
    static std::string dashed(std::int64_t count) { return count == 0 ? "-" : count_text(count); }
    static std::string measure_text(double measure) {
        return measure < 1000 ? fmt::format("{:.4g}", measure) : count_text(static_cast<std::int64_t>(std::round(measure)));
    }

    MeasureUnit unit_;
    bool flat_;
};

template <class Objects>
double largest_measure(const Objects& objects) {
    double largest = 0;
    for (const auto& object : objects) largest = std::max(largest, object.measure);
    return largest;
}

}  // namespace isoatlas::cli
