// cut() equals the brute-force oracle: objects, contours, labels, at data values and between, for every sample type, thread count and slab
// size.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/cut.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

void cut_equals_the_oracle() {
    const Grid grid = *arbitrary_grid();
    const isoatlas::CutOptions options{.interpolant = *arbitrary_interpolant(), .label = true};
    const Elements elements = elements_of(grid, options.interpolant);
    const double tau = arbitrary_tau(elements);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const std::string difference = compare_cut(elements, tau, isoatlas::cut(volume, tau, options, arbitrary_context()));
    RC_ASSERT(difference == "");
}

void cut_equals_the_oracle_at_every_value() {
    const Grid grid = *arbitrary_grid(4, 24);
    const isoatlas::CutOptions options{.interpolant = *arbitrary_interpolant(), .label = true};
    const Elements elements = elements_of(grid, options.interpolant);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::Context context;
    context.threads = 1;
    for (const double tau : interesting_values(elements)) {
        const std::string difference = compare_cut(elements, tau, isoatlas::cut(volume, tau, options, context));
        RC_ASSERT(difference == "");
    }
}

// Rows longer than a word of bits.
void cut_equals_the_oracle_on_long_rows() {
    const Index n = *rc::gen::inRange<Index>(60, 135);
    std::vector<int> raw =
        *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(6 * n), rc::gen::resize(100, rc::gen::inRange(0, 10000)));
    const int rank = *rc::gen::inRange(2, 4);
    const Texture texture = *rc::gen::element(Texture::ties2, Texture::ties4, Texture::smooth, Texture::checkerboard_ties);
    const Grid grid = make_grid(rank, {n, rank == 3 ? 2 : 6, 3}, texture, raw);
    const isoatlas::CutOptions options{.interpolant = *arbitrary_interpolant(), .label = true};
    const Elements elements = elements_of(grid, options.interpolant);
    const double tau = arbitrary_tau(elements);
    const std::string difference = compare_cut(elements, tau, isoatlas::cut(to_volume(grid), tau, options, arbitrary_context()));
    RC_ASSERT(difference == "");
}

RC_GTEST_PROP(Cut, EqualsTheOracle, ()) { cut_equals_the_oracle(); }
RC_GTEST_PROP(Cut, EqualsTheOracleAtEveryValue, ()) { cut_equals_the_oracle_at_every_value(); }
RC_GTEST_PROP(Cut, EqualsTheOracleOnLongRows, ()) { cut_equals_the_oracle_on_long_rows(); }

}  // namespace
}  // namespace oracle
