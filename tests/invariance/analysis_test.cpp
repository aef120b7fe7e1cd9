// The same analysis, byte for byte, for any number of threads, slab size and sample type.
#include <gtest/gtest.h>

#include <sstream>

#include "isoatlas/analysis.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace isoatlas {
namespace {

/// Everything an analysis says: all accessors and the JSON of every detail.
std::string everything(const Volume& volume, const Context& context) {
    const Analysis analysis = analyse(volume, {}, context);
    std::ostringstream out;
    out << oracle::full_text(analysis);
    for (const TreeDetail detail : {TreeDetail::events, TreeDetail::levels, TreeDetail::elements, TreeDetail::contours}) {
        write_tree_json(out, volume, analysis, {.detail = detail});
    }
    return out.str();
}

Context context_of(int threads, std::int64_t slab_slices) {
    Context context;
    context.threads = threads;
    context.slab_slices = slab_slices;
    return context;
}

void expect_same_for_any_context(const Volume& volume) {
    const std::string expected = everything(volume, context_of(1, volume.info.extent.size[2]));
    for (const int threads : {0, 1, 2, 3}) {
        for (const std::int64_t slab : {0, 1, 2, 3, 7}) {
            EXPECT_TRUE(everything(volume, context_of(threads, slab)) == expected) << threads << " threads, slabs of " << slab;
        }
    }
}

TEST(Invariance, ThreadsAndSlabsOnPhantoms) {
    PhantomOptions options;
    options.size = 20;
    for (const char* name : {"noise", "random-field", "checkerboard", "gyroid"}) {
        SCOPED_TRACE(name);
        expect_same_for_any_context(make_phantom(name, options));
    }
    expect_same_for_any_context(make_phantom("figure-plateau"));
    options.quantise = 5;
    expect_same_for_any_context(make_phantom("noise", options));
}

TEST(Invariance, ThreadsAndSlabsOnFlatAndThinVolumes) {
    std::vector<int> raw;
    for (int i = 0; i < 2000; ++i) raw.push_back(i * 7919 % 9973);
    for (const auto& size : {std::array<std::int64_t, 3>{40, 30, 1}, {1, 1, 50}, {1, 37, 11}, {50, 1, 1}}) {
        for (const int rank : {2, 3}) {
            expect_same_for_any_context(oracle::to_volume(oracle::make_grid(rank, size, oracle::Texture::ties8, raw)));
        }
    }
}

TEST(Invariance, SampleTypesOfTheSameNumbers) {
    std::vector<int> raw;
    for (int i = 0; i < 3000; ++i) raw.push_back(i * 7919 % 9973);
    for (const oracle::Texture texture : {oracle::Texture::ties8, oracle::Texture::ties3, oracle::Texture::checkerboard_ties}) {
        const oracle::Grid grid = oracle::make_grid(3, {14, 13, 12}, texture, raw);
        const std::string expected = oracle::full_text(analyse(oracle::to_volume(grid, ValueType::f64)));
        for (const ValueType type :
             {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::u32, ValueType::i32, ValueType::f32}) {
            EXPECT_TRUE(oracle::full_text(analyse(oracle::to_volume(grid, type))) == expected) << name_of(type);
        }
    }
}

TEST(Invariance, SignedAndLargeValuesKeepTheirOrder) {
    std::vector<int> raw;
    for (int i = 0; i < 1000; ++i) raw.push_back(i * 7919 % 9973);
    oracle::Grid grid = oracle::make_grid(3, {10, 10, 10}, oracle::Texture::uniform, raw);
    for (double& v : grid.value) v = std::round(v) - 78;  // i8: both signs
    const auto same = [&grid](ValueType a, ValueType b) {
        return oracle::full_text(analyse(oracle::to_volume(grid, a))) == oracle::full_text(analyse(oracle::to_volume(grid, b)));
    };
    EXPECT_TRUE(same(ValueType::i8, ValueType::f64));
    EXPECT_TRUE(same(ValueType::i16, ValueType::f32));
    for (double& v : grid.value) v = v * 200 + 20000;
    EXPECT_TRUE(same(ValueType::u16, ValueType::f64));
    for (double& v : grid.value) v *= 1e5;
    EXPECT_TRUE(same(ValueType::u32, ValueType::f64));
}

}  // namespace
}  // namespace isoatlas
