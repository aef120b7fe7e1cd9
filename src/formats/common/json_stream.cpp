#include "formats/common/json_stream.h"

#include <ostream>

#include "isoatlas/error.h"
#include "isoatlas/text.h"

namespace isoatlas {

void JsonStream::quote(std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef";
    text_ += '"';
    std::string valid;
    if (!is_utf8(text)) text = valid = written_name(text);
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text_ += '\\';
            text_ += c;
        } else if (byte < 0x20) {
            text_ += "\\u00";
            text_ += kHex[byte >> 4];
            text_ += kHex[byte & 15];
        } else {
            text_ += c;
        }
    }
    text_ += '"';
}

JsonStream::Output output_to(std::ostream& out, const char* what) {
    return [&out, what](std::string_view text) {
        if (out.write(text.data(), static_cast<std::streamsize>(text.size()))) return;
        throw Error(ErrorKind::resource,
                    {.what = std::string(what) + " cannot be written to its stream", .next = "free some space, or write it to a file"});
    };
}

}  // namespace isoatlas
