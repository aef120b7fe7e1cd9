#include "formats/common/json_file.h"

#include <memory>
#include <span>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {

nlohmann::ordered_json read_json_file(const std::string& path, const std::string& schema, const std::string& what, const std::string& next,
                                      const JsonFileLimits& limits) {
    const auto damaged = [&](const std::string& where, const std::string& expected) {
        throw Error(ErrorKind::input, {.file = path, .where = where, .what = what, .expected = expected, .next = next});
    };
    const std::unique_ptr<File> file = open_file(path);
    if (file->size() > limits.bytes) damaged("", "at most " + std::to_string(limits.bytes >> 20) + " MiB");
    std::string text(static_cast<std::size_t>(file->size()), '\0');
    read_fully(*file, path, 0, std::as_writable_bytes(std::span(text.data(), text.size())));
    int depth = 0;
    for (const char c : text) {
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (depth > limits.depth) damaged("", "JSON nested at most " + std::to_string(limits.depth) + " deep");
    }
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (json.is_discarded() || !json.is_object()) damaged("", "a JSON object");
    if (json.value("schema", nlohmann::ordered_json()) != schema) damaged("schema", schema);
    return json;
}

}  // namespace isoatlas
