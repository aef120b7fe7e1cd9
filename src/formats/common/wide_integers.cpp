#include "formats/common/wide_integers.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr int kFractionBits = std::numeric_limits<double>::digits;  // 53

/// Whether float64 has a number of this magnitude: its bits from the first to the last one fit in the fraction.
bool is_double(std::uint64_t magnitude) {
    return magnitude >> kFractionBits == 0 || magnitude >> std::countr_zero(magnitude) >> kFractionBits == 0;
}

std::uint64_t magnitude_of(std::uint64_t value) { return value; }
std::uint64_t magnitude_of(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    return value < 0 ? ~bits + 1 : bits;
}

template <class Integer>
void convert(std::span<std::byte> samples, std::span<const std::uint64_t> missing, const std::string& file) {
    for (std::size_t at = 0; at < samples.size(); at += sizeof(Integer)) {
        Integer integer = 0;
        std::memcpy(&integer, samples.data() + at, sizeof integer);
        auto value = static_cast<double>(integer);
        if (std::ranges::find(missing, static_cast<std::uint64_t>(integer)) != missing.end()) {
            value = std::numeric_limits<double>::quiet_NaN();
        } else if (!is_double(magnitude_of(integer))) {
            throw Error(ErrorKind::unsupported,
                        {.file = file,
                         .where = "samples",
                         .what = "a sample is " + std::to_string(integer) + ", which float64 does not have",
                         .expected = "integers of 64 bits that float64 has, such as all up to 9007199254740992",
                         .next = "write smaller numbers; labels for example as numpy.unique(array, return_inverse=True)[1]"});
        }
        std::memcpy(samples.data() + at, &value, sizeof value);
    }
}

}  // namespace

const char* name_of(WideInteger type) { return type == WideInteger::int64 ? "int64" : type == WideInteger::uint64 ? "uint64" : ""; }

std::string note_of(WideInteger type) { return std::string(name_of(type)) + " samples are read as float64, none of them rounded"; }

void doubles_of_integers(std::span<std::byte> samples, const WideIntegers& stored, const std::string& file) {
    ISOATLAS_CHECK(stored.type == WideInteger::none || samples.size() % sizeof(double) == 0);
    if (stored.type == WideInteger::int64) convert<std::int64_t>(samples, stored.missing, file);
    if (stored.type == WideInteger::uint64) convert<std::uint64_t>(samples, stored.missing, file);
}

}  // namespace isoatlas
