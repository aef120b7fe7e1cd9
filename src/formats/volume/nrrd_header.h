// The text of a NRRD header as fields and key/value pairs (http://teem.sourceforge.net/nrrd/format.html), uninterpreted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {

struct NrrdHeader {
    std::string path;
    std::map<std::string, std::string> fields;  ///< "space origin" -> text; names in lower case, spellings made one
    std::map<std::string, std::string> values;  ///< key:=value
    std::vector<std::string> listed_files;      ///< lines after "data file: LIST"
    std::int64_t data_offset = 0;               ///< attached data begin here
    bool ended = false;                         ///< by an empty line (needed when data are attached)
    std::vector<std::string> notes;

    [[nodiscard]] bool has(const std::string& field) const { return fields.contains(field); }
    [[nodiscard]] std::string text(const std::string& field) const;  ///< empty when absent
    /// Numbers of a field. Throws Error{input} when one is not a number or their count is not `count` (0: any).
    [[nodiscard]] std::vector<std::int64_t> integers(const std::string& field, std::size_t count) const;
    [[nodiscard]] std::vector<double> numbers(const std::string& field, std::size_t count) const;
    /// Vectors "(a,b,c)" of a field, nullopt for "none".
    [[nodiscard]] std::vector<std::optional<std::vector<double>>> vectors(const std::string& field, std::size_t count) const;
    /// Words of a field; "..." is one word.
    [[nodiscard]] std::vector<std::string> words(const std::string& field, std::size_t count) const;

    [[noreturn]] void fail(ErrorKind kind, const std::string& field, const std::string& what, const std::string& expected,
                           const std::string& next = "correct the header or get the file again") const;
};

/// Reads a header of version 1 to 5. Throws Error{input} for lines that are not fields, for fields given twice; unsupported for later
/// versions.
[[nodiscard]] NrrdHeader read_nrrd_header(const std::string& path);

}  // namespace isoatlas
