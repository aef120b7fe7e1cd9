#include "data/sides.h"

#include <algorithm>

#include "data/store_beside.h"

namespace isoatlas::cli {
namespace {

Polarity other(Polarity polarity) { return polarity == Polarity::high ? Polarity::low : Polarity::high; }

/// Every object that the command line names.
std::vector<ObjectReference> named_objects(const Arguments& arguments) {
    std::vector<ObjectReference> all = arguments.objects;
    all.insert(all.end(), arguments.contours.begin(), arguments.contours.end());
    for (const ShownObject& shown : arguments.picture.objects) all.push_back(shown.reference);
    return all;
}

/// Of page and viewer.
Arguments of_both_sides(const Arguments& arguments) {
    Arguments own = arguments;
    if (is_atlas(arguments.file)) return own;
    own.polarity = PolarityChoice::both, own.has_default_polarity = true;
    const bool are_ends = own.inputs.missing_of_low || own.missing.action == MissingPolicy::Action::below;
    if (!are_ends) return own;
    own.polarity = PolarityChoice::high;
    own.inputs.assumed.emplace_back(
        "missing samples lie below all others, where they would be objects of low values: objects of high values alone; "
        "--polarity low shows those of low values, --missing VALUE gives missing samples a value and shows both");
    return own;
}

}  // namespace

Arguments of_side(const Arguments& arguments, Polarity polarity) {
    Arguments own = arguments;
    own.polarity = polarity == Polarity::low ? PolarityChoice::low : PolarityChoice::high;
    if (polarity == Polarity::high || arguments.is_low()) return own;
    if (own.missing.action == MissingPolicy::Action::below) own.missing.action = MissingPolicy::Action::above;
    if (own.inputs.missing_of_low) own.missing = *own.inputs.missing_of_low;
    return own;
}

Arguments with_sides(const Arguments& arguments) {
    if (!arguments.polarity && (arguments.verb == "atlas" || arguments.verb == "view")) return of_both_sides(arguments);
    const std::vector<ObjectReference> all = named_objects(arguments);
    const bool asks_more = arguments.top > 0 || arguments.best || !arguments.picture.taus.empty();
    if (arguments.polarity || all.empty() || asks_more) return arguments;
    const bool is_low = std::ranges::all_of(all, [](const ObjectReference& one) { return one.polarity == Polarity::low; });
    return is_low ? of_side(arguments, Polarity::low) : arguments;
}

Polarity Sides::polarity() {
    if (!polarity_) polarity_ = arguments_.side();
    if (!polarity_ && is_atlas(arguments_.file)) polarity_ = polarity_of(Atlas(arguments_.file).info());
    if (!polarity_) polarity_ = Polarity::high;
    return *polarity_;
}

bool Sides::holds(Polarity polarity) const {
    return !is_atlas(arguments_.file) || isoatlas::holds(Atlas(arguments_.file).polarities(), polarity);
}

Sides::Side& Sides::side(Polarity polarity) {
    std::unique_ptr<Side>& wanted = sides_[static_cast<std::size_t>(polarity)];
    if (wanted) return *wanted;
    Arguments own = of_side(arguments_, polarity);
    if (is_open(other(polarity))) own.quiet = true, own.inputs.assumed.clear();  // the file is described already
    wanted = std::make_unique<Side>(std::move(own), terminal_);
    return *wanted;
}

/// Of a name: the side that has it, first that of the command.
Polarity Sides::polarity_of_reference(const ObjectReference& reference) {
    if (reference.polarity) return *reference.polarity;
    if (reference.kind != ObjectReference::Kind::name || arguments_.polarity) return polarity();
    const auto has_name = [&](Polarity side) {
        if (!holds(side)) return false;
        const std::string file = names_file(arguments_, side);
        return find_object_name(names_in(file, main().info().extent, terminal_), reference.word) != nullptr;
    };
    return !has_name(polarity()) && has_name(other(polarity())) ? other(polarity()) : polarity();
}

/// Both sides look for all of their references at once, which they do faster than one by one.
template <class Find>
std::vector<ChosenObject> Sides::find_on_sides(std::span<const ObjectReference> references, const Find& find) {
    std::array<std::vector<ObjectReference>, 2> wanted;
    std::vector<std::size_t> of;
    for (const ObjectReference& reference : references) {
        of.push_back(static_cast<std::size_t>(polarity_of_reference(reference)));
        wanted[of.back()].push_back(reference);
    }
    std::array<std::vector<ChosenObject>, 2> found;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        const auto i = static_cast<std::size_t>(polarity);
        if (!wanted[i].empty()) found[i] = find(directory(polarity), wanted[i]);
    }
    std::array<std::size_t, 2> next{};
    std::vector<ChosenObject> objects;
    for (const std::size_t i : of) objects.push_back(std::move(found[i][next[i]++]));
    return objects;
}

std::vector<ChosenObject> Sides::find(std::span<const ObjectReference> references, const std::optional<double>& typed) {
    return find_on_sides(references, [&](ObjectDirectory& on, const std::vector<ObjectReference>& own) { return on.find(own, typed); });
}

std::vector<ChosenObject> Sides::find_contours(std::span<const ObjectReference> references, const std::optional<double>& typed) {
    return find_on_sides(references,
                         [&](ObjectDirectory& on, const std::vector<ObjectReference>& own) { return on.find_contours(own, typed); });
}

std::vector<ObjectReference> Sides::first_of_both(std::int64_t count) {
    ObjectsAndCavities high;
    high.objects = source(Polarity::high).objects({.top = 0});
    source(Polarity::high).release_trees();
    const ObjectTable low = source(Polarity::low).objects({.top = 0});
    const Extent& extent = main().info().extent;
    std::vector<ObjectReference> first;
    for (const RankedObject& object : rank_together(high, low, extent, {.top = count})) {
        const ObjectTable& table = object.polarity == Polarity::high ? high.objects : low;
        if (!first.empty() && is_background(table, object.entry, extent)) break;  // it comes last
        const auto number = static_cast<std::int64_t>(object.entry) + 1;
        first.push_back({.number = number, .tau = {}, .word = std::to_string(number), .polarity = object.polarity});
    }
    return first;
}

std::vector<ChosenObject> Sides::first(std::int64_t count) {
    return arguments_.polarity == PolarityChoice::both ? find(first_of_both(count)) : directory().first(count);
}

void Sides::refuse_without_objects() const {
    throw Error(ErrorKind::not_found,
                {.file = arguments_.file,
                 .what = "no object of this volume is above the noise level",
                 .next = "isoatlas objects " + shell_word(arguments_.file) + " --all lists all: choose with --object, or give --tau"});
}

void Sides::release_trees() {
    for (const std::unique_ptr<Side>& side : sides_) {
        if (side) side->source.release_trees();
    }
}

}  // namespace isoatlas::cli
