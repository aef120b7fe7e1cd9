// Names are read as they were written; a damaged file is reported, and never replaced unread.
#include "isoatlas/object_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

class ObjectNames : public testing::Test {
protected:
    void SetUp() override { std::filesystem::remove(path_); }
    void TearDown() override { std::filesystem::remove(path_); }
    void put(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
    [[nodiscard]] ErrorKind refused() const {
        try {
            (void)read_object_names(path_, extent_);
        } catch (const Error& error) {
            EXPECT_EQ(error.text().file, path_);
            EXPECT_FALSE(error.text().next.empty());
            return error.kind();
        }
        return ErrorKind::internal;
    }

    const std::string path_ = testing::TempDir() + "isoatlas-names-" + std::to_string(::getpid()) + ".json";
    const Extent extent_{3, {10, 20, 30}};
    const std::vector<ObjectName> names_{
        {"skull", 12, 14.6484375, false}, {"left \"lung\"", 12, 0.1, true}, {"größte", 5999, -1e-300, false}};
};

TEST_F(ObjectNames, AreReadAsWritten) {
    EXPECT_TRUE(read_object_names(path_, extent_).empty());
    write_object_names(path_, extent_, names_);
    EXPECT_EQ(read_object_names(path_, extent_), names_);
    EXPECT_EQ(find_object_name(names_, "skull"), names_.data());
    EXPECT_EQ(find_object_name(names_, true, 12, 0.1), &names_[1]);
    EXPECT_EQ(find_object_name(names_, false, 12, 0.1), nullptr);
    write_object_names(path_, extent_, {});
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(ObjectNames, LieBesideTheStoreForEachPolarity) {
    EXPECT_EQ(object_names_path("a/scan.atlas"), "a/scan.atlas.names.json");
    EXPECT_EQ(object_names_path("a/scan.atlas", Polarity::low), "a/scan.low.atlas.names.json");
    EXPECT_EQ(object_names_path("a/scan.low.atlas", Polarity::low), "a/scan.low.atlas.names.json");
    EXPECT_EQ(object_names_path("scan", Polarity::low), "scan.low.names.json");
}

TEST_F(ObjectNames, OfAnotherVolumeOrDamagedAreReported) {
    write_object_names(path_, extent_, names_);
    std::string text;
    std::getline(std::ifstream(path_), text, '\0');
    EXPECT_THROW((void)read_object_names(path_, Extent{3, {10, 20, 31}}), Error);
    for (std::size_t size = 0; size + 3 < text.size(); ++size) {
        put(text.substr(0, size));
        EXPECT_EQ(refused(), ErrorKind::input) << size;
    }
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"12", "6000"},
                                                                                   {"12", "-1"},
                                                                                   {"12", "1.5"},
                                                                                   {"14.6484375", "\"x\""},
                                                                                   {"14.6484375", "1e999"},
                                                                                   {"cavity", "both"},
                                                                                   {"skull", "v7"},
                                                                                   {"skull", "größte"},
                                                                                   {"names/1", "names/2"}}) {
        std::string damaged = text;
        damaged.replace(damaged.find(from), from.size(), to);
        put(damaged);
        EXPECT_EQ(refused(), ErrorKind::input) << to;
    }
    put(std::string(100000, '['));
    EXPECT_EQ(refused(), ErrorKind::input);
    put("{\"schema\": \"isoatlas/names/1\", \"size\": [10, 20, 30], \"names\": 7}");
    EXPECT_EQ(refused(), ErrorKind::input);
}

TEST_F(ObjectNames, AreGivenOnce) {
    std::vector<ObjectName> names = names_;
    set_object_name(names, {"skull", 12, 14.6484375, false});
    EXPECT_EQ(names.size(), 3U);
    try {
        set_object_name(names, {"skull", 13, 14.6484375, false});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("v12"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("v13"), std::string::npos);
    }
    set_object_name(names, {"bone", 12, 14.6484375, false});
    EXPECT_EQ(names.size(), 3U);
    EXPECT_EQ(find_object_name(names, "skull"), nullptr);
}

TEST_F(ObjectNames, AreNoReferences) {
    for (const char* bad : {"", "2", "c3", "v218663", "a@b", "a,b", "a/b", "-x", " x", "x ", "a\nb", "a\x7f", "\xff"})
        EXPECT_THROW(check_object_name(bad), Error) << bad;
    EXPECT_THROW(check_object_name(std::string(101, 'x')), Error);
    for (const char* good : {"skull", "left lung", "c", "v", "c3a", "v-2", "3rd", "großer", "2.5"})
        EXPECT_NO_THROW(check_object_name(good)) << good;
}

}  // namespace
}  // namespace isoatlas
