// Disks that are full or closed: Error{resource}, and nothing half-written under the name.
#include <gtest/gtest.h>

#include <cerrno>

#include "faults/faulty_files.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

class Faults : public testing::TestWithParam<const char*> {
protected:
    void expect_resource_error(const std::string& path) {
        try {
            write_surface(path, two_objects());
            FAIL() << "written";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::resource);
            EXPECT_EQ(error.text().file, path);
            EXPECT_FALSE(error.text().next.empty());
        }
    }
    Folder folder_;
};

TEST_P(Faults, full_disk_leaves_what_was_there) {
    const std::string path = folder_ / (std::string("mesh") + GetParam());
    write_surface(path, two_objects());
    const std::string before = read_bytes(path);
    for (std::size_t after = 0; after < before.size(); after += 97) {
        const test::FullDisk fault(static_cast<std::int64_t>(after), ENOSPC);
        expect_resource_error(path);
        EXPECT_EQ(read_bytes(path), before);
        EXPECT_EQ(folder_.files(), 1U) << "a partial file stays behind";
    }
    std::filesystem::remove(path);
    const test::FullDisk fault(100, EIO);
    expect_resource_error(path);
    EXPECT_EQ(folder_.files(), 0U);
}

TEST_P(Faults, unwritable_paths) {
    expect_resource_error(folder_ / (std::string("no/such/folder") + GetParam()));
    std::filesystem::create_directory(folder_ / (std::string("folder") + GetParam()));
    expect_resource_error(folder_ / (std::string("folder") + GetParam()));
}

class ReadFaults : public Faults {};

TEST_P(ReadFaults, unreadable_paths) {
    for (const std::string& name : {std::string("missing"), std::string("folder")}) {
        const std::string path = folder_ / (name + GetParam());
        if (name == "folder") std::filesystem::create_directory(path);
        try {
            (void)read_mesh(path);
            FAIL() << "read";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_EQ(error.text().file, path);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, Faults, testing::Values(".ply", ".stl", ".obj", ".vtp", ".glb", ".vtkhdf"),
                         [](const auto& format) { return std::string(format.param).substr(1); });
INSTANTIATE_TEST_SUITE_P(Formats, ReadFaults, testing::Values(".ply", ".stl", ".obj", ".vtp", ".glb"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

}  // namespace
