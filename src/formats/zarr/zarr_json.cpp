#include "formats/zarr/zarr_json.h"

#include <limits>

#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kLongestText = std::int64_t{8} << 20;
constexpr int kDeepestNesting = 64;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// The text with NaN and Infinity as null; nullopt: nested too deep.
std::optional<std::string> plain_json(std::string_view text) {
    std::string plain;
    plain.reserve(text.size());
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            plain += c;
            if (c == '\\' && i + 1 < text.size()) plain += text[++i];
            in_string = c != '"';
            continue;
        }
        if (is_letter(c)) {
            std::size_t end = i;
            while (end < text.size() && is_letter(text[end])) ++end;
            const std::string_view word = text.substr(i, end - i);
            const bool is_no_number = word == "NaN" || word == "Infinity";
            if (word == "Infinity" && plain.ends_with('-')) plain.pop_back();
            plain += is_no_number ? "null" : word;
            i = end - 1;
            continue;
        }
        in_string = c == '"';
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        if (depth > kDeepestNesting) return std::nullopt;
        plain += c;
    }
    return plain;
}

}  // namespace

std::optional<Json> read_json(KeyStore& store, const std::string& key, std::string_view without) {
    constexpr const char* kExpected = "a JSON object";
    const std::optional<std::vector<std::byte>> bytes = store.read(key, kLongestText);
    if (!bytes) return std::nullopt;
    const std::optional<std::string> text = plain_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!text) bad_zarr(store, key, "the JSON is nested too deep", "at most " + std::to_string(kDeepestNesting) + " levels");
    const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
        return without.empty() || depth != 1 || event != Json::parse_event_t::key || parsed.get_ref<const std::string&>() != without;
    };
    Json value = Json::parse(*text, keep, /*allow_exceptions=*/false);
    if (!value.is_object()) bad_zarr(store, key, "is not valid JSON, or no object", kExpected);
    return value;
}

const Json* find_member(const Json& value, const char* name) {
    if (!value.is_object()) return nullptr;
    const auto found = value.find(name);
    return found == value.end() ? nullptr : &*found;
}

std::string text_member(const Json& value, const char* name) {
    const Json* member = find_member(value, name);
    return member != nullptr && member->is_string() ? member->get<std::string>() : "";
}

std::optional<std::int64_t> as_count(const Json& value) {
    if (!value.is_number_unsigned()) return std::nullopt;
    const auto number = value.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) return std::nullopt;
    return static_cast<std::int64_t>(number);
}

std::vector<std::int64_t> read_counts(const KeyStore& store, const std::string& key, const Json& object, const char* name,
                                      std::int64_t least) {
    constexpr std::size_t kMostAxes = 32;
    const Json* list = find_member(object, name);
    const std::string expected = "a list of 1 to 32 integers, each at least " + std::to_string(least);
    if (list == nullptr || !list->is_array() || list->empty() || list->size() > kMostAxes)
        bad_zarr(store, in_key(key, name), list == nullptr ? "is missing" : "is not valid", expected);
    std::vector<std::int64_t> counts;
    for (const Json& value : *list) {
        const std::optional<std::int64_t> count = as_count(value);
        if (!count || *count < least) bad_zarr(store, in_key(key, name), "is not valid", expected);
        counts.push_back(*count);
    }
    return counts;
}

std::string in_key(const std::string& key, const std::string& member) { return key + ", \"" + member + "\""; }

}  // namespace isoatlas
