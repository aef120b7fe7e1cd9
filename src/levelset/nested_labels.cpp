#include "isoatlas/nested_labels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/streamed.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

void check(std::int64_t voxels, std::span<const NestedPart> parts) {
    for (const NestedPart& part : parts) {
        if (part.voxel < 0 || part.voxel >= voxels || part.label == 0 || !std::isfinite(part.tau))
            throw Error(ErrorKind::usage,
                        {.where = "part " + std::to_string(&part - parts.data()), .what = "its voxel, label or isovalue is not valid"});
    }
}

/// In the order in which they are painted: later ones hide earlier ones.
std::vector<std::size_t> painted_order(std::span<const NestedPart> parts) {
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t p, std::size_t q) {
        const NestedPart &a = parts[p], &b = parts[q];
        if (a.is_cavity != b.is_cavity) return b.is_cavity;
        if (a.tau != b.tau) return a.is_cavity ? a.tau > b.tau : a.tau < b.tau;
        return p > q;
    });
    return order;
}

/// first: of the classes, that of no object or cavity.
template <class Class>
void paint(std::vector<std::uint32_t>& labels, std::span<const NestedPart> parts, std::span<const std::size_t> level,
           const std::vector<Class>& class_of, std::int64_t first) {
    std::int64_t classes = first;
    for (const std::size_t v : streamed(class_of.size(), {sizeof(Class)})) classes = std::max<std::int64_t>(classes, class_of[v]);
    std::vector<std::uint32_t> label_of(static_cast<std::size_t>(classes - first) + 1, 0);
    for (const std::size_t i : level) {
        const std::int64_t own = class_of[static_cast<std::size_t>(parts[i].voxel)];
        if (own == first) {
            throw Error(ErrorKind::not_found, {.where = "part " + std::to_string(i),
                                               .what = std::string("no ") + (parts[i].is_cavity ? "cavity" : "object") + " holds voxel " +
                                                       std::to_string(parts[i].voxel) + " at this isovalue"});
        }
        label_of[static_cast<std::size_t>(own - first)] = parts[i].label;
    }
    for (const std::size_t v : streamed(labels.size(), {sizeof(Class) + sizeof(std::uint32_t)})) {
        const std::uint32_t label = label_of[static_cast<std::size_t>(class_of[v] - first)];
        if (label != 0) labels[v] = label;
    }
}

std::vector<std::int64_t> voxels_of_labels(std::span<const std::uint32_t> labels) {
    std::vector<std::int64_t> voxels;
    for (const std::size_t v : streamed(labels.size(), {sizeof(std::uint32_t)})) {
        if (labels[v] >= voxels.size()) voxels.resize(std::size_t{labels[v]} + 1, 0);
        ++voxels[labels[v]];
    }
    return voxels;
}

}  // namespace

void overlay_labels(std::vector<std::uint32_t>& labels, std::span<const std::uint32_t> more) {
    const std::vector<std::int64_t> there = voxels_of_labels(labels), added = voxels_of_labels(more);
    for (const std::size_t v : streamed(labels.size(), {2 * sizeof(std::uint32_t)})) {
        const std::uint32_t label = more[v];
        if (label != 0 && (labels[v] == 0 || added[label] < there[labels[v]])) labels[v] = label;
    }
}

std::vector<std::uint32_t> nested_labels(std::int64_t voxels, std::span<const NestedPart> parts, const NestedSource& source) {
    check(voxels, parts);
    std::vector<std::uint32_t> labels(static_cast<std::size_t>(voxels), 0);
    const std::vector<std::size_t> order = painted_order(parts);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const NestedPart& first = parts[order[begin]];
        const auto is_of_level = [&](std::size_t i) { return parts[i].tau == first.tau && parts[i].is_cavity == first.is_cavity; };
        while (end < order.size() && is_of_level(order[end])) ++end;
        const std::span<const std::size_t> level = std::span(order).subspan(begin, end - begin);
        if (first.is_cavity) {
            paint(labels, parts, level, source.cavities(first.tau), 0);
        } else {
            paint(labels, parts, level, source.objects(first.tau), -1);
        }
    }
    return labels;
}

}  // namespace isoatlas
