// The JSON tree says what the analysis says, and follows its schema.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cerrno>
#include <limits>
#include <sstream>

#include "faults/faulty_files.h"
#include "formats/common/json_stream.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "unit/formats/mesh/mesh_samples.h"
#include "unit/formats/tree/json_schema.h"

using namespace isoatlas;
using json_schema::Json;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

constexpr std::array kDetails{TreeDetail::events, TreeDetail::levels, TreeDetail::elements, TreeDetail::contours};
constexpr std::array kNames{"events", "levels", "elements", "contours"};

Json tree_json(const Volume& volume, const Analysis& analysis, const TreeOutput& options = {}) {
    std::ostringstream out;
    write_tree_json(out, volume, analysis, options);
    return Json::parse(out.str());
}

std::string schema_problem(const Json& document, const std::string& detail) {
    return json_schema::problem(document, json_schema::load(ISOATLAS_SOURCE_DIR "/docs/schema/tree-" + detail + ".schema.json"));
}

/// A small volume with many ties; 2D in one case of three.
Volume random_volume() {
    const int rank = *rc::gen::element(2, 3, 3);
    Extent extent{rank, {*rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6), rank == 3 ? *rc::gen::inRange(1, 5) : 1}};
    const int values = *rc::gen::element(2, 3, 8);
    std::vector<std::int16_t> samples(static_cast<std::size_t>(extent.voxels()));
    for (std::int16_t& s : samples) s = static_cast<std::int16_t>(*rc::gen::inRange(0, values));
    return make_volume<std::int16_t>(extent, samples);
}

Volume figure() { return make_phantom("figure-plateau"); }

/// A row by the names of the columns.
Json named(const Json& document, std::size_t row) {
    Json event;
    for (std::size_t i = 0; i < document["columns"].size(); ++i)
        event[document["columns"][i].get<std::string>()] = document["events"][row][i];
    return event;
}

RC_GTEST_PROP(TreeJson, events_are_the_analysis, ()) {
    Volume volume = random_volume();
    volume.info.calibration = {0.5, -3};
    const Analysis analysis = analyse(volume);
    const Json document = tree_json(volume, analysis);
    RC_ASSERT(schema_problem(document, "events") == "");
    RC_ASSERT(static_cast<std::int64_t>(document["events"].size()) == analysis.event_count());
    RC_ASSERT(document["columns"].size() == 11);
    for (const EventId id : ids<EventId>(analysis.event_count())) {
        RC_ASSERT(document["events"][id.index()].size() == 11);
        const Json json = named(document, id.index());
        const Event event = analysis.event(id);
        RC_ASSERT(json["value"] == event.value * 0.5 - 3);
        RC_ASSERT(Json::array({json["x"], json["y"], json["z"]}) == Json(event.position));
        RC_ASSERT(json["kind"] == name_of(event.kind));
        RC_ASSERT(json["parent"] == (event.parent.exists() ? Json(event.parent.number()) : Json()));
        RC_ASSERT(json["lows_out"] == event.lows_out && json["b1"] == event.b1 && json["b2"] == event.b2);
        RC_ASSERT(json["zone_voxels"] == event.zone.voxels && json["object_voxels"] == event.object_voxels);
    }
}

/// What the rows leave out follows from them, as docs/formats.md says; all columns say it in full.
RC_GTEST_PROP(TreeJson, what_is_left_out_follows, ()) {
    const Volume volume = random_volume();
    const Analysis analysis = analyse(volume);
    const Json document = tree_json(volume, analysis), all = tree_json(volume, analysis, {.all = true});
    RC_ASSERT(schema_problem(all, "events") == "");
    RC_ASSERT(all["columns"].size() == 18);
    std::vector<std::vector<std::int64_t>> children(document["events"].size());
    for (std::size_t i = 0; i < children.size(); ++i) {
        const Json parent = named(document, i)["parent"];
        if (!parent.is_null()) children[parent.get<std::size_t>()].push_back(static_cast<std::int64_t>(i));
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
        const Json brief = named(document, i), full = named(all, i);
        const std::int64_t b1 = brief["b1"], b2 = brief["b2"];
        for (const auto& [key, value] : brief.items()) RC_ASSERT(full[key] == value);
        RC_ASSERT(full["id"] == i);
        RC_ASSERT(full["children"] == Json(children[i]));
        RC_ASSERT(full["tau_low"] == (brief["parent"].is_null() ? Json() : named(document, brief["parent"].get<std::size_t>())["value"]));
        RC_ASSERT(full["chi"] == 1 - b1 + b2);
        RC_ASSERT(full["contours"] == (volume.info.extent.rank == 2 ? b1 : b2) + 1);
        std::int64_t chi = full["chi"], contours = 0, genera = 0;
        for (const std::int64_t child : children[i]) chi -= named(all, static_cast<std::size_t>(child))["chi"].get<std::int64_t>();
        RC_ASSERT(full["delta_chi"] == chi);
        for (const Json& pair : full["genera"]) {
            contours += pair[1].get<std::int64_t>();
            genera += pair[0].get<std::int64_t>() * pair[1].get<std::int64_t>();
        }
        RC_ASSERT(full["contours"] == contours);
        RC_ASSERT(volume.info.extent.rank == 2 || b1 == genera);
    }
}

TEST(TreeJson, an_event_takes_at_most_100_bytes) {
    for (const char* name : {"noise", "demo"}) {
        const Volume volume = make_phantom(name, {.size = 40, .noise = 0.1});
        const Analysis analysis = analyse(volume);
        std::ostringstream out;
        write_tree_json(out, volume, analysis);
        EXPECT_LE(out.str().size(), 2000 + 100 * static_cast<std::size_t>(analysis.event_count())) << name;
    }
}

RC_GTEST_PROP(TreeJson, levels_elements_and_contours_are_the_analysis, ()) {
    const Volume volume = random_volume();
    const Analysis analysis = analyse(volume);
    const Json levels = tree_json(volume, analysis, {.detail = TreeDetail::levels});
    const Json elements = tree_json(volume, analysis, {.detail = TreeDetail::elements});
    const Json contours = tree_json(volume, analysis, {.detail = TreeDetail::contours});
    RC_ASSERT(schema_problem(levels, "levels") == "");
    RC_ASSERT(schema_problem(elements, "elements") == "");
    RC_ASSERT(schema_problem(contours, "contours") == "");
    RC_ASSERT(static_cast<std::int64_t>(levels["levels"].size()) == analysis.level_count());
    RC_ASSERT(static_cast<std::int64_t>(elements["elements"].size()) == analysis.element_count());
    RC_ASSERT(static_cast<std::int64_t>(contours["contours"].size()) == analysis.contour_arc_count());
    for (std::int64_t id = 0; id < analysis.level_count(); ++id) {
        const Json& json = levels["levels"][static_cast<std::size_t>(id)];
        const Level level = analysis.level(id);
        RC_ASSERT(json["value"] == level.value && json["event"] == level.event.number() && json["in"] == Json(level.in) &&
                  json["out"] == Json(level.out));
    }
    for (const ElementId id : ids<ElementId>(analysis.element_count())) {
        const Json& json = elements["elements"][id.index()];
        const Element e = analysis.element(id);
        RC_ASSERT(json["value"] == e.value && json["position"] == Json(e.position) && json["h0"] == e.h0 && json["l0"] == e.l0);
    }
    std::int64_t outside = 0;
    for (std::int64_t id = 0; id < analysis.contour_arc_count(); ++id) {
        const Json& json = contours["contours"][static_cast<std::size_t>(id)];
        const ContourArc arc = analysis.contour_arc(id);
        const bool is_outside = arc.lower == ElementId(analysis.element_count());
        outside += is_outside ? 1 : 0;
        RC_ASSERT(json["id"] == id && json["upper"] == arc.upper.number() && json["genus"] == arc.genus &&
                  json["tau_high"] == arc.value_high);
        RC_ASSERT(json["lower"] == (is_outside ? Json() : Json(arc.lower.number())));
        RC_ASSERT(json["tau_low"] == (is_outside ? Json() : Json(arc.value_low)));
    }
    RC_ASSERT(outside == 1);
}

TEST(TreeJson, the_schemas_notice_damage) {
    const Volume volume = figure();
    const Analysis analysis = analyse(volume);
    const Json good = tree_json(volume, analysis);
    EXPECT_EQ(schema_problem(good, "events"), "");
    EXPECT_NE(schema_problem(good, "levels"), "");
    Json bad = good;
    bad.erase("columns");
    EXPECT_EQ(schema_problem(bad, "events"), "$ lacks columns");
    bad = good;
    bad["events"][3].erase(4);
    EXPECT_EQ(schema_problem(bad, "events"), "$.events[3] has a wrong length");
    bad = good;
    bad["events"][0][7] = true;
    EXPECT_NE(schema_problem(bad, "events").find("$.events[0][7]"), std::string::npos);
    bad = good;
    bad["surprise"] = 1;
    EXPECT_NE(schema_problem(bad, "events").find("undocumented key surprise"), std::string::npos);
}

TEST(TreeJson, the_dissertations_figure) {
    const Volume volume = figure();
    const Json document = tree_json(volume, analyse(volume));
    std::vector<double> values;
    for (const Json& event : document["events"]) values.push_back(event[0]);
    EXPECT_EQ(values, (std::vector<double>{100, 90, 80, 70, 60, 58, 56, 50, 48, 46, 40, 38, 30, 20}));
    EXPECT_EQ(document["counts"]["events"], 14);
    EXPECT_EQ(document["detail"], "events");
}

TEST(TreeJson, a_file_holds_the_same_document_and_names_survive) {
    const Folder folder;
    Volume volume = figure();
    volume.info.path = "folder \"with\"\\quotes\n\tand \xff bytes \xc3\xa9";
    volume.info.geometry.unit = "mm";
    const Analysis analysis = analyse(volume);
    for (std::size_t d = 0; d < kDetails.size(); ++d) {
        const std::string path = folder / (std::string(kNames[d]) + ".JSON");
        write_tree(path, volume, analysis, {.detail = kDetails[d]});
        const Json document = json_schema::load(path);
        EXPECT_EQ(document, tree_json(volume, analysis, {.detail = kDetails[d]}));
        EXPECT_EQ(document["volume"]["path"], "folder \"with\"\\quotes\n\tand \\xff bytes \xc3\xa9");
        EXPECT_EQ(document["volume"]["unit"], "mm");
    }
}

TEST(TreeJson, without_zones_voxel_counts_are_null) {
    const Volume volume = figure();
    const Json document = tree_json(volume, analyse(volume, {.zones = false}));
    EXPECT_EQ(schema_problem(document, "events"), "");
    EXPECT_TRUE(named(document, 0)["zone_voxels"].is_null());
    EXPECT_TRUE(named(document, 0)["object_voxels"].is_null());
}

TEST(TreeJson, a_failing_stream_or_disk_is_an_error) {
    const Volume volume = figure();
    const Analysis analysis = analyse(volume);
    std::ostringstream closed;
    closed.setstate(std::ios::badbit);
    EXPECT_THROW(write_tree_json(closed, volume, analysis), Error);
    const Folder folder;
    for (const char* extension : {".json", ".csv", ".graphml", ".vtu"}) {
        const test::FullDisk fault(200, ENOSPC);
        try {
            write_tree(folder / (std::string("tree") + extension), volume, analysis);
            FAIL() << extension;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::resource);
        }
        EXPECT_EQ(folder.files(), 0U);
    }
}

TEST(JsonStream, numbers_text_and_layout) {
    std::string text;
    JsonStream json([&](std::string_view piece) { text += piece; });
    json.begin_object().key("a").begin_array().value(0.1).value(1e300).value(-0.0).value(std::numeric_limits<double>::infinity());
    json.value(std::numeric_limits<double>::quiet_NaN()).value(std::int64_t{-9007199254740993}).value(~std::uint64_t{0}).end_array();
    json.key("b\"").value("\x01\\/\x7f").line().key("c").begin_array().end_array().key("d").value(false).end_object().finish();
    EXPECT_EQ(
        text,
        "{\"a\":[0.1,1e+300,-0,null,null,-9007199254740993,18446744073709551615],\"b\\\"\":\"\\u0001\\\\/\x7f\",\n\"c\":[],\"d\":false}\n");
    EXPECT_EQ(Json::parse(text)["b\""], "\x01\\/\x7f");
}

RC_GTEST_PROP(JsonStream, any_double_and_any_bytes_come_back, (const double number, const std::string& bytes)) {
    std::string text;
    JsonStream json([&](std::string_view piece) { text += piece; });
    json.begin_array().value(number).value(bytes).end_array().finish();
    const Json document = Json::parse(text);
    if (std::isfinite(number)) RC_ASSERT(document[0].get<double>() == number);
    const bool is_ascii = std::none_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    RC_ASSERT(document[1].is_string());  // the parser refuses what is not UTF-8
    if (is_ascii) RC_ASSERT(document[1] == bytes);
}

}  // namespace
