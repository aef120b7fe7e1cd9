#include "formats/volume/dicom_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/check.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/dicom_codec.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

[[noreturn]] void unsupported_picture(const std::string& path, const std::string& what, const std::string& expected,
                                      const std::string& next) {
    throw Error(ErrorKind::unsupported, {.file = path, .where = "header", .what = what, .expected = expected, .next = next});
}

std::int64_t whole_number(const DicomHeader& header, DicomTag tag, const char* name, std::int64_t missing, std::int64_t least,
                          std::int64_t most) {
    const std::string* text = header.values.find(tag);
    if (text == nullptr || text->empty()) {
        if (missing >= 0) return missing;
        bad_header(header.path, name, "is missing", "a whole number");
    }
    const std::optional<double> value = header.values.number(tag);
    if (!value || *value != std::floor(*value) || *value < static_cast<double>(least) || *value > static_cast<double>(most))
        bad_header(header.path, name, "is " + in_quotes(*text), std::to_string(least) + " to " + std::to_string(most));
    return static_cast<std::int64_t>(*value);
}

ValueType type_of_bits(const DicomHeader& header, const DicomPixels& pixels) {
    if (header.pixel_tag == kDicomFloatPixels) return ValueType::f32;
    if (header.pixel_tag == kDicomDoublePixels) return ValueType::f64;
    switch (pixels.allocated) {
        case 8: return pixels.is_signed ? ValueType::i8 : ValueType::u8;
        case 16: return pixels.is_signed ? ValueType::i16 : ValueType::u16;
        case 32: return pixels.is_signed ? ValueType::i32 : ValueType::u32;
        default: break;
    }
    unsupported_picture(header.path, "samples have " + std::to_string(pixels.allocated) + " bits", "8, 16 or 32 bits",
                        "convert the file, e.g. with dcmconv or gdcmconv");
}

void check_syntax(const DicomHeader& header) {
    if (!header.syntax.encapsulated) {
        if (header.pixel_bytes < 0)
            bad_header(header.path, "pixel data", "are in fragments, but not compressed", "samples of a known size");
        return;
    }
    if (largest_dicom_ratio(header.syntax.uid) > 0 && header.pixel_bytes < 0) return;
    const std::string name = name_of_syntax(header.syntax.uid);
    if (largest_dicom_ratio(header.syntax.uid) > 0) bad_header(header.path, "pixel data", "are not in fragments", "fragments of " + name);
    unsupported_picture(header.path, "the pictures are compressed by " + name + ", which is not decoded",
                        "raw, RLE, JPEG, JPEG-LS or JPEG 2000", "decompress the files, e.g. with dcmdjpeg or the tools of their program");
}

void check_size(const DicomHeader& header, const DicomPixels& pixels) {
    const std::int64_t wanted = sample_bytes(header.path, {3, {pixels.columns, pixels.rows, pixels.frames}}, pixels.type);
    if (!header.syntax.encapsulated) {
        if (header.pixel_bytes >= wanted) return;
        bad_header(header.path, "pixel data", "the picture has " + std::to_string(header.pixel_bytes) + " bytes",
                   std::to_string(wanted) + " bytes");
    }
    const std::int64_t ratio = largest_dicom_ratio(header.syntax.uid);
    if (wanted / ratio > header.bound) {
        bad_header(header.path, "pixel data",
                   "the file is truncated: it has " + std::to_string(header.bound) + " bytes of compressed pictures",
                   "enough for " + std::to_string(wanted) + " bytes");
    }
}

/// Takes the stored bits out of samples that have others above or below them.
template <class T>
void keep_stored_bits(std::span<std::byte> samples, const DicomPixels& pixels) {
    using Bits = std::make_unsigned_t<T>;
    const int width = static_cast<int>(8 * sizeof(T)), up = width - 1 - pixels.high_bit, down = width - pixels.stored;
    for (std::size_t at = 0; at < samples.size(); at += sizeof(T)) {
        Bits bits{};
        std::memcpy(&bits, samples.data() + at, sizeof(T));
        bits = static_cast<Bits>(bits << up);
        const T value = static_cast<T>(static_cast<T>(bits) >> down);
        std::memcpy(samples.data() + at, &value, sizeof(T));
    }
}

void keep_stored_bits(std::span<std::byte> samples, const DicomPixels& pixels) {
    if (pixels.stored == pixels.allocated) return;
    switch (pixels.type) {
        case ValueType::u8: return keep_stored_bits<std::uint8_t>(samples, pixels);
        case ValueType::i8: return keep_stored_bits<std::int8_t>(samples, pixels);
        case ValueType::u16: return keep_stored_bits<std::uint16_t>(samples, pixels);
        case ValueType::i16: return keep_stored_bits<std::int16_t>(samples, pixels);
        case ValueType::u32: return keep_stored_bits<std::uint32_t>(samples, pixels);
        case ValueType::i32: return keep_stored_bits<std::int32_t>(samples, pixels);
        default: break;
    }
}

}  // namespace

DicomPixels dicom_pixels(const DicomHeader& header) {
    constexpr std::int64_t kMost16 = 0xFFFF, kMostFrames = std::numeric_limits<std::int32_t>::max();
    const std::int64_t colours = whole_number(header, kDicomSamplesPerPixel, "SamplesPerPixel", 1, 1, kMost16);
    if (colours != 1)
        unsupported_picture(header.path, std::to_string(colours) + " values per pixel (colour)", "one value per pixel",
                            "convert it to grey values");
    DicomPixels pixels;
    pixels.rows = whole_number(header, kDicomRows, "Rows", -1, 1, kMost16);
    pixels.columns = whole_number(header, kDicomColumns, "Columns", -1, 1, kMost16);
    pixels.frames = whole_number(header, kDicomNumberOfFrames, "NumberOfFrames", 1, 1, kMostFrames);
    const bool is_floating_point = header.pixel_tag != kDicomPixels;
    const std::int64_t bits = header.pixel_tag == kDicomDoublePixels ? 64 : is_floating_point ? 32 : -1;
    pixels.allocated = static_cast<int>(whole_number(header, kDicomBitsAllocated, "BitsAllocated", bits, 1, 64));
    pixels.is_signed = whole_number(header, kDicomPixelRepresentation, "PixelRepresentation", 0, 0, 1) == 1;
    pixels.type = type_of_bits(header, pixels);
    if (is_floating_point) {
        pixels.allocated = pixels.stored = static_cast<int>(bits);
        pixels.high_bit = pixels.stored - 1;
    } else {
        pixels.stored = static_cast<int>(whole_number(header, kDicomBitsStored, "BitsStored", pixels.allocated, 1, pixels.allocated));
        pixels.high_bit =
            static_cast<int>(whole_number(header, kDicomHighBit, "HighBit", pixels.stored - 1, pixels.stored - 1, pixels.allocated - 1));
    }
    check_syntax(header);
    check_size(header, pixels);
    if (!header.frames.empty() && static_cast<std::int64_t>(header.frames.size()) != pixels.frames) {
        bad_header(header.path, "PerFrameFunctionalGroups", "describes " + std::to_string(header.frames.size()) + " frames",
                   std::to_string(pixels.frames) + " as NumberOfFrames says");
    }
    return pixels;
}

DicomFrames::DicomFrames(DicomHeader header, const DicomPixels& pixels) : header_(std::move(header)), pixels_(pixels) {
    input_ = header_.syntax.deflated ? open_deflated_dicom_input(header_.path, header_.data_set) : open_dicom_input(header_.path);
}

void DicomFrames::damaged(const std::string& what, const std::string& expected) const {
    throw Error(
        ErrorKind::input,
        {.file = header_.path, .where = "pixel data", .what = what, .expected = expected, .next = "the file is damaged: get it again"});
}

void DicomFrames::read(std::int64_t frame, std::span<std::byte> out) {
    ISOATLAS_CHECK(frame >= 0 && frame < pixels_.frames && static_cast<std::int64_t>(out.size()) == pixels_.frame_bytes());
    if (header_.syntax.encapsulated) {
        read_encapsulated(frame, out);
    } else {
        read_native(frame, out);
    }
    keep_stored_bits(out, pixels_);
}

void DicomFrames::read_native(std::int64_t frame, std::span<std::byte> out) {
    input_->seek(header_.pixels + frame * pixels_.frame_bytes());
    const std::size_t got = input_->read(out);
    if (got < out.size())
        damaged("the file ends early", std::to_string(out.size() - got) + " more bytes of frame " + std::to_string(frame));
    if (needs_swap(header_.syntax.big_endian)) swap_bytes(out, size_of(pixels_.type));
}

/// An item with the offsets of the frames, then the fragments up to a delimiter.
void DicomFrames::list_fragments() {
    if (is_listed_) return;
    std::int64_t position = header_.pixels;
    const std::int64_t end = input_->size_bound();
    for (bool is_first = true;; is_first = false) {
        std::array<std::byte, 8> head;
        input_->seek(position);
        if (input_->read(head) < head.size()) damaged("the file ends between its fragments", "the end of the sequence of fragments");
        const auto word = [&](std::size_t at) {
            std::uint32_t value = 0;
            for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(head[at + i]);
            return value;
        };
        const std::uint32_t tag = word(0);
        const std::int64_t bytes = word(4);
        if (tag == 0xE0DDFFFE) break;
        if (tag != 0xE000FFFE || bytes > end - position - 8)
            damaged("a fragment at byte " + std::to_string(position) + " is wrong", "an item inside the file");
        if (!is_first) {
            fragments_.push_back({position + 8, bytes});
        } else if (bytes / 4 == pixels_.frames) {
            std::vector<std::byte> table(static_cast<std::size_t>(bytes));
            if (input_->read(table) < table.size()) damaged("the file ends inside the table of frames", "the whole table");
            for (std::size_t at = 0; at + 4 <= table.size(); at += 4) {
                std::uint32_t offset = 0;
                for (std::size_t i = 4; i-- > 0;) offset = offset << 8 | std::to_integer<std::uint32_t>(table[at + i]);
                offsets_.push_back(offset);
            }
        }
        position += 8 + bytes;
    }
    is_listed_ = true;
}

std::span<const DicomFrames::Fragment> DicomFrames::fragments_of(std::int64_t frame) const {
    if (pixels_.frames == 1) return fragments_;
    const auto at = static_cast<std::size_t>(frame);
    if (static_cast<std::int64_t>(fragments_.size()) == pixels_.frames) return std::span(fragments_).subspan(at, 1);
    if (offsets_.empty() || fragments_.empty())
        damaged(std::to_string(fragments_.size()) + " fragments for " + std::to_string(pixels_.frames) + " frames",
                "one for each, or a table of them");
    const std::int64_t base = fragments_.front().begin, first = base + offsets_[at];
    const std::int64_t last = at + 1 < offsets_.size() ? base + offsets_[at + 1] : std::numeric_limits<std::int64_t>::max();
    const auto begin = std::ranges::lower_bound(fragments_, first, {}, &Fragment::begin);
    const auto end = std::ranges::lower_bound(fragments_, last, {}, &Fragment::begin);
    if (begin == fragments_.end() || begin->begin != first || begin >= end)
        damaged("the table of frames is wrong", "the offset of frame " + std::to_string(frame));
    return {begin, end};
}

void DicomFrames::read_encapsulated(std::int64_t frame, std::span<std::byte> out) {
    list_fragments();
    std::vector<std::byte> packed;
    for (const Fragment& fragment : fragments_of(frame)) {
        const std::size_t before = packed.size();
        packed.resize(before + static_cast<std::size_t>(fragment.bytes));
        input_->seek(fragment.begin);
        if (input_->read(std::span(packed).subspan(before)) < static_cast<std::size_t>(fragment.bytes))
            damaged("the file ends early", "a whole fragment");
    }
    const std::int64_t ratio = largest_dicom_ratio(header_.syntax.uid);
    const std::string where = "frame " + std::to_string(frame) + " cannot be decoded: ";
    if (static_cast<std::int64_t>(out.size()) / ratio > static_cast<std::int64_t>(packed.size()))
        damaged(where + "it has " + std::to_string(packed.size()) + " bytes", "enough for its samples");
    const std::string wrong = decode_dicom_frame(header_.path, header_.syntax.uid, pixels_, packed, out);
    if (!wrong.empty()) damaged(where + wrong, name_of_syntax(header_.syntax.uid));
}

}  // namespace isoatlas
