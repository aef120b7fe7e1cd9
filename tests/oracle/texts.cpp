// Analyses as text, for comparing two of them.
#include <algorithm>
#include <sstream>

#include "oracle/compare.h"
#include "oracle/difference.h"

namespace oracle {
namespace {

std::string level_text(double value, std::vector<Index> in, std::vector<Index> out) {
    std::sort(in.begin(), in.end());
    std::sort(out.begin(), out.end());
    std::ostringstream text;
    text.precision(17);
    text << "level " << value << " in " << join(in) << "out " << join(out) << '\n';
    return text.str();
}

std::string sorted_text(std::vector<std::string> lines) {
    std::sort(lines.begin(), lines.end());
    std::string text;
    for (const std::string& line : lines) text += line;
    return text;
}

/// Long texts by their FNV-1a hash: a deep tree would otherwise repeat its leaves at every level.
std::string shortened(std::string text) {
    if (text.size() < 2000) return text;
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return "#" + std::to_string(hash) + "\n";
}

/// Every event with the texts of its children inside: equal for equal trees, whatever the numbering. Children have smaller ids.
template <class Describe, class Children>
std::string tree_text(Index events, Describe describe, Children children) {
    std::vector<std::string> text(static_cast<std::size_t>(events));
    for (Index e = 0; e < events; ++e) {
        std::vector<std::string> inside;
        for (const Index child : children(e)) inside.push_back(std::move(text[static_cast<std::size_t>(child)]));
        text[static_cast<std::size_t>(e)] = shortened(describe(e) + "(" + sorted_text(std::move(inside)) + ")\n");
    }
    return events > 0 ? text.back() : "";
}

std::vector<std::string> histograms(const isoatlas::Analysis& analysis) {
    std::vector<std::string> texts(static_cast<std::size_t>(analysis.event_count()));
    analysis.visit_object_contours([&](isoatlas::EventId event, std::span<const isoatlas::GenusCount> counts) {
        std::ostringstream out;
        for (const isoatlas::GenusCount& c : counts) out << c.genus << 'x' << c.count << ' ';
        texts[event.index()] = out.str();
    });
    return texts;
}

void put_event(std::ostringstream& out, const isoatlas::Event& e) {
    out << "event " << e.value << ' ' << isoatlas::name_of(e.kind) << " objects_in " << e.objects_in << " lows_out " << e.lows_out
        << " dchi " << e.delta_chi << " zone " << e.zone.tau_low << ".." << e.zone.tau_high << ' ' << e.zone.voxels << " chi " << e.chi
        << ' ' << e.b1 << ' ' << e.b2 << " contours " << e.contours << " voxels " << e.object_voxels;
}

}  // namespace

std::string canonical_text(const isoatlas::Analysis& analysis) {
    std::vector<std::string> levels;
    for (Index i = 0; i < analysis.level_count(); ++i) {
        const isoatlas::Level level = analysis.level(i);
        levels.push_back(level_text(level.value, level.in, level.out));
    }
    const std::vector<std::string> genera = histograms(analysis);
    const auto describe = [&](Index e) {
        std::ostringstream out;
        out.precision(17);
        put_event(out, analysis.event(isoatlas::EventId(e)));
        out << " genera " << genera[static_cast<std::size_t>(e)];
        return out.str();
    };
    const auto children = [&](Index e) { return numbers_of(analysis.event(isoatlas::EventId(e)).children); };
    return sorted_text(std::move(levels)) + tree_text(analysis.event_count(), describe, children);
}

std::string canonical_text(const Result& result) {
    std::vector<std::string> levels;
    for (const Level& level : result.levels) levels.push_back(level_text(level.value, level.in, level.out));
    const auto describe = [&](Index i) {
        const Event& e = result.events[static_cast<std::size_t>(i)];
        std::ostringstream out;
        out.precision(17);
        out << "event " << e.value << ' ' << static_cast<int>(e.kind) << ' ' << e.lows_out << ' ' << e.delta_chi << ' ' << e.tau_low << ' '
            << e.zone_voxels << ' ' << e.chi << ' ' << e.b1 << ' ' << e.b2 << ' ' << e.object_voxels << " genera " << join(e.genera);
        return out.str();
    };
    const auto children = [&](Index e) { return result.events[static_cast<std::size_t>(e)].children; };
    return sorted_text(std::move(levels)) + tree_text(static_cast<Index>(result.events.size()), describe, children);
}

std::string full_text(const isoatlas::Analysis& analysis) {
    std::ostringstream out;
    out.precision(17);
    for (const isoatlas::ElementId i : isoatlas::ids<isoatlas::ElementId>(analysis.element_count())) {
        const isoatlas::Element e = analysis.element(i);
        out << "element " << e.value << " at " << join(e.position) << e.h0 << ' ' << e.l0 << ' ' << static_cast<int>(e.kind) << '\n';
    }
    for (Index i = 0; i < analysis.contour_arc_count(); ++i) {
        const isoatlas::ContourArc a = analysis.contour_arc(i);
        out << "arc " << a.upper.number() << ' ' << a.lower.number() << ' ' << a.value_high << ' ' << a.value_low << ' ' << a.genus << '\n';
    }
    for (Index i = 0; i < analysis.level_count(); ++i) {
        const isoatlas::Level level = analysis.level(i);
        out << level.event.number() << ' ' << level_text(level.value, level.in, level.out);
    }
    const std::vector<std::string> genera = histograms(analysis);
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const isoatlas::Event e = analysis.event(i);
        put_event(out, e);
        out << " id " << e.id.number() << " at " << join(e.position) << "parent " << e.parent.number() << " children "
            << join(numbers_of(e.children)) << genera[i.index()] << '\n';
    }
    for (const isoatlas::VoxelId v : isoatlas::ids<isoatlas::VoxelId>(analysis.extent().voxels())) out << analysis.zone(v).number() << ' ';
    return out.str();
}

}  // namespace oracle
