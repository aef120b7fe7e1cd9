#include "formats/volume/amira_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/common/header_text.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxDepth = 16, kMaxParameters = 1 << 16;

std::optional<std::size_t> end_of_amira_header(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const bool is_complete = text.find('\n', begin) != std::string_view::npos;
        if (amira_section(take_line(text, begin)) > 0 && is_complete) return begin;
    }
    return std::nullopt;
}

/// A word, a text in quotes, or one of { } [ ] ( ) , =.
struct AmiraToken {
    enum class Kind : std::uint8_t { end, word, text, mark } kind = Kind::end;
    std::string_view text{};
    [[nodiscard]] bool is(char mark) const { return kind == Kind::mark && text[0] == mark; }
    [[nodiscard]] bool is_value() const { return kind == Kind::text || (kind == Kind::word && parse_number(text).has_value()); }
};

class AmiraTokens {
public:
    AmiraTokens(std::string_view text, const std::string& path) : text_(text), path_(path) { advance(); }

    [[nodiscard]] const AmiraToken& now() const { return token_; }
    AmiraToken take() {
        const AmiraToken taken = token_;
        advance();
        return taken;
    }
    bool take(char mark) {
        if (!token_.is(mark)) return false;
        advance();
        return true;
    }
    void expect(char mark) {
        if (!take(mark)) fail(std::string("'") + mark + "'");
    }
    std::string word(const char* what) {
        if (token_.kind != AmiraToken::Kind::word) fail(what);
        return std::string(take().text);
    }
    std::int64_t integer(const char* what) {
        const std::optional<std::int64_t> number = token_.kind == AmiraToken::Kind::word ? parse_integer(token_.text) : std::nullopt;
        if (!number) fail(what);
        advance();
        return *number;
    }
    [[noreturn]] void fail(const std::string& expected) const {
        const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin_), '\n');
        bad_field(path_, "line " + std::to_string(lines + 1),
                  token_.kind == AmiraToken::Kind::end ? "the header ends early" : in_quotes(token_.text) + " is not understood", expected);
    }

private:
    static constexpr std::string_view kBlanks = " \t\r\n\f\v", kMarks = "{}[](),=";

    void advance() {
        for (;;) {
            begin_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
            if (begin_ == text_.size() || text_[begin_] != '#') break;
            at_ = std::min(text_.find('\n', begin_), text_.size());
        }
        at_ = begin_;
        if (at_ == text_.size()) {
            token_ = {};
        } else if (text_[at_] == '"') {
            quoted();
        } else if (kMarks.find(text_[at_]) != std::string_view::npos) {
            token_ = {AmiraToken::Kind::mark, text_.substr(at_++, 1)};
        } else {
            while (at_ < text_.size() && kBlanks.find(text_[at_]) == std::string_view::npos &&
                   kMarks.find(text_[at_]) == std::string_view::npos && text_[at_] != '"')
                ++at_;
            token_ = {AmiraToken::Kind::word, text_.substr(begin_, at_ - begin_)};
        }
    }
    void quoted() {
        for (at_ = begin_ + 1; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\\') ++at_;
        }
        token_ = {AmiraToken::Kind::text, text_.substr(begin_ + 1, std::min(at_, text_.size()) - begin_ - 1)};
        if (at_ >= text_.size()) fail("a text in quotes that ends");
        ++at_;
    }

    std::string_view text_;
    const std::string& path_;
    std::size_t at_ = 0, begin_ = 0;  ///< behind the token, its begin
    AmiraToken token_{};
};

/// Parameters that are used, not those of other programs; one character away from them is damaged, and ignoring it could move the samples.
void refuse_damaged_parameter(const AmiraHeader& header, const std::string& name) {
    static constexpr std::array<std::string_view, 5> kKnown{"BoundingBox", "CoordType", "Units", "Materials", "TransformationMatrix"};
    for (const std::string_view known : kKnown) {
        if (is_damaged(lower(name), lower(known))) bad_header(header.path, printable(name), "is not a known parameter", std::string(known));
    }
}

/// Parameters in braces, those of the group `whole`; -1: of none.
void parse_parameters(AmiraHeader& header, AmiraTokens& tokens, std::int64_t whole) {
    std::vector<std::int64_t> open{whole};
    tokens.expect('{');
    for (;;) {
        while (tokens.take(',')) continue;
        if (tokens.take('}')) {
            open.pop_back();
            if (open.empty()) return;
            continue;
        }
        if (header.parameters.size() == kMaxParameters) tokens.fail("at most " + std::to_string(kMaxParameters) + " parameters");
        AmiraParameter parameter{.parent = open.back()};
        const bool has_name = tokens.now().kind == AmiraToken::Kind::word || tokens.now().kind == AmiraToken::Kind::text;
        if (has_name)
            parameter.name = tokens.take().text;
        else if (!tokens.now().is('{'))  // old files have groups without names
            tokens.fail("a parameter or '}'");
        if (open.back() < 0) refuse_damaged_parameter(header, parameter.name);
        const bool is_group = tokens.take('{');
        while (!is_group && tokens.now().is_value()) parameter.values.emplace_back(tokens.take().text);
        header.parameters.push_back(std::move(parameter));
        if (!is_group) continue;
        if (open.size() == kMaxDepth) tokens.fail("groups in at most " + std::to_string(kMaxDepth) + " groups");
        open.push_back(static_cast<std::int64_t>(header.parameters.size()) - 1);
    }
}

/// Old files have them outside of Parameters.
void parse_materials(AmiraHeader& header, AmiraTokens& tokens) {
    header.parameters.push_back({.parent = -1, .name = "Materials"});
    parse_parameters(header, tokens, static_cast<std::int64_t>(header.parameters.size()) - 1);
}

void parse_sizes(AmiraHeader& header, AmiraTokens& tokens) {
    const std::string name = tokens.word("the name of a lattice");
    std::vector<std::int64_t> sizes;
    do {
        sizes.push_back(tokens.integer("a size"));
        if (sizes.back() < 0) bad_header(header.path, "define " + printable(name), "a size is negative", "0 or more");
    } while (tokens.now().kind == AmiraToken::Kind::word && parse_integer(tokens.now().text) && sizes.size() < 4);
    if (!header.sizes.emplace(name, std::move(sizes)).second)
        bad_header(header.path, "define", in_quotes(name) + " is twice there", "once");
}

void parse_array(AmiraHeader& header, AmiraTokens& tokens, std::string location) {
    AmiraArray array{.location = std::move(location)};
    tokens.expect('{');
    array.type = lower(tokens.word("the type of an array"));
    if (tokens.take('[')) {
        array.components = tokens.integer("a number of components");
        tokens.expect(']');
    }
    array.name = tokens.word("the name of an array");
    tokens.expect('}');
    static_cast<void>(tokens.take('='));
    const std::string section = tokens.word("a section, @1");
    array.section = amira_section(section);
    if (array.section == 0) bad_header(header.path, "array " + in_quotes(array.name), in_quotes(section) + " is not a section", "@1");
    if (tokens.take('(')) {
        array.encoding = tokens.word("an encoding");
        tokens.expect(',');
        array.packed_bytes = tokens.integer("a number of bytes");
        tokens.expect(')');
    }
    if (array.components < 1 || array.packed_bytes < 0)
        bad_header(header.path, "array " + in_quotes(array.name), "its components or bytes are wrong", "at least 1 component");
    header.arrays.push_back(std::move(array));
}

/// "# AmiraMesh 3D BINARY-LITTLE-ENDIAN 2.1": how samples are encoded.
void parse_first_line(AmiraHeader& header, std::string_view line) {
    for (const std::string_view word : split_words(line)) {
        if (word == "ASCII") return void(header.is_text = true);
        if (word == "BINARY-LITTLE-ENDIAN") return;
        if (word == "BINARY" || word == "BINARY-BIG-ENDIAN") return void(header.big_endian = true);
    }
    bad_field(header.path, "line 1", in_quotes(line) + " does not say how samples are encoded", "ASCII, BINARY or BINARY-LITTLE-ENDIAN");
}

}  // namespace

bool begins_like_amira(std::string_view text) { return text.starts_with("# AmiraMesh") || text.starts_with("# Avizo"); }

std::int64_t amira_section(std::string_view line) {
    line = trim(line);
    if (line.size() < 2 || line[0] != '@' || line[1] < '0' || line[1] > '9') return 0;
    return std::max<std::int64_t>(parse_integer(line.substr(1)).value_or(0), 0);
}

const AmiraParameter* AmiraHeader::find(std::initializer_list<std::string_view> names) const {
    std::int64_t parent = -1;
    for (const std::string_view name : names) {
        const auto found = std::ranges::find_if(
            parameters, [&](const AmiraParameter& other) { return other.parent == parent && lower(other.name) == lower(name); });
        if (found == parameters.end()) return nullptr;
        parent = found - parameters.begin();
    }
    return parent < 0 ? nullptr : &parameters[static_cast<std::size_t>(parent)];
}

std::string AmiraHeader::word(std::initializer_list<std::string_view> names) const {
    const AmiraParameter* found = find(names);
    return found == nullptr || found->values.empty() ? std::string() : lower(found->values[0]);
}

std::vector<double> AmiraHeader::numbers(const AmiraParameter& parameter, std::size_t count) const {
    std::vector<double> result;
    for (const std::string& value : parameter.values) {
        const std::optional<double> number = parse_number(value);
        if (!number || !std::isfinite(*number))
            bad_header(path, printable(parameter.name), in_quotes(value) + " is not a number", "a number");
        result.push_back(*number);
    }
    if (result.size() != count)
        bad_header(path, printable(parameter.name), "has " + std::to_string(result.size()) + " numbers", std::to_string(count));
    return result;
}

AmiraHeader read_amira_header(const std::string& path) {
    const HeaderText source = read_header_text(path, end_of_amira_header);
    AmiraHeader header;
    header.path = path;
    std::size_t begin = 0;
    parse_first_line(header, take_line(source.text, begin));
    if (!source.terminated) bad_header(path, "end", "no section of samples follows it", "a line @1");
    header.data_offset = source.end;
    const std::string_view whole = std::string_view(source.text);
    const std::size_t last = whole.rfind('@');
    header.first_section = amira_section(whole.substr(last));
    AmiraTokens tokens(whole.substr(0, last), path);
    while (tokens.now().kind != AmiraToken::Kind::end) {
        std::string name = tokens.word("'define', 'Parameters' or an array");
        if (name == "define")
            parse_sizes(header, tokens);
        else if (name == "Parameters")
            parse_parameters(header, tokens, -1);
        else if (name == "Materials")
            parse_materials(header, tokens);
        else
            parse_array(header, tokens, std::move(name));
    }
    return header;
}

std::vector<NamedLabel> amira_materials(const std::string& path) {
    constexpr std::size_t kMaxMaterials = 65536;
    const AmiraHeader header = read_amira_header(path);
    const AmiraParameter* materials = header.find({"Materials"});
    std::vector<NamedLabel> labels;
    if (materials == nullptr) return labels;
    const std::int64_t group = materials - header.parameters.data();
    std::map<std::int64_t, std::size_t> place;  // of a material in labels
    for (std::size_t i = 0; i < header.parameters.size() && labels.size() < kMaxMaterials; ++i) {
        const AmiraParameter& parameter = header.parameters[i];
        if (parameter.parent == group) {
            place[static_cast<std::int64_t>(i)] = labels.size();
            labels.push_back({static_cast<std::int64_t>(labels.size()), parameter.name, {128, 128, 128}});
        }
        const auto material = place.find(parameter.parent);
        if (material == place.end() || parameter.values.empty()) continue;
        if (lower(parameter.name) == "name") labels[material->second].name = parameter.values[0];
        if (lower(parameter.name) != "color" || parameter.values.size() != 3) continue;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double part = std::clamp(parse_number(parameter.values[channel]).value_or(0), 0.0, 1.0);
            labels[material->second].colour[channel] = static_cast<std::uint8_t>(std::lround(part * 255));
        }
    }
    return labels;
}

}  // namespace isoatlas
