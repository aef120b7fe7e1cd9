// Names and colours of labels: segments in a NRRD header (vtkMRMLSegmentationStorageNode), or a table beside the labels.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "formats/common/byte_source.h"
#include "formats/common/byte_writer.h"
#include "formats/common/file_access.h"
#include "formats/common/header_text.h"
#include "formats/common/text.h"
#include "formats/volume/amira_header.h"
#include "formats/volume/nrrd_header.h"
#include "formats/volume/segmentation_table.h"
#include "isoatlas/segmentation.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostNames = 65536;
constexpr std::int64_t kLongestTable = std::int64_t{1} << 24;  ///< bytes

/// Values of NRRD pairs: a backslash begins an escape.
std::string without_escapes(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_escape = text[i] == '\\' && i + 1 < text.size();
        if (is_escape) ++i;
        result += is_escape && text[i] == 'n' ? ' ' : text[i];
    }
    return result;
}

std::uint8_t byte_of(double part) { return static_cast<std::uint8_t>(std::lround(std::clamp(part, 0.0, 1.0) * 255)); }

std::vector<NamedLabel> labels_of_header(const std::string& path) {
    const NrrdHeader header = read_nrrd_header(path);
    const auto text = [&header](std::size_t segment, const char* what) {
        const auto found = header.values.find("Segment" + std::to_string(segment) + "_" + what);
        return found == header.values.end() ? std::string() : found->second;
    };
    std::vector<NamedLabel> labels;
    for (std::size_t i = 0; i < kMostNames; ++i) {
        const std::optional<std::int64_t> label = parse_integer(text(i, "LabelValue"));
        if (!label) break;
        const std::string layer = text(i, "Layer");
        if (!layer.empty() && layer != "0") continue;
        NamedLabel named{*label, one_line(without_escapes(text(i, "Name"))), {}};
        const std::string colour = text(i, "Color");
        const std::vector<std::string_view> words = split_words(colour);
        for (std::size_t channel = 0; channel < 3 && words.size() == 3; ++channel)
            named.colour[channel] = byte_of(parse_number(words[channel]).value_or(0));
        if (!named.name.empty()) labels.push_back(std::move(named));
    }
    return labels;
}

/// Cells of a line of a table; quotes around those with a comma or a quote in them.
std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool is_double = line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"';
        if (line[i] == ',' && !is_quoted) {
            cells.emplace_back();
        } else if (is_double || line[i] != '"') {
            cells.back() += line[i];
            i += is_double ? 1 : 0;
        } else {
            is_quoted = !is_quoted;
        }
    }
    return cells;
}

std::vector<NamedLabel> labels_of_table(const std::string& path) {
    const std::string table = segment_table_path(path);
    if (!file_exists(table)) return {};
    const std::unique_ptr<File> file = open_file(table);
    std::string content(static_cast<std::size_t>(std::min(file->size(), kLongestTable)), '\0');
    content.resize(read_available(*file, table, 0, std::as_writable_bytes(std::span(content.data(), content.size()))));
    std::vector<NamedLabel> labels;
    for (std::size_t begin = 0; begin < content.size() && labels.size() < kMostNames;) {
        const bool is_first = begin == 0;
        const std::string_view line = take_line(content, begin);
        if (is_first && !line.starts_with(kSegmentTableHeader)) return {};
        const std::vector<std::string> cells = cells_of(line);
        const std::optional<std::int64_t> label = parse_integer(cells[0]);
        if (is_first || !label || cells.size() < 5 || cells[1].empty()) continue;
        NamedLabel named{*label, one_line(cells[1]), {}};
        for (std::size_t channel = 0; channel < 3; ++channel)
            named.colour[channel] = byte_of(static_cast<double>(parse_integer(cells[2 + channel]).value_or(0)) / 255);
        labels.push_back(std::move(named));
    }
    return labels;
}

bool is_amira(const std::string& path) {
    const std::vector<std::byte> first = read_header_bytes(path, 16);
    return begins_like_amira({reinterpret_cast<const char*>(first.data()), first.size()});
}

std::vector<NamedLabel> labels_of_materials(const std::string& path) {
    std::vector<NamedLabel> labels = amira_materials(path);
    for (NamedLabel& named : labels) named.name = one_line(named.name);
    std::erase_if(labels, [](const NamedLabel& named) { return named.name.empty(); });
    return labels;
}

}  // namespace

std::string segment_table_path(const std::string& path) {
    const std::size_t drop = ends_with_ignoring_case(path, ".gz") ? path.rfind('.', path.size() - 4) : path.rfind('.');
    return path.substr(0, drop) + ".csv";
}

std::vector<NamedLabel> named_labels(const std::string& path) {
    std::vector<NamedLabel> labels;
    try {
        if (ends_with_ignoring_case(path, ".nrrd"))
            labels = labels_of_header(path);
        else if (is_amira(path))
            labels = labels_of_materials(path);
        if (labels.empty()) labels = labels_of_table(path);
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
        return {};
    }
    std::ranges::stable_sort(labels, {}, &NamedLabel::label);
    const auto rest = std::ranges::unique(labels, {}, &NamedLabel::label);
    labels.erase(rest.begin(), rest.end());
    return labels;
}

}  // namespace isoatlas
