// Everything that changes a byte of a store changes its fingerprint, and the store says what it was.
#include "atlas/build_fingerprint.h"

#include <gtest/gtest.h>

#include <functional>

#include "faults/memory_files.h"
#include "isoatlas/atlas.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

struct Asked {
    VolumeInfo file;
    BuildOptions options;
    double tunnel_height = 0;
    std::uint64_t samples = 1, analysed = 1;

    [[nodiscard]] Fingerprint fingerprint() const {
        Fingerprint made = header_fingerprint(file, options, tunnel_height);
        add_samples(made, samples, analysed);
        return made;
    }
};

TEST(BuildFingerprint, EveryFactAndEveryOptionIsInIt) {
    const std::vector<std::pair<const char*, std::function<void(Asked&)>>> changes = {
        {"size", [](Asked& a) { a.file.extent.size[1] = 2; }},
        {"size", [](Asked& a) { a.file.extent.rank = 2; }},
        {"type", [](Asked& a) { a.file.type = ValueType::i8; }},
        {"spacing", [](Asked& a) { a.file.geometry.spacing[2] = 1.0000000000000002; }},
        {"origin", [](Asked& a) { a.file.geometry.origin[0] = 1; }},
        {"direction", [](Asked& a) { a.file.geometry.direction[0][1] = 0.5; }},
        {"steps", [](Asked& a) { a.file.geometry.coordinates[1] = {0, 1}; }},
        {"space", [](Asked& a) { a.file.geometry.space = "LPS"; }},
        {"unit of length", [](Asked& a) { a.file.geometry.unit = "mm"; }},
        {"calibration", [](Asked& a) { a.file.calibration.slope = 2; }},
        {"calibration", [](Asked& a) { a.file.calibration.intercept = 2; }},
        {"unit of values", [](Asked& a) { a.file.value_unit = "HU"; }},
        {"description", [](Asked& a) { a.file.description = "a head"; }},
        {"time step", [](Asked& a) { a.options.time_step = 0; }},
        {"spacing", [](Asked& a) { a.options.geometry.emplace().spacing = {2, 2, 2}; }},
        {"missing samples", [](Asked& a) { a.options.missing.action = MissingPolicy::Action::below; }},
        {"missing samples", [](Asked& a) { a.options.missing = {MissingPolicy::Action::replace, 0, {}}; }},
        {"no-data value", [](Asked& a) { a.options.missing.no_data = 3; }},
        {"Gaussian", [](Asked& a) { a.options.gaussian = 1; }},
        {"interpolant", [](Asked& a) { a.options.analysis.interpolant = Interpolant::faces; }},
        {"tunnel height", [](Asked& a) { a.tunnel_height = 1; }},
        {kSamplesMember, [](Asked& a) { a.samples = 2; }},
        {kAnalysedMember, [](Asked& a) { a.analysed = 2; }},
    };
    const Fingerprint plain = Asked().fingerprint();
    std::vector<Fingerprint> all{plain};
    for (const auto& [name, change] : changes) {
        Asked other;
        change(other);
        const std::vector<std::string> found = differences(plain, other.fingerprint());
        ASSERT_EQ(found.size(), 1U) << name;
        EXPECT_TRUE(found[0].starts_with(name)) << found[0];
        for (const Fingerprint& one : all) EXPECT_NE(one.hash(), other.fingerprint().hash()) << name;
        all.push_back(other.fingerprint());
    }
}

TEST(BuildFingerprint, MemoryThreadsAndRestartAreNot) {
    Asked other;
    other.options.memory = 1, other.options.restart = true, other.options.is_replaceable = true;
    EXPECT_EQ(Asked().fingerprint(), other.fingerprint());
}

/// A volume in memory, read as a file is.
class MemoryReader final : public VolumeReader {
public:
    explicit MemoryReader(Volume volume) : volume_(std::move(volume)) { info_ = volume_.info; }
    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        const auto slice = static_cast<std::int64_t>(size_of(info_.type)) * info_.extent.slice();
        std::copy(volume_.bytes.begin() + slice * z_begin, volume_.bytes.begin() + slice * z_end, out.begin());
    }

private:
    Volume volume_;
};

TEST(StoreDifferences, AStoreKnowsItsVolumeAndItsOptions) {
    test::MemoryFiles disk;
    const ReplacedFileSystem in_use(disk);
    const Volume volume = make_phantom("noise", {.size = 9, .quantise = 50});
    for (const double gaussian : {0.0, 0.7}) {
        BuildOptions options{.tunnel_height_percent = 3, .gaussian = gaussian};
        options.missing = {MissingPolicy::Action::replace, 1, 7.0};
        MemoryReader reader(volume);
        build_atlas("a.atlas", reader, options);
        const Atlas atlas("a.atlas");
        EXPECT_EQ(atlas.version(), kStoreVersion);
        EXPECT_FALSE(atlas.is_replaceable());
        EXPECT_EQ(joined_differences(store_differences(atlas, reader, options)), "");
        BuildOptions other = options;
        other.gaussian = 0.8, other.missing.no_data = 8;
        EXPECT_EQ(store_differences(atlas, reader, other).size(), 2U);
        other = options;
        other.tunnel_height_percent = 4;
        EXPECT_EQ(store_differences(atlas, reader, other).size(), 1U);
        Volume another = volume;
        another.bytes[500] ^= std::byte{1};
        MemoryReader samples(another);
        EXPECT_EQ(joined_differences(store_differences(atlas, samples, options)), "other samples there");
        EXPECT_TRUE(store_differences(atlas, samples, options, false).empty());
    }
}

TEST(StoreDifferences, TheMarkOfAReplaceableStoreIsKept) {
    test::MemoryFiles disk;
    const ReplacedFileSystem in_use(disk);
    MemoryReader reader(make_phantom("noise", {.size = 5}));
    BuildOptions options;
    options.is_replaceable = true;
    build_atlas("a.atlas", reader, options);
    EXPECT_TRUE(Atlas("a.atlas").is_replaceable());
}

}  // namespace
}  // namespace isoatlas
