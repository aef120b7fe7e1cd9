#include "io/vtk_geometry.h"

#include <cmath>
#include <pugixml.hpp>
#include <string_view>

#include "io/sample_reader.h"
#include "io/text.h"

namespace isoatlas::io {

namespace {

constexpr std::int64_t kLargestIndex = std::int64_t{1} << 40;

[[noreturn]] void bad_field(const std::string& path, const std::string& where, const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path, .where = where, .what = what, .expected = expected,
                                   .next = "the header is damaged: get the file again or correct it"});
}

VtkExtent parse_extent(const std::string& path, const pugi::xml_node& node, const char* name) {
    const std::string_view text = node.attribute(name).value();
    const std::string where = std::string(node.name()) + " " + name;
    const std::vector<std::string_view> words = split_words(text);
    VtkExtent extent;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::optional<std::int64_t> low = words.size() == 6 ? parse_integer(words[2 * axis]) : std::nullopt;
        const std::optional<std::int64_t> high = words.size() == 6 ? parse_integer(words[2 * axis + 1]) : std::nullopt;
        if (!low || !high || *low > *high || *low < -kLargestIndex || *high > kLargestIndex) {
            bad_field(path, where, quoted(text), "six integers: first and last index of x, y, z");
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
            bad_field(path, std::string(node.name()) + " " + name, quoted(attribute.value()), std::to_string(N) + " numbers");
        }
        values[i] = *value;
    }
    return values;
}

/// Moves lengths of the direction columns and signs of the spacing to where they belong.
void normalise(const std::string& path, Geometry& geometry, std::vector<std::string>& notes) {
    for (int axis = 0; axis < 3; ++axis) {
        Mat3& m = geometry.direction;
        double length = std::hypot(m[0][axis], m[1][axis], m[2][axis]);
        if (!(length > 0) || !std::isfinite(length)) bad_field(path, "ImageData Direction", "an axis has no length", "unit vectors");
        double& spacing = geometry.spacing[axis];
        if (spacing == 0) {
            notes.push_back("the spacing of axis " + std::to_string(axis) + " is 0: taken as 1");
            spacing = 1;
        }
        if (std::abs(length - 1) > 1e-12) spacing *= length;
        else length = 1;
        const double sign = spacing < 0 ? -1 : 1;
        spacing *= sign;
        if (!(spacing > 0) || !std::isfinite(spacing)) bad_field(path, "ImageData Spacing", "the size of a voxel is not a number", "positive numbers");
        if (length == 1 && sign > 0) continue;
        for (Vec3& row : m) row[axis] *= sign / length;
    }
}

std::vector<double> cell_centres(const std::vector<double>& points) {
    if (points.size() < 2) return points;
    std::vector<double> centres;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) centres.push_back(points[i] + (points[i + 1] - points[i]) / 2);
    return centres;
}

template <class T>
std::vector<double> convert(const std::vector<std::byte>& bytes) {
    const T* values = reinterpret_cast<const T*>(bytes.data());
    return std::vector<double>(values, values + bytes.size() / sizeof(T));
}

}  // namespace

Extent VtkExtent::samples(bool cells) const {
    Extent extent;
    for (std::size_t axis = 0; axis < 3; ++axis) extent.size[axis] = cells ? std::max<std::int64_t>(size[axis] - 1, 1) : size[axis];
    extent.rank = size[2] == 1 ? 2 : 3;
    return extent;
}

VtkExtent read_vtk_extent(const std::string& path, const pugi::xml_node& grid, const pugi::xml_node& piece, std::vector<std::string>& notes) {
    const VtkExtent whole = parse_extent(path, grid, "WholeExtent");
    if (!piece.attribute("Extent")) return whole;
    const VtkExtent part = parse_extent(path, piece, "Extent");
    if (part.low != whole.low || part.size != whole.size) notes.push_back("the file holds only a part of the whole extent of its grid");
    return part;
}

Geometry image_geometry(const std::string& path, const pugi::xml_node& grid, const VtkExtent& points, bool cells,
                        std::vector<std::string>& notes) {
    Geometry geometry;
    geometry.spacing = numbers<3>(path, grid, "Spacing", {1, 1, 1});
    geometry.origin = numbers<3>(path, grid, "Origin", {0, 0, 0});
    const std::array<double, 9> direction = numbers<9>(path, grid, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (std::size_t i = 0; i < 9; ++i) geometry.direction[i / 3][i % 3] = direction[i];
    Vec3 first{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = static_cast<double>(points.low[axis]) + (cells && points.size[axis] > 1 ? 0.5 : 0.0);
    }
    normalise(path, geometry, notes);
    // The index of the first sample counts along VTK's axes; a flipped axis has the same direction * spacing.
    const std::array<double, 3> spacing = numbers<3>(path, grid, "Spacing", {1, 1, 1});
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (first[axis] != 0) geometry.origin[row] += direction[3 * row + axis] * spacing[axis] * first[axis];
        }
        if (!std::isfinite(geometry.origin[row])) bad_field(path, "ImageData Origin", "the first sample is not at a finite place", "numbers");
    }
    return geometry;
}

Geometry rectilinear_geometry(const std::string& path, const pugi::xml_node& piece, const VtkExtent& points, bool cells,
                              const CoordinateReader& read) {
    Geometry geometry;
    pugi::xml_node node = piece.child("Coordinates").child("DataArray");
    for (std::size_t axis = 0; axis < 3; ++axis, node = node.next_sibling("DataArray")) {
        const std::string where = "Coordinates, axis " + std::to_string(axis);
        if (!node) bad_field(path, where, "the array is missing", "three arrays");
        std::vector<double> values = read(node, points.size[axis]);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isfinite(values[i]) && (i == 0 || values[i] > values[i - 1])) continue;
            throw Error(ErrorKind::unsupported, {.file = path, .where = where + ", number " + std::to_string(i),
                                                 .what = "the coordinates do not ascend", .expected = "ascending finite numbers",
                                                 .next = "flip or sort the axis, with its samples, before writing the file"});
        }
        geometry.coordinates[axis] = cells ? cell_centres(values) : std::move(values);
    }
    return geometry;
}

std::vector<double> read_doubles(const VtkFile& file, const VtkArray& array, std::int64_t count) {
    VolumeInfo line;
    line.path = file.path;
    line.type = array.type;
    line.big_endian = array.format == VtkFormat::ascii ? needs_swap(false) : file.big_endian;
    line.extent = {.rank = 3, .size = {count, 1, 1}};
    (void)sample_bytes(file.path, line.extent, line.type);
    const std::unique_ptr<VolumeReader> reader = make_sample_reader(line, open_vtk_array(file, array, count));
    std::vector<std::byte> bytes(static_cast<std::size_t>(count) * size_of(array.type));
    reader->read(0, 1, bytes);
    switch (array.type) {
        case ValueType::u8: return convert<std::uint8_t>(bytes);
        case ValueType::i8: return convert<std::int8_t>(bytes);
        case ValueType::u16: return convert<std::uint16_t>(bytes);
        case ValueType::i16: return convert<std::int16_t>(bytes);
        case ValueType::u32: return convert<std::uint32_t>(bytes);
        case ValueType::i32: return convert<std::int32_t>(bytes);
        case ValueType::f32: return convert<float>(bytes);
        case ValueType::f64: break;
    }
    return convert<double>(bytes);
}

}  // namespace isoatlas::io
