#include "formats/volume/vtk_geometry.h"

#include <cmath>
#include <pugixml.hpp>
#include <string_view>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {

namespace {

constexpr std::int64_t kLargestIndex = std::int64_t{1} << 40;

VtkExtent parse_extent(const std::string& path, const pugi::xml_node& node, const char* name) {
    const std::string_view text = node.attribute(name).value();
    const std::string where = std::string(node.name()) + " " + name;
    const std::vector<std::string_view> words = split_words(text);
    VtkExtent extent;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::optional<std::int64_t> low = words.size() == 6 ? parse_integer(words[2 * axis]) : std::nullopt;
        const std::optional<std::int64_t> high = words.size() == 6 ? parse_integer(words[2 * axis + 1]) : std::nullopt;
        if (!low || !high || *low > *high || *low < -kLargestIndex || *high > kLargestIndex) {
            bad_field(path, where, in_quotes(text), "six integers: first and last index of x, y, z");
        }
        extent.low[axis] = *low;
        extent.size[axis] = *high - *low + 1;
    }
    return extent;
}

/// Numbers of an attribute, or the default when it is missing.
template <std::size_t N>
std::array<double, N> numbers(const std::string& path, const pugi::xml_node& node, const char* name, const std::array<double, N>& missing) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) return missing;
    const std::vector<std::string_view> words = split_words(attribute.value());
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) {
        const std::optional<double> value = words.size() == N ? parse_number(words[i]) : std::nullopt;
        if (!value || !std::isfinite(*value)) {
            bad_field(path, std::string(node.name()) + " " + name, in_quotes(attribute.value()), std::to_string(N) + " numbers");
        }
        values[i] = *value;
    }
    return values;
}

std::vector<double> cell_centres(const std::vector<double>& points) {
    if (points.size() < 2) return points;
    std::vector<double> centres;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) centres.push_back(points[i] + (points[i + 1] - points[i]) / 2);
    return centres;
}

std::string coordinates_of(std::size_t axis) { return "Coordinates, axis " + std::to_string(axis); }

}  // namespace

Extent VtkExtent::samples(bool cells) const {
    Extent extent;
    for (std::size_t axis = 0; axis < 3; ++axis) extent.size[axis] = cells ? std::max<std::int64_t>(size[axis] - 1, 1) : size[axis];
    extent.rank = size[2] == 1 ? 2 : 3;
    return extent;
}

VtkExtent read_vtk_extent(const std::string& path, const pugi::xml_node& grid, const pugi::xml_node& piece,
                          std::vector<std::string>& notes) {
    const VtkExtent whole = parse_extent(path, grid, "WholeExtent");
    if (!piece.attribute("Extent")) return whole;
    const VtkExtent part = parse_extent(path, piece, "Extent");
    if (part.low != whole.low || part.size != whole.size) notes.emplace_back("the file holds only a part of the whole extent of its grid");
    return part;
}

void set_image_geometry(const pugi::xml_node& grid, const VtkExtent& points, bool cells, VolumeInfo& info) {
    const std::array<double, 3> spacing = numbers<3>(info.path, grid, "Spacing", {1, 1, 1});
    const std::array<double, 9> direction = numbers<9>(info.path, grid, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    Geometry& geometry = info.geometry;
    geometry.origin = numbers<3>(info.path, grid, "Origin", {0, 0, 0});
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 step{};
        for (int row = 0; row < 3; ++row) step[row] = direction[3 * row + axis] * spacing[axis];
        set_axis_step(info, axis, step);
        const double first = static_cast<double>(points.low[axis]) + (cells && points.size[axis] > 1 ? 0.5 : 0.0);
        for (int row = 0; row < 3 && first != 0; ++row) geometry.origin[row] += step[row] * first;
    }
    require_frame(info);
    for (const double place : geometry.origin) {
        if (!std::isfinite(place))
            bad_field(info.path, "ImageData Origin", "the first sample is not at a finite position", "smaller numbers");
    }
}

Geometry rectilinear_geometry(const std::string& path, std::array<std::vector<double>, 3> coordinates, bool cells) {
    Geometry geometry;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double>& values = coordinates[axis];
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isfinite(values[i]) && (i == 0 || values[i] > values[i - 1])) continue;
            throw Error(ErrorKind::unsupported, {.file = path,
                                                 .where = coordinates_of(axis) + ", number " + std::to_string(i),
                                                 .what = "the coordinates do not ascend",
                                                 .expected = "ascending finite numbers",
                                                 .next = "flip or sort the axis, with its samples, before writing the file"});
        }
        geometry.coordinates[axis] = cells ? cell_centres(values) : std::move(values);
    }
    return geometry;
}

Geometry rectilinear_geometry(const std::string& path, const pugi::xml_node& piece, const VtkExtent& points, bool cells,
                              const CoordinateReader& read) {
    std::array<std::vector<double>, 3> coordinates;
    pugi::xml_node node = piece.child("Coordinates").child("DataArray");
    for (std::size_t axis = 0; axis < 3; ++axis, node = node.next_sibling("DataArray")) {
        if (!node) bad_field(path, coordinates_of(axis), "the array is missing", "three arrays");
        coordinates[axis] = read(node, points.size[axis]);
    }
    return rectilinear_geometry(path, std::move(coordinates), cells);
}

std::vector<double> read_doubles(const std::string& path, std::unique_ptr<ByteSource> numbers, ValueType type, bool big_endian,
                                 std::int64_t count, const OpenOptions& options) {
    VolumeInfo line;
    line.path = path;
    line.type = type;
    line.big_endian = big_endian;
    line.extent = {.rank = 3, .size = {count, 1, 1}};
    const std::unique_ptr<VolumeReader> reader = make_sample_reader(line, std::move(numbers), options);
    std::vector<std::byte> bytes(static_cast<std::size_t>(count) * size_of(type));
    reader->read(0, 1, bytes);
    return visit_type(type, [&]<class T>(T) {
        const T* values = reinterpret_cast<const T*>(bytes.data());
        return std::vector<double>(values, values + count);
    });
}

std::vector<double> read_doubles(const VtkFile& file, const VtkArray& array, ValueType type, std::int64_t count) {
    (void)sample_bytes(file.path, {.rank = 3, .size = {count, 1, 1}}, type);
    OpenOptions options;
    options.skip_rest = file.skip_rest;
    const bool big_endian = array.format == VtkFormat::ascii ? needs_swap(false) : file.big_endian;
    return read_doubles(file.path, open_vtk_array(file, array, type, count), type, big_endian, count, options);
}

}  // namespace isoatlas
