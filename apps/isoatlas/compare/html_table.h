// A table of an HTML document that screen readers can read: a caption, titles of columns and of rows.
#pragma once

#include <string>
#include <vector>

namespace isoatlas::cli {

class HtmlTable {
public:
    struct Column {
        std::string title;
        bool is_words = false;  ///< to the left
    };
    HtmlTable(std::string caption, std::vector<Column> columns) : caption_(std::move(caption)), columns_(std::move(columns)) {}

    /// Begins a row. html: of its title.
    void begin(const std::string& html) { rows_.push_back({html}); }
    /// The next cell. html: escaped already.
    void add(const std::string& html) { rows_.back().push_back(html); }
    /// A count that should be zero.
    void add_defects(std::int64_t count);
    [[nodiscard]] std::string html() const;

private:
    std::string caption_;
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<std::pair<std::size_t, std::size_t>> bad_;  ///< row and column
};

}  // namespace isoatlas::cli
