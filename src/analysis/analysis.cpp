// Accessors of include/isoatlas/analysis.h.
#include "isoatlas/analysis.h"

#include <limits>
#include <map>
#include <utility>

#include "analysis/analysis_data.h"
#include "analysis/event_alone.h"
#include "field/order.h"
#include "isoatlas/id.h"

namespace isoatlas {
namespace {

template <class Id>
std::vector<std::int64_t> list_at(const Lists<Id>& lists, std::size_t i) {
    return {lists.item.begin() + lists.first[i], lists.item.begin() + lists.first[i + 1]};
}

void require(bool in_range, const char* what) {
    if (!in_range) throw Error(ErrorKind::usage, {.what = std::string("no such ") + what + ": the id is out of range"});
}

/// Genus histogram of the contours of an object.
using Histogram = std::map<std::int64_t, std::int64_t>;

void add(Histogram& histogram, std::int64_t genus, std::int64_t count) {
    const auto [entry, fresh] = histogram.try_emplace(genus, 0);
    entry->second += count;
    if (entry->second == 0) histogram.erase(entry);
}

}  // namespace

Analysis::Analysis(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Analysis::Analysis(Analysis&&) noexcept = default;
Analysis& Analysis::operator=(Analysis&&) noexcept = default;
Analysis::~Analysis() = default;

const Extent& Analysis::extent() const { return data_->extent; }
Interpolant Analysis::interpolant() const { return data_->interpolant; }
double Analysis::tunnel_height() const { return data_->tunnel_height; }

bool Analysis::counts_voxels() const {
    return data_->visit([](const auto& held) { return !held.arrays.voxels.empty(); });
}

std::int64_t Analysis::element_count() const {
    return data_->visit([](const auto& held) { return static_cast<std::int64_t>(held.arrays.value.size()); });
}

Element Analysis::element(ElementId id) const {
    require(id >= ElementId(0) && id < ElementId(element_count()), "element");
    return data_->visit([&](const auto& held) {
        const ElementCode code{held.arrays.code[id]};
        return Element{held.arrays.value[id], element_position(code, data_->extent), code.h0(), code.l0(),
                       code.kind() == CodeKind::vertex ? ElementKind::vertex
                       : code.is_body()                ? ElementKind::body
                                                       : ElementKind::face};
    });
}

std::int64_t Analysis::contour_arc_count() const {
    return data_->visit([](const auto& held) { return static_cast<std::int64_t>(held.levels().arcs.size()); });
}

ContourArc Analysis::contour_arc(std::int64_t id) const {
    require(id >= 0 && id < contour_arc_count(), "contour");
    return data_->visit([&](const auto& held) {
        const auto& tree = held.arrays.contours;
        const auto x = held.levels().arcs[id];
        const ElementId upper(tree.upper(x)), lower(tree.lower(x));
        const bool outside = lower.index() == held.arrays.value.size();
        return ContourArc{upper, lower, held.arrays.value[upper],
                          outside ? -std::numeric_limits<double>::infinity() : held.arrays.value[lower],
                          1 - static_cast<std::int64_t>(tree.half_chi[x])};
    });
}

std::int64_t Analysis::level_count() const {
    return data_->visit([](const auto& held) { return static_cast<std::int64_t>(held.levels().levels.size()); });
}

Level Analysis::level(std::int64_t id) const {
    require(id >= 0 && id < level_count(), "level");
    return data_->visit([&](const auto& held) {
        const auto& index = held.levels();
        const auto root = index.levels[id];
        return Level{held.arrays.value[root], EventId(held.arrays.tree.event_of_element[root]), list_at(index.level_in, id),
                     list_at(index.level_out, id)};
    });
}

std::int64_t Analysis::event_count() const {
    return data_->visit([](const auto& held) { return static_cast<std::int64_t>(held.arrays.tree.size()); });
}

Event Analysis::event(EventId id) const {
    Event event = event_alone(*data_, id);
    data_->visit([&](const auto& held) {
        const auto& index = held.events();
        const auto first = static_cast<std::size_t>(index.first_child[id.index()]);
        event.children = std::span(index.children).subspan(first, index.first_child[id.index() + 1] - first);
        event.objects_in = static_cast<std::int64_t>(event.children.size());
        if (!index.object_voxels.empty()) event.object_voxels = static_cast<std::int64_t>(index.object_voxels[id.index()]);
    });
    return event;
}

void Analysis::visit_object_contours(const std::function<void(EventId, std::span<const GenusCount>)>& visit) const {
    data_->visit([&](const auto& held) {
        const auto& arrays = held.arrays;
        const auto& index = held.levels();
        std::vector<Histogram> waiting(
            arrays.tree.size());  // of finished children, gathered at their parent; moved on, so few live at a time
        std::vector<GenusCount> flat;
        for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
            Histogram own = std::move(waiting[e]);
            for (auto k = index.event_levels.first[e]; k < index.event_levels.first[e + 1]; ++k) {
                const std::size_t level = index.event_levels.item[k];
                for (const std::int64_t genus : list_at(index.level_in, level)) add(own, genus, -1);
                for (const std::int64_t genus : list_at(index.level_out, level)) add(own, genus, 1);
            }
            flat.clear();
            for (const auto& [genus, count] : own) flat.push_back({genus, count});
            visit(EventId(e), flat);
            if (arrays.tree.is_root(EventId(e))) continue;
            Histogram& parent = waiting[arrays.tree.parent[EventId(e)].index()];
            if (parent.size() < own.size()) parent.swap(own);
            for (const auto& [genus, count] : own) add(parent, genus, count);
        }
    });
}

EventId Analysis::zone(VoxelId voxel) const {
    require(voxel >= VoxelId(0) && voxel < VoxelId(data_->extent.voxels()), "voxel");
    return data_->visit([&](const auto& held) {
        if (held.arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "this analysis was made without zones"});
        return EventId(held.arrays.zone[voxel]);
    });
}

}  // namespace isoatlas
