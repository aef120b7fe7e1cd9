#include "formats/volume/nrrd_header.h"

#include <array>

#include "formats/common/header_text.h"
#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::array<std::string_view, 30> kFields = {"content",
                                                      "number",
                                                      "type",
                                                      "block size",
                                                      "dimension",
                                                      "space",
                                                      "space dimension",
                                                      "sizes",
                                                      "spacings",
                                                      "thicknesses",
                                                      "axis mins",
                                                      "axis maxs",
                                                      "space directions",
                                                      "centers",
                                                      "kinds",
                                                      "labels",
                                                      "units",
                                                      "space units",
                                                      "space origin",
                                                      "measurement frame",
                                                      "min",
                                                      "max",
                                                      "old min",
                                                      "old max",
                                                      "data file",
                                                      "endian",
                                                      "encoding",
                                                      "line skip",
                                                      "byte skip",
                                                      "sample units"};

/// The one spelling of a field name; empty when NRRD has no such field.
std::string canonical(std::string_view name) {
    std::string wanted = lower(trim(name));
    if (wanted == "centerings") wanted = "centers";
    for (const std::string_view field : kFields) {
        std::string joined(field);
        std::erase(joined, ' ');
        if (wanted == field || wanted == joined) return std::string(field);
    }
    return {};
}

std::optional<std::size_t> end_of_nrrd_header(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const bool complete = text.find('\n', begin) != std::string_view::npos;
        if (take_line(text, begin).empty() && complete) return begin;
    }
    return std::nullopt;
}

void check_magic(const std::string& path, std::string_view line) {
    const bool version = line.size() == 8 && line.starts_with("NRRD000");
    if (version && line[7] >= '1' && line[7] <= '5') return;
    throw Error(version ? ErrorKind::unsupported : ErrorKind::input, {.file = path,
                                                                      .where = "line 1",
                                                                      .what = in_quotes(line) + " is not a NRRD version",
                                                                      .expected = "NRRD0001 to NRRD0005",
                                                                      .next = "write the file again as NRRD0005"});
}

/// A field that differs from a known one in a single character is damaged: ignoring it could change the samples.
void refuse_damaged_name(const NrrdHeader& header, std::string_view name) {
    const std::string given = lower(trim(name));
    for (const std::string_view field : kFields) {
        std::string joined(field);
        std::erase(joined, ' ');
        if (!is_damaged(given, field) && !is_damaged(given, joined)) continue;
        throw Error(ErrorKind::input, {.file = header.path,
                                       .where = "header",
                                       .what = in_quotes(given) + " is not a field of NRRD",
                                       .expected = in_quotes(field),
                                       .next = "the header is damaged: get the file again or correct it"});
    }
}

void add_once(NrrdHeader& header, std::map<std::string, std::string>& target, const std::string& name, std::string_view value) {
    if (!target.emplace(name, std::string(trim(value))).second) {
        header.fail(ErrorKind::input, name, "the field appears twice", "one value");
    }
}

void parse_line(NrrdHeader& header, std::string_view line, int number) {
    const std::size_t pair = line.find(":=");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
        throw Error(ErrorKind::input, {.file = header.path,
                                       .where = "line " + std::to_string(number),
                                       .what = in_quotes(line) + " is not a line of a NRRD header",
                                       .expected = "'field: value', 'key:=value' or '# comment'",
                                       .next = "the header is damaged: get the file again"});
    }
    if (pair == colon) {
        const std::string key(trim(line.substr(0, pair)));
        for (const char* known : {"calibration_slope", "calibration_intercept"}) {
            if (is_damaged(key, known)) header.fail(ErrorKind::input, printable(key), "is not a known key", known);
        }
        header.values.insert_or_assign(key, std::string(trim(line.substr(pair + 2))));
        return;
    }
    const std::string field = canonical(line.substr(0, colon));
    if (field.empty()) {
        refuse_damaged_name(header, line.substr(0, colon));
        header.notes.push_back("unknown header field " + in_quotes(line.substr(0, colon)) + " ignored");
        return;
    }
    add_once(header, header.fields, field, line.substr(colon + 1));
}

[[noreturn]] void wrong_count(const NrrdHeader& header, const std::string& field, std::size_t found, std::size_t wanted) {
    header.fail(ErrorKind::input, field, "has " + std::to_string(found) + " values", std::to_string(wanted));
}

}  // namespace

void NrrdHeader::fail(ErrorKind kind, const std::string& field, const std::string& what, const std::string& expected,
                      const std::string& next) const {
    throw Error(kind, {.file = path, .where = "field '" + field + "'", .what = what, .expected = expected, .next = next});
}

std::string NrrdHeader::text(const std::string& field) const {
    const auto found = fields.find(field);
    return found == fields.end() ? std::string() : found->second;
}

std::vector<std::int64_t> NrrdHeader::integers(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<std::int64_t> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<std::int64_t> number = parse_integer(word);
        if (!number) fail(ErrorKind::input, field, in_quotes(word) + " is not a number", "an integer");
        result.push_back(*number);
    }
    if (count != 0 && result.size() != count) wrong_count(*this, field, result.size(), count);
    return result;
}

std::vector<double> NrrdHeader::numbers(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<double> result;
    for (const std::string_view word : split_words(value)) {
        const std::optional<double> number = parse_number(word);
        if (!number) fail(ErrorKind::input, field, in_quotes(word) + " is not a number", "a number");
        result.push_back(*number);
    }
    if (count != 0 && result.size() != count) wrong_count(*this, field, result.size(), count);
    return result;
}

std::vector<std::optional<std::vector<double>>> NrrdHeader::vectors(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<std::optional<std::vector<double>>> result;
    for (std::size_t at = value.find_first_not_of(" \t"); at != std::string::npos; at = value.find_first_not_of(" \t", at)) {
        if (value.compare(at, 4, "none") == 0) {
            result.emplace_back();
            at += 4;
            continue;
        }
        const std::size_t close = value.find(')', at);
        if (value[at] != '(' || close == std::string::npos)
            fail(ErrorKind::input, field, in_quotes(value) + " is not valid", "vectors like (1,0,0)");
        std::vector<double>& vector = result.emplace_back(std::vector<double>{}).value();
        for (std::size_t begin = at + 1; begin <= close;) {
            const std::size_t end = std::min(value.find(',', begin), close);
            const std::optional<double> number = parse_number(trim(std::string_view(value).substr(begin, end - begin)));
            if (!number) fail(ErrorKind::input, field, in_quotes(value) + " is not valid", "vectors like (1,0,0)");
            vector.push_back(*number);
            begin = end + 1;
        }
        at = close + 1;
    }
    if (result.size() != count) wrong_count(*this, field, result.size(), count);
    return result;
}

std::vector<std::string> NrrdHeader::words(const std::string& field, std::size_t count) const {
    const std::string value = text(field);
    std::vector<std::string> result;
    for (std::size_t at = value.find_first_not_of(" \t"); at != std::string::npos; at = value.find_first_not_of(" \t", at)) {
        const bool is_quoted = value[at] == '"';
        const std::size_t begin = is_quoted ? at + 1 : at;
        const std::size_t end = std::min(is_quoted ? value.find('"', begin) : value.find_first_of(" \t", begin), value.size());
        result.push_back(value.substr(begin, end - begin));
        at = std::min(is_quoted ? end + 1 : end, value.size());
    }
    if (result.size() != count) wrong_count(*this, field, result.size(), count);
    return result;
}

NrrdHeader read_nrrd_header(const std::string& path) {
    const HeaderText source = read_header_text(path, end_of_nrrd_header);
    NrrdHeader header;
    header.path = path;
    header.data_offset = source.end;
    header.ended = source.terminated;
    bool list = false;
    int number = 0;
    for (std::size_t begin = 0; begin < source.text.size();) {
        const std::string_view line = take_line(source.text, begin);
        ++number;
        if (number == 1) {
            check_magic(path, line);
        } else if (list && !trim(line).empty()) {
            header.listed_files.emplace_back(trim(line));
        } else if (!trim(line).empty() && !line.starts_with('#')) {
            parse_line(header, line, number);
            list = header.text("data file").starts_with("LIST");
        }
    }
    if (number == 0) check_magic(path, "");
    return header;
}

}  // namespace isoatlas
