// Every file says with which interpolant it was made and, when that is trilinear, up to which height tunnels were left out.
#include <gtest/gtest.h>

#include <cstring>
#include <pugixml.hpp>
#include <sstream>

#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "isoatlas/version.h"
#include "unit/formats/common/external.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

constexpr double kHeight = 0.75;          // of stored values
constexpr const char* kReported = "1.5";  // with a slope of 2

Surface surface_of(const Volume& volume, double tau, Interpolant interpolant, double tunnel_height) {
    ExtractOptions options;
    options.interpolant = interpolant;
    options.tunnel_height = tunnel_height;
    return extract(volume, tau, options);
}

class SaysInterpolant : public testing::TestWithParam<Interpolant> {
protected:
    SaysInterpolant() : volume_(make_phantom("noise", {.size = 6})) {
        volume_.info.calibration = {2, 1};
        volume_.info.geometry.unit = "mm";
        surface_ = surface_of(volume_, 0.5, GetParam(), kHeight);
        analysis_.emplace(analyse(volume_, {.interpolant = GetParam(), .tunnel_height = kHeight}));
    }
    [[nodiscard]] bool trilinear() const { return GetParam() == Interpolant::trilinear; }
    [[nodiscard]] std::string name() const { return name_of(GetParam()); }
    std::string of_surface(const std::string& extension) {
        write_surface(folder_ / ("surface" + extension), surface_);
        return read_bytes(folder_ / ("surface" + extension));
    }
    std::string of_tree(const std::string& extension, TreeDetail detail = TreeDetail::events) {
        write_tree(folder_ / ("tree" + extension), volume_, *analysis_, {.detail = detail});
        return read_bytes(folder_ / ("tree" + extension));
    }
    std::string of_labels(const std::string& extension, std::optional<double> tau) {
        const std::vector<std::uint32_t> labels(volume_.bytes.size() / size_of(volume_.info.type), 1);
        write_labels(folder_ / ("labels" + extension), volume_.info, labels,
                     {.interpolant = GetParam(), .tunnel_height = kHeight, .tau = tau});
        return read_bytes(folder_ / ("labels" + extension));
    }
    /// The interpolant is there, and the height exactly when it means something.
    void expect_says(const std::string& bytes, const std::string& interpolant, const std::string& height) const {
        EXPECT_NE(bytes.find(interpolant), std::string::npos) << interpolant;
        EXPECT_EQ(bytes.find(height) != std::string::npos, trilinear()) << height;
    }

    Volume volume_;
    Surface surface_;
    std::optional<Analysis> analysis_;
    Folder folder_;
};

TEST_P(SaysInterpolant, extracted_surfaces) {
    EXPECT_EQ(surface_.interpolant, GetParam());
    EXPECT_EQ(surface_.tunnel_height, kHeight);
    EXPECT_EQ(surface_.reported_tunnel_height, 2 * kHeight);
}

TEST_P(SaysInterpolant, ply_and_obj_in_comments) {
    expect_says(of_surface(".ply"), "\ncomment interpolant " + name() + "\n", std::string("\ncomment tunnel_height ") + kReported + "\n");
    expect_says(of_surface(".obj"), "\n# interpolant " + name() + "\n", std::string("\n# tunnel_height ") + kReported + "\n");
}

TEST_P(SaysInterpolant, glb_in_extras_of_every_node_and_of_the_asset) {
    const std::string member =
        "\"interpolant\":\"" + name() + "\"" + (trilinear() ? std::string(",\"tunnel_height\":") + kReported : "") + "}";
    const std::string bytes = of_surface(".glb");
    std::size_t found = 0, nodes = 0;
    for (std::size_t at = 0; (at = bytes.find(member, at)) != std::string::npos; ++at) ++found;
    for (std::size_t at = 0; (at = bytes.find("\"translation\"", at)) != std::string::npos; ++at) ++nodes;
    EXPECT_GT(nodes, 0U);
    EXPECT_EQ(found, nodes + 1);
}

TEST_P(SaysInterpolant, stl_in_its_80_bytes) {
    const auto header = [&] { return std::string(of_surface(".stl").substr(0, 80).c_str()); };
    const std::string height = trilinear() ? std::string(" tunnel_height ") + kReported : "";
    EXPECT_EQ(header(), "isoatlas " ISOATLAS_VERSION " tau 2 " + name() + height + " space unknown unit mm");
    surface_.reported_tau = -1.2345678901234567e-300;
    surface_.reported_tunnel_height = 9.8765432109876543e-300;
    surface_.space = "LPS";
    EXPECT_EQ(header().rfind("isoatlas " ISOATLAS_VERSION " SPACE=LPS tau -1.23456789", 0) == 0, !trilinear());
    expect_says(header(), " " + name() + " ", " tunnel_height 9.876543e-300 ");
    EXPECT_NE(header().find(" SPACE=LPS "), std::string::npos);
}

/// The text of a String array and the number of an appended Float64 array of field data; empty: there is none.
std::string field_text(const pugi::xml_node& field, const char* name) {
    std::istringstream codes(field.find_child_by_attribute("DataArray", "Name", name).text().get());
    std::string text;
    for (int code = 0; codes >> code && code != 0;) text += static_cast<char>(code);
    return text;
}
std::optional<double> field_number(const pugi::xml_node& field, const char* name, const std::string& bytes) {
    const pugi::xml_node element = field.find_child_by_attribute("DataArray", "Name", name);
    if (!element) return {};
    double number = 0;
    const std::size_t blocks = bytes.find('_', bytes.find("<AppendedData encoding=\"raw\">\n")) + 1;
    std::memcpy(&number, bytes.data() + blocks + element.attribute("offset").as_ullong() + 8, sizeof number);
    return number;
}

TEST_P(SaysInterpolant, vtp_and_vtu_in_field_data) {
    const std::optional<double> height = trilinear() ? std::optional(2 * kHeight) : std::nullopt;
    for (const auto& [kind, bytes] : {std::pair{"PolyData", of_surface(".vtp")}, std::pair{"UnstructuredGrid", of_tree(".vtu")}}) {
        const std::string text = bytes.substr(0, bytes.find("<AppendedData")) + "</VTKFile>";
        pugi::xml_document document;
        ASSERT_TRUE(document.load_string(text.c_str()));
        const pugi::xml_node field = document.child("VTKFile").child(kind).child("FieldData");
        EXPECT_EQ(field_text(field, "Interpolant"), name()) << kind;
        EXPECT_EQ(field_number(field, "TunnelHeight", bytes), height) << kind;
    }
}

TEST_P(SaysInterpolant, vtk_sees_it) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    (void)of_surface(".vtp");
    (void)of_tree(".vtu");
    const external::Result result = external::python(
        "import vtk\n"
        "for name, reader in (('surface.vtp', vtk.vtkXMLPolyDataReader()), ('tree.vtu', vtk.vtkXMLUnstructuredGridReader())):\n"
        "  reader.SetFileName('" +
        (folder_ / "") +
        "' + name)\n  reader.Update()\n  field = reader.GetOutput().GetFieldData()\n"
        "  height = field.GetArray('TunnelHeight')\n"
        "  print(field.GetAbstractArray('Interpolant').GetValue(0), height.GetValue(0) if height else None)\n");
    const std::string line = name() + (trilinear() ? std::string(" ") + kReported : " None") + "\n";
    EXPECT_EQ(result.text, line + line);
}

TEST_P(SaysInterpolant, csv_in_every_row) {
    const std::string end = "," + name() + "," + (trilinear() ? kReported : "");
    for (const TreeDetail detail : {TreeDetail::events, TreeDetail::levels, TreeDetail::elements, TreeDetail::contours}) {
        std::istringstream lines(of_tree(".csv", detail));
        std::string line;
        std::getline(lines, line);
        EXPECT_TRUE(line.ends_with(",interpolant,tunnel_height")) << line;
        int rows = 0;
        for (; std::getline(lines, line); ++rows) EXPECT_TRUE(line.ends_with(end)) << line;
        EXPECT_GT(rows, 0);
    }
}

TEST_P(SaysInterpolant, graphml_and_json) {
    for (const TreeDetail detail : {TreeDetail::events, TreeDetail::contours}) {
        expect_says(of_tree(".graphml", detail), "<data key=\"interpolant\">" + name() + "<",
                    std::string("<data key=\"tunnel_height\">") + kReported + "<");
        expect_says(of_tree(".json", detail), "\"interpolant\":\"" + name() + "\"", std::string("\"tunnel_height\":") + kReported);
    }
    if (external::run("/usr/bin/python3 -c 'import networkx'").status != 0) return;
    const external::Result result = external::python("import networkx as nx\ng = nx.read_graphml('" + (folder_ / "tree.graphml") +
                                                     "')\nprint(g.graph['interpolant'], g.graph.get('tunnel_height'))");
    EXPECT_EQ(result.text, name() + (trilinear() ? std::string(" ") + kReported : " None") + "\n");
}

TEST_P(SaysInterpolant, labels) {
    const std::string height = trilinear() ? std::string(", tunnel height ") + kReported : "";
    for (const auto& [tau, what] : {std::pair{std::optional(0.125), std::string("objects")}, {std::optional<double>(), "zones"}}) {
        const std::string sentence = "isoatlas " + what + (tau ? " at tau 1.25, " : ", ") + name() + height;
        const std::string nrrd = of_labels(".nrrd", tau), tiff = of_labels(".tif", tau);
        EXPECT_NE(nrrd.find("\ncontent: " + sentence + "\n"), std::string::npos);
        for (const auto& [bytes, between] : {std::pair{nrrd, std::string(":=")}, {tiff, "="}}) {
            expect_says(bytes, "\ninterpolant" + between + name() + "\n", "\ntunnel_height" + between + kReported + "\n");
            EXPECT_NE(bytes.find("\nlabels_are" + between + what + "\n"), std::string::npos);
            EXPECT_EQ(bytes.find("\ntau" + between + "1.25\n") != std::string::npos, tau.has_value());
        }
        EXPECT_EQ(std::string(of_labels(".nii", tau).substr(148, 80).c_str()), sentence);
        for (const std::string extension : {".nrrd", ".nii", ".nii.gz", ".tif"}) {
            (void)of_labels(extension, tau);
            const Volume back = load_volume(folder_ / ("labels" + extension));
            EXPECT_EQ(back.value(0), 1);
            EXPECT_TRUE(back.info.calibration.is_identity());
        }
    }
}

TEST_P(SaysInterpolant, tifffile_sees_it) {
    if (external::run("/usr/bin/python3 -c 'import tifffile'").status != 0) GTEST_SKIP() << "python3-tifffile is not installed";
    (void)of_labels(".tif", 0.125);
    const external::Result result =
        external::python("import tifffile\nm = tifffile.TiffFile('" + (folder_ / "labels.tif") +
                         "').imagej_metadata\nprint(m['labels_are'], m['tau'], m['interpolant'], m.get('tunnel_height'))");
    EXPECT_EQ(result.text, "objects 1.25 " + name() + (trilinear() ? std::string(" ") + kReported : " None") + "\n");
}

/// 79 characters hold the longest sentence; what is cut off of another description is never half a number.
TEST_P(SaysInterpolant, nifti_in_its_description) {
    volume_.info.calibration = {};
    const auto description = [&](double height) {
        const std::vector<std::uint32_t> labels(volume_.bytes.size() / size_of(volume_.info.type), 1);
        write_labels(folder_ / "labels.nii", volume_.info, labels,
                     {.interpolant = GetParam(), .tunnel_height = height, .tau = -1.2345678901234567e-300});
        return load_volume(folder_ / "labels.nii").info.description;
    };
    const std::string sentence = "isoatlas objects at tau -1.234568e-300, " + name();
    EXPECT_EQ(description(9.8765432109876543e-300), sentence + (trilinear() ? ", tunnel height 9.876543e-300" : ""));
    EXPECT_EQ(description(0), sentence);
    volume_.info.geometry.coordinates = {{{0, 1, 2, 3, 4, 9}, {0, 1, 2, 3, 4, 9}, {0, 1, 2, 3, 4, 9}}};
    EXPECT_EQ(description(9.8765432109876543e-300), sentence + "; was rectilinear");
}

INSTANTIATE_TEST_SUITE_P(Both, SaysInterpolant, testing::Values(Interpolant::faces, Interpolant::trilinear),
                         [](const auto& interpolant) { return std::string(name_of(interpolant.param)); });

TEST(SaysInterpolantIn2D, what_was_asked_for) {
    const Volume image = make_volume<std::uint8_t>(Extent{2, {3, 3, 1}}, std::vector<std::uint8_t>{0, 0, 0, 0, 9, 0, 0, 0, 0});
    for (const Interpolant interpolant : {Interpolant::faces, Interpolant::trilinear}) {
        EXPECT_EQ(surface_of(image, 5, interpolant, 0).interpolant, interpolant);
        EXPECT_EQ(analyse(image, {.interpolant = interpolant}).interpolant(), interpolant);
    }
}

TEST(SaysInterpolantIn, words_for_people) {
    EXPECT_EQ(describe(Interpolant::faces, 3), "faces");
    EXPECT_EQ(describe(Interpolant::trilinear, 0), "trilinear");
    EXPECT_EQ(describe(Interpolant::trilinear, 1.0 / 3), "trilinear, tunnel height 0.3333333");
}

}  // namespace
