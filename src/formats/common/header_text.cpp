#include "formats/common/header_text.h"

#include "formats/common/byte_source.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFirstPiece = 64 * 1024;
constexpr std::int64_t kLongestHeader = 16 * 1024 * 1024;  // room for lists of a hundred thousand file names

}  // namespace

HeaderText read_header_text(const std::string& path, const std::function<std::optional<std::size_t>(std::string_view)>& find_end) {
    for (std::int64_t piece = kFirstPiece; piece <= kLongestHeader; piece *= 16) {
        const std::vector<std::byte> bytes = read_header_bytes(path, piece);
        std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (const std::optional<std::size_t> end = find_end(text)) {
            text.resize(*end);
            return {std::move(text), static_cast<std::int64_t>(*end), true};
        }
        if (static_cast<std::int64_t>(bytes.size()) < piece) return {std::move(text), static_cast<std::int64_t>(bytes.size()), false};
    }
    throw Error(ErrorKind::input, {.file = path,
                                   .where = "header",
                                   .what = "the header does not end within " + std::to_string(kLongestHeader) + " bytes",
                                   .next = "the file is damaged or of another format"});
}

std::string_view take_line(std::string_view text, std::size_t& begin) {
    const std::size_t end = text.find('\n', begin);
    std::string_view line = text.substr(begin, end == std::string_view::npos ? end : end - begin);
    begin = end == std::string_view::npos ? text.size() : end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

}  // namespace isoatlas
