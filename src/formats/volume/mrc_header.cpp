#include "formats/volume/mrc_header.h"

#include <algorithm>
#include <string_view>

#include "formats/common/field_reader.h"

namespace isoatlas {
namespace {

// Offsets of fields, in bytes.
constexpr std::size_t kSizeAt = 0, kModeAt = 12, kStartAt = 16, kCellsAt = 28, kCellAt = 40, kAnglesAt = 52, kAxisAt = 64,
                      kSpaceGroupAt = 88, kExtendedAt = 92, kImodStampAt = 152, kImodFlagsAt = 156, kOriginAt = 196, kMarkAt = 208,
                      kByteOrderAt = 212, kLabelsAt = 220, kLabelAt = 224;

bool is_mode(int mode) { return (mode >= 0 && mode <= 6) || mode == 12 || mode == 16 || mode == 101; }

bool makes_sense(const FieldReader& fields) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = fields.at<std::int32_t>(kAxisAt + 4 * i);
        if (fields.at<std::int32_t>(kSizeAt + 4 * i) < 1 || axis < 0 || axis > 3) return false;
    }
    return is_mode(fields.at<std::int32_t>(kModeAt)) && fields.at<std::int32_t>(kExtendedAt) >= 0;
}

MrcHeader decoded(const FieldReader& fields, bool big_endian) {
    MrcHeader header;
    header.big_endian = big_endian;
    fields.take<std::int32_t>(kSizeAt, header.size);
    header.mode = fields.at<std::int32_t>(kModeAt);
    fields.take<std::int32_t>(kStartAt, header.start);
    fields.take<std::int32_t>(kCellsAt, header.cells);
    fields.take<float>(kCellAt, header.cell);
    fields.take<float>(kAnglesAt, header.angles);
    fields.take<std::int32_t>(kAxisAt, header.axis);
    for (int& axis : header.axis) --axis;
    header.space_group = fields.at<std::int32_t>(kSpaceGroupAt);
    header.extended_bytes = fields.at<std::int32_t>(kExtendedAt);
    fields.take<float>(kOriginAt, header.origin);
    constexpr std::int32_t kImod = 1146047817;  // "IMOD"
    constexpr std::int32_t kSigned = 1;
    header.unsigned_bytes = fields.at<std::int32_t>(kImodStampAt) == kImod && (fields.at<std::int32_t>(kImodFlagsAt) & kSigned) == 0;
    if (fields.at<std::int32_t>(kLabelsAt) > 0) header.label = fields.text(kLabelAt, 80);
    return header;
}

}  // namespace

std::optional<MrcHeader> decode_mrc(std::span<const std::byte> bytes, bool needs_mark) {
    if (static_cast<std::int64_t>(bytes.size()) < kMrcHeaderBytes) return std::nullopt;
    const std::string_view mark(reinterpret_cast<const char*>(bytes.data()) + kMarkAt, 3);
    if (needs_mark && mark != "MAP") return std::nullopt;
    const bool says_big = std::to_integer<int>(bytes[kByteOrderAt]) == 0x11;
    for (const bool big_endian : {says_big, !says_big}) {  // the stamp of some files is wrong
        const FieldReader fields(bytes, big_endian);
        if (makes_sense(fields)) return decoded(fields, big_endian);
    }
    return std::nullopt;
}

}  // namespace isoatlas
