#include "server/coding.h"

#include <libdeflate.h>
#include <zstd.h>

#include <memory>

#include "base/check.h"

namespace isoatlas {
namespace {

constexpr int kQuick = 1;  ///< level of both; the next one saves 1 % of a mesh for twice the time

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// Is the coding named, and not with the weight 0?
bool allows(std::string_view accept, std::string_view coding) {
    while (!accept.empty()) {
        const std::size_t comma = accept.find(',');
        const std::string_view item = accept.substr(0, comma);
        const std::size_t semicolon = item.find(';');
        if (trimmed(item.substr(0, semicolon)) == coding) {
            if (semicolon == std::string_view::npos) return true;
            const std::string_view weight = trimmed(item.substr(semicolon + 1));
            return weight.find_first_of("123456789") != std::string_view::npos;
        }
        if (comma == std::string_view::npos) return false;
        accept.remove_prefix(comma + 1);
    }
    return false;
}

}  // namespace

std::string_view coding_for(std::string_view accept) {
    for (const std::string_view coding : {"zstd", "gzip"}) {
        if (allows(accept, coding)) return coding;
    }
    return "";
}

std::string coded(std::string_view bytes, std::string_view coding) {
    std::string result;
    if (coding == "zstd") {
        result.resize(ZSTD_compressBound(bytes.size()));
        const std::size_t size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kQuick);
        ISOATLAS_CHECK(ZSTD_isError(size) == 0);
        result.resize(size);
        return result;
    }
    if (coding != "gzip") return std::string(bytes);
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(kQuick),
                                                                                                   &libdeflate_free_compressor);
    ISOATLAS_CHECK(compressor != nullptr);
    result.resize(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
    result.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
    return result;
}

}  // namespace isoatlas
