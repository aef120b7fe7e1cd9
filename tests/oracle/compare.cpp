#include "oracle/compare.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "oracle/difference.h"

namespace oracle {
namespace {

std::string histogram(const std::vector<Index>& genera) {
    std::map<Index, Index> counts;
    for (const Index g : genera) ++counts[g];
    std::ostringstream out;
    for (const auto& [genus, count] : counts) out << genus << 'x' << count << ' ';
    return out.str();
}

std::vector<std::string> contour_texts(const isoatlas::Analysis& analysis) {
    std::vector<std::string> texts(static_cast<std::size_t>(analysis.event_count()), "not visited");
    Index next = 0;
    analysis.visit_object_contours([&](isoatlas::EventId event, std::span<const isoatlas::GenusCount> counts) {
        std::ostringstream out;
        for (const isoatlas::GenusCount& c : counts) out << c.genus << 'x' << c.count << ' ';
        texts[event.index()] = event.number() == next++ ? out.str() : "visited out of order";
    });
    return texts;
}

const char* kind_text(Kind kind) {
    constexpr const char* kNames[] = {"maximum", "minimum", "merge", "split", "genus change", "complex"};
    return kNames[static_cast<int>(kind)];
}

}  // namespace

isoatlas::Volume to_volume(const Grid& grid, isoatlas::ValueType type) {
    isoatlas::Volume volume = isoatlas::make_volume({grid.rank, {grid.size}}, type);
    const auto put = [&]<class T>(T) {
        std::transform(grid.value.begin(), grid.value.end(), volume.samples<T>().begin(), [](double v) { return static_cast<T>(v); });
    };
    using isoatlas::ValueType;
    switch (type) {
        case ValueType::u8: put(std::uint8_t{}); break;
        case ValueType::i8: put(std::int8_t{}); break;
        case ValueType::u16: put(std::uint16_t{}); break;
        case ValueType::i16: put(std::int16_t{}); break;
        case ValueType::u32: put(std::uint32_t{}); break;
        case ValueType::i32: put(std::int32_t{}); break;
        case ValueType::f32: put(float{}); break;
        case ValueType::f64: put(double{}); break;
    }
    return volume;
}

Grid to_grid(const isoatlas::Volume& volume) {
    Grid grid{volume.info.extent.rank, volume.info.extent.size.along, {}};
    for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(volume.value(v));
    return grid;
}

std::string compare_elements(const Result& expected, const isoatlas::Analysis& actual) {
    const auto count = static_cast<Index>(expected.critical.size());
    if (actual.element_count() != count) return Difference("elements").check("count", count, actual.element_count()).text();
    for (Index i = 0; i < count; ++i) {
        const CriticalElement& e = expected.critical[i];
        const isoatlas::Element a = actual.element(isoatlas::ElementId(i));
        Difference d(at("element", i));
        d.check("value", e.value, a.value).check("position", join(e.position), join(a.position));
        d.check("h0", e.h0, a.h0).check("l0", e.l0, a.l0).check("kind", static_cast<int>(e.type), static_cast<int>(a.kind));
        if (!d.text().empty()) return d.text();
    }
    return {};
}

std::string compare_arcs(const Result& expected, const isoatlas::Analysis& actual) {
    const auto text = [](Index upper, Index lower, const auto& arc) {
        std::ostringstream out;
        out.precision(17);
        out << upper << "->" << lower << " values " << arc.value_high << ".." << arc.value_low << " genus " << arc.genus;
        return out.str();
    };
    std::multiset<std::string> left, right;
    for (const Arc& arc : expected.arcs) left.insert(text(arc.upper, arc.lower, arc));
    for (Index i = 0; i < actual.contour_arc_count(); ++i) {
        const isoatlas::ContourArc arc = actual.contour_arc(i);
        right.insert(text(arc.upper.number(), arc.lower.number(), arc));
    }
    if (left == right) return {};
    std::vector<std::string> missing, extra;
    std::set_difference(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(missing));
    std::set_difference(right.begin(), right.end(), left.begin(), left.end(), std::back_inserter(extra));
    return "contour arcs: missing " + (missing.empty() ? "none" : missing.front()) + "; not expected " +
           (extra.empty() ? "none" : extra.front());
}

std::string compare_levels(const Result& expected, const isoatlas::Analysis& actual) {
    const auto count = static_cast<Index>(expected.levels.size());
    if (actual.level_count() != count) return Difference("levels").check("count", count, actual.level_count()).text();
    for (Index i = 0; i < count; ++i) {
        const Level& e = expected.levels[i];
        const isoatlas::Level a = actual.level(i);
        Difference d(at("level", i));
        d.check("value", e.value, a.value)
            .check("event", e.event, a.event.number())
            .check("in", join(e.in), join(a.in))
            .check("out", join(e.out), join(a.out));
        if (!d.text().empty()) return d.text();
    }
    return {};
}

std::string compare_events(const Result& expected, const isoatlas::Analysis& actual) {
    const auto count = static_cast<Index>(expected.events.size());
    if (actual.event_count() != count) return Difference("events").check("count", count, actual.event_count()).text();
    const std::vector<std::string> contours = contour_texts(actual);
    for (Index i = 0; i < count; ++i) {
        const Event& e = expected.events[i];
        const isoatlas::Event a = actual.event(isoatlas::EventId(i));
        std::vector<Index> children = numbers_of(a.children);
        std::sort(children.begin(), children.end());
        Difference d(at("event", i));
        d.check("id", i, a.id.number()).check("value", e.value, a.value).check("position", join(e.position), join(a.position));
        d.check("kind", std::string(kind_text(e.kind)), std::string(isoatlas::name_of(a.kind)))
            .check("parent", e.parent, a.parent.number());
        d.check("children", join(e.children), join(children)).check("objects_in", static_cast<Index>(e.children.size()), a.objects_in);
        d.check("lows_out", e.lows_out, a.lows_out).check("delta_chi", e.delta_chi, a.delta_chi);
        d.check("tau_low", e.tau_low, a.zone.tau_low).check("tau_high", e.value, a.zone.tau_high);
        d.check("zone voxels", e.zone_voxels, a.zone.voxels).check("object voxels", e.object_voxels, a.object_voxels);
        d.check("chi", e.chi, a.chi).check("b1", e.b1, a.b1).check("b2", e.b2, a.b2);
        d.check("contours", static_cast<Index>(e.genera.size()), a.contours).check("genera", histogram(e.genera), contours[i]);
        if (!d.text().empty()) return d.text();
    }
    return {};
}

std::string compare_zones(const Result& expected, const isoatlas::Analysis& actual) {
    for (std::size_t v = 0; v < expected.zone.size(); ++v) {
        const Index zone = actual.zone(isoatlas::VoxelId(v)).number();
        if (expected.zone[v] != zone) return Difference(at("voxel", static_cast<Index>(v))).check("zone", expected.zone[v], zone).text();
    }
    return {};
}

std::string compare(const Result& expected, const isoatlas::Analysis& actual) {
    for (const auto part : {compare_elements, compare_arcs, compare_levels, compare_events, compare_zones}) {
        const std::string difference = part(expected, actual);
        if (!difference.empty()) return difference;
    }
    return {};
}

}  // namespace oracle
