#include "text/table.h"

#include <algorithm>

#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

/// Characters of a UTF-8 text.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string line_of(const std::vector<std::string>& cells, const std::vector<Table::Column>& columns,
                    const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string space(widths[i] - std::min(widths[i], width_of(cells[i])), ' ');
        line += (i > 0 ? "  " : "") + (columns[i].left ? cells[i] + space : space + cells[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

}  // namespace

void Table::print(Terminal& terminal) const {
    std::vector<std::size_t> widths;
    std::vector<std::string> titles;
    for (const Column& column : columns_) {
        titles.push_back(column.title);
        widths.push_back(width_of(column.title));
    }
    for (const auto& row : rows_) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
    }
    terminal.out() << terminal.bold(line_of(titles, columns_, widths)) << '\n';
    for (const auto& row : rows_) terminal.out() << line_of(row, columns_, widths) << '\n';
}

}  // namespace isoatlas::cli
