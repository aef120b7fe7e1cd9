// MRC2014 maps. Source: https://www.ccpem.ac.uk/mrc-format/mrc2014/.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/byte_writer.h"
#include "formats/common/generator.h"
#include "formats/common/length_unit.h"
#include "formats/common/volume_file.h"

namespace isoatlas {
namespace {

/// Mode of the type; uint8 is widened to 16 bits, because mode 0 is signed.
std::int32_t mode_of(const std::string& path, ValueType type) {
    switch (type) {
        case ValueType::i8: return 0;
        case ValueType::i16: return 1;
        case ValueType::f32: return 2;
        case ValueType::u8:
        case ValueType::u16: return 6;
        default: break;
    }
    throw Error(ErrorKind::unsupported, {.file = path,
                                         .what = std::string("MRC has no samples of type ") + name_of(type),
                                         .expected = "8 or 16-bit integers, or float32",
                                         .next = "write .nrrd or .nii"});
}

/// How the axes lie, as MRC says it: sides of a unit cell, the first along X, the second in the plane of X and Y.
struct CellAxes {
    std::array<std::int32_t, 3> side{1, 2, 3};  ///< 1 to 3 for each axis of the volume
    std::array<float, 3> angles{90, 90, 90};    ///< between sides 2 and 3, 1 and 3, 1 and 2, in degrees
};

/// nullopt: MRC cannot say it.
std::optional<CellAxes> axes_of(const Geometry& geometry) {
    constexpr double kRounding = 1e-6;  // of headers
    std::array<std::int32_t, 3> side{1, 2, 3};
    do {
        Mat3 sides{};  // column k: direction of side k
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t row = 0; row < 3; ++row) sides[row][static_cast<std::size_t>(side[a] - 1)] = geometry.direction[row][a];
        }
        const auto is_zero = [](double entry) { return std::abs(entry) < kRounding; };
        if (!is_zero(sides[1][0]) || !is_zero(sides[2][0]) || !is_zero(sides[2][1])) continue;
        if (sides[0][0] <= 0 || sides[1][1] <= 0 || sides[2][2] <= 0) continue;
        const auto angle = [&](std::size_t one, std::size_t other) {
            double product = 0;
            for (std::size_t row = 0; row < 3; ++row) product += sides[row][one] * sides[row][other];
            return is_zero(product) ? 90.0F : static_cast<float>(std::acos(product) * 180 / std::numbers::pi);
        };
        return CellAxes{side, {angle(1, 2), angle(0, 2), angle(0, 1)}};
    } while (std::ranges::next_permutation(side).found);
    return std::nullopt;
}

/// Angstrom in a unit of the volume; 1 for units that are not known.
double angstrom_in(const std::string& unit) {
    constexpr double kAngstrom = 1e-10;
    const std::optional<double> metres = metres_in(unit);
    return metres ? *metres / kAngstrom : 1;
}

}  // namespace

void write_mrc(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    const Geometry geometry = regular_geometry(info);
    const std::int32_t mode = mode_of(sink.name(), info.type);
    const std::optional<CellAxes> kept = axes_of(geometry);
    const CellAxes axes = kept.value_or(CellAxes{});
    const double scale = angstrom_in(geometry.unit);
    std::array<std::int32_t, 3> size{}, cells{};
    std::array<float, 3> cell{}, origin{};
    for (std::size_t a = 0; a < 3; ++a) {
        if (info.extent.size[a] > 0x7fffffff) {
            throw Error(ErrorKind::unsupported, {.file = sink.name(), .what = "MRC has no axis of 2^31 samples", .next = "write .nrrd"});
        }
        size[a] = static_cast<std::int32_t>(info.extent.size[a]);
        const auto side = static_cast<std::size_t>(axes.side[a] - 1);
        cells[side] = size[a];
        cell[side] = static_cast<float>(geometry.spacing[a] * static_cast<double>(size[a]) * scale);
        origin[a] = static_cast<float>(geometry.origin[a] * scale);
    }
    ByteWriter out(sink);
    out.put(size);
    out.put(mode);
    out.put(std::array<std::int32_t, 3>{});  // NXSTART: the place is in ORIGIN
    out.put(cells);
    out.put(cell);
    out.put(axes.angles);
    out.put(axes.side);
    out.put(std::array<float, 3>{0, -1, -2});              // least, greatest, mean value: not known
    out.put(std::int32_t{info.extent.rank == 2 ? 0 : 1});  // an image, a volume
    constexpr std::int32_t kVersion2014 = 20141;
    out.put(std::array<std::int32_t, 5>{0, 0, 0, 0, kVersion2014});  // no extended header
    out.put(std::array<std::int32_t, 21>{});
    out.put(origin);
    out.text("MAP ");
    out.text(std::endian::native == std::endian::big ? std::string_view("\x11\x11\0\0", 4) : std::string_view("\x44\x44\0\0", 4));
    out.put(-1.0F);  // deviation: not known
    std::string label = std::string(kGenerator) + (kept ? "" : ": the directions of the axes were not kept");
    label.resize(80, ' ');
    out.put(std::int32_t{1});
    out.text(label + std::string(9 * 80, ' '));
    out.finish();
    samples([&](std::span<const std::byte> bytes) {
        if (info.type != ValueType::u8) return sink.write(bytes);
        std::vector<std::uint16_t> wide(bytes.size());
        std::ranges::transform(bytes, wide.begin(), [](std::byte sample) { return std::to_integer<std::uint16_t>(sample); });
        sink.write(std::as_bytes(std::span(wide)));
    });
}

}  // namespace isoatlas
