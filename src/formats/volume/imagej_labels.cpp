#include "formats/volume/imagej_labels.h"

#include <algorithm>
#include <set>

namespace isoatlas {
namespace {

std::uint32_t number(std::span<const std::byte> bytes, std::size_t size, bool big_endian) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[big_endian ? i : size - 1 - i]);
    return value;
}

void add_utf8(std::uint32_t code, std::string& text) {
    const auto add = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80) return add(code);
    if (code < 0x800) return add(0xc0 | code >> 6), add(0x80 | (code & 63));
    if (code < 0x10000) return add(0xe0 | code >> 12), add(0x80 | (code >> 6 & 63)), add(0x80 | (code & 63));
    add(0xf0 | code >> 18), add(0x80 | (code >> 12 & 63)), add(0x80 | (code >> 6 & 63)), add(0x80 | (code & 63));
}

std::string utf8_of_utf16(std::span<const std::byte> bytes, bool big_endian) {
    std::string text;
    for (std::size_t i = 0; i + 2 <= bytes.size(); i += 2) {
        std::uint32_t code = number(bytes.subspan(i), 2, big_endian);
        if (code >= 0xd800 && code < 0xdc00 && i + 4 <= bytes.size()) {
            const std::uint32_t low = number(bytes.subspan(i + 2), 2, big_endian);
            if (low >= 0xdc00 && low < 0xe000) code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00), i += 2;
        }
        if (code >= 0xd800 && code < 0xe000) code = '?';
        add_utf8(code, text);
    }
    return text;
}

}  // namespace

std::vector<std::string> imagej_labels(std::span<const std::uint32_t> counts, std::span<const std::byte> texts, bool big_endian) {
    constexpr std::uint32_t kMagic = 0x494a494a, kLabel = 0x6c61626c;  // "IJIJ", "labl"
    if (counts.empty() || counts[0] < 12 || counts[0] > texts.size() || number(texts, 4, big_endian) != kMagic) return {};
    std::size_t at = counts[0], next = 1;
    for (std::size_t kind = 4; kind + 8 <= counts[0]; kind += 8) {
        const std::uint32_t type = number(texts.subspan(kind), 4, big_endian), count = number(texts.subspan(kind + 4), 4, big_endian);
        std::vector<std::string> labels;
        for (std::uint32_t i = 0; i < count; ++i, ++next) {
            if (next >= counts.size() || counts[next] > texts.size() - at) return {};
            if (type == kLabel) labels.push_back(utf8_of_utf16(texts.subspan(at, counts[next]), big_endian));
            at += counts[next];
        }
        if (type == kLabel) return labels;
    }
    return {};
}

std::vector<std::string> channel_names_of(const std::vector<std::string>& labels, std::int64_t channels) {
    const auto count = static_cast<std::size_t>(channels);
    std::vector<std::string> names(count);
    if (labels.size() < count || labels.size() % count != 0 || count < 2) return names;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i].empty() || labels[i] != labels[i % count]) return names;
    }
    if (std::set<std::string>(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(count)).size() != count) return names;
    std::copy_n(labels.begin(), count, names.begin());
    return names;
}

}  // namespace isoatlas
