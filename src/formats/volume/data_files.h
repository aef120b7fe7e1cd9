// The samples of formats whose header may point to other files (NRRD, MetaImage): one file, a list, or a numbered series.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/byte_source.h"
#include "formats/common/wide_integers.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Names of data files in the header. A numbered series is kept as its rule, so that a forged count needs no memory.
struct DataFiles {
    std::vector<std::string> names;  ///< used when pattern is empty
    std::string pattern;             ///< contains one %d, %3d, %03d, ...
    std::int64_t first = 0, last = 0, step = 1;

    [[nodiscard]] std::int64_t count() const;
    [[nodiscard]] std::string name(std::int64_t i) const;
};

/// Whether the word contains a number directive like %d or %03d.
[[nodiscard]] bool has_number_directive(std::string_view word);
/// A series from its words: pattern first last [step]. Throws Error{input} with `where` for words that are not a series.
[[nodiscard]] DataFiles parse_series(const std::string& header_path, const std::string& where, const std::vector<std::string_view>& words);

enum class Encoding : std::uint8_t { raw, deflate, bzip2, text };

/// Location and encoding of the samples.
struct PayloadPlan {
    std::string header_path;
    DataFiles files;  ///< no files: the samples are in header_path
    Encoding encoding = Encoding::raw;
    std::int64_t offset = 0;         ///< start of the data in each file (an attached payload: after its header)
    std::int64_t line_skip = 0;      ///< then this many lines are skipped
    std::int64_t skip = 0;           ///< then this many bytes; -1: all before the samples at the end (raw only)
    std::int64_t inflated_skip = 0;  ///< then this many decompressed bytes
    ValueType type = ValueType::u8;  ///< of the samples, for texts
    WideInteger wide = WideInteger::none;
    std::int64_t sample_bytes = 0;                 ///< of all files together, decoded
    bool skip_rest = false, follow_links = false;  ///< as in OpenOptions
};

/// Path of data file i. Throws Error{input} for names with control bytes and for files outside the folder of the header (unless
/// follow_links).
[[nodiscard]] std::string data_file_path(const PayloadPlan& plan, std::int64_t i);
/// Opens the payload; checks every data file of a raw plan, and only the sizes in other plans.
/// Throws Error{input}: missing or short data files, files that do not divide the samples evenly.
[[nodiscard]] std::unique_ptr<ByteSource> open_payload(const PayloadPlan& plan);
/// Sum of the sizes of the header and its data files (overflow is impossible: they exist).
[[nodiscard]] std::int64_t bytes_on_disk(const PayloadPlan& plan);

}  // namespace isoatlas
