// References to objects, one grammar for all options: 2 (number in the table), c3 (cavity), v218663 (voxel), skull (name); low2, lowc3,
// lowv218663: the same of the tables of low values; each with an isovalue of its own as 2@1367.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <isoatlas/polarity.h>

namespace isoatlas::cli {

struct ObjectReference {
    enum class Kind : std::uint8_t { number, cavity, voxel, name };
    Kind kind = Kind::number;
    std::int64_t number = 0;             ///< in the table, from 1; of the voxel, from 0
    std::optional<double> tau;           ///< calibrated; none: the best isovalue
    std::string word;                    ///< without the isovalue; the name
    std::optional<Polarity> polarity{};  ///< low: written with it; none: that which the command is about
};

/// One reference. Throws Error{usage} that names the option.
[[nodiscard]] ObjectReference parse_reference(const std::string& option, const std::string& word);
/// All of some words; commas separate several in a word.
[[nodiscard]] std::vector<ObjectReference> parse_references(const std::string& option, const std::vector<std::string>& words);

/// "v218663"
[[nodiscard]] std::string voxel_word(std::int64_t voxel);
/// "c3"
[[nodiscard]] std::string cavity_word(std::int64_t number);
/// "2"; of low values "low2"
[[nodiscard]] std::string with_polarity(const std::string& word, Polarity polarity);

}  // namespace isoatlas::cli
