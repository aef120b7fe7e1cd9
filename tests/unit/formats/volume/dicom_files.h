// DICOM files for tests: data sets as bytes, explicit and little endian unless told otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas::test {

/// A slice of 4 x 3 samples of 16 bits; every element can be replaced. Texts are padded.
class DicomFileBytes {
public:
    DicomFileBytes() {
        text(0x00080018, "UI", "1.2.3.4." + std::to_string(next_++));
        text(0x00080060, "CS", "MR");
        text(0x00100010, "PN", "SECRET^NAME");
        text(0x00100020, "LO", "SECRETID");
        text(0x0020000E, "UI", "1.2.3");
        text(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
        text(0x00280004, "CS", "MONOCHROME2");
        text(0x00280030, "DS", "0.5\\0.25");
        number(0x00280002, 1).number(0x00280010, 3).number(0x00280011, 4);
        number(0x00280100, 16).number(0x00280101, 16).number(0x00280102, 15).number(0x00280103, 0);
        at(0);
    }
    DicomFileBytes& text(std::uint32_t tag, const std::string& vr, std::string value) {
        if (value.size() % 2 != 0) value += vr == "UI" ? '\0' : ' ';
        elements_[tag] = {vr, std::move(value)};
        return *this;
    }
    DicomFileBytes& number(std::uint32_t tag, std::uint16_t value) {
        elements_[tag] = {"US", std::string{static_cast<char>(value & 255), static_cast<char>(value >> 8)}};
        return *this;
    }
    DicomFileBytes& without(std::uint32_t tag) {
        elements_.erase(tag);
        return *this;
    }
    DicomFileBytes& at(double z) { return at(0, 0, z); }
    DicomFileBytes& at(double x, double y, double z) { return text(0x00200032, "DS", digits(x) + "\\" + digits(y) + "\\" + digits(z)); }
    /// Samples first, first + 1, ...
    DicomFileBytes& counting(std::uint16_t first) {
        samples_.clear();
        for (std::uint16_t i = 0; i < 12; ++i) samples_ += {static_cast<char>((first + i) & 255), static_cast<char>((first + i) >> 8)};
        return *this;
    }
    DicomFileBytes& samples(std::string bytes) {
        samples_ = std::move(bytes);
        return *this;
    }
    /// Fragments of pixel data: with a transfer syntax that has them.
    DicomFileBytes& fragments(const std::vector<std::string>& all) {
        samples_.clear();
        is_encapsulated_ = true;
        samples_ += item(0xE000, "");
        for (const std::string& fragment : all) samples_ += item(0xE000, fragment.size() % 2 == 0 ? fragment : fragment + '\0');
        samples_ += item(0xE0DD, "");
        return *this;
    }
    [[nodiscard]] const std::string& pixels() const { return samples_; }

    [[nodiscard]] std::string data_set(bool is_implicit = false) const {
        std::string bytes;
        for (const auto& [tag, element] : elements_) bytes += encoded(tag, element.first, element.second, is_implicit);
        const std::string vr = is_encapsulated_ ? "OB" : "OW";
        const std::string length = is_encapsulated_ ? "\xFF\xFF\xFF\xFF" : u32(static_cast<std::uint32_t>(samples_.size()));
        return bytes + u16(0x7FE0) + u16(0x0010) + (is_implicit ? "" : vr + std::string(2, '\0')) + length + samples_;
    }
    [[nodiscard]] std::string bytes(const std::string& syntax = "1.2.840.10008.1.2.1") const {
        return meta(syntax) + data_set(syntax == "1.2.840.10008.1.2");
    }
    [[nodiscard]] static std::string meta(std::string syntax) {
        if (syntax.size() % 2 != 0) syntax += '\0';
        const std::string uid = encoded(0x00020010, "UI", syntax, false);
        return std::string(128, '\0') + "DICM" + encoded(0x00020000, "UL", u32(static_cast<std::uint32_t>(uid.size())), false) + uid;
    }
    [[nodiscard]] static std::string u16(std::uint32_t value) {
        return {static_cast<char>(value & 255), static_cast<char>(value >> 8 & 255)};
    }
    [[nodiscard]] static std::string u32(std::uint32_t value) { return u16(value & 0xFFFF) + u16(value >> 16); }
    [[nodiscard]] static std::string encoded(std::uint32_t tag, const std::string& vr, const std::string& value, bool is_implicit) {
        const std::string name = u16(tag >> 16) + u16(tag & 0xFFFF);
        const auto length = static_cast<std::uint32_t>(value.size());
        if (is_implicit) return name + u32(length) + value;
        const bool is_long = vr == "SQ" || vr == "OB" || vr == "OW" || vr == "UN";
        return name + vr + (is_long ? std::string(2, '\0') + u32(length) : u16(length)) + value;
    }
    [[nodiscard]] static std::string item(std::uint32_t element, const std::string& value) {
        return u16(0xFFFE) + u16(element) + u32(static_cast<std::uint32_t>(value.size())) + value;
    }
    [[nodiscard]] static std::string digits(double value) {
        std::array<char, 32> text{};
        return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.10g", value))};
    }

private:
    inline static int next_ = 1;
    std::map<std::uint32_t, std::pair<std::string, std::string>> elements_;
    std::string samples_;
    bool is_encapsulated_ = false;
};

}  // namespace isoatlas::test
