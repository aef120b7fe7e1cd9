// EvolutionFile: what it takes and refuses, and that under its name is nothing but a whole file. What is in it:
// tests/python/test_vtkhdf.py.
#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <optional>

#include "faults/faulty_files.h"
#include "isoatlas/evolution_file.h"
#include "isoatlas/phantom.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

void write(const std::string& path, const std::vector<double>& taus) {
    const Volume volume = make_phantom("demo", {.size = 32});
    EvolutionFile file(path);
    for (const double tau : taus) file.add(extract(volume, tau));
    EXPECT_EQ(file.steps(), static_cast<std::int64_t>(taus.size()));
    file.commit();
}

std::optional<ErrorText> refusal(ErrorKind kind, const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.text();
    }
    return std::nullopt;
}

TEST(EvolutionFile, the_same_bytes_every_time) {
    const Folder folder;
    write(folder / "a.vtkhdf", {90, 120, 200});
    write(folder / "b.VTKHDF", {90, 120, 200});
    EXPECT_EQ(read_bytes(folder / "a.vtkhdf").substr(0, 8), "\x89HDF\r\n\x1a\n");
    EXPECT_TRUE(read_bytes(folder / "a.vtkhdf") == read_bytes(folder / "b.VTKHDF"));
}

TEST(EvolutionFile, without_commit_there_is_no_file) {
    const Folder folder;
    {
        EvolutionFile file(folder / "x.vtkhdf");
        file.add(mesh_samples::two_objects());
    }
    EXPECT_EQ(folder.files(), 0U);
}

TEST(EvolutionFile, a_full_disk_leaves_what_was_there) {
    const Folder folder;
    const std::string path = folder / "x.vtkhdf";
    write(path, {90, 120});
    const std::string before = read_bytes(path);
    for (std::size_t full = 0; full < before.size(); full += before.size() / 40 + 1) {
        const test::FullDisk fault(static_cast<std::int64_t>(full), ENOSPC);
        const auto text = refusal(ErrorKind::resource, [&] { write(path, {90, 120}); });
        ASSERT_TRUE(text) << full;
        EXPECT_EQ(text->file, path);
        EXPECT_EQ(text->reason, Reason::disk_full);
        EXPECT_FALSE(text->next.empty());
        EXPECT_TRUE(read_bytes(path) == before);
        EXPECT_EQ(folder.files(), 1U);
    }
}

TEST(EvolutionFile, refuses_what_readers_would_take_for_something_else) {
    const Folder folder;
    const Surface first = mesh_samples::two_objects();
    const auto second = [&](const std::function<void(Surface&)>& change) {
        const auto text = refusal(ErrorKind::usage, [&] {
            EvolutionFile file(folder / "x.vtkhdf");
            file.add(first);
            Surface next = first;
            next.reported_tau += 1;
            change(next);
            file.add(next);
            file.commit();
        });
        return text.has_value();
    };
    EXPECT_FALSE(second([](Surface&) {}));
    std::filesystem::remove(folder / "x.vtkhdf");
    EXPECT_TRUE(second([](Surface& next) { next.reported_tau -= 1; })) << "the same isovalue";
    EXPECT_TRUE(second([](Surface& next) { next.reported_tau -= 2; })) << "a lower one";
    EXPECT_TRUE(second([](Surface& next) { next.normals.clear(); }));
    EXPECT_TRUE(second([](Surface& next) { next.object.clear(); }));
    EXPECT_TRUE(second([](Surface& next) { next.unit = "um"; }));
    EXPECT_TRUE(second([](Surface& next) { next.space = "unknown"; }));
    EXPECT_TRUE(second([](Surface& next) { next.interpolant = Interpolant::faces; }));
    EXPECT_TRUE(second([](Surface& next) { next.polarity = Polarity::low; }));
    EXPECT_TRUE(second([](Surface& next) { next = mesh_samples::curve(), next.reported_tau = 1e3; }));
    EXPECT_TRUE(refusal(ErrorKind::usage, [&] { EvolutionFile(folder / "x.vtkhdf").add(Surface{}); }));
    EXPECT_TRUE(refusal(ErrorKind::usage, [&] { EvolutionFile(folder / "x.vtkhdf").commit(); }));
    EXPECT_TRUE(refusal(ErrorKind::usage, [&] { EvolutionFile(folder / "x.vtp"); }));
    EXPECT_EQ(folder.files(), 0U);
}

TEST(Vtkhdf, is_not_read) {
    const Folder folder;
    (void)write_surface(folder / "x.vtkhdf", mesh_samples::two_objects());
    const auto text = refusal(ErrorKind::unsupported, [&] { (void)read_mesh(folder / "x.vtkhdf"); });
    ASSERT_TRUE(text);
    EXPECT_NE(text->next.find(".vtp"), std::string::npos);
}

}  // namespace
