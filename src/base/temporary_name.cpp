#include "base/temporary_name.h"

#include <array>
#include <cstdint>
#include <random>

namespace isoatlas {
namespace {

constexpr std::string_view kBegin = ".isoatlas-", kEnd = ".partial";
constexpr std::size_t kRandom = 16, kCheck = 8;

std::string hexadecimal(std::uint64_t number, std::size_t digits) {
    std::string text(digits, '0');
    for (std::size_t i = digits; i-- > 0; number >>= 4U) text[i] = "0123456789abcdef"[number & 15U];
    return text;
}

/// FNV-1a: guards against accidental names, not against malice, for which the owner of the file is checked.
std::string check_of(std::string_view digits) {
    std::uint32_t sum = 2166136261U;
    for (const char c : digits) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619U;
    return hexadecimal(sum, kCheck);
}

}  // namespace

std::string temporary_name() {
    static_assert(std::random_device::max() == 0xffffffffU);
    std::random_device random;
    const std::string digits = hexadecimal(random(), kRandom / 2) + hexadecimal(random(), kRandom / 2);
    return std::string(kBegin) + digits + check_of(digits) + std::string(kEnd);
}

bool is_temporary_name(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    if (name.size() != kBegin.size() + kRandom + kCheck + kEnd.size() || !name.starts_with(kBegin) || !name.ends_with(kEnd)) return false;
    return name.substr(kBegin.size() + kRandom, kCheck) == check_of(name.substr(kBegin.size(), kRandom));
}

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

}  // namespace isoatlas
