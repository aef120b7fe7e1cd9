// MRC and CCP4 maps: .mrc .map .ccp4 .rec .st .ali .mrcs. Modes 0, 1, 2, 6 and 12; the extended header is skipped. A file may
// be packed as a whole (.map.gz, as archives of maps have them).
//
// The samples stay in the order of the file. Columns, rows and sections that run along other axes than X, Y and Z, and unit cells whose
// sides are not perpendicular, are in the directions of the volume's axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "formats/common/packed_file.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/formats.h"
#include "formats/volume/half_source.h"
#include "formats/volume/mrc_header.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr int kHalfMode = 12;

bool has_name_of_maps(const std::string& path) {
    const std::string_view name = unpacked_name(path);
    constexpr std::array<std::string_view, 7> kMapNames{".mrc", ".map", ".ccp4", ".rec", ".st", ".ali", ".mrcs"};
    return std::any_of(kMapNames.begin(), kMapNames.end(), [&](std::string_view end) { return ends_with_ignoring_case(name, end); });
}

MrcHeader read_mrc_header(const std::string& path) {
    const std::vector<std::byte> bytes = read_unpacked_bytes(path, kMrcHeaderBytes);
    if (static_cast<std::int64_t>(bytes.size()) < kMrcHeaderBytes) {
        bad_header(path, "offset " + std::to_string(bytes.size()), "the file ends early", "1024 bytes of header");
    }
    std::optional<MrcHeader> header = decode_mrc(bytes, false);
    if (!header) bad_header(path, "offset 0", "is not that of an MRC file", "sizes from 1 and a mode from 0 to 6, 12 or 101");
    const bool has_axes = std::ranges::any_of(header->axis, [](int axis) { return axis >= 0; });
    if (!has_axes) header->axis = {0, 1, 2};  // files of before 2000
    std::array<int, 3> sorted = header->axis;
    std::ranges::sort(sorted);
    if (sorted != std::array{0, 1, 2}) bad_header(path, "MAPC, MAPR, MAPS", "two of them name the same axis", "1, 2 and 3 in any order");
    return *std::move(header);
}

ValueType type_of_mode(const std::string& path, const MrcHeader& header) {
    switch (header.mode) {
        case 0: return header.unsigned_bytes ? ValueType::u8 : ValueType::i8;
        case 1: return ValueType::i16;
        case 2:
        case kHalfMode: return ValueType::f32;
        case 6: return ValueType::u16;
        default: break;
    }
    const std::string what = header.mode == 3 || header.mode == 4 ? "complex numbers"
                             : header.mode == 16                  ? "RGB colours"
                             : header.mode == 101                 ? "4-bit integers"
                                                                  : "of mode " + std::to_string(header.mode);
    throw Error(ErrorKind::unsupported, {.file = path,
                                         .where = "header, MODE",
                                         .what = "samples are " + what,
                                         .expected = "mode 0, 1, 2, 6 or 12",
                                         .next = "convert it, for example with the Python package mrcfile, or with newstack of IMOD"});
}

/// The directions of the sides of the unit cell: that along X first, the second in the plane of X and Y.
Mat3 directions_of(const std::string& path, const std::array<double, 3>& angles, std::vector<std::string>& notes) {
    constexpr double kRight = 90, kRounding = 1e-3;
    const auto is_right = [](double angle) { return angle == 0 || std::abs(angle - kRight) < kRounding; };  // 0: not given
    if (std::ranges::all_of(angles, is_right)) return Geometry{}.direction;
    std::array<double, 3> cosine{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(angles[i] > 0 && angles[i] < 180))
            bad_header(path, "CELLB", "an angle of the unit cell is wrong", "above 0 and below 180 degrees");
        cosine[i] = is_right(angles[i]) ? 0 : std::cos(angles[i] * std::numbers::pi / 180);
    }
    const auto [alpha, beta, gamma] = cosine;
    const double sine = std::sqrt(1 - gamma * gamma), along_y = (alpha - beta * gamma) / sine, height = 1 - beta * beta - along_y * along_y;
    constexpr double kFlat = 1e-6;
    if (!(height > kFlat)) bad_header(path, "CELLB", "the angles of the unit cell make no volume", "angles of a parallelepiped");
    notes.emplace_back("the axes of the file are not perpendicular (angles of the unit cell); they are kept");
    return {{{1, gamma, beta}, {0, sine, along_y}, {0, 0, std::sqrt(height)}}};
}

Geometry geometry_of(const std::string& path, const MrcHeader& header, std::vector<std::string>& notes) {
    std::array<double, 3> spacing{1, 1, 1};  // along X, Y, Z
    bool is_known = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = header.cells[k] > 0 ? header.cell[k] / static_cast<double>(header.cells[k]) : 0;
        if (std::isfinite(step) && step > 0)
            spacing[k] = step;
        else
            is_known = false;
    }
    if (!is_known) notes.emplace_back("the size of the samples is not given along every axis: 1 was assumed there");
    const Mat3 sides = directions_of(path, header.angles, notes);
    Geometry geometry;
    if (is_known) geometry.unit = "\xc3\x85";  // angstrom
    for (std::size_t a = 0; a < 3; ++a) {
        const auto side = static_cast<std::size_t>(header.axis[a]);
        geometry.spacing[a] = spacing[side];
        for (std::size_t row = 0; row < 3; ++row) geometry.direction[row][a] = sides[row][side];
    }
    const bool has_start = std::ranges::any_of(header.start, [](std::int64_t start) { return start != 0; });
    const bool has_origin = std::ranges::any_of(header.origin, [](double place) { return std::isfinite(place) && place != 0; }) &&
                            std::ranges::all_of(header.origin, [](double place) { return std::isfinite(place); });
    if (has_origin) {
        geometry.origin = header.origin;
        if (has_start) notes.emplace_back("the header has ORIGIN and NXSTART; ORIGIN is used");
    } else {
        geometry.origin = to_physical(
            geometry, {static_cast<double>(header.start[0]), static_cast<double>(header.start[1]), static_cast<double>(header.start[2])});
    }
    return geometry;
}

/// Volumes in the file; of each the sections.
std::pair<std::int64_t, std::int64_t> volumes_of(const std::string& path, const MrcHeader& header, std::vector<std::string>& notes) {
    constexpr int kStackOfVolumes = 401;
    const std::int64_t sections = header.size[2];
    if (header.space_group < kStackOfVolumes) {
        if (header.space_group == 0 && sections > 1 && header.cells[2] == 1)
            notes.emplace_back("a stack of images, which are read as the slices of a volume");
        return {1, sections};
    }
    const std::int64_t each = header.cells[2];
    if (each < 1 || sections % each != 0) {
        bad_header(path, "MZ",
                   "a stack of volumes of " + std::to_string(each) + " sections each, with " + std::to_string(sections) + " in all",
                   "a whole number of volumes");
    }
    return {sections / each, each};
}

}  // namespace

bool looks_like_mrc(FirstBytes first, const std::string& path) { return decode_mrc(first, !has_name_of_maps(path)).has_value(); }

std::unique_ptr<VolumeReader> open_mrc(const std::string& path, const OpenOptions& options) {
    const MrcHeader header = read_mrc_header(path);
    VolumeInfo info;
    info.path = path;
    info.format = "MRC";
    info.encoding = name_of(packing_of(path));
    info.type = type_of_mode(path, header);
    info.description = header.label;
    const auto [volumes, sections] = volumes_of(path, header, info.notes);
    info.extent.size = {header.size[0], header.size[1], sections};
    if (header.size[2] == 1 && header.axis[2] == 2) info.extent.rank = 2;
    info.geometry = geometry_of(path, header, info.notes);
    static_cast<void>(sample_bytes(path, info.extent, info.type, volumes));  // rejects sizes that do not fit
    const TimeStep step = choose_time_step(path, options, volumes);
    std::unique_ptr<ByteSource> source = open_unpacked(path, kMrcHeaderBytes + header.extended_bytes);
    info.file_bytes = file_size(path);
    if (header.mode == kHalfMode) {
        info.notes.emplace_back("samples of 16 bits in floating point are read as float32");
        source = widen_halves(std::move(source), header.big_endian);
    } else {
        info.big_endian = header.big_endian;
    }
    return make_sample_reader(std::move(info), std::move(source), options, step);
}

}  // namespace isoatlas
