#include "compare/methods_text.h"

#include <algorithm>
#include <cctype>

#include "compare/html.h"
#include "compare/html_table.h"

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

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// Of a line "| a | b |": what stands between the bars.
std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells;
    line.remove_prefix(1);
    for (std::size_t end = line.find('|'); end != std::string_view::npos; end = line.find('|')) {
        cells.emplace_back(trimmed(line.substr(0, end)));
        line.remove_prefix(end + 1);
    }
    return cells;
}

/// lines: titles of columns, a line of dashes, rows.
std::string html_of_table(std::string_view caption, const std::vector<std::string_view>& lines) {
    std::vector<HtmlTable::Column> columns;
    for (const std::string& title : cells_of(lines[0])) columns.push_back({title, columns.empty()});
    HtmlTable table("Numbers of: " + std::string(caption), std::move(columns));
    for (std::size_t i = 2; i < lines.size(); ++i) {
        const std::vector<std::string> cells = cells_of(lines[i]);
        table.begin(html_of_markdown(cells[0]));
        for (std::size_t k = 1; k < cells.size(); ++k) table.add(html_of_markdown(cells[k]));
    }
    return table.html();
}

/// A paragraph, a list whose items begin with "- ", or both: the items follow the text that announces them.
std::string html_of_text(const std::vector<std::string_view>& lines) {
    std::vector<std::string> parts{""};  // the text, then the items
    for (const std::string_view line : lines) {
        const bool is_item = line.starts_with("- ");
        if (is_item) parts.emplace_back();
        const std::string_view words = trimmed(is_item ? line.substr(2) : line);
        parts.back() += (parts.back().empty() ? "" : " ") + std::string(words);
    }
    std::string html = parts[0].empty() ? "" : "<p>" + html_of_markdown(parts[0]) + "</p>";
    if (parts.size() == 1) return html;
    html += "<ul>";
    for (std::size_t i = 1; i < parts.size(); ++i) html += "<li>" + html_of_markdown(parts[i]) + "</li>";
    return html + "</ul>";
}

/// Sections of the document: those whose heading names a section of the dissertation; figures, which are files beside it, are left out.
std::vector<MethodSection> parsed(std::string_view text) {
    std::vector<MethodSection> sections;
    std::vector<std::string_view> lines;  // of a paragraph
    const auto end_paragraph = [&] {
        if (!lines.empty() && !lines[0].starts_with("![")) {
            const bool is_table = lines[0].starts_with("|") && lines.size() > 2;
            sections.back().html += is_table ? html_of_table(sections.back().title, lines) : html_of_text(lines);
        }
        lines.clear();
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
            lines.push_back(line);
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
