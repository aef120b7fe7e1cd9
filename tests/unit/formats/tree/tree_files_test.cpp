// The tree as CSV, GraphML and VTU: opened by readers that are not ours, compared with the analysis.
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <sstream>

#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "unit/formats/common/external.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

std::vector<std::vector<std::string>> csv_rows(const std::string& path) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream in(read_bytes(path));
    for (std::string line; std::getline(in, line);) {
        rows.emplace_back();
        line += ',';
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = line.find(',', at);
            rows.back().push_back(line.substr(at, end - at));
            at = end + 1;
        }
    }
    return rows;
}

/// The dissertation's figure, calibrated and placed in space.
class TreeFiles : public testing::Test {
protected:
    TreeFiles() : volume_(make_phantom("figure-plateau")) {
        volume_.info.calibration = {2, 1};
        volume_.info.geometry.spacing = {0.5, 2, 3};
        volume_.info.geometry.origin = {-10, 0, 7};
        volume_.info.geometry.unit = "mm";
        analysis_.emplace(analyse(volume_));
    }
    std::string write(const std::string& name, TreeDetail detail = TreeDetail::events) {
        write_tree(folder_ / name, volume_, *analysis_, {.detail = detail});
        return folder_ / name;
    }
    Volume volume_;
    std::optional<Analysis> analysis_;
    Folder folder_;
};

TEST_F(TreeFiles, csv_has_a_row_for_each_item) {
    const auto events = csv_rows(write("events.csv"));
    ASSERT_EQ(events.size(), 15U);
    for (const auto& row : events) EXPECT_EQ(row.size(), events[0].size());
    for (const EventId id : ids<EventId>(14)) {
        const Event event = analysis_->event(id);
        const auto& row = events[id.index() + 1];
        EXPECT_EQ(row[0], std::to_string(id.number()));
        EXPECT_EQ(std::stod(row[1]), 2 * event.value + 1);
        EXPECT_EQ(row[5], name_of(event.kind));
        EXPECT_EQ(row[6], event.parent.exists() ? std::to_string(event.parent.number()) : "");
        EXPECT_EQ(row[11].empty(), !event.parent.exists());
        EXPECT_EQ(row[13], std::to_string(event.zone.voxels));
    }
    EXPECT_EQ(csv_rows(write("levels.csv", TreeDetail::levels)).size(), static_cast<std::size_t>(analysis_->level_count()) + 1);
    EXPECT_EQ(csv_rows(write("elements.csv", TreeDetail::elements)).size(), static_cast<std::size_t>(analysis_->element_count()) + 1);
    const auto contours = csv_rows(write("contours.csv", TreeDetail::contours));
    EXPECT_EQ(contours.size(), static_cast<std::size_t>(analysis_->contour_arc_count()) + 1);
    EXPECT_EQ(contours[0],
              (std::vector<std::string>{"id", "upper", "lower", "tau_high", "tau_low", "genus", "interpolant", "tunnel_height"}));
    EXPECT_EQ(std::count_if(contours.begin(), contours.end(), [](const auto& row) { return row[2].empty(); }), 1);
}

TEST_F(TreeFiles, graphml_is_xml_with_typed_keys) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file(write("tree.graphml").c_str()));
    const pugi::xml_node graph = document.child("graphml").child("graph");
    EXPECT_EQ(std::distance(graph.children("node").begin(), graph.children("node").end()), 14);
    EXPECT_EQ(std::distance(graph.children("edge").begin(), graph.children("edge").end()), 13);
    for (const auto& data : graph.child("node").children("data")) {
        EXPECT_TRUE(document.child("graphml").find_child_by_attribute("key", "id", data.attribute("key").value()))
            << data.attribute("key").value();
    }
    for (const auto& edge : graph.children("edge")) {
        const EventId child(std::stoll(edge.attribute("source").value() + 1)), parent(std::stoll(edge.attribute("target").value() + 1));
        EXPECT_EQ(analysis_->event(child).parent, parent);
    }
    ASSERT_TRUE(document.load_file(write("contours.graphml", TreeDetail::contours).c_str()));
    const pugi::xml_node arcs = document.child("graphml").child("graph");
    EXPECT_EQ(std::distance(arcs.children("edge").begin(), arcs.children("edge").end()), analysis_->contour_arc_count());
}

TEST_F(TreeFiles, graphml_opens_in_networkx) {
    if (external::run("/usr/bin/python3 -c 'import networkx'").status != 0) GTEST_SKIP() << "networkx is not installed";
    const external::Result result = external::python(
        "import networkx as nx\ng = nx.read_graphml('" + write("tree.graphml") + "')\nc = nx.read_graphml('" +
        write("contours.graphml", TreeDetail::contours) +
        "')\n"
        "root = [n for n in g if g.out_degree(n) == 0]\nassert len(root) == 1 and 'tau_low' not in g.nodes[root[0]]\n"
        "assert nx.is_directed_acyclic_graph(g) and nx.is_weakly_connected(g)\n"
        "assert [g.nodes['n%d' % i]['value'] for i in range(3)] == [201.0, 181.0, 161.0] and type(g.nodes['n0']['voxels']) is int\n"
        "print(len(g), g.size(), len(c), c.size(), g.graph['schema'])");
    EXPECT_EQ(result.text, "14 13 " + std::to_string(analysis_->element_count() + 1) + " " +
                               std::to_string(analysis_->contour_arc_count()) + " isoatlas/tree/1\n");
}

TEST_F(TreeFiles, vtu_opens_in_vtk) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const std::string load =
        "import vtk\ndef load(name):\n  r = vtk.vtkXMLUnstructuredGridReader()\n  r.SetFileName(name)\n  r.Update()\n  return "
        "r.GetOutput()\n";
    const external::Result result = external::python(
        load + "g = load('" + write("tree.vtu") +
        "')\np, c = g.GetPointData(), g.GetCellData()\n"
        "print(g.GetNumberOfPoints(), g.GetNumberOfCells(), g.GetCellType(0), p.GetArray('Scalar').GetValue(0), "
        "p.GetArray('CriticalType').GetValue(0))\n"
        "print(g.GetPoint(0), g.GetFieldData().GetAbstractArray('Unit').GetValue(0))\n"
        "for n in ('NodeId', 'RegionSize', 'Chi', 'Tunnels', 'Cavities', 'Contours'): assert p.GetArray(n).GetNumberOfTuples() == 14, n\n"
        "for n in ('SegmentationId', 'upNodeId', 'downNodeId', 'RegionSize', 'RegionSpan', 'RegionType', 'ValueSpan'): assert "
        "c.GetArray(n).GetNumberOfTuples() == 13, n\n"
        "for i in range(13):\n  k = g.GetCell(i)\n  a, b = k.GetPointId(0), k.GetPointId(1)\n"
        "  assert (a, b) == (c.GetArray('upNodeId').GetValue(i), c.GetArray('downNodeId').GetValue(i)) and "
        "p.GetArray('Scalar').GetValue(a) > p.GetArray('Scalar').GetValue(b)\n"
        "print(p.GetArray('RegionSize').GetRange()[1])\n");
    const Event first = analysis_->event(EventId(0));
    std::int64_t largest = 0;
    for (const EventId id : ids<EventId>(14)) largest = std::max(largest, analysis_->event(id).zone.voxels);
    std::ostringstream expected;
    const auto python_number = [](double x) {
        return x == std::floor(x) ? std::to_string(static_cast<long>(x)) + ".0" : std::to_string(static_cast<long>(x * 10) / 10) + ".5";
    };
    const Vec3 place = to_physical(volume_.info.geometry, first.position);
    expected << "14 13 3 " << python_number(2 * first.value + 1) << " 3\n";
    EXPECT_NE(result.text.find(expected.str()), std::string::npos) << result.text << expected.str();
    EXPECT_NE(result.text.find(python_number(static_cast<double>(largest)) + "\n"), std::string::npos) << result.text;
    const external::Result point =
        external::python(load + "g = load('" + (folder_ / "tree.vtu") + "')\nprint([round(1000 * x) for x in g.GetPoint(0)])");
    std::ostringstream rounded;
    rounded << "[" << std::lround(1000 * place[0]) << ", " << std::lround(1000 * place[1]) << ", " << std::lround(1000 * place[2]) << "]\n";
    EXPECT_EQ(point.text, rounded.str());
    for (const auto& [detail, cells] : {std::pair{TreeDetail::elements, analysis_->element_count()},
                                        std::pair{TreeDetail::contours, analysis_->contour_arc_count() - 1}}) {
        const external::Result other =
            external::python(load + "g = load('" + write("other.vtu", detail) +
                             "')\nprint(g.GetNumberOfPoints(), g.GetNumberOfCells(), g.GetPointData().GetArray('H0').GetNumberOfTuples())");
        EXPECT_EQ(other.text, std::to_string(analysis_->element_count()) + " " + std::to_string(cells) + " " +
                                  std::to_string(analysis_->element_count()) + "\n");
    }
}

TEST_F(TreeFiles, a_single_event_is_a_file_in_every_format) {
    const Volume constant = make_volume<std::uint8_t>(Extent{3, {3, 2, 2}}, std::vector<std::uint8_t>(12, 5));
    const Analysis analysis = analyse(constant);
    ASSERT_EQ(analysis.event_count(), 1);
    for (const char* extension : {".json", ".csv", ".graphml", ".vtu"}) {
        const std::string path = folder_ / (std::string("one") + extension);
        EXPECT_NO_THROW(write_tree(path, constant, analysis)) << extension;
        EXPECT_GT(read_bytes(path).size(), 50U);
    }
}

TEST_F(TreeFiles, what_cannot_be_is_a_usage_error) {
    for (const auto& [name, detail] :
         {std::pair{"tree.txt", TreeDetail::events}, std::pair{"tree", TreeDetail::events}, std::pair{"tree.graphml", TreeDetail::levels},
          std::pair{"tree.graphml", TreeDetail::elements}, std::pair{"tree.vtu", TreeDetail::levels}}) {
        try {
            write(name, detail);
            FAIL() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            EXPECT_FALSE(error.text().next.empty());
        }
    }
    EXPECT_EQ(folder_.files(), 0U);
}

}  // namespace
