// Tables as CSV: numbers, fixed names and lists of numbers separated by spaces; missing values are empty.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"

namespace isoatlas {

/// One row of cells, ended by last_cells. No cell needs quotes: all are numbers, fixed names or lists of numbers.
class CsvRow {
public:
    CsvRow(ByteWriter& out, const std::string& last_cells) : out_(out), last_cells_(last_cells) {}
    ~CsvRow() { out_.text(last_cells_); }
    CsvRow(const CsvRow&) = delete;
    CsvRow& operator=(const CsvRow&) = delete;

    CsvRow& text(std::string_view cell) {
        separate();
        out_.text(cell);
        return *this;
    }
    template <class T>
    CsvRow& number(T value, bool known = true) {
        separate();
        if (known) out_.number(value);
        return *this;
    }
    CsvRow& real(double value) { return number(value, std::isfinite(value)); }
    CsvRow& position(const std::array<double, 3>& p) { return real(p[0]).real(p[1]).real(p[2]); }

private:
    void separate() {
        if (!first_) out_.text(",");
        first_ = false;
    }
    ByteWriter& out_;
    const std::string& last_cells_;
    bool first_ = true;
};

/// The columns of a detail, then the interpolant in each row: many CSV readers do not accept a comment line.
class CsvTable {
public:
    CsvTable(ByteWriter& out, const Connectivity& connectivity, const std::string& columns) : out_(out) {
        const std::string height = connectivity.has_tunnels() ? number_text(connectivity.tunnel_height) : "";
        last_cells_ = std::string(",") + connectivity.name() + "," + height + (connectivity.is_low() ? ",low\n" : "\n");
        out_.text(columns + ",interpolant,tunnel_height" + (connectivity.is_low() ? ",polarity\n" : "\n"));
    }
    [[nodiscard]] CsvRow row() const { return {out_, last_cells_}; }

private:
    ByteWriter& out_;
    std::string last_cells_;
};

}  // namespace isoatlas
