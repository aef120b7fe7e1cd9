// The header of an Amira mesh (.am), uninterpreted: sizes, parameters and the arrays that are declared.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/error.h"
#include "isoatlas/segmentation.h"

namespace isoatlas {

/// A parameter or a group of parameters.
struct AmiraParameter {
    std::int64_t parent = -1;  ///< place of its group in AmiraHeader::parameters; -1: none
    std::string name{};
    std::vector<std::string> values{};  ///< numbers and texts, without quotes
};

/// "Lattice { float[3] Data } @1(HxZip,1234)".
struct AmiraArray {
    std::string location{}, type{}, name{};
    std::int64_t components = 1;
    std::int64_t section = 0;       ///< the number behind @
    std::string encoding{};         ///< "", "HxByteRLE", "HxZip"
    std::int64_t packed_bytes = 0;  ///< of a section with an encoding
};

struct AmiraHeader {
    std::string path{};
    bool is_text = false, big_endian = false;
    std::map<std::string, std::vector<std::int64_t>> sizes{};  ///< "Lattice" -> 10 20 30
    std::vector<AmiraParameter> parameters{};
    std::vector<AmiraArray> arrays{};
    std::int64_t first_section = 0, data_offset = 0;  ///< of the section that follows the header

    /// The parameter at these names from the outermost group; nullptr: there is none.
    [[nodiscard]] const AmiraParameter* find(std::initializer_list<std::string_view> names) const;
    /// The first value of a parameter, in lower case; empty when it is not there.
    [[nodiscard]] std::string word(std::initializer_list<std::string_view> names) const;
    /// Numbers of a parameter. Throws Error{input} when one is not finite or their count differs.
    [[nodiscard]] std::vector<double> numbers(const AmiraParameter& parameter, std::size_t count) const;
};

/// "# AmiraMesh" or "# Avizo" at the beginning.
[[nodiscard]] bool begins_like_amira(std::string_view text);

/// Throws Error: input (damaged, no section of samples follows), unsupported (surfaces).
[[nodiscard]] AmiraHeader read_amira_header(const std::string& path);

/// The section of a number in a line by itself, "@1"; 0: none.
[[nodiscard]] std::int64_t amira_section(std::string_view line);

/// The materials of label fields with their labels: 0, 1, ... in the order of the header. Throws as read_amira_header().
[[nodiscard]] std::vector<NamedLabel> amira_materials(const std::string& path);

}  // namespace isoatlas
