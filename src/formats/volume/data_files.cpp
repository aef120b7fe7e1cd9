#include "formats/volume/data_files.h"

#include <algorithm>
#include <array>
#include <limits>

#include "formats/common/bzip2_source.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/common/text_source.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kWidestNumber = 18;

/// The directive in a pattern: text[begin, end), padded to `width` with `fill`.
struct Directive {
    std::size_t begin = std::string::npos, end = std::string::npos;
    std::size_t width = 0;
    char fill = ' ';
};

Directive find_directive(std::string_view text) {
    for (std::size_t begin = text.find('%'); begin != std::string_view::npos; begin = text.find('%', begin + 1)) {
        Directive found{.begin = begin};
        std::size_t at = begin + 1;
        if (at < text.size() && text[at] == '0') found.fill = '0';
        for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && found.width <= kWidestNumber; ++at) {
            found.width = found.width * 10 + static_cast<std::size_t>(text[at] - '0');
        }
        if (at < text.size() && (text[at] == 'd' || text[at] == 'i' || text[at] == 'u') && found.width <= kWidestNumber) {
            found.end = at + 1;
            return found;
        }
    }
    return {};
}

/// Offset after `lines` line ends, starting at `offset`.
std::int64_t skip_lines(const std::string& path, std::int64_t offset, std::int64_t lines) {
    if (lines == 0) return offset;
    const std::unique_ptr<ByteSource> source = open_file_source(path, offset);
    std::array<std::byte, 16384> chunk;
    for (std::int64_t done = 0; done < source->size_bound();) {
        const auto bytes = static_cast<std::size_t>(std::min<std::int64_t>(chunk.size(), source->size_bound() - done));
        source->read(std::span(chunk).first(bytes));
        for (std::size_t i = 0; i < bytes; ++i) {
            if (chunk[i] == std::byte{'\n'} && --lines == 0) return offset + done + static_cast<std::int64_t>(i) + 1;
        }
        done += static_cast<std::int64_t>(bytes);
    }
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the data file has fewer lines than its header wants to skip",
                                   .expected = std::to_string(lines) + " more lines",
                                   .next = "correct 'line skip' in the header"});
}

std::unique_ptr<ByteSource> open_one(const PayloadPlan& plan, const std::string& path, std::int64_t bytes) {
    const std::int64_t begin = skip_lines(path, plan.offset, plan.line_skip);
    if (plan.encoding == Encoding::raw && plan.skip < 0) {
        const std::int64_t size = file_size(path);
        if (size - begin < bytes) return open_file_source(path, begin, bytes);  // reports what is missing
        return open_file_source(path, size - bytes, bytes);
    }
    const std::int64_t offset = plan.skip > kMax - begin ? kMax : begin + std::max<std::int64_t>(0, plan.skip);
    if (plan.encoding == Encoding::raw) return open_file_source(path, offset);
    if (plan.encoding == Encoding::text) return open_text_source(open_file_source(path, offset), plan.type, TextEnd::separator, plan.wide);
    std::unique_ptr<ByteSource> inflated =
        plan.encoding == Encoding::bzip2 ? open_bzip2_source(path, offset) : open_inflate_source(path, offset);
    if (plan.inflated_skip == 0) return inflated;
    return skip_bytes(std::move(inflated), plan.inflated_skip);
}

[[noreturn]] void bad_part(const std::string& path, std::int64_t holds, std::int64_t wanted) {
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the data file holds " + std::to_string(holds) + " bytes of samples at most",
                                   .expected = std::to_string(wanted) + " bytes",
                                   .next = "the file is truncated or the header is wrong: get both again"});
}

/// Opens each part once, so that a missing or short file is found before anything is read or allocated.
std::int64_t check_parts(const PayloadPlan& plan, std::int64_t part_bytes) {
    std::int64_t bound = 0, rest = 0;
    std::string longer;
    for (std::int64_t part = 0; part < plan.files.count(); ++part) {
        const std::unique_ptr<ByteSource> source = open_one(plan, data_file_path(plan, part), part_bytes);
        const std::int64_t holds = source->size_bound();
        if (holds < part_bytes) bad_part(source->file(), holds, part_bytes);
        if (source->random_access() && holds > part_bytes && longer.empty()) longer = source->file(), rest = holds - part_bytes;
        bound += part_bytes;
    }
    if (!longer.empty() && !plan.skip_rest) refuse_rest(longer, rest);  // a missing file has an error of its own
    return bound;
}

}  // namespace

std::string data_file_path(const PayloadPlan& plan, std::int64_t i) {
    const std::string name = plan.files.name(i);
    if (std::any_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; })) {
        throw Error(ErrorKind::input, {.file = plan.header_path,
                                       .what = "the name of a data file contains control bytes: " + in_quotes(name),
                                       .expected = "a file name",
                                       .next = "the header is damaged: get the file again"});
    }
    const std::string path = beside(plan.header_path, name);
    if (!plan.follow_links) require_own_folder(plan.header_path, path);
    return path;
}

std::int64_t DataFiles::count() const {
    if (pattern.empty()) return static_cast<std::int64_t>(names.size());
    return (last - first) / step + 1;
}

std::string DataFiles::name(std::int64_t i) const {
    if (pattern.empty()) return names[static_cast<std::size_t>(i)];
    const Directive directive = find_directive(pattern);
    const std::string digits = std::to_string(first + i * step);
    const std::size_t padding = digits.size() < directive.width ? directive.width - digits.size() : 0;
    return pattern.substr(0, directive.begin) + std::string(padding, directive.fill) + digits + pattern.substr(directive.end);
}

bool has_number_directive(std::string_view word) { return find_directive(word).end != std::string::npos; }

DataFiles parse_series(const std::string& header_path, const std::string& where, const std::vector<std::string_view>& words) {
    constexpr std::int64_t kLargest = 1'000'000'000'000;
    DataFiles files;
    files.pattern = std::string(words.at(0));
    const auto number = [&](std::size_t i, std::int64_t otherwise) { return i < words.size() ? parse_integer(words[i]) : otherwise; };
    const std::optional<std::int64_t> first = number(1, -1), last = number(2, -1), step = number(3, 1);
    const bool readable = words.size() >= 3 && first && last && step;
    if (!readable || *first < 0 || *last < 0 || *first > kLargest || *last > kLargest || *step == 0 || *step > kLargest ||
        *step < -kLargest || (*last - *first) / *step < 0) {
        throw Error(ErrorKind::input, {.file = header_path,
                                       .where = where,
                                       .what = "the numbered series of data files is not valid",
                                       .expected = "a name with %03d, first number, last number, step",
                                       .next = "correct the header"});
    }
    files.first = *first;
    files.last = *last;
    files.step = *step;
    return files;
}

std::unique_ptr<ByteSource> open_payload(const PayloadPlan& plan) {
    const std::int64_t count = plan.files.count();
    if (count == 0) return open_one(plan, plan.header_path, plan.sample_bytes);
    if (count == 1) return open_one(plan, data_file_path(plan, 0), plan.sample_bytes);
    if (plan.sample_bytes % count != 0 || plan.sample_bytes / count % static_cast<std::int64_t>(size_of(plan.type)) != 0) {
        throw Error(ErrorKind::input, {.file = plan.header_path,
                                       .what = "its " + std::to_string(count) + " data files do not divide the samples evenly",
                                       .expected = "equal parts of " + std::to_string(plan.sample_bytes) + " bytes",
                                       .next = "correct the sizes or the list of files in the header"});
    }
    const std::int64_t part_bytes = plan.sample_bytes / count;
    const std::int64_t bound = check_parts(plan, part_bytes);
    return open_parts_source(
        {.count = count,
         .part_bytes = part_bytes,
         .size_bound = bound,
         .random_access = plan.encoding == Encoding::raw,
         .skip_rest = plan.skip_rest,
         .open = [plan, part_bytes](std::int64_t part) { return open_one(plan, data_file_path(plan, part), part_bytes); },
         .file = plan.header_path});
}

std::int64_t bytes_on_disk(const PayloadPlan& plan) {
    std::int64_t bytes = file_size(plan.header_path);
    for (std::int64_t part = 0; part < plan.files.count(); ++part) bytes += file_size(data_file_path(plan, part));
    return bytes;
}

}  // namespace isoatlas
