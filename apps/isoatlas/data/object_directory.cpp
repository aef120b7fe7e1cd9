#include "data/object_directory.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/store_beside.h"
#include "options/suggest.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kLines = 1000;  ///< that a store has without a new analysis

using Kind = ObjectReference::Kind;

std::string list_command(const Arguments& arguments) {
    return "isoatlas objects " + shell_word(arguments.file) + reading_options(arguments);
}

[[noreturn]] void not_found(const Arguments& arguments, const std::string& what, const std::string& expected, const std::string& next) {
    throw Error(ErrorKind::not_found, {.file = arguments.file, .what = what, .expected = expected, .next = next});
}

/// Line of the same object at the same isovalue.
template <class Table, class Entry>
std::int64_t line_of(const Table& table, const Entry& entry) {
    const auto same =
        std::ranges::find_if(table.entries, [&](const auto& other) { return other.id == entry.id && other.best_tau == entry.best_tau; });
    return same == table.entries.end() ? 0 : same - table.entries.begin() + 1;
}

}  // namespace

std::string title_of(const ChosenObject& object) {
    if (!object.name.empty()) return object.name;
    const auto own = [&](const std::string& word) { return with_polarity(word, object.polarity); };
    if (object.number == 0) return (object.is_contour ? "contour " : "") + own(voxel_word(object.voxel));
    return (object.is_contour ? "cavity " : "object ") + own(std::to_string(object.number));
}

std::string reference_of(const ChosenObject& object, bool with_tau) {
    const std::string word = object.number == 0  ? voxel_word(object.voxel)
                             : object.is_contour ? cavity_word(object.number)
                                                 : std::to_string(object.number);
    return with_polarity(word, object.polarity) + (with_tau && !object.is_best ? "@" + object.tau_text : "");
}

Colour colour_of(const ChosenObject& object, std::int64_t place) {
    if (object.number == 0) return palette(place);
    const bool is_low = object.polarity == Polarity::low;
    return object.is_contour != is_low ? colour_of_cavity(object.number) : colour_of_object(object.number);
}

std::string names_file(const Arguments& arguments, Polarity polarity) {
    return object_names_path(is_atlas(arguments.file) ? arguments.file : stem_of_volume(arguments) + ".atlas", polarity);
}

std::vector<ObjectName> names_in(const std::string& file, const Extent& extent, Terminal& terminal) {
    try {
        return read_object_names(file, extent);
    } catch (const Error& error) {
        terminal.warn(std::string("names are not used: ") + error.what());
        return {};
    }
}

ObjectDirectory::ObjectDirectory(const Arguments& arguments, Source& source, Terminal& terminal)
    : arguments_(arguments), source_(source), terminal_(terminal) {}

const ObjectTable& ObjectDirectory::objects() {
    if (!objects_) objects_ = source_.objects({.top = kLines});
    return *objects_;
}

const CavityTable& ObjectDirectory::cavities() {
    if (!cavities_) cavities_ = source_.cavities({.top = kLines});
    return *cavities_;
}

std::int64_t ObjectDirectory::object_count() { return std::ssize(objects().entries); }

void ObjectDirectory::load_both() {
    if (objects_ || cavities_) return;
    ObjectsAndCavities both = source_.objects_and_cavities({.top = kLines});
    objects_ = std::move(both.objects), cavities_ = std::move(both.cavities);
}

const std::vector<ObjectName>& ObjectDirectory::names() {
    if (!names_) names_ = names_in(names_file(arguments_, polarity_of(source_.info())), source_.info().extent, terminal_);
    return *names_;
}

std::int64_t ObjectDirectory::number_of(const ObjectEntry& entry) { return line_of(objects(), entry); }
std::int64_t ObjectDirectory::number_of(const CavityEntry& entry) { return line_of(cavities(), entry); }

std::string ObjectDirectory::name_of(const ObjectEntry& entry) {
    const ObjectName* found = find_object_name(names(), false, entry.id, Scale(source_.info()).reported(entry.best_tau));
    return found == nullptr ? "" : found->name;
}

std::string ObjectDirectory::name_of(const CavityEntry& entry) {
    const ObjectName* found = find_object_name(names(), true, entry.id, Scale(source_.info()).reported(entry.best_tau));
    return found == nullptr ? "" : found->name;
}

ChosenObject ObjectDirectory::chosen(const ObjectEntry& entry, std::int64_t number) {
    const std::string tau = Scale(source_.info()).text_within(entry.best_tau, entry.tau_low, entry.tau_high);
    return {number, false, entry.id, entry.best_tau, tau, true, name_of(entry), polarity()};
}

ChosenObject ObjectDirectory::chosen(const CavityEntry& entry, std::int64_t number) {
    const std::string tau = Scale(source_.info()).text_within(entry.best_tau, entry.tau_low, entry.tau_high);
    return {number, true, entry.id, entry.best_tau, tau, true, name_of(entry), polarity()};
}

ChosenObject ObjectDirectory::at(ChosenObject object, double typed) {
    const double tau = source_.stored(typed);
    if (tau == object.tau) return object;
    object.tau = tau, object.tau_text = fmt::format("{}", typed), object.is_best = false;
    return object;
}

std::vector<ChosenObject> ObjectDirectory::find(std::span<const ObjectReference> references, const std::optional<double>& typed) {
    const auto has = [&](Kind kind) { return std::ranges::any_of(references, [&](const auto& one) { return one.kind == kind; }); };
    const bool names_cavity = has(Kind::name) && std::ranges::any_of(names(), &ObjectName::is_cavity);
    if ((has(Kind::number) || has(Kind::name)) && (has(Kind::cavity) || names_cavity)) load_both();
    std::vector<ChosenObject> objects;
    for (const ObjectReference& reference : references) {
        const std::optional<double> tau = reference.tau ? reference.tau : typed;
        switch (reference.kind) {
            case Kind::number: objects.push_back(numbered(reference, tau)); break;
            case Kind::cavity: objects.push_back(cavity(reference, tau)); break;
            case Kind::voxel: objects.push_back(voxel(reference, tau)); break;
            case Kind::name: objects.push_back(named(reference, tau)); break;
        }
    }
    return objects;
}

std::vector<ChosenObject> ObjectDirectory::find_contours(std::span<const ObjectReference> references, const std::optional<double>& typed) {
    std::vector<ChosenObject> contours;
    for (const ObjectReference& reference : references) {
        const std::optional<double> tau = reference.tau ? reference.tau : typed;
        if (reference.kind == Kind::number) {
            throw Error(ErrorKind::usage,
                        {.where = "contour " + reference.word,
                         .what = "a number is that of an object of the table, not of a contour",
                         .expected = fmt::format("c{0} for cavity {0}, v{0} for the contour of voxel {0}", reference.number),
                         .next = list_command(arguments_) + " --cavities lists cavities"});
        }
        if (reference.kind != Kind::voxel) {
            contours.push_back(find({&reference, 1}, typed).front());
            if (contours.back().is_contour) continue;
            throw Error(ErrorKind::usage, {.where = "contour " + reference.word,
                                           .what = "it is the name of an object, not of a cavity",
                                           .next = "refer to it as an object"});
        }
        check_voxel(reference.number);
        if (!tau)
            throw Error(ErrorKind::usage, {.where = "contour " + reference.word,
                                           .what = "at which isovalue?",
                                           .expected = reference.word + "@T",
                                           .next = list_command(arguments_) + " --cavities lists cavities and their isovalues"});
        ChosenObject contour{
            .is_contour = true, .voxel = reference.number, .tau = source_.stored(*tau), .tau_text = fmt::format("{}", *tau)};
        contour.polarity = polarity();
        contours.push_back(contour);
    }
    return contours;
}

std::vector<ChosenObject> ObjectDirectory::first(std::int64_t count) {
    const ObjectTable table = source_.objects({.top = 0});
    const Extent& extent = source_.info().extent;
    std::vector<ChosenObject> objects;
    for (std::size_t i = 0; i < table.entries.size() && std::ssize(objects) < count; ++i) {
        if (table.entries.size() > 1 && is_background(table, i, extent)) continue;
        objects.push_back(chosen(table.entries[i], static_cast<std::int64_t>(i) + 1));
    }
    return objects;
}

void ObjectDirectory::no_number(std::int64_t number, bool is_cavity, std::int64_t count) const {
    const std::string of_low = polarity() == Polarity::low ? " of low values" : "";
    const std::string what = is_cavity ? "cavity" : "object", many = is_cavity ? "cavities" : "objects";
    const std::string expected = count == 0   ? fmt::format("no {} of this volume is above the noise level", what)
                                 : count == 1 ? fmt::format("1: the table has one {}", what)
                                              : fmt::format("1 to {}: the table{} has {} {}", count, of_low, count, many);
    const bool is_voxel = !is_cavity && number >= 0 && number < source_.info().extent.voxels();
    const std::string other =
        is_voxel ? fmt::format("; the object of voxel {} is {}", number, with_polarity(voxel_word(number), polarity())) : "";
    not_found(arguments_, fmt::format("there is no {} {}", what, with_polarity(std::to_string(number), polarity())), expected,
              list_command(arguments_) + (is_cavity ? " --cavities" : "") + " lists them" + other);
}

ChosenObject ObjectDirectory::numbered(const ObjectReference& reference, const std::optional<double>& typed) {
    const std::int64_t number = reference.number;
    if (number > kLines && std::ssize(objects().entries) == kLines) objects_ = source_.objects({.top = 0});
    const std::int64_t count = std::ssize(objects().entries);
    if (number < 1 || number > count) no_number(number, false, count);
    const ObjectEntry& entry = objects_->entries[static_cast<std::size_t>(number - 1)];
    ChosenObject object = chosen(entry, number);
    if (!typed) return object;
    const Scale scale(source_.info());
    if (scale.stored(*typed) > entry.appears && source_.stored(*typed) > entry.appears) {
        not_found(arguments_, fmt::format("{} does not exist at {}", title_of(object), *typed),
                  fmt::format("an isovalue of at {} {}, where it appears", scale.is_low() ? "least" : "most", scale.text(entry.appears)),
                  fmt::format("{} shows it best", reference_of(object) + "@" + object.tau_text));
    }
    return at(object, *typed);
}

ChosenObject ObjectDirectory::cavity(const ObjectReference& reference, const std::optional<double>& typed) {
    const std::int64_t number = reference.number;
    if (number > kLines && std::ssize(cavities().entries) == kLines) cavities_ = source_.cavities({.top = 0});
    const std::int64_t count = std::ssize(cavities().entries);
    if (number < 1 || number > count) no_number(number, true, count);
    const ChosenObject object = chosen(cavities_->entries[static_cast<std::size_t>(number - 1)], number);
    return typed ? at(object, *typed) : object;
}

void ObjectDirectory::check_voxel(std::int64_t voxel) const {
    const std::int64_t voxels = source_.info().extent.voxels();
    if (voxel < voxels) return;
    not_found(arguments_, fmt::format("there is no voxel v{}", voxel), fmt::format("v0 to v{}", voxels - 1),
              list_command(arguments_) + " lists objects");
}

ChosenObject ObjectDirectory::voxel(const ObjectReference& reference, const std::optional<double>& typed) {
    check_voxel(reference.number);
    if (!typed) return voxel_of_lines(reference);
    const double tau = source_.stored(*typed);
    ChosenObject object{.voxel = reference.number, .tau = tau, .tau_text = fmt::format("{}", *typed)};
    object.polarity = polarity();
    const ObjectName* name = find_object_name(names(), false, object.voxel, Scale(source_.info()).reported(tau));
    if (name != nullptr) object.name = name->name;
    return object;
}

/// A voxel without an isovalue: the only line whose object has it as its highest.
ChosenObject ObjectDirectory::voxel_of_lines(const ObjectReference& reference) {
    const auto lines = [&](const ObjectTable& table) {
        std::vector<std::int64_t> found;
        for (std::size_t i = 0; i < table.entries.size(); ++i) {
            if (table.entries[i].id == reference.number) found.push_back(static_cast<std::int64_t>(i) + 1);
        }
        return found;
    };
    const std::vector<std::int64_t> own = lines(objects());
    if (own.size() == 1) return chosen(objects_->entries[static_cast<std::size_t>(own[0] - 1)], own[0]);
    if (own.size() > 1) {
        std::string numbers;
        for (const std::int64_t number : own) numbers += (numbers.empty() ? "" : ", ") + std::to_string(number);
        throw Error(ErrorKind::usage, {.file = arguments_.file,
                                       .what = fmt::format("{} is the voxel of the objects {}", reference.word, numbers),
                                       .expected = "one of these numbers",
                                       .next = fmt::format("give the number, or {}@T for an isovalue", reference.word)});
    }
    const ObjectTable all = source_.objects({.top = 0, .gate = false});
    const std::vector<std::int64_t> others = lines(all);
    if (!others.empty()) return chosen(all.entries[static_cast<std::size_t>(others[0] - 1)], 0);
    const bool is_low = polarity() == Polarity::low;
    not_found(arguments_, fmt::format("no object of the table has {} as its {} voxel", reference.word, is_low ? "lowest" : "highest"), "",
              fmt::format("{} lists them; {}@T is the object at T that holds this voxel", list_command(arguments_), reference.word));
}

ChosenObject ObjectDirectory::named(const ObjectReference& reference, const std::optional<double>& typed) {
    const std::string file = names_file(arguments_, polarity_of(source_.info()));
    const std::vector<ObjectName> all = read_object_names(file, source_.info().extent);  // a damaged file is an error here
    const ObjectName* name = find_object_name(all, reference.word);
    if (name == nullptr) {
        std::vector<std::string> known;
        for (const ObjectName& one : all) known.push_back(one.name);
        const std::string near = nearest(reference.word, known);
        not_found(arguments_, fmt::format("no object has the name \"{}\"", shown_name(reference.word)),
                  known.empty() ? "there are no names yet" : list_of(known),
                  (near.empty() ? "" : "did you mean " + shell_word(near) + "? ") + list_command(arguments_) + " lists numbers and names");
    }
    const Scale scale(source_.info());
    ChosenObject object{.is_contour = name->is_cavity, .voxel = name->voxel, .tau = scale.stored(name->isovalue)};
    object.tau_text = fmt::format("{}", name->isovalue), object.name = name->name, object.polarity = polarity();
    const auto look = [&](const auto& table) {
        for (std::size_t i = 0; i < table.entries.size(); ++i) {
            const auto& entry = table.entries[i];
            if (entry.id == name->voxel && scale.reported(entry.best_tau) == name->isovalue)
                object = chosen(entry, static_cast<std::int64_t>(i) + 1);
        }
    };
    name->is_cavity ? look(cavities()) : look(objects());
    return typed ? at(object, *typed) : object;
}

}  // namespace isoatlas::cli
