#include "formats/volume/metaimage_header.h"

#include <array>

#include "formats/common/header_text.h"
#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::string_view kLastField = "elementdatafile";

/// End of the name of a line; npos when it has none.
std::size_t name_end(std::string_view line) {
    const std::size_t at = line.find('=');
    return at == std::string_view::npos ? line.find(':') : at;
}

/// Name and value of a line "Name = value" (or "Name : value"), the name in lower case; an empty name for any other line.
std::pair<std::string, std::string> split_field(std::string_view line) {
    const std::size_t at = name_end(line);
    if (at == std::string_view::npos) return {};
    return {lower(trim(line.substr(0, at))), std::string(trim(line.substr(at + 1)))};
}

std::optional<std::size_t> end_of_metaimage_header(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const bool complete = text.find('\n', begin) != std::string_view::npos;
        const auto [name, value] = split_field(take_line(text, begin));
        if (name == kLastField && complete) return value.starts_with("LIST") ? std::nullopt : std::optional(begin);
    }
    return std::nullopt;
}

/// Fields that are used. Others belong to the writer of the file; but one that differs from these in a single character is damaged, and
/// ignoring it could change the samples.
void refuse_damaged_name(const MetaHeader& header, const std::string& name) {
    static constexpr std::array<std::string_view, 27> kKnown = {"objecttype",
                                                                "objectsubtype",
                                                                "ndims",
                                                                "comment",
                                                                "dimsize",
                                                                "elementtype",
                                                                "headersize",
                                                                "elementnumberofchannels",
                                                                "binarydata",
                                                                "binarydatabyteordermsb",
                                                                "elementbyteordermsb",
                                                                "compresseddata",
                                                                "compresseddatasize",
                                                                "transformmatrix",
                                                                "rotation",
                                                                "orientation",
                                                                "centerofrotation",
                                                                "elementspacing",
                                                                "elementsize",
                                                                "offset",
                                                                "position",
                                                                "origin",
                                                                "anatomicalorientation",
                                                                "distanceunits",
                                                                "elementtointensityfunctionslope",
                                                                "elementtointensityfunctionoffset",
                                                                kLastField};
    for (const std::string_view known : kKnown) {
        if (is_damaged(name, known)) header.fail(ErrorKind::input, name, "is not a field of MetaImage", std::string(known));
    }
}

void parse_line(MetaHeader& header, std::string_view line, int number) {
    auto [name, value] = split_field(line);
    if (name.empty()) {
        throw Error(ErrorKind::input, {.file = header.path,
                                       .where = "line " + std::to_string(number),
                                       .what = in_quotes(line) + " is not a line of a MetaImage header",
                                       .expected = "'Name = value'",
                                       .next = "the header is damaged: get the file again"});
    }
    refuse_damaged_name(header, name);
    header.spelling.emplace(name, printable(trim(line.substr(0, name_end(line)))));
    if (!header.fields.emplace(name, std::move(value)).second) header.fail(ErrorKind::input, name, "the field appears twice", "one value");
}

}  // namespace

void MetaHeader::fail(ErrorKind kind, const std::string& field, const std::string& what, const std::string& expected,
                      const std::string& next) const {
    const auto found = spelling.find(field);
    throw Error(kind, {.file = path,
                       .where = "field " + (found == spelling.end() ? field : found->second),
                       .what = what,
                       .expected = expected,
                       .next = next});
}

std::string MetaHeader::text(const std::string& field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? std::string() : found->second;
}

std::string MetaHeader::first_of(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
        if (has(name)) return name;
    }
    return {};
}

bool MetaHeader::flag(const std::string& field, bool otherwise) const {
    if (!has(field)) return otherwise;
    const std::string value = lower(text(field));
    if (value == "true" || value == "t" || value == "1" || value == "yes") return true;
    if (value == "false" || value == "f" || value == "0" || value == "no") return false;
    fail(ErrorKind::input, field, "is " + in_quotes(text(field)), "True or False");
}

std::int64_t MetaHeader::integer(const std::string& field, std::int64_t otherwise) const {
    return has(field) ? integers(field, 1)[0] : otherwise;
}

double MetaHeader::number(const std::string& field, double otherwise) const { return has(field) ? numbers(field, 1)[0] : otherwise; }

std::vector<std::int64_t> MetaHeader::integers(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<std::int64_t> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<std::int64_t> found = parse_integer(word);
        if (!found) fail(ErrorKind::input, field, in_quotes(word) + " is not a number", "an integer");
        result.push_back(*found);
    }
    if (result.size() != count) fail(ErrorKind::input, field, "has " + std::to_string(result.size()) + " values", std::to_string(count));
    return result;
}

std::vector<double> MetaHeader::numbers(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<double> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<double> found = parse_number(word);
        if (!found) fail(ErrorKind::input, field, in_quotes(word) + " is not a number", "a number");
        result.push_back(*found);
    }
    if (result.size() != count) fail(ErrorKind::input, field, "has " + std::to_string(result.size()) + " values", std::to_string(count));
    return result;
}

MetaHeader read_metaimage_header(const std::string& path) {
    const HeaderText source = read_header_text(path, end_of_metaimage_header);
    MetaHeader header;
    header.path = path;
    header.data_offset = source.end;
    int number = 0;
    for (std::size_t begin = 0; begin < source.text.size();) {
        const std::string_view line = take_line(source.text, begin);
        ++number;
        if (trim(line).empty()) continue;
        if (header.has(std::string(kLastField))) {
            header.listed_files.emplace_back(trim(line));
        } else if (!line.starts_with('#')) {
            parse_line(header, line, number);
        }
    }
    if (!header.has(std::string(kLastField))) {
        header.fail(ErrorKind::input, "ElementDataFile", "is missing", "LOCAL or the name of the data file",
                    "the header is truncated: get the file again");
    }
    return header;
}

}  // namespace isoatlas
