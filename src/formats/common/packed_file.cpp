#include "formats/common/packed_file.h"

#include "formats/common/bzip2_source.h"
#include "formats/common/compressed_source.h"
#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBytesOfMark = 10;

/// "BZh", the size of a block, and the mark of a block or, where there is none, of the end.
bool starts_like_bzip2(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.size() < kBytesOfMark || !text.starts_with("BZh") || text[3] < '1' || text[3] > '9') return false;
    const std::string_view mark = text.substr(4, 6);
    return mark == "1AY&SY" || mark == "\x17rE8P\x90";
}

}  // namespace

FilePacking packing_of(std::span<const std::byte> first) {
    if (starts_like_gzip(first)) return FilePacking::gzip;
    return starts_like_bzip2(first) ? FilePacking::bzip2 : FilePacking::none;
}

FilePacking packing_of(const std::string& path) { return packing_of(read_header_bytes(path, kBytesOfMark)); }

const char* name_of(FilePacking packing) {
    switch (packing) {
        case FilePacking::gzip: return "gzip";
        case FilePacking::bzip2: return "bzip2";
        case FilePacking::none: break;
    }
    return "raw";
}

std::string_view unpacked_name(std::string_view path) {
    for (const std::string_view end : {".gz", ".bz2"}) {
        if (ends_with_ignoring_case(path, end)) path.remove_suffix(end.size());
    }
    return path;
}

std::vector<std::byte> read_unpacked_bytes(const std::string& path, std::int64_t max) {
    switch (packing_of(path)) {
        case FilePacking::gzip: return read_inflated_bytes(path, max);
        case FilePacking::bzip2: return read_bunzipped_bytes(path, max);
        case FilePacking::none: break;
    }
    return read_header_bytes(path, max);
}

std::unique_ptr<ByteSource> open_unpacked(const std::string& path, std::int64_t offset) {
    switch (packing_of(path)) {
        case FilePacking::gzip: return skip_bytes(open_inflate_source(path), offset);
        case FilePacking::bzip2: return skip_bytes(open_bzip2_source(path), offset);
        case FilePacking::none: break;
    }
    return open_file_source(path, offset);
}

}  // namespace isoatlas
