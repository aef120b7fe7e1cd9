#include "formats/volume/dicom_header.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "formats/common/field_reader.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/dicom_input.h"
#include "formats/volume/dicom_wanted.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kUndefined = 0xFFFFFFFF;
constexpr std::int64_t kMaxValue = 1 << 20;  // bytes of a wanted element
constexpr std::size_t kMaxSequenceDepth = 64;
constexpr std::size_t kDicomPreamble = 128;
constexpr DicomTag kGroupLength = 0x00020000;

std::string tag_name(DicomTag tag) {
    static constexpr char kDigits[] = "0123456789ABCDEF";
    std::string name = "(";
    for (int digit = 7; digit >= 0; --digit) {
        name += kDigits[tag >> (4 * digit) & 15U];
        if (digit == 4) name += ",";
    }
    return name + ")";
}

bool is_vr(std::string_view vr) {
    static constexpr std::string_view kAll =
        "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC UI UL UN UR US UT UV ";
    const std::size_t at = kAll.find(vr);
    return vr.size() == 2 && at != std::string_view::npos && at % 3 == 0;
}

/// These have a length of 4 bytes behind 2 that are unused.
bool has_long_length(std::string_view vr) {
    static constexpr std::string_view kLong = "OB OD OF OL OV OW SQ SV UC UN UR UT UV ";
    const std::size_t at = kLong.find(vr);
    return at != std::string_view::npos && at % 3 == 0;
}

DicomSyntax syntax_of(const std::string& uid) {
    DicomSyntax syntax{.uid = uid};
    if (uid == "1.2.840.10008.1.2") {
        syntax.is_implicit = true;
    } else if (uid == "1.2.840.10008.1.2.2") {
        syntax.big_endian = true;
    } else if (uid == "1.2.840.10008.1.2.1.99") {
        syntax.deflated = true;
    } else {
        syntax.encapsulated = uid != "1.2.840.10008.1.2.1";
    }
    return syntax;
}

template <class T>
std::string numbers_of(const FieldReader& fields, std::size_t bytes) {
    std::string text;
    for (std::size_t at = 0; at + sizeof(T) <= bytes; at += sizeof(T)) {
        if (!text.empty()) text += "\\";
        if constexpr (std::is_floating_point_v<T>) {
            std::array<char, 32> digits{};
            const double value = fields.at<T>(at);
            const int length = std::snprintf(digits.data(), digits.size(), "%.17g", value);
            text += std::string_view(digits.data(), static_cast<std::size_t>(std::max(length, 0)));
        } else {
            text += std::to_string(fields.at<T>(at));
        }
    }
    return text;
}

class DicomParser {
public:
    explicit DicomParser(const std::string& path) : path_(path), input_(open_dicom_input(path)) {
        header_.path = path;
        header_.file_bytes = input_->size_bound();
    }

    DicomHeader parse() {
        read_meta();
        while (step()) {
        }
        return std::move(header_);
    }

private:
    struct Level {
        DicomTag sequence = 0;
        std::int64_t end = 0;  ///< max: where a delimiter says so
        bool is_item = false, is_wanted = false, is_implicit = false, has_fragments = false;
    };
    struct Element {
        DicomTag tag = 0;
        std::string vr;
        std::int64_t length = 0;
    };

    [[noreturn]] void truncated(DicomTag tag) const {
        bad_header(path_, "element " + tag_name(tag) + " at byte " + std::to_string(input_->position()), "the file ends early",
                   "the whole element");
    }
    [[noreturn]] void damaged(DicomTag tag, const std::string& what, const std::string& expected) const {
        bad_header(path_, "element " + tag_name(tag) + " at byte " + std::to_string(input_->position()), what, expected);
    }

    template <std::size_t N>
    bool take(std::array<std::byte, N>& bytes) {
        return input_->read(bytes) == N;
    }
    std::uint32_t u32(std::span<const std::byte> bytes) const { return FieldReader(bytes, big_endian_).at<std::uint32_t>(0); }
    std::uint16_t u16(std::span<const std::byte> bytes) const { return FieldReader(bytes, big_endian_).at<std::uint16_t>(0); }

    /// nullopt: the end of the file.
    std::optional<DicomTag> read_tag() {
        std::array<std::byte, 4> bytes;
        const std::size_t got = input_->read(bytes);
        if (got == 0) return std::nullopt;
        if (got < 4) truncated(0);
        return DicomTag{u16(bytes)} << 16 | u16(std::span(bytes).subspan(2));
    }
    std::int64_t read_length(DicomTag tag) {
        std::array<std::byte, 4> bytes;
        if (!take(bytes)) truncated(tag);
        return u32(bytes);
    }
    Element read_element(DicomTag tag, bool is_implicit) {
        Element element{.tag = tag, .vr = "", .length = 0};
        if (is_implicit || tag >> 16 == 0xFFFE) {
            element.length = read_length(tag);
            return element;
        }
        std::array<std::byte, 4> bytes;
        if (!take(bytes)) truncated(tag);
        element.vr = {static_cast<char>(bytes[0]), static_cast<char>(bytes[1])};
        if (!is_vr(element.vr)) damaged(tag, "its type " + in_quotes(element.vr) + " is not known", "two letters such as DS");
        element.length = has_long_length(element.vr) ? read_length(tag) : u16(std::span(bytes).subspan(2));
        return element;
    }
    void skip(DicomTag tag, std::int64_t length) {
        const std::int64_t end = input_->position() + length;
        if (end > input_->size_bound()) truncated(tag);
        input_->seek(end);
    }

    void read_meta();
    void read_meta_elements(std::int64_t begin);
    void begin_data_set(const std::string& uid);
    bool step();
    bool step_sequence(Level& level, DicomTag tag);
    bool step_element(DicomTag tag);
    void push(Level level);
    void store(const WantedElement& wanted, const Element& element);
    void found_pixels(const Element& element);
    DicomValues& values_here();

    std::string path_;
    std::unique_ptr<DicomInput> input_;
    DicomHeader header_;
    bool big_endian_ = false;
    std::vector<Level> levels_;
};

void DicomParser::read_meta() {
    std::array<std::byte, kDicomPreamble + 4> first{};
    const std::size_t got = input_->read(first);
    const bool has_preamble = got == first.size() && std::memcmp(first.data() + kDicomPreamble, "DICM", 4) == 0;
    const std::int64_t begin = has_preamble ? static_cast<std::int64_t>(first.size()) : 0;
    if (!has_preamble && !starts_like_dicom(std::span(first).first(got)))
        bad_header(path_, "byte 0", "is not that of a DICOM file", "\"DICM\" at byte 128");
    read_meta_elements(begin);
}

/// The group 0002, which is always explicit and little endian.
void DicomParser::read_meta_elements(std::int64_t begin) {
    std::string uid;
    std::int64_t position = begin, end = std::numeric_limits<std::int64_t>::max();
    input_->seek(position);
    while (position < end) {
        const std::optional<DicomTag> tag = read_tag();
        if (!tag || *tag >> 16 != 2) break;
        const Element element = read_element(*tag, false);
        if (element.length > header_.file_bytes - input_->position()) truncated(*tag);
        if (*tag == kDicomTransferSyntax || *tag == kGroupLength) {
            std::string value(static_cast<std::size_t>(std::min<std::int64_t>(element.length, 64)), '\0');
            if (input_->read(std::as_writable_bytes(std::span(value))) < value.size()) truncated(*tag);
            input_->seek(input_->position() - static_cast<std::int64_t>(value.size()));
            if (*tag == kDicomTransferSyntax) uid = trim(value.substr(0, value.find('\0')));
            if (*tag == kGroupLength && value.size() == 4) end = input_->position() + 4 + u32(std::as_bytes(std::span(value)));
        }
        skip(*tag, element.length);
        position = input_->position();
    }
    input_->seek(position);
    begin_data_set(uid);
}

/// Without a transfer syntax the first element tells the encoding.
void DicomParser::begin_data_set(const std::string& uid) {
    const std::int64_t position = input_->position();
    std::array<std::byte, 6> first{};
    const bool has_element = take(first);
    input_->seek(position);
    const std::string_view vr(reinterpret_cast<const char*>(first.data()) + 4, 2);
    if (!uid.empty()) {
        header_.syntax = syntax_of(uid);
    } else if (has_element && first[0] == std::byte{0} && first[1] != std::byte{0}) {
        header_.syntax = syntax_of("1.2.840.10008.1.2.2");
    } else {
        header_.syntax = syntax_of(is_vr(vr) ? "1.2.840.10008.1.2.1" : "1.2.840.10008.1.2");
    }
    // Some writers name the explicit syntax and write the implicit one.
    if (!header_.syntax.deflated && !header_.syntax.is_implicit && has_element && !is_vr(vr)) header_.syntax.is_implicit = true;
    big_endian_ = header_.syntax.big_endian;
    header_.data_set = position;
    if (header_.syntax.deflated) input_ = open_deflated_dicom_input(path_, position);
}

bool DicomParser::step() {
    while (!levels_.empty() && input_->position() >= levels_.back().end) {
        if (input_->position() > levels_.back().end)
            damaged(levels_.back().sequence, "its items are longer than the sequence", "items inside it");
        levels_.pop_back();
    }
    const std::optional<DicomTag> tag = read_tag();
    if (!tag) {
        if (!levels_.empty()) truncated(levels_.back().sequence);
        return false;
    }
    if (!levels_.empty() && !levels_.back().is_item) return step_sequence(levels_.back(), *tag);
    if (*tag == kDicomItemEnd && !levels_.empty()) {
        static_cast<void>(read_length(*tag));
        levels_.pop_back();
        return true;
    }
    return step_element(*tag);
}

/// Between the items of a sequence, or the fragments of an icon.
bool DicomParser::step_sequence(Level& level, DicomTag tag) {
    const std::int64_t length = read_length(tag);
    if (tag == kDicomSequenceEnd) {
        levels_.pop_back();
        return true;
    }
    if (tag != kDicomItem) damaged(tag, "is not an item of the sequence " + tag_name(level.sequence), "an item");
    if (level.has_fragments) {
        skip(tag, length);
        return true;
    }
    if (level.is_wanted && level.sequence == kDicomPerFrame) header_.frames.emplace_back();
    push({.sequence = level.sequence,
          .end = length == kUndefined ? std::numeric_limits<std::int64_t>::max() : input_->position() + length,
          .is_item = true,
          .is_wanted = level.is_wanted,
          .is_implicit = level.is_implicit});
    return true;
}

void DicomParser::push(Level level) {
    if (levels_.size() >= kMaxSequenceDepth)
        damaged(level.sequence, "sequences lie in sequences too deeply", "at most " + std::to_string(kMaxSequenceDepth) + " levels");
    levels_.push_back(level);
}

/// False: the picture follows, or the file ends.
bool DicomParser::step_element(DicomTag tag) {
    const bool is_implicit = levels_.empty() ? header_.syntax.is_implicit : levels_.back().is_implicit;
    const bool is_wanted = levels_.empty() || levels_.back().is_wanted;
    const DicomTag parent = levels_.empty() ? 0 : levels_.back().sequence;
    const Element element = read_element(tag, is_implicit);
    if (levels_.empty() && (tag == kDicomPixels || tag == kDicomFloatPixels || tag == kDicomDoublePixels)) {
        found_pixels(element);
        return false;
    }
    const WantedElement* wanted = is_wanted ? find_wanted_element(parent, tag) : nullptr;
    const bool is_sequence =
        wanted != nullptr && wanted->holds == DicomHolds::sequence && (element.vr.empty() || element.vr == "SQ" || element.vr == "UN");
    if (is_sequence || element.length == kUndefined) {
        push({.sequence = tag,
              .end = element.length == kUndefined ? std::numeric_limits<std::int64_t>::max() : input_->position() + element.length,
              .is_item = false,
              .is_wanted = is_sequence,
              .is_implicit = is_implicit || element.vr == "UN",
              .has_fragments = element.vr.empty() ? tag == kDicomPixels : element.vr != "SQ" && element.vr != "UN"});
    } else if (wanted != nullptr && wanted->holds != DicomHolds::sequence) {
        store(*wanted, element);
    } else {
        skip(tag, element.length);
    }
    return true;
}

DicomValues& DicomParser::values_here() {
    for (const Level& level : levels_) {
        if (level.sequence == kDicomShared) return header_.shared;
        if (level.sequence == kDicomPerFrame) return header_.frames.back();
    }
    return header_.values;
}

void DicomParser::store(const WantedElement& wanted, const Element& element) {
    if (element.length > kMaxValue || element.length > input_->size_bound() - input_->position()) {
        if (element.length <= kMaxValue) truncated(element.tag);
        return skip(element.tag, element.length);
    }
    std::string value(static_cast<std::size_t>(element.length), '\0');
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(value));
    if (input_->read(bytes) < bytes.size()) truncated(element.tag);
    const FieldReader fields(bytes, big_endian_);
    const bool is_double = wanted.holds == DicomHolds::f64 && bytes.size() % sizeof(double) == 0;
    if (wanted.holds == DicomHolds::text) {
        values_here().add(element.tag, std::string(trim(value.substr(0, value.find('\0')))));
    } else if (is_double) {
        values_here().add(element.tag, numbers_of<double>(fields, bytes.size()));
    } else if (bytes.size() == sizeof(std::uint32_t)) {  // of type UL
        values_here().add(element.tag, numbers_of<std::uint32_t>(fields, bytes.size()));
    } else if (wanted.holds == DicomHolds::u16_or_i16 &&
               (element.vr == "SS" || (element.vr != "US" && header_.values.text(kDicomPixelRepresentation) == "1"))) {
        values_here().add(element.tag, numbers_of<std::int16_t>(fields, bytes.size()));
    } else {
        values_here().add(element.tag, numbers_of<std::uint16_t>(fields, bytes.size()));
    }
}

void DicomParser::found_pixels(const Element& element) {
    header_.pixel_tag = element.tag;
    header_.pixels = input_->position();
    header_.pixel_bytes = element.length == kUndefined ? -1 : element.length;
    header_.bound = std::max<std::int64_t>(0, input_->size_bound() - header_.pixels);
    if (element.length != kUndefined && element.length > header_.bound) {
        bad_header(path_, "pixel data at byte " + std::to_string(header_.pixels),
                   "the file is truncated: it has " + std::to_string(header_.bound) + " bytes of the picture",
                   std::to_string(element.length) + " bytes");
    }
}

}  // namespace

bool starts_like_dicom(std::span<const std::byte> first) {
    if (first.size() >= kDicomPreamble + 4 && std::memcmp(first.data() + kDicomPreamble, "DICM", 4) == 0) return true;
    constexpr std::size_t kElement = 8;
    if (first.size() < 2 * kElement) return false;
    const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(first[i]); };
    const std::uint32_t group = byte(0) | byte(1) << 8, element = byte(2) | byte(3) << 8;
    const std::string_view vr(reinterpret_cast<const char*>(first.data()) + 4, 2);
    constexpr std::uint32_t kShort = 128;
    if (group == 0x0800) return byte(2) == 0 && byte(3) <= 0x18 && is_vr(vr) && byte(6) == 0 && byte(7) < kShort;  // big endian
    if ((group != 8 && group != 2) || element > 0x18) return false;
    if (is_vr(vr)) return byte(6) < kShort && byte(7) == 0;
    // implicit: the element behind it is of the group 0008 as well
    const std::uint32_t length = byte(4), next = kElement + length;
    if (group != 8 || length >= kShort || byte(5) != 0 || byte(6) != 0 || byte(7) != 0 || first.size() < next + 4) return false;
    return byte(next) == 8 && byte(next + 1) == 0 && (byte(next + 2) | byte(next + 3) << 8) > element;
}

DicomHeader read_dicom_header(const std::string& path) { return DicomParser(path).parse(); }

}  // namespace isoatlas
