#include "formats/volume/mrc_header.h"

#include <algorithm>
#include <string_view>

#include "formats/common/field_reader.h"

namespace isoatlas {
namespace {

constexpr std::size_t kSize = 0, kMode = 12, kStart = 16, kCells = 28, kCell = 40, kAngles = 52, kAxis = 64, kSpaceGroup = 88,
                      kExtended = 92, kImodStamp = 152, kImodFlags = 156, kOrigin = 196, kMark = 208, kByteOrder = 212, kLabels = 220,
                      kLabel = 224;

bool is_mode(int mode) { return (mode >= 0 && mode <= 6) || mode == 12 || mode == 16 || mode == 101; }

bool makes_sense(const FieldReader& fields) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = fields.at<std::int32_t>(kAxis + 4 * i);
        if (fields.at<std::int32_t>(kSize + 4 * i) < 1 || axis < 0 || axis > 3) return false;
    }
    return is_mode(fields.at<std::int32_t>(kMode)) && fields.at<std::int32_t>(kExtended) >= 0;
}

MrcHeader decoded(const FieldReader& fields, bool big_endian) {
    MrcHeader header;
    header.big_endian = big_endian;
    fields.take<std::int32_t>(kSize, header.size);
    header.mode = fields.at<std::int32_t>(kMode);
    fields.take<std::int32_t>(kStart, header.start);
    fields.take<std::int32_t>(kCells, header.cells);
    fields.take<float>(kCell, header.cell);
    fields.take<float>(kAngles, header.angles);
    fields.take<std::int32_t>(kAxis, header.axis);
    for (int& axis : header.axis) --axis;
    header.space_group = fields.at<std::int32_t>(kSpaceGroup);
    header.extended_bytes = fields.at<std::int32_t>(kExtended);
    fields.take<float>(kOrigin, header.origin);
    constexpr std::int32_t kImod = 1146047817;  // "IMOD"
    constexpr std::int32_t kSigned = 1;
    header.unsigned_bytes = fields.at<std::int32_t>(kImodStamp) == kImod && (fields.at<std::int32_t>(kImodFlags) & kSigned) == 0;
    if (fields.at<std::int32_t>(kLabels) > 0) header.label = fields.text(kLabel, 80);
    return header;
}

}  // namespace

std::optional<MrcHeader> decode_mrc(std::span<const std::byte> bytes, bool needs_mark) {
    if (static_cast<std::int64_t>(bytes.size()) < kMrcHeaderBytes) return std::nullopt;
    const std::string_view mark(reinterpret_cast<const char*>(bytes.data()) + kMark, 3);
    if (needs_mark && mark != "MAP") return std::nullopt;
    const bool says_big = std::to_integer<int>(bytes[kByteOrder]) == 0x11;
    for (const bool big_endian : {says_big, !says_big}) {  // the stamp of some files is wrong
        const FieldReader fields(bytes, big_endian);
        if (makes_sense(fields)) return decoded(fields, big_endian);
    }
    return std::nullopt;
}

}  // namespace isoatlas
