// A code, with the samples, says all of an element: its value follows bit by bit, place and form are the code again, and so is the order of
// all elements.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "analysis/analysis_data.h"
#include "atlas/element_form.h"
#include "critical/bodies.h"
#include "critical/element_values.h"
#include "critical/sort_codes.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

void check(const Grid& grid, isoatlas::Interpolant interpolant, isoatlas::ValueType type, double tunnel_height) {
    const isoatlas::Volume volume = to_volume(grid, type);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant, .tunnel_height = tunnel_height});
    const auto& arrays = std::get<0>(analysis.data().arrays)->arrays;
    const std::span<const std::uint64_t> codes(arrays.code.items());
    std::vector<double> values(codes.size());
    isoatlas::find_element_values(codes, volume, isoatlas::tunnel_height_of(interpolant, tunnel_height), 1, values);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        RC_ASSERT(std::bit_cast<std::uint64_t>(values[i]) == std::bit_cast<std::uint64_t>(arrays.value.items()[i]));
        const isoatlas::ElementForm form = isoatlas::form_of(isoatlas::ElementCode{codes[i]});
        RC_ASSERT(form.place >= 0 && form.place < volume.info.extent.voxels());
        RC_ASSERT(isoatlas::code_of(form).bits == codes[i]);
    }
    isoatlas::BigVector<std::uint64_t> shuffled(codes.begin(), codes.end());
    isoatlas::BigVector<double> found;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()));
    RC_ASSERT(isoatlas::sort_codes(volume, isoatlas::tunnel_height_of(interpolant, tunnel_height), 2, shuffled, found));
    RC_ASSERT(std::ranges::equal(shuffled, codes) && std::ranges::equal(found, values));
}

void element_codes_give_their_values() {
    const auto interpolant = *arbitrary_interpolant();
    const double height = interpolant == isoatlas::Interpolant::trilinear ? *rc::gen::element(0.0, 0.5, 3.0) : 0;
    check(*arbitrary_grid(7, 200), interpolant, isoatlas::ValueType::f64, height);
}

void element_codes_of_integers_give_their_values() {
    Grid grid = *arbitrary_grid(7, 200);
    for (double& value : grid.value) value = std::round(value / 4) - 20;
    const auto type = *rc::gen::element(isoatlas::ValueType::i8, isoatlas::ValueType::i16, isoatlas::ValueType::f32);
    check(grid, *arbitrary_interpolant(), type, 0);
}

/// Of whatever code or numbers: no element outside the volume is looked up.
void element_codes_of_no_element_have_no_value() {
    const isoatlas::Volume volume = to_volume(*arbitrary_grid(4, 60));
    const auto place = *rc::gen::inRange<std::int64_t>(0, volume.info.extent.voxels());
    const auto form = *rc::gen::arbitrary<std::uint16_t>();
    const isoatlas::ElementCode code = isoatlas::code_of({place, form});
    double value = 0;
    isoatlas::find_element_values(std::span(&code.bits, 1), volume, 0, 1, std::span(&value, 1));
    const auto [low, high] = std::ranges::minmax(volume.samples<double>());
    RC_ASSERT(std::isnan(value) || (value >= low && value <= high));
}

RC_GTEST_PROP(ElementCodes, GiveTheirValues, ()) { element_codes_give_their_values(); }
RC_GTEST_PROP(ElementCodes, OfIntegersGiveTheirValues, ()) { element_codes_of_integers_give_their_values(); }
RC_GTEST_PROP(ElementCodes, OfNoElementHaveNoValue, ()) { element_codes_of_no_element_have_no_value(); }

}  // namespace
}  // namespace oracle
