// The tree as CSV: a row for each event, level, element or contour; lists are separated by spaces; what does not exist is empty.
#include <cmath>

#include "output/byte_writer.h"
#include "output/tree_formats.h"

namespace isoatlas::output {

namespace {

/// One row of cells, ended by last_cells. No cell needs quotes: all are numbers, names of ours or lists of numbers.
class Row {
public:
    Row(ByteWriter& out, const std::string& last_cells) : out_(out), last_cells_(last_cells) {}
    ~Row() { out_.text(last_cells_); }
    Row(const Row&) = delete;
    Row& operator=(const Row&) = delete;

    Row& text(std::string_view cell) {
        separate();
        out_.text(cell);
        return *this;
    }
    template <class T>
    Row& number(T value, bool known = true) {
        separate();
        if (known) out_.number(value);
        return *this;
    }
    Row& real(double value) { return number(value, std::isfinite(value)); }
    Row& position(const std::array<double, 3>& p) { return real(p[0]).real(p[1]).real(p[2]); }

private:
    void separate() {
        if (!first_) out_.text(",");
        first_ = false;
    }
    ByteWriter& out_;
    const std::string& last_cells_;
    bool first_ = true;
};

/// The columns of a detail, then the interpolant in each row: readers of tables would stumble over a comment line.
class Table {
public:
    Table(ByteWriter& out, const TreeView& tree, const std::string& columns) : out_(out) {
        const Connectivity connectivity = tree.connectivity();
        const std::string height = connectivity.has_tunnels() ? number_text(connectivity.tunnel_height) : "";
        last_cells_ = std::string(",") + connectivity.name() + "," + height + "\n";
        out_.text(columns + ",interpolant,tunnel_height\n");
    }
    [[nodiscard]] Row row() const { return {out_, last_cells_}; }

private:
    ByteWriter& out_;
    std::string last_cells_;
};

void put_events(ByteWriter& out, const TreeView& tree) {
    const Table table(
        out, tree,
        "id,value,x,y,z,kind,parent,children,objects_in,lows_out,delta_chi,tau_low,tau_high,voxels,chi,b1,b2,object_voxels,contours,"
        "genera");
    visit_events(tree, [&](const Event& e, std::span<const GenusCount> genera) {
        Row row = table.row();
        row.number(e.id).real(tree.reported(e.value)).position(e.position).text(isoatlas::name_of(e.kind)).number(e.parent, e.parent >= 0);
        row.text(list_text(e.children)).number(e.objects_in).number(e.lows_out).number(e.delta_chi);
        row.real(tree.reported(e.zone.tau_low)).real(tree.reported(e.zone.tau_high)).number(e.zone.voxels, tree.has_zones);
        row.number(e.chi).number(e.b1).number(e.b2).number(e.object_voxels, tree.has_zones).number(e.contours).text(histogram_text(genera));
    });
}

void put_levels(ByteWriter& out, const TreeView& tree) {
    const Table table(out, tree, "id,value,event,in,out");
    for (std::int64_t id = 0; id < tree.analysis.level_count(); ++id) {
        const Level level = tree.analysis.level(id);
        table.row().number(id).real(tree.reported(level.value)).number(level.event).text(list_text(level.in)).text(list_text(level.out));
    }
}

void put_elements(ByteWriter& out, const TreeView& tree) {
    const Table table(out, tree, "id,value,x,y,z,h0,l0");
    for (std::int64_t id = 0; id < tree.analysis.element_count(); ++id) {
        const Element e = tree.analysis.element(id);
        table.row().number(id).real(tree.reported(e.value)).position(e.position).number(e.h0).number(e.l0);
    }
}

void put_contours(ByteWriter& out, const TreeView& tree) {
    const Table table(out, tree, "id,upper,lower,tau_high,tau_low,genus");
    for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
        const ContourArc arc = tree.analysis.contour_arc(id);
        Row row = table.row();
        row.number(id).number(arc.upper).number(arc.lower, !tree.is_outside(arc.lower));
        row.real(tree.reported(arc.value_high)).real(tree.reported(arc.value_low)).number(arc.genus);
    }
}

}  // namespace

void write_tree_csv(AtomicFile& file, const TreeView& tree) {
    ByteWriter out(file);
    switch (tree.options.detail) {
        case TreeDetail::events: put_events(out, tree); break;
        case TreeDetail::levels: put_levels(out, tree); break;
        case TreeDetail::elements: put_elements(out, tree); break;
        case TreeDetail::contours: put_contours(out, tree); break;
    }
    out.finish();
}

}  // namespace isoatlas::output
