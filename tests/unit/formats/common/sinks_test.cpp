// Every writer puts the same bytes into memory as into a file.
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "isoatlas/sink.h"
#include "isoatlas/spectrum.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

using Write = std::function<void(const std::string& path)>;
using WriteToSink = std::function<void(Sink& sink)>;

void expect_same(const Folder& folder, const std::string& name, const Write& write, const WriteToSink& write_to_sink) {
    write(folder / name);
    MemorySink sink(name);
    write_to_sink(sink);
    EXPECT_FALSE(sink.bytes().empty()) << name;
    EXPECT_TRUE(sink.bytes() == read_bytes(folder / name)) << name;
}

TEST(Sinks, Surfaces) {
    const Folder folder;
    const Surface surface = mesh_samples::two_objects();
    for (const char* name : {"s.ply", "s.stl", "s.obj", "s.vtp", "s.glb", "s.vtkhdf"}) {
        std::vector<std::string> warnings;
        expect_same(
            folder, name, [&](const std::string& path) { warnings = write_surface(path, surface); },
            [&](Sink& sink) { EXPECT_EQ(write_surface(sink, surface), warnings); });
    }
}

TEST(Sinks, VolumesAndLabels) {
    const Folder folder;
    const Volume volume = make_phantom("noise", {.size = 40});
    for (const char* name : {"v.nrrd", "v.npy", "v.raw", "v.mha", "v.vti", "v.nii", "v.nii.gz", "v.tif", "V.TIFF"}) {
        expect_same(
            folder, name, [&](const std::string& path) { write_volume(path, volume); }, [&](Sink& sink) { write_volume(sink, volume); });
    }
    std::vector<std::uint32_t> labels(static_cast<std::size_t>(volume.info.extent.voxels()));
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<std::uint32_t>(i % 300);
    const LabelOrigin origin{.interpolant = Interpolant::trilinear, .tau = 0.5};
    for (const char* name : {"l.nrrd", "l.nii", "l.nii.gz", "l.tif"}) {
        expect_same(
            folder, name, [&](const std::string& path) { write_labels(path, volume.info, labels, origin); },
            [&](Sink& sink) { write_labels(sink, volume.info, labels, origin); });
    }
}

TEST(Sinks, TreesAndSpectra) {
    const Folder folder;
    const Volume volume = make_phantom("figure-plateau");
    const Analysis analysis = analyse(volume);
    for (const char* name : {"t.json", "t.csv", "t.graphml", "t.vtu"}) {
        expect_same(
            folder, name, [&](const std::string& path) { write_tree(path, volume, analysis); },
            [&](Sink& sink) { write_tree(sink, volume, analysis); });
    }
    Spectrum spectrum;
    spectrum.intervals.push_back({.low = 1, .high = 2, .all = {.objects = 3}});
    for (const char* name : {"p.json", "p.csv", "p.svg"}) {
        expect_same(
            folder, name, [&](const std::string& path) { write_spectrum(path, volume.info, spectrum); },
            [&](Sink& sink) { write_spectrum(sink, volume.info, spectrum); });
    }
}

TEST(Sinks, TheNameIsTheFormat) {
    MemorySink sink("s.unknown");
    try {
        (void)write_surface(sink, mesh_samples::two_objects());
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_EQ(error.text().file, "s.unknown");
    }
    EXPECT_EQ(sink.size(), 0);
}

}  // namespace
