// Table: columns of text, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace isoatlas::cli {

class Terminal;

class Table {
public:
    struct Column {
        std::string title;
        bool left = false;  ///< words: aligned to the left
    };
    explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    void print(Terminal& terminal) const;

private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace isoatlas::cli
