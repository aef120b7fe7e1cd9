#include "text/table.h"

#include <algorithm>

#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

std::string line_of(const std::vector<std::string>& cells, const std::vector<Table::Column>& columns,
                    const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string space(widths[i] - std::min(widths[i], cells[i].size()), ' ');
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
        widths.push_back(column.title.size());
    }
    for (const auto& row : rows_) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    terminal.out() << terminal.bold(line_of(titles, columns_, widths)) << '\n';
    for (const auto& row : rows_) terminal.out() << line_of(row, columns_, widths) << '\n';
}

}  // namespace isoatlas::cli
