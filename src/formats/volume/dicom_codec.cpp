#include "formats/volume/dicom_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "formats/common/field_reader.h"
#include "formats/volume/dicom_library.h"

namespace isoatlas {
namespace {

constexpr std::size_t kRleHeader = 64, kMaxSegments = 15;

/// One run of the byte planes: literal bytes and repeated ones.
bool unpack_bits(std::span<const std::byte> packed, std::span<std::byte> out, std::size_t first, std::size_t stride) {
    std::size_t at = 0, done = 0;
    const std::size_t wanted = out.size() / stride;
    while (done < wanted) {
        if (at >= packed.size()) return false;
        const int control = static_cast<std::int8_t>(std::to_integer<std::uint8_t>(packed[at++]));
        if (control == -128) continue;
        const bool is_run = control < 0;
        const auto count = static_cast<std::size_t>(is_run ? 1 - control : 1 + control);
        if (count > wanted - done || at + (is_run ? 1 : count) > packed.size()) return false;
        for (std::size_t i = 0; i < count; ++i) out[(done + i) * stride + first] = packed[is_run ? at : at + i];
        at += is_run ? 1 : count;
        done += count;
    }
    return true;
}

/// A segment for each byte of a sample, the highest first.
std::string decode_rle(const DicomPixels& pixels, std::span<const std::byte> packed, std::span<std::byte> out) {
    const std::size_t bytes = size_of(pixels.type);
    if (packed.size() < kRleHeader) return "it is shorter than the header of RLE";
    const FieldReader fields(packed, false);
    const std::size_t segments = fields.at<std::uint32_t>(0);
    if (segments != bytes || segments > kMaxSegments)
        return "it has " + std::to_string(segments) + " RLE segments, not " + std::to_string(bytes);
    for (std::size_t segment = 0; segment < segments; ++segment) {
        const std::size_t begin = fields.at<std::uint32_t>(4 + 4 * segment);
        const std::size_t end = segment + 1 < segments ? fields.at<std::uint32_t>(8 + 4 * segment) : packed.size();
        if (begin < kRleHeader || begin > end || end > packed.size()) return "the offsets of its RLE segments are wrong";
        const std::size_t place = std::endian::native == std::endian::little ? bytes - 1 - segment : segment;
        if (!unpack_bits(packed.subspan(begin, end - begin), out, place, bytes)) return "an RLE segment does not decode to its samples";
    }
    return "";
}

/// Of one code stream.
struct CodeStream {
    std::int64_t width = 0, height = 0, components = 0, bits = 0;
};

std::string difference(const DicomPixels& pixels, const CodeStream& stream) {
    const auto size = [](std::int64_t width, std::int64_t height) { return std::to_string(width) + " x " + std::to_string(height); };
    if (stream.width != pixels.columns || stream.height != pixels.rows)
        return "the compressed picture is " + size(stream.width, stream.height) + ", not " + size(pixels.columns, pixels.rows);
    if (stream.components != 1) return "the compressed picture has " + std::to_string(stream.components) + " components, not 1";
    if (stream.bits < 1 || (stream.bits + 7) / 8 * 8 != pixels.allocated)
        return "the compressed picture has " + std::to_string(stream.bits) + " bits a sample, not " + std::to_string(pixels.allocated);
    return "";
}

constexpr const char* kNoPicture = "the compressed picture has no header";

std::string jpeg_2000_contradiction(const DicomPixels& pixels, std::span<const std::byte> packed) {
    constexpr std::size_t kSizes = 6, kNeeded = 44;  // behind SOC, SIZ and its length
    if (packed.size() < kNeeded) return kNoPicture;
    const FieldReader fields(packed, true);
    if (fields.at<std::uint16_t>(2) != 0xFF51) return kNoPicture;
    const auto word = [&](std::size_t i) { return std::int64_t{fields.at<std::uint32_t>(kSizes + 2 + 4 * i)}; };
    CodeStream stream{.width = word(0) - word(2), .height = word(1) - word(3), .components = fields.at<std::uint16_t>(40), .bits = 0};
    stream.bits = (std::to_integer<int>(packed[42]) & 0x7F) + 1;
    if (word(4) < 1 || word(5) < 1 || word(6) > word(2) || word(7) > word(3)) return "the tiles of the compressed picture are wrong";
    constexpr std::int64_t kMostTiles = 65535;
    const std::int64_t tiles_x = (word(0) - word(6) + word(4) - 1) / word(4), tiles_y = (word(1) - word(7) + word(5) - 1) / word(5);
    if (tiles_x > kMostTiles || tiles_y > kMostTiles || tiles_x * tiles_y > kMostTiles)
        return "the tiles of the compressed picture are wrong";
    if (packed.size() < kNeeded + 1 || packed[43] != std::byte{1} || packed[44] != std::byte{1})
        return "the compressed picture is subsampled";
    return difference(pixels, stream);
}

bool is_frame_marker(int marker) {
    const bool is_other = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    return (marker >= 0xC0 && marker <= 0xCF && !is_other) || marker == 0xF7;
}

/// Of a segment with a length that may come before the first scan. The others, restart markers above all, stand alone for GDCM, whose next
/// marker is then another one.
bool is_header_marker(int marker) {
    constexpr std::array kOthers{0xC4, 0xCC, 0xDA, 0xDB, 0xDC, 0xDD, 0xF8, 0xFE};
    return is_frame_marker(marker) || (marker >= 0xE0 && marker <= 0xEF) || std::ranges::find(kOthers, marker) != kOthers.end();
}

}  // namespace

std::string jpeg_contradiction(const DicomPixels& pixels, std::span<const std::byte> packed) {
    const FieldReader fields(packed, true);
    if (packed.size() < 4 || packed[0] != std::byte{0xFF}) return kNoPicture;
    if (packed[1] == std::byte{0x4F}) return jpeg_2000_contradiction(pixels, packed);
    if (packed[1] != std::byte{0xD8}) return kNoPicture;
    std::optional<std::string> found;  // of the frame, once it was seen
    for (std::size_t at = 2; at + 4 <= packed.size();) {
        if (packed[at] != std::byte{0xFF}) return kNoPicture;
        const int marker = std::to_integer<int>(packed[at + 1]);
        if (marker == 0xFF) {  // padding
            ++at;
            continue;
        }
        const std::size_t length = fields.at<std::uint16_t>(at + 2);
        if (!is_header_marker(marker) || length < 2 || length > packed.size() - at - 2) return kNoPicture;
        if (marker == 0xDA) return found.value_or(kNoPicture);  // a frame without a scan ends GDCM by an assertion
        if (is_frame_marker(marker)) {
            if (found || at + 10 > packed.size()) return kNoPicture;
            found = difference(pixels, {.width = fields.at<std::uint16_t>(at + 7),
                                        .height = fields.at<std::uint16_t>(at + 5),
                                        .components = std::to_integer<int>(packed[at + 9]),
                                        .bits = std::to_integer<int>(packed[at + 4])});
        }
        at += 2 + length;
    }
    return kNoPicture;
}

std::int64_t largest_dicom_ratio(const std::string& syntax) {
    constexpr std::int64_t kDiscrete = 1 << 12,
                           kRuns = 1 << 18;  // an empty packet of JPEG 2000 stands for a tile, a bit of JPEG-LS for 2^15
    constexpr std::string_view kJpeg = "1.2.840.10008.1.2.4.";
    if (syntax == "1.2.840.10008.1.2.5") return 64;
    if (!syntax.starts_with(kJpeg)) return 0;
    const std::string_view kind = std::string_view(syntax).substr(kJpeg.size());
    if (kind == "50" || kind == "51" || kind == "57" || kind == "70") return kDiscrete;
    if (kind == "80" || kind == "81" || kind == "90" || kind == "91") return kRuns;
    return 0;
}

std::string decode_dicom_frame(const std::string& path, const std::string& syntax, const DicomPixels& pixels,
                               std::span<const std::byte> packed, std::span<std::byte> out) {
    if (syntax == "1.2.840.10008.1.2.5") return decode_rle(pixels, packed, out);
    const std::string contradiction = jpeg_contradiction(pixels, packed);
    return contradiction.empty() ? dicom_decoder(path, syntax)(syntax, pixels, packed, out) : contradiction;
}

}  // namespace isoatlas
