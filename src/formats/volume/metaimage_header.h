// The text of a MetaImage header as fields (https://itk.org/Wiki/ITK/MetaIO/Documentation), uninterpreted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {

struct MetaHeader {
    std::string path;
    std::map<std::string, std::string> fields;    ///< names in lower case
    std::map<std::string, std::string> spelling;  ///< the names in the file, for messages
    std::vector<std::string> listed_files;        ///< lines after ElementDataFile = LIST
    std::int64_t data_offset = 0;                 ///< local data begin here

    [[nodiscard]] bool has(const std::string& field) const { return fields.contains(field); }
    [[nodiscard]] std::string text(const std::string& field) const;  ///< empty when absent
    /// The first of these fields that is present (MetaImage has synonyms); empty when none is.
    [[nodiscard]] std::string first_of(const std::vector<std::string>& names) const;
    [[nodiscard]] bool flag(const std::string& field, bool otherwise) const;
    [[nodiscard]] std::int64_t integer(const std::string& field, std::int64_t otherwise) const;
    [[nodiscard]] double number(const std::string& field, double otherwise) const;
    [[nodiscard]] std::vector<std::int64_t> integers(const std::string& field, std::size_t count) const;
    [[nodiscard]] std::vector<double> numbers(const std::string& field, std::size_t count) const;

    [[noreturn]] void fail(ErrorKind kind, const std::string& field, const std::string& what, const std::string& expected,
                           const std::string& next = "correct the header or get the file again") const;
};

/// Throws Error{input} for lines that are not "Name = value", fields given twice, a missing ElementDataFile.
[[nodiscard]] MetaHeader read_metaimage_header(const std::string& path);

}  // namespace isoatlas
