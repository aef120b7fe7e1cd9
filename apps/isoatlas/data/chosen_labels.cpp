#include "data/chosen_labels.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "data/chosen_surfaces.h"
#include "text/interrupt.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

/// Labels of all objects, each once.
void number_labels(std::vector<LabelledObject>& objects, std::int64_t table) {
    std::set<std::int64_t> taken;
    std::int64_t next = table;
    for (LabelledObject& one : objects) {
        const ChosenObject& object = one.object;
        std::int64_t label = object.number == 0 ? 0 : object.is_contour ? table + object.number : object.number;
        if (label != 0 && !taken.insert(label).second) label = 0;
        one.segment.number = label;
        next = std::max(next, label);
    }
    for (LabelledObject& one : objects) {
        if (one.segment.number == 0) one.segment.number = ++next;
    }
}

[[noreturn]] void does_not_exist(const Arguments& arguments, const ChosenObject& object) {
    throw Error(ErrorKind::not_found, {.file = arguments.file,
                                       .where = fmt::format("{} at {}", title_of(object), object.tau_text),
                                       .what = fmt::format("no {} holds voxel {} at this isovalue", object.is_contour ? "cavity" : "object",
                                                           voxel_word(object.voxel)),
                                       .next = "isoatlas objects " + shell_word(arguments.file) + " --tau T lists what is there"});
}

NestedSource nested_source(Source& source, std::optional<Analysis>& analysis) {
    const auto objects = [&source](double tau) {
        stop_if_interrupted();
        return source.cut(tau, true).label;
    };
    const auto cavities = [&source, &analysis](double tau) {
        stop_if_interrupted();
        if (!analysis) analysis = source.analysis(false);
        std::vector<std::int64_t> ids;
        return label_cavities(source.volume(), *analysis, tau, ids, source.context());
    };
    return {objects, cavities};
}

/// By label, with the number of voxels of each.
void count_voxels(ChosenLabels& labels) {
    std::ranges::stable_sort(labels.objects, {}, [](const LabelledObject& one) { return one.segment.number; });
    std::vector<std::int64_t> voxels(static_cast<std::size_t>(labels.objects.back().segment.number) + 1, 0);
    for (const std::uint32_t label : labels.of_voxel) ++voxels[label];
    for (LabelledObject& one : labels.objects) one.segment.voxels = voxels[static_cast<std::size_t>(one.segment.number)];
}

/// Of objects of one polarity. table: how many objects it has.
ChosenLabels labels_of_side(const Arguments& arguments, Source& source, std::int64_t table, const std::vector<ChosenObject>& objects) {
    ChosenLabels labels;
    const Scale scale(source.info());
    for (const ChosenObject& object : objects) {
        const Colour colour = colour_of(object, std::ssize(labels.objects));
        labels.objects.push_back({object, {0, title_of(object), bytes_of(colour), scale.reported(object.tau), 0, object.polarity}});
    }
    number_labels(labels.objects, table);
    std::vector<NestedPart> parts;
    for (const auto& [object, segment] : labels.objects)
        parts.push_back({object.is_contour, object.voxel, object.tau, static_cast<std::uint32_t>(segment.number)});
    std::optional<Analysis> analysis;
    try {
        labels.of_voxel = nested_labels(source.info().extent.voxels(), parts, nested_source(source, analysis));
    } catch (const Error& error) {
        const bool is_of_part = error.kind() == ErrorKind::not_found && error.text().where.starts_with("part ");
        if (!is_of_part) throw;
        does_not_exist(arguments, objects[std::stoull(error.text().where.substr(5))]);
    }
    count_voxels(labels);
    return labels;
}

/// Adds those of low values behind the last label of the others.
void add_labels(ChosenLabels& labels, ChosenLabels low) {
    const std::int64_t last = labels.objects.back().segment.number;
    std::vector<std::uint32_t> renumbered(static_cast<std::size_t>(low.objects.back().segment.number) + 1, 0);
    for (LabelledObject& one : low.objects) {
        const std::int64_t number = last + (&one - low.objects.data()) + 1;
        renumbered[static_cast<std::size_t>(one.segment.number)] = static_cast<std::uint32_t>(number);
        one.segment.number = number;
        labels.objects.push_back(std::move(one));
    }
    for (std::uint32_t& label : low.of_voxel) label = renumbered[label];
    overlay_labels(labels.of_voxel, low.of_voxel);
    count_voxels(labels);
}

}  // namespace

ChosenLabels chosen_labels(const Arguments& arguments, Sides& sides, const std::vector<ChosenObject>& objects) {
    std::optional<ChosenLabels> labels;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        std::vector<ChosenObject> own;
        std::ranges::copy_if(objects, std::back_inserter(own), [&](const ChosenObject& object) { return object.polarity == polarity; });
        if (own.empty()) continue;
        const std::int64_t table = sides.directory(polarity).object_count();
        sides.source(polarity).release_trees();
        ChosenLabels found = labels_of_side(arguments, sides.source(polarity), table, own);
        if (labels) {
            add_labels(*labels, std::move(found));
        } else {
            labels = std::move(found);
        }
    }
    return std::move(labels.value());
}

}  // namespace isoatlas::cli
