#include "server/object_words.h"

#include <cmath>

#include "isoatlas/atlas.h"
#include "isoatlas/error.h"
#include "isoatlas/isovalue.h"
#include "server/parameter_text.h"
#include "server/query_parameters.h"

namespace isoatlas {
namespace {

constexpr std::string_view kLow = "low";

[[noreturn]] void refuse(std::string_view name, std::string_view item) {
    refuse_parameter(name, item,
                     name == "contour"
                         ? "c and the number of a cavity, or v and a voxel; with an isovalue: c3, v218663@150"
                         : "a number of the table, or v and a voxel; with an isovalue, of low values with low: 2, v218663, low2@150");
}

const NumberedLines::Line& line_of(std::string_view name, std::int64_t number, const std::vector<NumberedLines::Line>& lines,
                                   const std::string& what) {
    if (number >= 1 && number <= std::ssize(lines)) return lines[static_cast<std::size_t>(number - 1)];
    throw Error(ErrorKind::not_found, {.where = std::string(name),
                                       .what = "there is no " + what + " " + std::to_string(number),
                                       .expected = lines.empty() ? "none: the table is empty" : "1 to " + std::to_string(lines.size()),
                                       .next = "/api/atlas lists the first ones"});
}

NamedPart part_of(std::string_view name, std::string_view item, const NumberedSides& sides) {
    const std::size_t mark = std::min(item.find('@'), item.size());
    std::string_view word = item.substr(0, mark);
    NamedPart part{.is_contour = name == "contour", .polarity = sides.polarity};
    if (word.starts_with(kLow)) word.remove_prefix(kLow.size()), part.polarity = Polarity::low;
    const Atlas& atlas = store_of(sides.stores, part.polarity);
    const NumberedLines& lines = sides.lines(part.polarity);
    if (mark < item.size()) {
        const std::optional<double> tau = whole_text_as<double>(item.substr(mark + 1));
        if (!tau || !std::isfinite(*tau)) refuse(name, item);
        part.tau = stored_isovalue(atlas.info(), *tau), part.has_own_tau = true;
    }
    const char letter = word.empty() || (word[0] >= '0' && word[0] <= '9') ? '\0' : word[0];
    if (letter != '\0') word.remove_prefix(1);
    const std::optional<std::int64_t> number = whole_text_as<std::int64_t>(word);
    if (!number || *number < 0 || letter == (part.is_contour ? '\0' : 'c') || (letter != '\0' && letter != 'v' && letter != 'c'))
        refuse(name, item);
    if (letter == 'v') {
        if (*number >= atlas.info().extent.voxels()) refuse(name, item);
        part.voxel = *number;
        return part;
    }
    const NumberedLines::Line& line =
        part.is_contour ? line_of(name, *number, lines.cavities, "cavity") : line_of(name, *number, lines.objects, "object");
    part.number = *number, part.voxel = line.voxel;
    if (!part.tau) part.tau = line.tau;
    return part;
}

}  // namespace

const Atlas& store_of(const StoreSides& stores, Polarity polarity) {
    const Atlas& found = stores.of(polarity);
    if (polarity_of(found.info()) == polarity) return found;
    throw Error(ErrorKind::usage, {.where = "polarity",
                                   .what = std::string("the store does not hold objects of ") + name_of(polarity) + " values",
                                   .next = "omit it, or build a store of both polarities",
                                   .reason = Reason::polarity_not_stored,
                                   .value = name_of(polarity)});
}

NumberedLines numbered_lines(const ObjectTable& objects, const CavityTable& cavities) {
    NumberedLines lines;
    for (const ObjectEntry& entry : objects.entries) lines.objects.push_back({entry.id, entry.best_tau});
    for (const CavityEntry& entry : cavities.entries) lines.cavities.push_back({entry.id, entry.best_tau});
    return lines;
}

std::string title_of(const NamedPart& part) {
    const std::string low(part.polarity == Polarity::low ? kLow : "");
    if (part.number == 0) return (part.is_contour ? "contour " : "") + low + "v" + std::to_string(part.voxel);
    return (part.is_contour ? "cavity " : "object ") + low + std::to_string(part.number);
}

std::vector<NamedPart> named_parts(QueryParameters& words, std::string_view name, const NumberedSides& sides, std::size_t max) {
    std::vector<NamedPart> parts;
    for (const std::string_view item : words.items(name, max)) parts.push_back(part_of(name, item, sides));
    return parts;
}

std::vector<NamedPart> named_parts(QueryParameters& words, const NumberedSides& sides, std::size_t max) {
    std::vector<NamedPart> parts = named_parts(words, "object", sides, max);
    for (const NamedPart& part : named_parts(words, "contour", sides, max)) parts.push_back(part);
    return parts;
}

std::vector<std::int64_t> voxels_of(const std::vector<NamedPart>& parts, Polarity polarity) {
    std::vector<std::int64_t> voxels;
    for (const NamedPart& part : parts) {
        if (part.polarity != polarity)
            throw Error(ErrorKind::usage, {.where = part.is_contour ? "contour" : "object",
                                           .what = "this request is about objects of " + std::string(name_of(polarity)) + " values",
                                           .next = "add polarity=" + std::string(name_of(part.polarity))});
        if (part.has_own_tau)
            throw Error(ErrorKind::usage, {.where = part.is_contour ? "contour" : "object",
                                           .what = "this request has one isovalue for all",
                                           .expected = "no isovalue behind @",
                                           .next = "/api/surfaces takes an isovalue for each"});
        voxels.push_back(part.voxel);
    }
    return voxels;
}

}  // namespace isoatlas
