#include "compare/methods_text.h"

#include <algorithm>
#include <cctype>

#include "compare/html.h"

namespace isoatlas::cli {
namespace {

/// As GitHub makes it from a heading.
std::string anchor_of(std::string_view title) {
    std::string anchor;
    for (const char c : title) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (c == ' ' || c == '-') anchor += '-';
    }
    return anchor;
}

/// "3.7.1" of "Octree (3.7.1), and more".
std::string section_in(std::string_view title) {
    const std::size_t begin = title.find('('), end = title.find(')', begin == std::string_view::npos ? 0 : begin);
    return begin == std::string_view::npos || end == std::string_view::npos ? "" : std::string(title.substr(begin + 1, end - begin - 1));
}

std::vector<std::string> words_in(std::string_view text) {
    std::vector<std::string> words{""};
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!words.back().empty())
            words.emplace_back();
    }
    return words;
}

std::vector<MethodSection> parsed(std::string_view text) {
    std::vector<MethodSection> sections;
    std::string paragraph;
    const auto end_paragraph = [&] {
        const bool is_figure = paragraph.starts_with("![");  // a file beside the document
        if (!paragraph.empty() && !is_figure && !sections.empty()) sections.back().html += "<p>" + html_of_markdown(paragraph) + "</p>";
        paragraph.clear();
    };
    bool is_method = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("#") || line.empty()) end_paragraph();
        if (line.starts_with("#")) is_method = line.starts_with("## ") && !section_in(line).empty();
        if (is_method && line.starts_with("## ")) {
            const std::string_view title = line.substr(3);
            sections.push_back({std::string(title), section_in(title), "", anchor_of(title)});
        } else if (is_method && !line.empty()) {
            paragraph += (paragraph.empty() ? "" : " ") + std::string(line);
        }
    }
    end_paragraph();
    return sections;
}

}  // namespace

const std::vector<MethodSection>& method_sections() {
    static const std::vector<MethodSection> sections = parsed(methods_text());
    return sections;
}

const MethodSection* section_about(const ComparedMethod& method) {
    const std::vector<std::string> wanted = words_in(method.title);
    const MethodSection* best = nullptr;
    std::ptrdiff_t most = -1;
    for (const MethodSection& section : method_sections()) {
        if (!method.section.empty() && section.section != method.section) continue;
        const std::vector<std::string> words = words_in(section.title);
        const std::ptrdiff_t common = std::ranges::count_if(
            wanted, [&](const std::string& word) { return !word.empty() && std::ranges::find(words, word) != words.end(); });
        if (common > most) most = common, best = &section;
    }
    return best;
}

}  // namespace isoatlas::cli
