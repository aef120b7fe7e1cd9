// A JSON document of the server: schema and kind first.
#pragma once

#include <string>
#include <utility>

#include "formats/common/json_stream.h"

namespace isoatlas {

/// write(json): the members that follow.
template <class Write>
[[nodiscard]] std::string document(const char* kind, Write&& write) {
    std::string text;
    JsonStream json([&text](std::string_view piece) { text += piece; });
    json.begin_object().key("schema").value("isoatlas/server/2").key("kind").value(kind);
    std::forward<Write>(write)(json);
    json.end_object().finish();
    return text;
}

}  // namespace isoatlas
