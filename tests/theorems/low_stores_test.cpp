// A store of both polarities answers about each what the volume and the negated volume answer, to the last byte.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "isoatlas/navigator.h"
#include "isoatlas/phantom.h"
#include "isoatlas/simplify.h"
#include "isoatlas/spectrum.h"
#include "isoatlas/verify.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Atlas;
using isoatlas::Polarity;
using isoatlas::PolarityChoice;
using isoatlas::Volume;

bool same_cut(const isoatlas::Cut& p, const isoatlas::Cut& q) {
    bool same = p.label == q.label && p.active_cells == q.active_cells && p.objects.size() == q.objects.size() &&
                p.contours.size() == q.contours.size();
    for (std::size_t i = 0; same && i < p.objects.size(); ++i)
        same = p.objects[i].id == q.objects[i].id && p.objects[i].voxels == q.objects[i].voxels && p.objects[i].chi == q.objects[i].chi;
    for (std::size_t i = 0; same && i < p.contours.size(); ++i)
        same = p.contours[i].id == q.contours[i].id && p.contours[i].genus == q.contours[i].genus;
    return same;
}

bool same_table(const isoatlas::ObjectTable& p, const isoatlas::ObjectTable& q) {
    bool same = p.isovalues == q.isovalues && p.branches == q.branches && p.noise == q.noise && p.entries.size() == q.entries.size();
    for (std::size_t i = 0; same && i < p.entries.size(); ++i) {
        const isoatlas::ObjectEntry &a = p.entries[i], &b = q.entries[i];
        same = a.id == b.id && a.best_tau == b.best_tau && a.merges == b.merges && a.hypervolume == b.hypervolume && a.note == b.note &&
               a.position == b.position && (!a.border.is_known() || !b.border.is_known() || a.border == b.border);
    }
    return same;
}

/// The atlas is open for the polarity of the volume.
void expect_answers_of(const Atlas& atlas, const Volume& volume, const isoatlas::AnalysisOptions& options) {
    ASSERT_EQ(polarity_of(atlas.info()), polarity_of(volume.info));
    ASSERT_EQ(atlas.info().calibration, volume.info.calibration);
    ASSERT_EQ(atlas.volume().bytes, volume.bytes);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, options);
    EXPECT_TRUE(same_table(atlas.objects({.top = 0}), isoatlas::rank_objects(volume, analysis, {.top = 0})));
    EXPECT_EQ(atlas.cavities({.top = 0}).entries.size(), isoatlas::rank_cavities(volume, analysis, {.top = 0}).entries.size());
    EXPECT_EQ(atlas.analysis().event_count(), analysis.event_count());
    const auto [low, high] = atlas.range();
    isoatlas::Navigator navigator(atlas);
    for (const double part : {0.0, 0.3, 0.5, 0.8, 1.0}) {
        const double tau = low + part * (high - low);
        const isoatlas::CutOptions own{.interpolant = options.interpolant, .label = true};
        const isoatlas::Cut cut = isoatlas::cut(volume, tau, own);
        EXPECT_TRUE(same_cut(atlas.cut(tau, {.label = true}), cut)) << tau;
        const isoatlas::Surface surface = isoatlas::extract(volume, tau, {.interpolant = options.interpolant});
        EXPECT_TRUE(same(atlas.extract(tau), surface)) << tau;
        EXPECT_TRUE(same(navigator.go_to(tau), surface)) << tau;
        EXPECT_EQ(atlas.active(tau).objects.size(), cut.objects.size());
        EXPECT_EQ(atlas.preview(tau).objects, static_cast<Index>(cut.objects.size()));
        if (cut.objects.empty()) continue;
        isoatlas::SurfaceOptions alone;
        alone.objects = {cut.objects.back().id};
        EXPECT_TRUE(
            same(atlas.extract(tau, alone), isoatlas::extract(volume, tau, {.interpolant = options.interpolant, .surface = alone})));
    }
    if (high > low) {
        const std::vector<double> edges{low, (low + high) / 2, high};
        Index above = 0;
        for (Index v = 0; v < volume.info.extent.voxels(); ++v) above += volume.value(v) >= edges[1];
        EXPECT_EQ(atlas.histogram(edges)[1], above);
    }
}

RC_GTEST_FIXTURE_PROP(Stores, OfBothPolaritiesAnswerAboutEach, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    if (*rc::gen::inRange(0, 3) == 0) volume.info.calibration = {.slope = 0.5, .intercept = 7};
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    const PolarityChoice choice = *rc::gen::element(PolarityChoice::both, PolarityChoice::low);
    isoatlas::build_atlas(path_, volume, options, arbitrary_context(), choice);
    const isoatlas::AtlasOptions of_low{.cache_bytes = 0, .polarity = Polarity::low};
    RC_ASSERT(Atlas(path_).polarities() == choice);
    expect_answers_of(Atlas(path_, of_low), isoatlas::negated(volume), options);
    RC_ASSERT(!testing::Test::HasFailure());
    if (choice == PolarityChoice::both)
        expect_answers_of(Atlas(path_), volume, options);
    else
        RC_ASSERT(polarity_of(Atlas(path_).info()) == Polarity::low);
    RC_ASSERT(!testing::Test::HasFailure());
    if (*rc::gen::inRange(0, 6) > 0) return;
    for (const isoatlas::CheckResult& check : isoatlas::verify_atlas(Atlas(path_, of_low), {.levels = 2, .full = true})) {
        RC_LOG() << check.name << ": " << check.detail << "\n";
        RC_ASSERT(check.holds);
    }
}

TEST_F(Stores, OfBothPolaritiesHoldTheHighSideUnchanged) {
    const Volume volume = isoatlas::make_phantom("demo", {.size = 40, .noise = 0.01});
    isoatlas::build_atlas(path_, volume, {}, {}, PolarityChoice::both);
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        const Atlas atlas(path_, {.cache_bytes = 0, .polarity = polarity});
        expect_answers_of(atlas, polarity == Polarity::high ? volume : isoatlas::negated(volume), {});
        for (const isoatlas::CheckResult& check : isoatlas::verify_atlas(atlas, {.levels = 3, .full = true}))
            EXPECT_TRUE(check.holds) << check.name << ": " << check.detail;
    }
}

/// A volume in memory, read as a file is.
class MemoryReader final : public isoatlas::VolumeReader {
public:
    explicit MemoryReader(const Volume& volume) : bytes_(volume.bytes.begin(), volume.bytes.end()) { info_ = volume.info; }
    void read(Index z_begin, Index z_end, std::span<std::byte> out) override {
        const auto slice = static_cast<Index>(size_of(info_.type)) * info_.extent.slice();
        std::copy(bytes_.begin() + slice * z_begin, bytes_.begin() + slice * z_end, out.begin());
    }

private:
    std::vector<std::byte> bytes_;
};

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

RC_GTEST_FIXTURE_PROP(Stores, OfBothPolaritiesAreLentWithTheHighSideFirst, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    MemoryReader reader(volume);
    isoatlas::BuildOptions options{.polarities = PolarityChoice::both};
    isoatlas::build_atlas(path_, reader, options);
    const std::string plain = text_of(path_);
    std::string lent;
    options.high_values = [&](const std::string& store, const isoatlas::Context&) {
        lent = store;
        const Atlas atlas(store);
        EXPECT_EQ(atlas.polarities(), PolarityChoice::high);
        expect_answers_of(atlas, volume, {});
    };
    isoatlas::build_atlas(path_, reader, options, arbitrary_context());
    RC_ASSERT(!lent.empty());
    RC_ASSERT(!std::filesystem::exists(lent));
    RC_ASSERT(text_of(path_) == plain);
    RC_ASSERT(!testing::Test::HasFailure());
}

TEST_F(Stores, ABuildEndsWithTheErrorOfWhoeverIsLentOne) {
    MemoryReader reader(isoatlas::make_phantom("demo", {.size = 32}));
    isoatlas::BuildOptions options{.polarities = PolarityChoice::both};
    options.high_values = [](const std::string&, const isoatlas::Context&) { throw std::runtime_error("no page"); };
    EXPECT_THROW(isoatlas::build_atlas(path_, reader, options), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(path_));
    EXPECT_FALSE(std::filesystem::exists(path_ + ".build/high-values"));
    options.high_values = nullptr;
    EXPECT_EQ(isoatlas::build_atlas(path_, reader, options).resumed, (std::vector<std::string>{"trees", "zones"}));
    EXPECT_FALSE(std::filesystem::exists(path_ + ".build"));
}

TEST_F(Stores, OfOnePolarityAreNotLent) {
    MemoryReader reader(isoatlas::make_phantom("demo", {.size = 32}));
    for (const PolarityChoice choice : {PolarityChoice::high, PolarityChoice::low}) {
        isoatlas::BuildOptions options{.polarities = choice};
        options.high_values = [](const std::string& store, const isoatlas::Context&) { FAIL() << store; };
        isoatlas::build_atlas(path_, reader, options);
    }
}

TEST_F(Stores, OfOnePolarityRefuseTheOther) {
    const Volume volume = isoatlas::make_phantom("demo", {.size = 32});
    isoatlas::build_atlas(path_, volume);
    try {
        const Atlas atlas(path_, {.cache_bytes = 0, .polarity = Polarity::low});
        FAIL();
    } catch (const isoatlas::Error& error) {
        EXPECT_EQ(error.kind(), isoatlas::ErrorKind::unsupported);
        EXPECT_EQ(error.reason(), isoatlas::Reason::polarity_not_stored);
        EXPECT_EQ(error.text().value, "low");
    }
    isoatlas::build_atlas(path_, isoatlas::negated(volume));
    EXPECT_EQ(Atlas(path_).polarities(), PolarityChoice::low);
    EXPECT_EQ(isoatlas::negated(Atlas(path_).volume()).bytes, volume.bytes);
    EXPECT_THROW(Atlas(path_, {.cache_bytes = 0, .polarity = Polarity::high}), isoatlas::Error);
}

}  // namespace
}  // namespace oracle
