#include "compare/html_table.h"

#include <algorithm>

#include "compare/html.h"
#include "text/values.h"

namespace isoatlas::cli {

void HtmlTable::add_defects(std::int64_t count) {
    if (count > 0) bad_.emplace_back(rows_.size() - 1, rows_.back().size());
    add(count_text(count));
}

std::string HtmlTable::html() const {
    std::string html = R"(<div class="scroll" tabindex="0" role="region" aria-label=")" + html_text(caption_) + R"("><table><caption>)" +
                       html_text(caption_) + "</caption>\n<thead><tr>";
    for (const Column& column : columns_)
        html +=
            std::string(column.is_words ? R"(<th scope="col" class="words">)" : R"(<th scope="col">)") + html_text(column.title) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        html += R"(<tr><th scope="row">)" + rows_[row][0] + "</th>";
        for (std::size_t i = 1; i < rows_[row].size(); ++i) {
            const bool is_bad = std::ranges::find(bad_, std::pair(row, i)) != bad_.end();
            html += is_bad ? R"(<td class="bad">)" : columns_[i].is_words ? R"(<td class="words">)" : "<td>";
            html += rows_[row][i] + "</td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace isoatlas::cli
