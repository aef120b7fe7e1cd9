// Numbers and texts at byte offsets of a binary header.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "formats/common/text.h"

namespace isoatlas {

/// Every offset must lie inside the bytes.
class FieldReader {
public:
    FieldReader(std::span<const std::byte> bytes, bool big_endian)
        : bytes_(bytes), swap_(big_endian != (std::endian::native == std::endian::big)) {}

    template <class T>
    [[nodiscard]] T at(std::size_t offset) const {
        std::array<std::byte, sizeof(T)> raw{};
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
        if (swap_) std::reverse(raw.begin(), raw.end());
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }
    template <class T, class Out, std::size_t N>
    void take(std::size_t offset, std::array<Out, N>& out) const {
        for (std::size_t i = 0; i < N; ++i) out[i] = static_cast<Out>(at<T>(offset + i * sizeof(T)));
    }
    /// Up to the first zero byte, without blanks around it.
    [[nodiscard]] std::string text(std::size_t offset, std::size_t size) const {
        const std::string_view field(reinterpret_cast<const char*>(bytes_.data()) + offset, size);
        return std::string(trim(field.substr(0, field.find('\0'))));
    }

private:
    std::span<const std::byte> bytes_;
    bool swap_;
};

}  // namespace isoatlas
