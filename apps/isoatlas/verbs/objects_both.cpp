// isoatlas objects --polarity both: the objects of high and of low values in one list.
#include <algorithm>

#include <fmt/format.h>

#include "data/assume_inputs.h"
#include "data/sides.h"
#include "text/document.h"
#include "text/entry_json.h"
#include "text/sizes.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kListedTogether = 24;

/// How the entries of a table are called.
struct Called {
    std::vector<std::int64_t> numbers;    ///< 0: none
    std::vector<std::string> references;  ///< "2", "low2"; without a number the voxel
    std::vector<std::string> names;       ///< that a user gave; empty: none
    std::vector<Card> cards;
};

Called find_called(const Arguments& own, Source& source, Terminal& terminal, const ObjectTable& table) {
    ObjectDirectory directory(own, source, terminal);
    const Polarity polarity = polarity_of(source.info());
    Called called;
    called.cards = cards_of(table, source.info().extent);
    for (const ObjectEntry& entry : table.entries) {
        const bool is_numbered = !own.all && !own.selects;
        const std::int64_t number = is_numbered ? std::ssize(called.numbers) + 1 : directory.number_of(entry);
        called.numbers.push_back(number);
        called.references.push_back(with_polarity(number == 0 ? voxel_word(entry.id) : std::to_string(number), polarity));
        called.names.push_back(directory.name_of(entry));
    }
    return called;
}

/// What the list is made of. One polarity is in memory at a time.
struct Tables {
    ObjectsAndCavities high;
    ObjectTable low;
    Called high_called, low_called;
    VolumeInfo info, low_info;
    Interpolant interpolant{};
    double tunnel_height = 0;
    ValueRange range{};
    std::optional<QueryCost> reads;
    std::vector<RankedObject> list;

    [[nodiscard]] const ObjectTable& of(Polarity polarity) const { return polarity == Polarity::high ? high.objects : low; }
    [[nodiscard]] const Called& called(Polarity polarity) const { return polarity == Polarity::high ? high_called : low_called; }
    [[nodiscard]] const VolumeInfo& info_of(Polarity polarity) const { return polarity == Polarity::high ? info : low_info; }
    [[nodiscard]] const ObjectEntry& entry(const RankedObject& object) const { return of(object.polarity).entries[object.entry]; }
    [[nodiscard]] const Card& card(const RankedObject& object) const { return called(object.polarity).cards[object.entry]; }
    /// Line of the list whose card it is on, from 1; 0: not listed.
    [[nodiscard]] std::int64_t card_line(const RankedObject& object) const {
        const auto own = std::ranges::find_if(
            list, [&](const RankedObject& other) { return other.polarity == object.polarity && other.entry == card(object).line; });
        return own == list.end() ? 0 : own - list.begin() + 1;
    }
    /// Of a line of the list.
    [[nodiscard]] const std::string& reference(std::int64_t line) const {
        const RankedObject& object = list[static_cast<std::size_t>(line)];
        return called(object.polarity).references[object.entry];
    }
};

RankOptions rank_options(const Arguments& arguments, Source& source) {
    RankOptions options{.top = 0, .gate = !arguments.all};
    if (arguments.selects) options.selection = source.selection();
    return options;
}

/// TogetherOptions::holds by a cut, kept for the questions that follow about the same object.
class Holder {
public:
    explicit Holder(Source& source) : source_(&source) {}
    bool operator()(const ObjectEntry& low, std::int64_t voxel) {
        if (!at_ || at_->tau != low.best_tau) at_ = source_->cut(low.best_tau, true);
        const std::vector<std::int32_t>& label = at_->label;
        return label[static_cast<std::size_t>(voxel)] == label[static_cast<std::size_t>(low.id)];
    }

private:
    Source* source_;
    std::optional<Cut> at_;
};

Tables find_tables(const Arguments& arguments, Terminal& terminal) {
    Tables tables;
    {
        const Arguments own = of_side(arguments, Polarity::high);
        Source source(own, terminal);
        tables.high = source.objects_and_cavities(rank_options(own, source));
        tables.high_called = find_called(own, source, terminal, tables.high.objects);
        tables.info = source.info(), tables.interpolant = source.interpolant(), tables.tunnel_height = source.tunnel_height();
        tables.range = source.range();
        tables.reads = source.reads();
    }
    Arguments own = of_side(arguments, Polarity::low);
    own.quiet = true;  // the file is described already
    own.inputs.assumed.clear();
    Source source(own, terminal);
    tables.low = source.objects(rank_options(own, source));
    tables.low_called = find_called(own, source, terminal, tables.low);
    tables.low_info = source.info();
    const std::int64_t top = arguments.top > 0 ? arguments.top : arguments.all || arguments.selects ? 0 : kListedTogether;
    tables.list = rank_together(tables.high, tables.low, tables.info.extent, {.top = top, .holds = Holder(source)});
    if (tables.reads) *tables.reads += source.reads().value_or(QueryCost{});
    return tables;
}

std::string tau_text(const ObjectEntry& entry, const Scale& scale) {
    return scale.text_within(entry.best_tau, entry.tau_low, entry.tau_high);
}

/// RankedObject::note, where lines are called by their numbers in the tables.
std::string line_note(const Tables& tables, const RankedObject& object) {
    const ObjectEntry& entry = tables.entry(object);
    std::string note;
    const auto add = [&note](const std::string& text) {
        if (!text.empty()) note += (note.empty() ? "" : ", ") + text;
    };
    if (entry.outline) {
        add("outline");
    } else if (object.inside >= 0) {
        add("inside " + tables.reference(object.inside));
    } else if (entry.main_branch) {
        add("largest");
    }
    add(likeness_note(tables.card(object), object.entry, tables.called(object.polarity).references));
    if (object.is_enclosed) add(object.cavity_of >= 0 ? "cavity of " + tables.reference(object.cavity_of) : "cavity");
    if (object.polarity == Polarity::low) add(border_text(entry.border, tables.info.extent));
    return note;
}

Json object_json(const Tables& tables, const RankedObject& object) {
    const VolumeInfo& info = tables.info_of(object.polarity);
    const ObjectTable& table = tables.of(object.polarity);
    const Called& called = tables.called(object.polarity);
    const ObjectEntry& entry = tables.entry(object);
    const Scale scale(info);
    Json json{{"polarity", name_of(object.polarity)}, {"id", entry.id}, {"event", entry.event.number()}};
    add_number_and_name(json, called.numbers[object.entry], called.names[object.entry]);
    json["reference"] = called.references[object.entry];
    add_isovalues_and_topology(json, table, entry, scale);
    add_size_and_place(json, entry, info, line_note(tables, object));
    json["inside"] = object.inside >= 0 ? Json(object.inside + 1) : Json(nullptr);
    json["like"] = likeness_json(tables.card(object), tables.card_line(object), tables.card(object).line == object.entry);
    json["cavity_of"] = object.cavity_of >= 0 ? Json(object.cavity_of + 1) : Json(nullptr);
    json["border"] = border_json(entry.border);
    return json;
}

void print_list_json(Terminal& terminal, const Tables& tables) {
    const std::vector<RankedObject>& list = tables.list;
    Json head = document("objects", tables.info, tables.interpolant, tables.tunnel_height);
    head["polarity"] = name_of(PolarityChoice::both);
    head["tau"] = nullptr;
    head["branches"] = tables.high.objects.branches + tables.low.branches;
    head["hidden"] = tables.high.objects.branches + tables.low.branches - std::ssize(list);
    head["noise"] = tables.high.objects.noise * tables.info.calibration.slope;
    const double range = tables.range.high - tables.range.low;
    head["noise_part"] = range > 0 ? tables.high.objects.noise / range : 0;
    add_reads(head, tables.reads);
    print(terminal, head, "objects", std::ssize(list),
          [&](std::int64_t i) { return object_json(tables, list[static_cast<std::size_t>(i)]); });
}

/// Columns: reference to the table of the polarity, and name.
Table table_of(const Tables& tables) {
    const Sizes sizes(tables.info, std::max(largest_measure(tables.high.objects.entries), largest_measure(tables.low.entries)));
    const auto is_named = [&](const RankedObject& object) { return !tables.called(object.polarity).names[object.entry].empty(); };
    const bool has_name = std::ranges::any_of(tables.list, is_named);
    std::vector<Table::Column> columns{{"polarity", true}, {"#", true}};
    if (has_name) columns.push_back({"name", true});
    columns.insert(columns.end(), {{"id"}, {"appears"}, {"merges"}, {"best tau" + in_unit(tables.info)}});
    sizes.add_titles(columns);
    columns.insert(columns.end(), {{"reason", true}, {"note", true}});
    Table text(columns);
    for (const RankedObject& object : tables.list) {
        const ObjectEntry& entry = tables.entry(object);
        const Called& called = tables.called(object.polarity);
        const std::int64_t number = called.numbers[object.entry];
        const Scale scale(tables.info_of(object.polarity));
        std::vector<std::string> row{name_of(object.polarity), number == 0 ? "-" : called.references[object.entry]};
        if (has_name) row.push_back(called.names[object.entry]);
        row.insert(row.end(), {voxel_word(entry.id), scale.brief(entry.appears), scale.brief(entry.merges), tau_text(entry, scale)});
        sizes.add(row, entry.voxels, entry.measure, entry.tunnels, entry.cavities);
        const std::optional<RecommendedIsovalue> best = isovalue_of(tables.of(object.polarity), entry);
        row.insert(row.end(), {best ? name_of(best->reason) : "", line_note(tables, object)});
        text.add(row);
    }
    return text;
}

void print_list(Terminal& terminal, const Arguments& arguments, const Tables& tables) {
    terminal.say(fmt::format("{} and {} in all; {} listed, by contrast times size; {}",
                             counted(tables.high.objects.branches, "maximum", "maxima"), counted(tables.low.branches, "minimum", "minima"),
                             counted(std::ssize(tables.list), "line"),
                             interpolant_text(tables.info, tables.interpolant, tables.tunnel_height)));
    table_of(tables).print(terminal);
    if (const std::string advice = noise_advice(arguments, tables.info); !advice.empty()) terminal.say("note: " + advice);
    if (tables.list.empty()) return terminal.say("no object is above the noise level; --all lists all objects");
    const RankedObject& first = tables.list[0];
    const bool has_number = tables.called(first.polarity).numbers[first.entry] != 0;
    const std::string at = has_number ? "" : "@" + tau_text(tables.entry(first), Scale(tables.info_of(first.polarity)));
    terminal.next(fmt::format("isoatlas extract {}{} --object {}{} -o object.ply", shell_word(arguments.file), reading_options(arguments),
                              tables.reference(0), at));
}

}  // namespace

int run_objects_of_both(const Arguments& arguments, Terminal& terminal) {
    const Tables tables = find_tables(arguments, terminal);
    if (arguments.json) {
        print_list_json(terminal, tables);
    } else {
        print_list(terminal, arguments, tables);
    }
    return 0;
}

}  // namespace isoatlas::cli
