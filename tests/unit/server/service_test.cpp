// Any request gets an answer: what was asked for, or a refusal that says why.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "isoatlas/build.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "unit/server/service_fixture.h"

namespace isoatlas {
namespace {

TEST_F(ServiceTest, NothingWithoutTheToken) {
    for (const char* token : {"", "Secret", "secre", "secret "}) {
        for (const char* path : {"/api/atlas", "/api/surface", "/nothing"}) EXPECT_EQ(ask(path, {}, token).status, 403) << token;
    }
    EXPECT_EQ(ask("/api/atlas").status, 200);
}

TEST_F(ServiceTest, AnswersAreThoseOfTheStore) {
    const auto json = nlohmann::json::parse(ask("/api/atlas").bytes);
    const ObjectTable table = atlas_->objects();
    ASSERT_GE(json["entries"].size(), table.entries.size());
    EXPECT_EQ(json["entries"][0]["id"], table.entries[0].id);
    EXPECT_TRUE(json["entries"][0]["picture"].is_null());
    const double tau = table.entries[0].best_tau;
    const auto preview = nlohmann::json::parse(ask("/api/preview", {{"tau", std::to_string(tau)}}).bytes);
    EXPECT_EQ(preview["objects"], atlas_->preview(tau).objects);
    const auto objects = nlohmann::json::parse(ask("/api/objects", {{"tau", std::to_string(tau)}, {"top", "1"}}).bytes);
    EXPECT_EQ(objects["count"], atlas_->active(tau).objects.size());
    EXPECT_EQ(objects["objects"].size(), 1U);
    EXPECT_FALSE(preview.contains("object"));
    const std::int64_t id = objects["objects"][0]["id"];
    const auto of = [&](std::int64_t object) {
        return nlohmann::json::parse(ask("/api/preview", {{"tau", std::to_string(tau)}, {"object", "v" + std::to_string(object)}}).bytes);
    };
    EXPECT_EQ(of(id)["object"], objects["objects"][0]);
    EXPECT_TRUE(of(id == 0 ? 1 : id - 1)["object"].is_null());
    const Response surface = ask("/api/surface", {{"tau", std::to_string(tau)}});
    ASSERT_EQ(surface.status, 200);
    EXPECT_EQ(surface.headers.at("X-Triangles"), std::to_string(atlas_->extract(tau).triangles.size()));
    std::size_t parts = 0;
    for (const auto& [shell, choice] : {std::pair{"inner", ShellChoice::inner}, std::pair{"outer", ShellChoice::outer}}) {
        SurfaceOptions options;
        options.shell = choice;
        const std::size_t triangles = atlas_->extract(tau, options).triangles.size();
        const Response part = ask("/api/surface", {{"tau", std::to_string(tau)}, {"shell", shell}});
        EXPECT_EQ(part.headers.at("X-Triangles"), std::to_string(triangles)) << shell;
        parts += triangles;
    }
    EXPECT_EQ(parts, atlas_->extract(tau).triangles.size());
}

TEST_F(ServiceTest, BranchesAreThoseOfTheHierarchy) {
    const BranchHierarchy hierarchy = atlas_->hierarchy();
    const auto json = nlohmann::json::parse(ask("/api/branches").bytes);
    ASSERT_EQ(json["all"], hierarchy.branches().size());
    ASSERT_EQ(json["rank"].size(), std::min<std::size_t>(hierarchy.branches().size(), 1000));
    std::size_t significant = 0;
    for (std::size_t i = 0; i < json["rank"].size(); ++i) {
        const BranchInfo& branch = hierarchy.branches()[i];
        EXPECT_EQ(json["rank"][i], i);
        EXPECT_EQ(json["id"][i], branch.id);
        EXPECT_EQ(json["persistence"][i], branch.persistence);
        EXPECT_EQ(json["voxels"][i], branch.voxels);
        EXPECT_EQ(json["parent"][i], branch.parent.number());
        significant += json["significant"][i].get<bool>();
        const double tau = json["tau"][i];
        EXPECT_GT(tau, branch.merges);
        EXPECT_LE(tau, branch.appears);
        const ActiveObjects there = atlas_->active(tau, false);
        const Surface surface = atlas_->extract(tau, {.objects = {json["voxel"][i].get<std::int64_t>()}, .contours = {}});
        const auto object = std::ranges::find(there.objects, surface.object[0], &ActiveObject::id);
        ASSERT_NE(object, there.objects.end());
        EXPECT_EQ(json["tunnels"][i], object->b1);
        EXPECT_EQ(json["cavities"][i], object->b2);
    }
    EXPECT_EQ(significant, hierarchy.significant().size());
}

TEST_F(ServiceTest, BranchesAreChosenAsOnTheCommandLine) {
    const BranchHierarchy hierarchy = atlas_->hierarchy();
    for (const double height : {0.0, 0.1, 0.5, 2.0}) {
        const auto json =
            nlohmann::json::parse(ask("/api/branches", {{"persistence", std::to_string(height)}, {"min-voxels", "5"}, {"top", "3"}}).bytes);
        const auto kept = hierarchy.kept({.min_voxels = 5, .min_persistence = height});
        EXPECT_EQ(json["kept"], kept.size());
        ASSERT_EQ(json["rank"].size(), std::min<std::size_t>(kept.size(), 3));
        for (std::size_t i = 0; i < json["rank"].size(); ++i) EXPECT_EQ(json["rank"][i], kept[i].number());
    }
}

TEST_F(ServiceTest, CardsAreDrawnOnce) {
    for (const char* of : {"entry", "branch"}) {
        const Response first = ask("/api/card", {{of, "0"}, {"frames", "2"}});
        ASSERT_EQ(first.status, 200) << first.bytes;
        const auto json = nlohmann::json::parse(first.bytes);
        EXPECT_EQ(json["of"], std::string(of) + " 0");
        EXPECT_EQ(json["picture"]["frames"], 2);
        EXPECT_TRUE(json["picture"]["image"].get<std::string>().starts_with("data:image/webp;base64,"));
        const AtlasReads before = atlas_->reads();
        EXPECT_EQ(ask("/api/card", {{of, "0"}, {"frames", "2"}}).bytes, first.bytes);
        EXPECT_EQ(atlas_->reads().extents, before.extents);
    }
}

TEST_F(ServiceTest, SimplifiedFilesTellHowFarTheyAre) {
    const std::multimap<std::string, std::string> words{{"tau", "0.5"}, {"format", "ply"}, {"simplify", "0.25"}};
    const Response answer = ask("/api/surface", words);
    ASSERT_EQ(answer.status, 200) << answer.bytes;
    const SimplifiedSurface own =
        simplify_surface(atlas_->extract(0.5), atlas_->info().geometry, atlas_->info().extent, {.max_distance = 0.25});
    EXPECT_EQ(answer.headers.at("X-Triangles"), std::to_string(own.surface.triangles.size()));
    EXPECT_NEAR(std::stod(answer.headers.at("X-Distance")), own.distance, 1e-6);
    EXPECT_EQ(ask("/api/surface", {{"tau", "0.5"}, {"format", "ply"}}).headers.contains("X-Distance"), false);
}

TEST_F(ServiceTest, RefusalsSayWhy) {
    struct Case {
        std::string path;
        std::multimap<std::string, std::string> words;
        int status;
    };
    const std::vector<Case> cases{{"/api/surface", {}, 400},
                                  {"/api/surface", {{"tau", "nan"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "v" + std::to_string(atlas_->info().extent.voxels())}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "v0"}}, 404},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "0"}}, 404},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "99999"}}, 404},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "c1"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "1@0.5"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"contour", "1"}}, 400},
                                  {"/api/surfaces", {}, 400},
                                  {"/api/surfaces", {{"object", "v3"}}, 400},
                                  {"/api/surfaces", {{"object", "1"}, {"format", "seg.nrrd"}}, 400},
                                  {"/api/segmentation", {{"object", "1"}, {"format", "glb"}}, 400},
                                  {"/api/segmentation", {{"object", "v0@0.5"}}, 404},
                                  {"/api/names", {{"x", "1"}}, 400},
                                  {"/api/name", {{"object", "1"}, {"name", "skull"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"max", "0"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"simplify", "0.5"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"format", "stl"}, {"simplify", "0"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"format", "stl"}, {"simplify", "-1"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"shell", "all"}}, 400},
                                  {"/api/preview", {{"tau", "0.5"}, {"x", "1"}}, 400},
                                  {"/api/preview", {{"tau", "0.5"}, {"object", "-1"}}, 400},
                                  {"/api/preview", {{"tau", "0.5"}, {"object", "v99999999999"}}, 400},
                                  {"/api/objects", {{"tau", "0.5"}, {"top", "1e9"}}, 400},
                                  {"/api/measures", {{"tau", "0.5"}}, 400},
                                  {"/api/measures", {{"tau", "0.5"}, {"object", "v0"}}, 404},
                                  {"/api/label", {{"tau", "0.5"}, {"format", "stl"}}, 400},
                                  {"/api/label", {{"tau", "0.5"}, {"object", "v0"}}, 404},
                                  {"/api/events", {{"tau", "0.5"}}, 400},
                                  {"/api/branches", {{"top", "20001"}}, 400},
                                  {"/api/branches", {{"persistence", "-1"}}, 400},
                                  {"/api/branches", {{"min-voxels", "nan"}}, 400},
                                  {"/api/card", {}, 400},
                                  {"/api/card", {{"entry", "0"}, {"branch", "0"}}, 400},
                                  {"/api/card", {{"entry", "9999"}}, 404},
                                  {"/api/card", {{"branch", "1000000000"}}, 404},
                                  {"/api/card", {{"entry", "0"}, {"frames", "17"}}, 400},
                                  {"/api/card", {{"entry", "-1"}}, 400},
                                  {"/api/slice", {{"axis", "0"}}, 400},
                                  {"/api/slice", {{"axis", "0"}, {"index", "54"}}, 400},
                                  {"/api/slice", {{"axis", "0"}, {"index", "0"}, {"max", "99999999999"}}, 400},
                                  {"/api/volume", {{"max", "-1"}}, 400},
                                  {"/api/at", {{"voxel", "0,0"}}, 400},
                                  {"/api/at", {{"voxel", "0,0,12"}}, 400},
                                  {"/api/at", {{"voxel", "0,0,0"}, {"object", "3@nan"}}, 400},
                                  {"/api/transfer", {{"x", "1"}}, 400},
                                  {"/api", {}, 404},
                                  {"", {}, 404}};
    for (const Case& c : cases) {
        const Response answer = ask(c.path, c.words);
        EXPECT_EQ(answer.status, c.status) << c.path << " " << answer.bytes;
        const auto json = nlohmann::json::parse(answer.bytes);
        EXPECT_FALSE(json["error"]["message"].get<std::string>().empty());
    }
}

TEST_F(ServiceTest, SlicesAreSamples) {
    const Response answer = ask("/api/slice", {{"axis", "1"}, {"index", "5"}});
    ASSERT_EQ(answer.status, 200) << answer.bytes;
    const Volume volume = atlas_->volume();
    const auto [nx, ny, nz] = volume.info.extent.size;
    const std::size_t width = size_of(volume.info.type);
    ASSERT_EQ(answer.bytes.size(), 40 + nx * nz * width);
    for (std::int64_t z = 0; z < nz; ++z) {
        for (std::int64_t x = 0; x < nx; ++x) {
            const auto* sample = reinterpret_cast<const char*>(volume.bytes.data()) + width * volume.info.extent.index(x, 5, z);
            ASSERT_EQ(answer.bytes.compare(40 + width * (x + nx * z), width, sample, width), 0);
        }
    }
    EXPECT_EQ(ask("/api/slice", {{"axis", "1"}, {"index", "5"}, {"max", std::to_string(nx * nz)}}).bytes, answer.bytes);
    EXPECT_EQ(ask("/api/slice", {{"axis", "1"}, {"index", "5"}, {"max", std::to_string(nx * nz - 1)}}).bytes.size(),
              40 + (nx + 1) / 2 * ((nz + 1) / 2) * width);
}

TEST_F(ServiceTest, VolumesAreMeansInABytePerValue) {
    const Response answer = ask("/api/volume", {{"max", "2500"}});
    const CoarseVolume coarse = atlas_->coarse(2500);
    ASSERT_EQ(answer.bytes.size(), 40 + coarse.mean.size());
    const auto [low, high] = atlas_->range();
    for (std::size_t i = 0; i < coarse.mean.size(); ++i) {
        const double value = low + static_cast<unsigned char>(answer.bytes[40 + i]) / 255.0 * (high - low);
        ASSERT_NEAR(value, static_cast<double>(coarse.mean[i]), (high - low) / 509);
    }
}

TEST_F(ServiceTest, WhatHoldsAVoxelIsWhatACutSays) {
    const auto entries = nlohmann::json::parse(ask("/api/atlas").bytes)["entries"];
    const ObjectEntry object = atlas_->objects().entries[0];
    const Index3 at = atlas_->info().extent.voxel(object.id);
    const std::string voxel = std::to_string(at[0]) + "," + std::to_string(at[1]) + "," + std::to_string(at[2]);
    const std::string id = "v" + std::to_string(object.id), tau = nlohmann::json(object.best_tau).dump();
    const auto found = nlohmann::json::parse(
        ask("/api/at", {{"voxel", voxel}, {"object", id + "@" + tau + "," + id + "@1e9"}, {"contour", id + "@" + tau}}).bytes);
    EXPECT_EQ(found["objects"], nlohmann::json({true, false}));
    EXPECT_EQ(found["contours"], nlohmann::json::array({false}));
    EXPECT_NE(std::find(found["entries"].begin(), found["entries"].end(), 0), found["entries"].end());
    EXPECT_EQ(nlohmann::json::parse(ask("/api/at", {{"voxel", "0,0,0"}, {"object", id + "@" + tau}}).bytes)["objects"][0], false);
}

TEST_F(ServiceTest, RandomRequestsAreAnswered) {
    std::mt19937 random(7);
    const std::vector<std::string> paths{"/",
                                         "/api/atlas",
                                         "/api/preview",
                                         "/api/objects",
                                         "/api/surface",
                                         "/api/measures",
                                         "/api/label",
                                         "/api/events",
                                         "/api/branches",
                                         "/api/card",
                                         "/api/slice",
                                         "/api/volume",
                                         "/api/at",
                                         "/api/transfer",
                                         "/api/surfaces",
                                         "/api/segmentation",
                                         "/api/names",
                                         "/api/name",
                                         "/api/../api/atlas",
                                         "//"};
    const std::vector<std::string> names{"tau",  "object",      "max", "top", "entry", "branch", "keep",
                                         "axis", "persistence", "",    "TAU", "index", "voxel",  "contour"};
    const std::vector<std::string> values{"0.5",   "-1e308",  "1e308", "nan",        "",           "0", "1", "99999999999999999999",
                                          "1,2,3", "\xff\0x", "0.5;",  "7@0.5,9@-1", "v7@0.5,c1,2"};
    for (int i = 0; i < 2000; ++i) {
        std::multimap<std::string, std::string> words;
        for (unsigned k = random() % 4; k > 0; --k) words.emplace(names[random() % names.size()], values[random() % values.size()]);
        const Response answer = ask(paths[random() % paths.size()], words);
        EXPECT_TRUE(answer.status == 200 || answer.status == 400 || answer.status == 404 || answer.status == 500) << answer.status;
        EXPECT_EQ(answer.bytes.find("a bug"), std::string::npos) << answer.bytes;
    }
}

TEST_F(ServiceTest, LabelsAreThoseOfTheCommandLine) {
    const Cut cut = atlas_->cut(0.5, {.label = true});
    ASSERT_GE(cut.objects.size(), 1U);
    const std::string file = path_ + ".nrrd";
    write_labels(file, atlas_->info(), object_labels(cut), {.interpolant = cut.interpolant, .tau = cut.tau});
    const Response all = ask("/api/label", {{"tau", "0.5"}, {"format", "nrrd"}});
    ASSERT_EQ(all.status, 200) << all.bytes;
    std::ifstream stream(file, std::ios::binary);
    EXPECT_EQ(all.bytes, std::string(std::istreambuf_iterator<char>(stream), {}));
    std::filesystem::remove(file);
    for (const char* format : {"nii", "nii.gz", "tif"})
        EXPECT_EQ(ask("/api/label", {{"tau", "0.5"}, {"format", format}, {"object", "v" + std::to_string(cut.objects[0].id)}}).status, 200)
            << format;
}

TEST_F(ServiceTest, MeasuresAreThoseOfTheSurface) {
    const Cut cut = atlas_->cut(0.5);
    const std::int64_t id = cut.objects[0].id;
    const auto json = nlohmann::json::parse(ask("/api/measures", {{"tau", "0.5"}, {"object", "v" + std::to_string(id)}}).bytes);
    ASSERT_EQ(json["objects"].size(), 1U);
    const auto& object = json["objects"][0];
    EXPECT_EQ(object["id"], id);
    EXPECT_EQ(object["tunnels"], cut.objects[0].b1);
    EXPECT_EQ(object["cavities"], cut.objects[0].b2);
    SurfaceOptions options;
    options.objects = {id};
    const Surface surface = atlas_->extract(0.5, options);
    EXPECT_EQ(object["triangles"], surface.triangles.size());
    for (const auto& point : surface.points) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_GE(point[axis], object["box"][0][axis].get<double>());
            EXPECT_LE(point[axis], object["box"][1][axis].get<double>());
        }
    }
    EXPECT_NEAR(object["volume"].get<double>(), cut.objects[0].measure, 0.2 * cut.objects[0].measure);
    EXPECT_GT(object["area"].get<double>(), 0);
    EXPECT_EQ(object["voxels"][0], cut.objects[0].voxels);
    EXPECT_GE(object["values"]["min"].get<double>(), 0.5);
    EXPECT_GE(object["feret"]["max"].get<double>(), object["feret"]["min"].get<double>());
    EXPECT_LE(object["sphericity"].get<double>(), 1);
}

TEST_F(ServiceTest, WithoutAStoreItSaysHowFarItIs) {
    Service service("secret", {});
    const auto status = [&](const char* path) { return service.answer({path, {{"tau", "0.5"}}, "secret", ""}).status; };
    for (const char* path : {"/api/preview", "/api/objects", "/api/surface", "/api/label", "/api/measures"})
        EXPECT_EQ(status(path), 503) << path;
    service.store_state().fail(Error(ErrorKind::input, {.what = "no such volume", .next = "find it"}));
    EXPECT_EQ(status("/api/preview"), 500);
    service.store_state().open(*atlas_);
    EXPECT_EQ(status("/api/preview"), 200);
}

TEST_F(ServiceTest, AnExtractionEndsWhenWhoAskedHasLeft) {
    int asked = 0;
    is_disconnected_ = [&asked] { return ++asked > 1; };  // there while it waits, gone at the first slab
    EXPECT_EQ(ask("/api/surface", {{"tau", "0.5"}}).status, 409);
    EXPECT_LE(asked, 3);
    is_disconnected_ = {};
    EXPECT_EQ(ask("/api/surface", {{"tau", "0.5"}}).status, 200);
}

TEST_F(ServiceTest, AnyAnswerIsGivenUpWhenWhoAskedHasLeft) {
    const std::string id = "v" + std::to_string(atlas_->objects().entries[0].id);
    const std::vector<std::pair<std::string, std::multimap<std::string, std::string>>> requests{
        {"/api/atlas", {}},
        {"/api/preview", {{"tau", "0.5"}}},
        {"/api/objects", {{"tau", "0.5"}}},
        {"/api/branches", {}},
        {"/api/card", {{"entry", "0"}}},
        {"/api/card", {{"branch", "0"}, {"frames", "1"}}},
        {"/api/surface", {{"tau", "0.5"}}},
        {"/api/surface", {{"tau", "0.5"}, {"object", id}}},
        {"/api/surface", {{"tau", "0.5"}, {"format", "stl"}}},
        {"/api/label", {{"tau", "0.5"}}},
        {"/api/measures", {{"tau", "0.5"}, {"object", id}}},
        {"/api/slice", {{"axis", "0"}, {"index", "1"}}},
        {"/api/volume", {}},
        {"/api/at", {{"voxel", "1,2,3"}}},
        {"/api/transfer", {}},
    };
    for (const auto& [path, words] : requests) {
        service_.emplace("secret", Context{});  // nothing is found yet
        service_->store_state().open(*atlas_);
        atlas_->clear_cache();
        int looks = 0;
        is_disconnected_ = [&looks] { return ++looks > 1; };  // there when it is asked, gone soon after
        EXPECT_EQ(ask(path, words).status, 409) << path;
        EXPECT_LE(looks, 4) << path;
        is_disconnected_ = {};
        EXPECT_EQ(ask(path, words).status, 200) << path;
    }
}

TEST_F(ServiceTest, MoreThanMayBeHeldIsRefusedWithWhatToDo) {
    Service small("secret", {}, {.memory = 1000});
    small.store_state().open(*atlas_);
    const std::pair<const char*, const char*> refused[] = {{"/api/surface", "too_many_triangles"}, {"/api/label", "labels_too_large"}};
    for (const auto& [path, reason] : refused) {
        const Response answer = small.answer({path, {{"tau", "0.5"}}, "secret", ""});
        EXPECT_EQ(answer.status, 503);
        EXPECT_EQ(nlohmann::json::parse(answer.bytes)["error"]["reason"], reason);
    }
}

TEST_F(ServiceTest, AfterTheEndNothingIsMade) {
    service_->end();
    EXPECT_EQ(ask("/api/surface", {{"tau", "0.5"}}).status, 409);
    EXPECT_EQ(ask("/api/card", {{"branch", "0"}}).status, 409);
    EXPECT_EQ(ask("/api/slice", {{"axis", "0"}, {"index", "0"}}).status, 409);
    EXPECT_EQ(ask("/api/atlas").status, 409);
    EXPECT_EQ(ask("/api/at", {{"voxel", "0,0,0"}}).status, 409);
}

}  // namespace
}  // namespace isoatlas
