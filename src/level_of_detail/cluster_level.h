// One level of a hierarchy of clusters: groups are simplified while their borders stay, and what comes out is cut into clusters.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "level_of_detail/versions.h"

namespace isoatlas {

/// Throws Error{resource} for a surface of 2^29 triangles or more: corners of a group have numbers of 32 bits.
void require_few_triangles(const Surface& surface);

class ClusterLevels {
public:
    ClusterLevels(ClusterHierarchy& hierarchy, Versions& versions, const Context& context);

    /// Clusters that no group replaces so far; ascending but for those that were left alone.
    [[nodiscard]] std::span<const std::int64_t> current() const { return current_; }

    struct Group {
        std::vector<std::int64_t> clusters;
        BoundingBox box;  ///< in which what replaces them lies, scaled
    };
    /// Simplifies groups of the current clusters, all but `left`, which stay. step: between a group and what replaces it. Points that
    /// several groups have stay. Groups whose boxes are apart are simplified at the same time, colour after colour; each sees all versions
    /// that were there before its colour. The clusters of groups in which nothing can be collapsed stay, too. Returns whether any could.
    /// told: gets what share of the groups is done.
    bool simplify(std::span<const Group> groups, std::vector<std::int64_t> left, double step, const std::function<void(double)>& told);

private:
    void simplify_colour(std::span<const std::size_t> of_colour, std::span<const Group> groups, std::span<const std::int64_t> numbers,
                         double step, std::vector<std::int64_t>& left);

    ClusterHierarchy& hierarchy_;
    Versions& versions_;
    const Context& context_;
    std::vector<std::int64_t> current_;
    Array<std::uint8_t> is_locked_;  ///< of each point: do triangles of several groups have it?
};

}  // namespace isoatlas
