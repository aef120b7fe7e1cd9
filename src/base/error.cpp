#include "isoatlas/error.h"

#include <utility>

#include "isoatlas/text.h"

namespace isoatlas {

std::string describe(const ErrorText& text) {
    std::string line;
    for (const std::string& part : {text.file, text.where}) {
        if (!part.empty()) line += part + ": ";
    }
    line += text.what;
    if (!text.expected.empty()) line += " (expected " + text.expected + ")";
    if (!text.next.empty()) line += ". Next: " + text.next;
    return shown_name(line);  // a path may hold any byte
}

Error::Error(ErrorKind kind, ErrorText text) : std::runtime_error(describe(text)), kind_(kind), text_(std::move(text)) {}

}  // namespace isoatlas
