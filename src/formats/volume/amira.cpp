// Amira meshes (.am) on a regular lattice: uniform and rectilinear; raw, text, HxByteRLE and HxZip.
//
// The bounding box of Amira is that of the centres of the first and last samples. Sections of samples follow each other without a table:
// where one begins is known from the lengths of those before it, for texts from their line "@N".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/header_text.h"
#include "formats/common/text.h"
#include "formats/common/text_source.h"
#include "formats/volume/amira_header.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/byte_rle_source.h"
#include "formats/volume/component_source.h"
#include "formats/volume/formats.h"
#include "formats/volume/named_type.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/vtk_geometry.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr const char* kLattice = "Lattice";

std::optional<ValueType> type_of_amira(const std::string& name) {
    static constexpr std::array<NamedType, 9> kTypes{{{"byte", ValueType::u8},
                                                      {"short", ValueType::i16},
                                                      {"ushort", ValueType::u16},
                                                      {"int", ValueType::i32},
                                                      {"int32", ValueType::i32},
                                                      {"uint", ValueType::u32},
                                                      {"uint32", ValueType::u32},
                                                      {"float", ValueType::f32},
                                                      {"double", ValueType::f64}}};
    return find_type(kTypes, name);
}

ValueType required_type(const AmiraHeader& header, const AmiraArray& array) {
    if (const std::optional<ValueType> type = type_of_amira(array.type)) return *type;
    throw Error(ErrorKind::unsupported, {.file = header.path,
                                         .where = "array " + in_quotes(array.name),
                                         .what = "samples of type " + in_quotes(array.type) + " are not supported",
                                         .expected = "byte, short, ushort, int, float or double",
                                         .next = "convert it in Amira or Avizo with Convert Image Type"});
}

/// Bytes of an array that is not packed.
std::int64_t plain_bytes(const AmiraHeader& header, const AmiraArray& array) {
    const auto sizes = header.sizes.find(array.location);
    if (sizes == header.sizes.end())
        bad_header(header.path, "array " + in_quotes(array.name), in_quotes(array.location) + " has no size",
                   "'define " + array.location + "'");
    std::int64_t bytes = static_cast<std::int64_t>(size_of(required_type(header, array)));
    const auto multiply = [&](std::int64_t factor) {
        if (factor != 0 && bytes > std::numeric_limits<std::int64_t>::max() / factor)
            bad_header(header.path, "define " + printable(array.location), "the sizes do not fit in 63 bits", "smaller sizes");
        bytes *= factor;
    };
    for (const std::int64_t size : sizes->second) multiply(size);
    multiply(array.components);
    return bytes;
}

struct AmiraRange {
    std::int64_t begin = 0, bytes = 0;
};

/// Where the next line "@N" begins, or the end of the file.
std::int64_t end_of_text(const std::string& path, std::int64_t begin) {
    constexpr std::size_t kMaxPiece = std::size_t{1} << 16;
    const std::int64_t size = file_size(path);
    if (begin >= size) return begin;
    const std::unique_ptr<ByteSource> source = open_file_source(path, begin);
    std::string piece;
    bool at_line = true;
    for (std::int64_t at = begin; at < size; at += static_cast<std::int64_t>(piece.size())) {
        piece.resize(static_cast<std::size_t>(std::min(size - at, static_cast<std::int64_t>(kMaxPiece))));
        source->read(std::as_writable_bytes(std::span(piece)));
        for (std::size_t i = 0; i < piece.size(); ++i) {
            if (at_line && piece[i] == '@') return at + static_cast<std::int64_t>(i);
            at_line = piece[i] == '\n';
        }
    }
    return size;
}

/// Reads the line "@N" at or behind `at`; the number and the offset behind the line.
std::pair<std::int64_t, std::int64_t> next_section(const std::string& path, std::int64_t at) {
    constexpr std::int64_t kMaxLine = 64;
    const std::int64_t left = file_size(path) - at;
    if (left <= 0) return {0, at};
    std::string text(static_cast<std::size_t>(std::min(left, kMaxLine)), '\0');
    open_file_source(path, at, static_cast<std::int64_t>(text.size()))->read(std::as_writable_bytes(std::span(text)));
    std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const std::int64_t section = amira_section(take_line(text, begin));
    return {section, at + static_cast<std::int64_t>(begin)};
}

/// Where the section of an array lies in the file.
AmiraRange range_of(const AmiraHeader& header, const AmiraArray& wanted) {
    std::map<std::int64_t, const AmiraArray*> arrays;
    for (const AmiraArray& array : header.arrays) arrays.emplace(array.section, &array);
    std::int64_t section = header.first_section, at = header.data_offset;
    for (std::size_t read = 0; read < arrays.size(); ++read) {
        const auto found = arrays.find(section);
        if (found == arrays.end()) break;
        const AmiraArray& array = *found->second;
        const std::int64_t bytes = header.is_text           ? end_of_text(header.path, at) - at
                                   : array.encoding.empty() ? plain_bytes(header, array)
                                                            : array.packed_bytes;
        if (section == wanted.section) return {at, bytes};
        if (bytes > std::numeric_limits<std::int64_t>::max() - at) break;
        std::tie(section, at) = next_section(header.path, at + bytes);
    }
    throw Error(ErrorKind::input, {.file = header.path,
                                   .where = "array " + in_quotes(wanted.name),
                                   .what = "its section @" + std::to_string(wanted.section) + " is not where the sections before it end",
                                   .next = "the file is truncated or damaged: get it again"});
}

/// The samples of an array, components interleaved.
std::unique_ptr<ByteSource> open_array(const AmiraHeader& header, const AmiraArray& array) {
    const ValueType type = required_type(header, array);
    const AmiraRange range = range_of(header, array);
    if (header.is_text) return open_text_source(open_file_source(header.path, range.begin, range.bytes), type);
    if (array.encoding.empty()) return open_file_source(header.path, range.begin, range.bytes);
    if (array.encoding == "HxZip") return open_inflate_source(header.path, range.begin, range.bytes);
    if (array.encoding == "HxByteRLE") return open_byte_rle_source(open_file_source(header.path, range.begin, range.bytes));
    throw Error(ErrorKind::unsupported, {.file = header.path,
                                         .where = "array " + in_quotes(array.name),
                                         .what = "its encoding " + in_quotes(array.encoding) + " is not supported",
                                         .expected = "none, HxByteRLE or HxZip",
                                         .next = "save it in Amira or Avizo as AmiraMesh binary"});
}

/// The arrays on the lattice; `choices` are their paths.
std::vector<const AmiraArray*> lattice_arrays(const AmiraHeader& header, std::vector<ErrorChoice>& choices) {
    std::vector<const AmiraArray*> arrays;
    std::set<std::string> words;
    for (const AmiraArray& array : header.arrays) {
        if (array.location != kLattice) continue;
        std::string word = "/" + shown_name(array.name);
        if (!words.insert(word).second) word += "@" + std::to_string(array.section);
        choices.push_back({word, printable(array.type) + (array.components > 1 ? "[" + std::to_string(array.components) + "]" : "")});
        arrays.push_back(&array);
    }
    if (!arrays.empty() && header.sizes.contains(kLattice)) return arrays;
    throw Error(ErrorKind::unsupported, {.file = header.path,
                                         .what = "holds no samples on a lattice (meshes, tracts and tables are not volumes)",
                                         .expected = "'define Lattice' and an array on it",
                                         .next = "resample it to a lattice in Amira or Avizo, or give a file that holds a volume"});
}

Extent extent_of(const AmiraHeader& header, std::vector<std::string>& notes) {
    const std::vector<std::int64_t>& sizes = header.sizes.at(kLattice);
    if (sizes.size() < 2 || sizes.size() > 3) bad_header(header.path, "define Lattice", std::to_string(sizes.size()) + " sizes", "2 or 3");
    Extent extent;
    std::ranges::copy(sizes, extent.size.begin());
    extent.rank = sizes.size() == 2 || sizes[2] == 1 ? 2 : 3;
    if (sizes.size() == 3 && extent.rank == 2) notes.emplace_back("the lattice has a single slice along z: read as a 2D image");
    return extent;
}

void read_box_of_centres(const AmiraHeader& header, VolumeInfo& info) {
    const AmiraParameter* box = header.find({"BoundingBox"});
    if (box == nullptr) return info.notes.emplace_back("the file has no bounding box: distances of 1 were assumed"), void();
    const std::vector<double> ends = header.numbers(*box, 6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        info.geometry.origin[axis] = ends[2 * axis];
        const double length = ends[2 * axis + 1] - ends[2 * axis];
        const std::int64_t steps = std::max<std::int64_t>(info.extent.size[axis] - 1, 1);
        const bool is_thin = info.extent.size[axis] == 1 && !(length > 0);  // its thickness is not given
        if (!is_thin) set_axis_spacing(info, static_cast<int>(axis), length / static_cast<double>(steps));
    }
}

/// Coordinates of a rectilinear lattice: those of x, y and z in a row.
void read_coordinates(const AmiraHeader& header, VolumeInfo& info) {
    const auto found = std::ranges::find(header.arrays, "Coordinates", &AmiraArray::location);
    const auto defined = header.sizes.find("Coordinates");
    std::int64_t count = 0;
    for (const std::int64_t size : info.extent.size) count = size > std::numeric_limits<std::int64_t>::max() - count ? -1 : count + size;
    if (found == header.arrays.end() || defined == header.sizes.end() || defined->second != std::vector{count} || found->components != 1)
        bad_header(header.path, "Coordinates", "the array is missing or has another size", std::to_string(count) + " numbers");
    const std::vector<double> all = read_doubles(header.path, open_array(header, *found), required_type(header, *found),
                                                 header.is_text ? needs_swap(false) : header.big_endian, count);
    std::array<std::vector<double>, 3> coordinates;
    auto next = all.begin();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        coordinates[axis].assign(next, next + info.extent.size[axis]);
        next += info.extent.size[axis];
    }
    info.geometry = rectilinear_geometry(header.path, std::move(coordinates), false);
}

/// TransformationMatrix places the volume among others: four rows, of the axes and of the origin.
void apply_transform(const AmiraHeader& header, VolumeInfo& info) {
    const AmiraParameter* parameter = header.find({"TransformationMatrix"});
    if (parameter == nullptr) return;
    const std::vector<double> matrix = header.numbers(*parameter, 16);
    if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
        return info.notes.emplace_back("the transformation of the file is not affine: it was left out"), void();
    const Geometry given = info.geometry;
    for (std::size_t row = 0; row < 3; ++row) {
        info.geometry.origin[row] = matrix[12 + row];
        for (std::size_t axis = 0; axis < 3; ++axis) info.geometry.origin[row] += matrix[4 * axis + row] * given.origin[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double scale = given.coordinates[axis].empty() ? given.spacing[axis] : 1;
        Vec3 step{};
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t k = 0; k < 3; ++k) step[row] += matrix[4 * k + row] * given.direction[k][axis] * scale;
        }
        set_axis_step(info, static_cast<int>(axis), step);
        for (double& place : info.geometry.coordinates[axis]) place *= info.geometry.spacing[axis];
        if (!given.coordinates[axis].empty()) info.geometry.spacing[axis] = 1;
    }
    require_frame(info);
}

void read_geometry(const AmiraHeader& header, VolumeInfo& info) {
    const std::string kind = header.word({"CoordType"});
    if (kind.empty() || kind == "uniform") {
        read_box_of_centres(header, info);
    } else if (kind == "rectilinear") {
        read_coordinates(header, info);
    } else {
        throw Error(ErrorKind::unsupported, {.file = header.path,
                                             .where = "CoordType",
                                             .what = "a lattice with " + in_quotes(kind) + " coordinates is not supported",
                                             .expected = "uniform or rectilinear",
                                             .next = "resample it in Amira or Avizo to uniform coordinates (Resample, Arithmetic)"});
    }
    apply_transform(header, info);
    for (double& place : info.geometry.origin) {
        if (std::isfinite(place)) continue;
        bad_header(header.path, "TransformationMatrix", "the first sample is not at a finite position", "smaller numbers");
    }
    if (const AmiraParameter* unit = header.find({"Units", "Coordinates"}); unit != nullptr && !unit->values.empty())
        info.geometry.unit = unit->values[0];
}

std::vector<std::string> component_names(const AmiraArray& array) {
    const auto count = static_cast<std::size_t>(array.components);
    if (count == 3 && (array.type == "float" || array.type == "double")) return {"x", "y", "z"};
    return std::vector<std::string>(count);
}

}  // namespace

bool looks_like_amira(FirstBytes first, const std::string&) {
    return begins_like_amira({reinterpret_cast<const char*>(first.data()), first.size()});
}

std::unique_ptr<VolumeReader> open_amira(const std::string& path, const OpenOptions& options) {
    const AmiraHeader header = read_amira_header(path);
    std::vector<ErrorChoice> choices;
    const std::vector<const AmiraArray*> arrays = lattice_arrays(header, choices);
    VolumeInfo info;
    info.path = path;
    info.format = "Amira";
    info.file_bytes = file_size(path);
    info.extent = extent_of(header, info.notes);
    const std::size_t chosen = choose_dataset(path, options, choices);
    const AmiraArray& array = *arrays[chosen];
    if (arrays.size() > 1) info.notes.push_back("the array " + choices[chosen].word);
    info.volumes.has_datasets = true;
    info.type = required_type(header, array);
    info.encoding = header.is_text ? "ascii" : array.encoding.empty() ? "raw" : array.encoding;
    info.big_endian = header.is_text ? needs_swap(false) : header.big_endian;
    static_cast<void>(sample_bytes(path, info.extent, info.type, array.components));
    constexpr std::int64_t kMaxComponents = 1 << 16;
    if (array.components > kMaxComponents)
        bad_header(path, "array " + in_quotes(array.name), std::to_string(array.components) + " components", "at most 65536");
    const TimeStep step = choose_time_step(path, options, 1);
    std::int64_t component = 0;
    if (array.components > 1) {
        info.volumes.channels = component_names(array);
        info.volumes.channel = component = choose_channel(path, options, info.volumes.channels);
    }
    read_geometry(header, info);
    std::unique_ptr<ByteSource> source =
        pick_component(open_array(header, array), static_cast<std::int64_t>(size_of(info.type)), array.components, component);
    return make_sample_reader(std::move(info), std::move(source), options, step);
}

}  // namespace isoatlas
