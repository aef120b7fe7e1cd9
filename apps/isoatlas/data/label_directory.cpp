#include "data/label_directory.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/chosen_surfaces.h"

namespace isoatlas::cli {
namespace {

constexpr std::size_t kMostAtOnce = 1024;  ///< labels in one file, unless references name them

}  // namespace

LabelDirectory::LabelDirectory(const Arguments& arguments, Source& source)
    : arguments_(arguments), source_(source), names_(named_labels(arguments.file)) {
    if (polarity_of(source.info()) == Polarity::low)
        throw Error(ErrorKind::usage, {.file = source.info().path,
                                       .what = "the store holds objects of low values, and labels have none",
                                       .next = "name the volume file, or omit --labels yes"});
}

std::int64_t LabelDirectory::label_of(const ObjectReference& reference) const {
    if (reference.kind == ObjectReference::Kind::number && !reference.tau) return reference.number;
    const auto named = std::ranges::find(names_, reference.word, &NamedLabel::name);
    if (reference.kind == ObjectReference::Kind::name && !reference.tau && named != names_.end()) return named->label;
    throw Error(ErrorKind::usage, {.where = "--object",
                                   .what = "'" + reference.word + "' is not a label",
                                   .expected = "the number of a label" + std::string(names_.empty() ? "" : " or its name") +
                                               ": this volume holds labels, which have no isovalues",
                                   .next = "isoatlas objects " + shell_word(arguments_.file) + " lists them; or --labels no"});
}

std::vector<std::int64_t> LabelDirectory::find(std::span<const ObjectReference> references, std::int64_t top) {
    std::vector<std::int64_t> labels;
    for (const ObjectReference& reference : references) labels.push_back(label_of(reference));
    if (!labels.empty()) return labels;
    LabelTable table = list_labels(source_.volume(), {.interpolant = source_.interpolant()}, source_.context());
    std::vector<LabelRegion>& regions = table.regions;
    if (top > 0) {
        std::ranges::stable_sort(regions, std::ranges::greater(), &LabelRegion::voxels);
        if (std::ssize(regions) > top) regions.erase(regions.begin() + top, regions.end());
    }
    for (const LabelRegion& region : regions) labels.push_back(region.label);
    if (labels.empty() || labels.size() > kMostAtOnce) {
        throw Error(ErrorKind::not_found,
                    {.file = arguments_.file,
                     .what = labels.empty() ? "there is no label but the background" : "there are too many labels for one file",
                     .next = "name some with --object LABEL"});
    }
    return labels;
}

std::string LabelDirectory::name_of(std::int64_t label) const {
    const auto named = std::ranges::find(names_, label, &NamedLabel::label);
    return named == names_.end() ? "" : named->name;
}

std::string LabelDirectory::title_of(std::int64_t label) const {
    const std::string name = name_of(label);
    return name.empty() ? fmt::format("label {}", label) : name;
}

std::array<std::uint8_t, 3> LabelDirectory::colour_of(std::int64_t label) const {
    const auto named = std::ranges::find(names_, label, &NamedLabel::label);
    return named == names_.end() ? bytes_of(colour_of_object(label)) : named->colour;
}

}  // namespace isoatlas::cli
