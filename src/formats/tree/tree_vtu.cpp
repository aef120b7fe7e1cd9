// The tree as VTU: events with lines to their parents, critical elements with the contours between them.
#include "formats/tree/tree_formats.h"
#include "formats/tree/vtu_graph.h"

namespace isoatlas {

namespace {

/// A genus change has the Morse index of the merge (a handle: the Euler number falls) or the split (it rises) that it resembles.
TtkType type_of(const Event& e) {
    switch (e.kind) {
        case Criticality::maximum: return TtkType::maximum;
        case Criticality::minimum: return TtkType::minimum;
        case Criticality::merge: return TtkType::saddle2;
        case Criticality::split: return TtkType::saddle1;
        case Criticality::genus: return e.delta_chi < 0 ? TtkType::saddle2 : e.delta_chi > 0 ? TtkType::saddle1 : TtkType::degenerate;
        case Criticality::complex: break;
    }
    return TtkType::degenerate;
}

/// By the numbers of objects just above and low components just below. (2, 2) is the saddle of 2D, where TTK has one kind only.
TtkType type_of(const Element& e) {
    if (e.h0 == 0) return TtkType::maximum;
    if (e.l0 == 0) return TtkType::minimum;
    if (e.l0 == 2) return TtkType::saddle1;
    return e.h0 == 2 ? TtkType::saddle2 : TtkType::regular;
}

/// That of the file's values, where the trees are those of the negated samples.
TtkType turned(TtkType type) {
    switch (type) {
        case TtkType::maximum: return TtkType::minimum;
        case TtkType::minimum: return TtkType::maximum;
        case TtkType::saddle1: return TtkType::saddle2;
        case TtkType::saddle2: return TtkType::saddle1;
        default: return type;
    }
}

template <class Item>
VtuPoint point_of(const TreeView& tree, const Item& item) {
    return {item.position, tree.reported(item.value), tree.is_low() ? turned(type_of(item)) : type_of(item)};
}

VtuLines lines_of(const TreeView& tree) {
    VtuLines lines;
    if (tree.options.detail == TreeDetail::events) {
        for (const EventId id : ids<EventId>(tree.analysis.event_count())) {
            const EventId parent = tree.analysis.event(id).parent;
            if (parent.exists()) lines.add(id.number(), id.number(), parent.number());
        }
    } else if (tree.options.detail == TreeDetail::contours) {
        for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
            const ContourArc arc = tree.analysis.contour_arc(id);
            if (!tree.is_outside(arc.lower)) lines.add(id, arc.upper.number(), arc.lower.number());  // the outside has no position
        }
    }
    return lines;
}

VtuGraph graph_of_events(const TreeView& tree) {
    const Analysis& analysis = tree.analysis;
    const auto at = [&tree](std::int64_t id) { return point_of(tree, tree.analysis.event(EventId(id))); };
    VtuGraph graph(analysis.event_count(), at, lines_of(tree));
    const auto add = [&](const char* name, std::int64_t Event::* number) {
        graph.point_array<std::int64_t>(name, [&analysis, number](std::int64_t id) { return analysis.event(EventId(id)).*number; });
    };
    const auto zone_voxels = [&analysis](std::int64_t id) { return analysis.event(EventId(id)).zone.voxels; };
    if (tree.has_zones) {
        graph.point_array<std::int64_t>("RegionSize", zone_voxels);
        add("ObjectVoxels", &Event::object_voxels);
        graph.line_array<std::int64_t>("RegionSize", zone_voxels);
    }
    add("Chi", &Event::chi);
    add("Tunnels", &Event::b1);
    add("Cavities", &Event::b2);
    add("Contours", &Event::contours);
    return graph;
}

VtuGraph graph_of_elements(const TreeView& tree) {
    const Analysis& analysis = tree.analysis;
    const auto at = [&tree](std::int64_t id) { return point_of(tree, tree.analysis.element(ElementId(id))); };
    VtuGraph graph(analysis.element_count(), at, lines_of(tree));
    graph.point_array<std::int32_t>("H0", [&analysis](std::int64_t id) { return analysis.element(ElementId(id)).h0; });
    graph.point_array<std::int32_t>("L0", [&analysis](std::int64_t id) { return analysis.element(ElementId(id)).l0; });
    graph.line_array<std::int64_t>("Genus", [&analysis](std::int64_t id) { return analysis.contour_arc(id).genus; });
    return graph;
}

}  // namespace

void write_tree_vtu(Sink& sink, const TreeView& tree) {
    const VtuGraph graph = tree.options.detail == TreeDetail::events ? graph_of_events(tree) : graph_of_elements(tree);
    graph.write(sink, tree.volume.info, tree.connectivity());
}

}  // namespace isoatlas
