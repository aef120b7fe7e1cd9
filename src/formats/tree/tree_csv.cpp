// The tree as CSV: a row for each event, level, element or contour; lists are separated by spaces; missing values are empty.
#include "formats/common/csv_table.h"
#include "formats/tree/tree_formats.h"

namespace isoatlas {

namespace {

void put_event_rows(ByteWriter& out, const TreeView& tree) {
    const CsvTable table(
        out, tree.connectivity(),
        "id,value,x,y,z,kind,parent,children,objects_in,lows_out,delta_chi,tau_low,tau_high,voxels,chi,b1,b2,object_voxels,contours,"
        "genera");
    visit_events(tree, [&](const Event& e, std::span<const GenusCount> genera) {
        CsvRow row = table.row();
        row.number(e.id.number())
            .real(tree.reported(e.value))
            .position(e.position)
            .text(isoatlas::name_of(tree.kind_of(e)))
            .number(e.parent.number(), e.parent.exists());
        row.text(list_text(e.children)).number(e.objects_in).number(e.lows_out).number(e.delta_chi);
        const auto [low, high] = tree.reported(e.zone);
        row.real(low).real(high).number(e.zone.voxels, tree.has_zones);
        row.number(e.chi).number(e.b1).number(e.b2).number(e.object_voxels, tree.has_zones).number(e.contours).text(histogram_text(genera));
    });
}

void put_levels(ByteWriter& out, const TreeView& tree) {
    const CsvTable table(out, tree.connectivity(), "id,value,event,in,out");
    for (std::int64_t id = 0; id < tree.analysis.level_count(); ++id) {
        const Level level = tree.analysis.level(id);
        table.row()
            .number(id)
            .real(tree.reported(level.value))
            .number(level.event.number())
            .text(list_text(level.in))
            .text(list_text(level.out));
    }
}

void put_elements(ByteWriter& out, const TreeView& tree) {
    const CsvTable table(out, tree.connectivity(), "id,value,x,y,z,h0,l0");
    for (const ElementId id : ids<ElementId>(tree.analysis.element_count())) {
        const Element e = tree.analysis.element(id);
        table.row().number(id.number()).real(tree.reported(e.value)).position(e.position).number(e.h0).number(e.l0);
    }
}

void put_contour_rows(ByteWriter& out, const TreeView& tree) {
    const CsvTable table(out, tree.connectivity(), "id,upper,lower,tau_high,tau_low,genus");
    for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
        const ContourArc arc = tree.analysis.contour_arc(id);
        CsvRow row = table.row();
        row.number(id).number(arc.upper.number()).number(arc.lower.number(), !tree.is_outside(arc.lower));
        const auto [low, high] = tree.reported(arc);
        row.real(high).real(low).number(arc.genus);
    }
}

}  // namespace

void write_tree_csv(Sink& sink, const TreeView& tree) {
    ByteWriter out(sink);
    switch (tree.options.detail) {
        case TreeDetail::events: put_event_rows(out, tree); break;
        case TreeDetail::levels: put_levels(out, tree); break;
        case TreeDetail::elements: put_elements(out, tree); break;
        case TreeDetail::contours: put_contour_rows(out, tree); break;
    }
    out.finish();
}

}  // namespace isoatlas
