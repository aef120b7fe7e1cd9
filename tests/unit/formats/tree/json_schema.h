// The part of JSON Schema that docs/schema uses: type, const, enum, required, properties, items, minimum, minItems, maxItems.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace json_schema {

using Json = nlohmann::json;

inline Json load(const std::string& path) {
    std::ifstream in(path);
    return Json::parse(in);
}

inline bool has_type(const Json& value, const std::string& type) {
    if (type == "null") return value.is_null();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "array") return value.is_array();
    return type == "object" && value.is_object();
}

/// Where and why the value breaks the schema; empty when it does not.
inline std::string problem(const Json& value, const Json& schema, const std::string& where = "$") {
    if (schema.contains("const") && value != schema["const"]) return where + " is not " + schema["const"].dump();
    if (schema.contains("enum")) {
        bool found = false;
        for (const Json& allowed : schema["enum"]) found = found || value == allowed;
        if (!found) return where + " is none of the values: " + value.dump();
    }
    if (schema.contains("type")) {
        const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
        bool found = false;
        for (const Json& type : types) found = found || has_type(value, type.get<std::string>());
        if (!found) return where + " has the wrong type: " + value.dump();
    }
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"]) return where + " is too small: " + value.dump();
    if (value.is_object()) {
        for (const Json& key : schema.value("required", Json::array())) {
            if (!value.contains(key.get<std::string>())) return where + " lacks " + key.get<std::string>();
        }
        for (const auto& [key, item] : value.items()) {
            if (!schema.contains("properties") || !schema["properties"].contains(key)) return where + " has the undocumented key " + key;
            if (std::string text = problem(item, schema["properties"][key], where + "." + key); !text.empty()) return text;
        }
    }
    if (value.is_array()) {
        if (value.size() < schema.value("minItems", std::size_t{0}) || value.size() > schema.value("maxItems", ~std::size_t{0}))
            return where + " has a wrong length";
        for (std::size_t i = 0; i < value.size() && schema.contains("items"); ++i) {
            if (std::string text = problem(value[i], schema["items"], where + "[" + std::to_string(i) + "]"); !text.empty()) return text;
        }
    }
    return {};
}

}  // namespace json_schema
