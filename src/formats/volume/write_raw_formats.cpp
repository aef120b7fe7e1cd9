// Formats of uncompressed samples with a short text header: MetaImage, NumPy, RAW with a sidecar.
#include <bit>

#include "base/atomic_file.h"
#include "base/output_target.h"
#include "formats/common/byte_writer.h"
#include "formats/common/json_stream.h"
#include "formats/common/volume_file.h"
#include "formats/volume/raw_description.h"
#include "isoatlas/units.h"

namespace isoatlas {

namespace {

constexpr bool kBigEndian = std::endian::native == std::endian::big;

const char* meta_type(ValueType type) {
    static constexpr const char* kNames[] = {"MET_UCHAR", "MET_CHAR", "MET_USHORT", "MET_SHORT",
                                             "MET_UINT",  "MET_INT",  "MET_FLOAT",  "MET_DOUBLE"};
    return kNames[static_cast<int>(type)];
}

/// Orientation code of an LPS grid in ITK's convention: RAI for the axes of LPS.
std::string anatomical_orientation(const Geometry& geometry) {
    static constexpr const char* kFrom[] = {"RL", "AP", "IS"};
    std::string letters;
    for (int axis = 0; axis < 3; ++axis) {
        int main = 0;
        for (int row = 1; row < 3; ++row) {
            if (std::abs(geometry.direction[row][axis]) > std::abs(geometry.direction[main][axis])) main = row;
        }
        letters += kFrom[main][geometry.direction[main][axis] < 0 ? 1 : 0];
    }
    return letters;
}

std::string meta_header(const VolumeInfo& info) {
    const Geometry geometry = turned_to(regular_geometry(info), "LPS");
    const int rank = info.extent.rank;
    std::string matrix, offset, centre, spacing, sizes;
    for (int axis = 0; axis < rank; ++axis) {
        for (int row = 0; row < rank; ++row) matrix += " " + number_text(geometry.direction[row][axis]);
        offset += " " + number_text(geometry.origin[axis]);
        centre += " 0";
        spacing += " " + number_text(geometry.spacing[axis]);
        sizes += " " + std::to_string(info.extent.size[axis]);
    }
    std::string text = "ObjectType = Image\nNDims = " + std::to_string(rank) + "\n";
    if (is_rectilinear(info.geometry)) text += "Comment = rectilinear coordinates replaced by their mean spacing\n";
    text += std::string("BinaryData = True\nBinaryDataByteOrderMSB = ") + (kBigEndian ? "True" : "False") + "\nCompressedData = False\n";
    text += "TransformMatrix =" + matrix + "\nOffset =" + offset + "\nCenterOfRotation =" + centre + "\n";
    if (rank == 3 && is_anatomical(geometry)) text += "AnatomicalOrientation = " + anatomical_orientation(geometry) + "\n";
    const std::string unit = ascii_unit(one_line(geometry.unit));
    if (!unit.empty()) text += "DistanceUnits = " + unit + "\n";
    return text + "ElementSpacing =" + spacing + "\nDimSize =" + sizes + "\nElementType = " + meta_type(info.type) +
           "\nElementDataFile = LOCAL\n";
}

std::string npy_header(const VolumeInfo& info) {
    static constexpr const char* kTypes[] = {"u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8"};
    std::string text = std::string("{'descr': '") +
                       (size_of(info.type) == 1 ? '|'
                        : kBigEndian            ? '>'
                                                : '<') +
                       kTypes[static_cast<int>(info.type)] + "', 'fortran_order': False, 'shape': (";
    for (int axis = info.extent.rank - 1; axis >= 0; --axis) text += std::to_string(info.extent.size[axis]) + (axis > 0 ? ", " : "");
    text += "), }";
    constexpr std::size_t kPreamble = 10, kAlignment = 64;  // version 1.0
    const std::size_t padding = (kAlignment - (kPreamble + text.size() + 1) % kAlignment) % kAlignment;
    text += std::string(padding, ' ') + "\n";
    const auto size = static_cast<std::uint16_t>(text.size());
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(size & 255) + static_cast<char>(size >> 8) + text;
}

/// Whether the name describes the file. Throws Error{usage} when it contradicts it.
bool name_is_enough(const std::string& path, const VolumeInfo& info) {
    const RawDescription name = description_from_name(path);
    const std::vector<std::int64_t> dims(info.extent.size.begin(), info.extent.size.begin() + info.extent.rank);
    if ((name.dims && *name.dims != dims) || (name.type && *name.type != info.type) ||
        (name.big_endian && *name.big_endian != kBigEndian)) {
        std::string size;
        for (const std::int64_t side : dims) size += (size.empty() ? "" : "x") + std::to_string(side);
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the name contradicts dims, type or byte order of the volume",
                                       .expected = size + " " + name_of(info.type) + (kBigEndian ? ", big endian" : ", little endian"),
                                       .next = "choose a name like volume_" + size + "_" + name_of(info.type) + ".raw"});
    }
    return name.dims && name.type && !kBigEndian && info.geometry == Geometry{} && info.value_unit.empty();
}

void write_sidecar(const std::string& path, const VolumeInfo& info) {
    const Geometry geometry = regular_geometry(info);
    AtomicFile file(path);
    JsonStream json(output_to(file));
    json.begin_object().key("dims").begin_array();
    for (int axis = 0; axis < info.extent.rank; ++axis) json.value(info.extent.size[axis]);
    json.end_array().key("type").value(name_of(info.type)).key("endian").value(kBigEndian ? "big" : "little");
    json.key("spacing").begin_array();
    for (int axis = 0; axis < info.extent.rank; ++axis) json.value(geometry.spacing[axis]);
    json.end_array().key("origin").begin_array();
    for (int axis = 0; axis < info.extent.rank; ++axis) json.value(geometry.origin[axis]);
    json.end_array();
    if (!geometry.unit.empty()) json.key("unit").value(geometry.unit);
    if (!info.value_unit.empty()) json.key("value_unit").value(info.value_unit);
    if (geometry.space != "unknown") json.key("space").value(geometry.space);
    json.end_object().finish();
    file.commit();
}

}  // namespace

void write_raw(Sink& sink, const SampleFeed& samples) {
    samples([&](std::span<const std::byte> bytes) { sink.write(bytes); });
}

void write_metaimage(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    sink.write(meta_header(info));
    write_raw(sink, samples);
}

void write_npy(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    sink.write(npy_header(info));
    write_raw(sink, samples);
}

void write_raw(const std::string& path, const VolumeInfo& info, const SampleFeed& samples) {
    const std::string sidecar = path + ".json";
    const bool is_replaced = require_target(sidecar).status.kind == FileStatus::Kind::regular;  // one that describes another volume
    const bool is_needed = !name_is_enough(path, info);
    AtomicFile file(path);
    write_raw(file, samples);
    file.commit();
    if (is_needed || is_replaced) write_sidecar(sidecar, info);
}

}  // namespace isoatlas
