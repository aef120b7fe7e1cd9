#include "atlas/object_arrays.h"

#include <algorithm>
#include <memory>

#include "isoatlas/cavities.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

constexpr const char* kBranchTop = "objects/branch_top";       // not in the first stores of version 1
constexpr const char* kBranchMinimum = "dark/branch_minimum";  // not in the first stores of version 2

/// Calls visit(name, type, member of ObjectEntry) for everything that is stored of an entry.
template <class Visit>
void for_members(Visit&& visit) {
    visit("objects/id", "int64", &ObjectEntry::id);
    visit("objects/event", "int64", &ObjectEntry::event);
    visit("objects/appears", "float64", &ObjectEntry::appears);
    visit("objects/merges", "float64", &ObjectEntry::merges);
    visit("objects/best_tau", "float64", &ObjectEntry::best_tau);
    visit("objects/tau_low", "float64", &ObjectEntry::tau_low);
    visit("objects/tau_high", "float64", &ObjectEntry::tau_high);
    visit("objects/voxels", "int64", &ObjectEntry::voxels);
    visit("objects/measure", "float64", &ObjectEntry::measure);
    visit("objects/tunnels", "int64", &ObjectEntry::tunnels);
    visit("objects/cavities", "int64", &ObjectEntry::cavities);
    visit("objects/hypervolume", "float64", &ObjectEntry::hypervolume);
    visit("objects/inside", "int64", &ObjectEntry::inside);
    visit(kBranchTop, "int64", &ObjectEntry::branch_top);
    visit("objects/outline", "uint8", &ObjectEntry::outline);
    visit("objects/trunk", "uint8", &ObjectEntry::main_branch);
}

/// The same for CavityEntry.
template <class Visit>
void for_cavity_members(Visit&& visit) {
    visit("dark/id", "int64", &CavityEntry::id);
    visit("dark/appears", "float64", &CavityEntry::appears);
    visit("dark/merges", "float64", &CavityEntry::merges);
    visit("dark/best_tau", "float64", &CavityEntry::best_tau);
    visit("dark/tau_low", "float64", &CavityEntry::tau_low);
    visit("dark/tau_high", "float64", &CavityEntry::tau_high);
    visit("dark/voxels", "int64", &CavityEntry::voxels);
    visit("dark/measure", "float64", &CavityEntry::measure);
    visit("dark/hypervolume", "float64", &CavityEntry::hypervolume);
    visit("dark/object", "int64", &CavityEntry::object);
    visit("dark/tunnels", "int64", &CavityEntry::tunnels);
    visit("dark/islands", "int64", &CavityEntry::islands);
    visit("dark/inside", "int64", &CavityEntry::inside);
    visit("dark/reason", "uint8", &CavityEntry::reason);
    visit(kBranchMinimum, "int64", &CavityEntry::branch_minimum);
}

/// The same for RecommendedIsovalue. group: "isovalues" or "dark_isovalues".
template <class Visit>
void for_isovalue_members(const std::string& group, Visit&& visit) {
    visit((group + "/branch_top").c_str(), "int64", &RecommendedIsovalue::branch_top);
    visit((group + "/tau").c_str(), "float64", &RecommendedIsovalue::tau);
    visit((group + "/prominence").c_str(), "float64", &RecommendedIsovalue::prominence);
    visit((group + "/reason").c_str(), "uint8", &RecommendedIsovalue::reason);
    visit((group + "/cavity").c_str(), "int64", &RecommendedIsovalue::cavity);
}

template <class T>
PackedArray owned(const char* name, const char* type, std::vector<T> numbers) {
    const auto held = std::make_shared<std::vector<T>>(std::move(numbers));
    return keeping(packed<T>(name, type, *held), held);
}

/// Type of a member in the file: ids are numbers.
template <class Member>
struct StoredType : std::conditional<std::is_same_v<Member, bool> || std::is_enum_v<Member>, std::uint8_t, Member> {};
template <class Tag, class Number>
struct StoredType<StrongId<Tag, Number>> {
    using type = Number;
};
template <class Member>
using Stored = typename StoredType<Member>::type;

template <class Member>
Stored<Member> to_stored(const Member& member) {
    if constexpr (requires { member.number(); }) {
        return member.number();
    } else {
        return static_cast<Stored<Member>>(member);
    }
}

/// for_each: for_members, for_cavity_members or for_isovalue_members.
template <class Line>
void add_arrays(const auto& for_each, const std::vector<Line>& lines, std::vector<PackedArray>& arrays) {
    for_each([&]<class Member>(const char* name, const char* type, Member Line::* member) {
        std::vector<Stored<Member>> numbers;
        for (const Line& line : lines) numbers.push_back(to_stored(line.*member));
        arrays.push_back(owned(name, type, std::move(numbers)));
    });
}

[[noreturn]] void contradiction(const Container& store) {
    throw Error(ErrorKind::input, {.file = store.path(),
                                   .where = "objects",
                                   .what = "the table is inconsistent",
                                   .next = "the store is damaged: build it again from the volume"});
}

/// The lines of the arrays that for_each visits.
template <class Line>
std::vector<Line> lines_of(const Container& store, const char* first, const char* type, const auto& for_each) {
    std::vector<Line> lines(static_cast<std::size_t>(store.contents().array(first, type).count()));
    for_each([&]<class Member>(const char* name, const char* type_of_member, Member Line::* member) {
        if constexpr (std::is_same_v<Stored<Member>, std::int64_t>) {
            const bool is_optional = std::string_view(name) == kBranchTop || std::string_view(name) == kBranchMinimum;
            if (is_optional && !store.contents().has_array(name)) {
                for (Line& line : lines) line.*member = Member(-1);
                return;
            }
        }
        const auto numbers = store.all<Stored<Member>>(name, type_of_member);
        if (numbers.size() != lines.size()) contradiction(store);
        for (std::size_t i = 0; i < numbers.size(); ++i) lines[i].*member = static_cast<Member>(numbers[i]);
    });
    return lines;
}

/// Objects are not in the first stores of version 1, cavities not in those of version 2.
std::vector<RecommendedIsovalue> isovalues_of(const Container& store, const std::string& group) {
    const std::string first = group + "/tau";
    if (!store.contents().has_array(first)) return {};
    return lines_of<RecommendedIsovalue>(store, first.c_str(), "float64", [&](const auto& visit) { for_isovalue_members(group, visit); });
}

std::array<double, 3> position_of(std::int64_t voxel, const Extent& extent) {
    const Index3 at = extent.voxel(voxel);
    return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
}

void check(const RecommendedIsovalue& isovalue, bool has_cavity, const Container& store) {
    if (isovalue.reason > IsovalueReason::middle || has_cavity != (isovalue.cavity >= 0)) contradiction(store);
    if (isovalue.cavity >= store.contents().volume.extent.voxels()) contradiction(store);
}

void check(const ObjectTable& table, const Container& store) {
    const std::int64_t voxels = store.contents().volume.extent.voxels();
    for (const RecommendedIsovalue& isovalue : table.isovalues) check(isovalue, isovalue.reason == IsovalueReason::inner, store);
    for (const ObjectEntry& entry : table.entries) {
        if (entry.id < 0 || entry.id >= voxels || entry.inside < -1) contradiction(store);
        // A containing entry has a lower isovalue, so the chain ends.
        if (entry.inside < 0) continue;
        const auto inside = static_cast<std::size_t>(entry.inside);
        if (inside >= table.entries.size() || !(table.entries[inside].best_tau < entry.best_tau)) contradiction(store);
    }
}

/// Physical sizes of a store whose spacing was corrected, or of sheared axes, which early versions took as perpendicular: as
/// rank_objects() computes them.
template <class Entry>
void measure_again(const Container& store, std::vector<Entry>& entries) {
    const VolumeInfo& info = store.contents().volume;
    const bool is_even = std::ranges::all_of(info.geometry.coordinates, [](const auto& places) { return places.size() < 2; });
    if (!is_even || (!store.has_other_steps() && skew_of(info.geometry, info.extent.rank) == 1)) return;
    for (Entry& entry : entries) entry.measure = static_cast<double>(entry.voxels) * voxel_measure(info.geometry, info.extent, 0);
}

constexpr const char *kSides = "objects/sides", *kBorder = "objects/border";

std::vector<PackedArray> border_arrays(const ObjectTable& table) {
    std::vector<std::uint8_t> sides;
    std::vector<double> parts;
    for (const ObjectEntry& entry : table.entries) sides.push_back(entry.border.sides), parts.push_back(entry.border.part);
    return {owned(kSides, "uint8", std::move(sides)), owned(kBorder, "float64", std::move(parts))};
}

void read_border(const Container& store, ObjectTable& table) {
    if (!store.contents().has_array(kBorder)) return;
    const auto sides = store.all<std::uint8_t>(kSides, "uint8");
    const auto parts = store.all<double>(kBorder, "float64");
    if (sides.size() != table.entries.size() || parts.size() != sides.size()) contradiction(store);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (sides[i] > 63 || !(parts[i] >= 0 && parts[i] <= 1)) contradiction(store);
        table.entries[i].border = {.sides = sides[i], .part = parts[i]};
    }
}

}  // namespace

std::vector<PackedArray> object_arrays(const ObjectTable& table, Polarity polarity) {
    std::vector<PackedArray> arrays;
    add_arrays([](const auto& visit) { for_members(visit); }, table.entries, arrays);
    add_arrays([](const auto& visit) { for_isovalue_members("isovalues", visit); }, table.isovalues, arrays);
    arrays.push_back(owned<std::int64_t>("objects/branches", "int64", {table.branches}));
    arrays.push_back(owned<double>("objects/noise", "float64", {table.noise}));
    if (polarity == Polarity::low) std::ranges::move(border_arrays(table), std::back_inserter(arrays));
    return arrays;
}

bool has_objects(const Container& store) { return store.contents().has_array("objects/id"); }

ObjectTable objects_of(const Container& store) {
    ObjectTable table;
    table.entries = lines_of<ObjectEntry>(store, "objects/id", "int64", [](const auto& visit) { for_members(visit); });
    const auto branches = store.all<std::int64_t>("objects/branches", "int64");
    const auto noise = store.all<double>("objects/noise", "float64");
    if (branches.size() != 1 || noise.size() != 1) contradiction(store);
    table.branches = branches[0], table.noise = noise[0];
    table.isovalues = isovalues_of(store, "isovalues");
    check(table, store);
    read_border(store, table);
    const Extent& extent = store.contents().volume.extent;
    for (ObjectEntry& entry : table.entries) entry.position = position_of(entry.id, extent);
    measure_again(store, table.entries);
    return table;
}

bool knows_branches(const ObjectTable& table) {
    return std::ranges::all_of(table.entries, [](const ObjectEntry& entry) { return entry.branch_top >= EventId(0); });
}

std::vector<PackedArray> cavity_arrays(const CavityTable& table) {
    std::vector<PackedArray> arrays;
    add_arrays([](const auto& visit) { for_cavity_members(visit); }, table.entries, arrays);
    add_arrays([](const auto& visit) { for_isovalue_members("dark_isovalues", visit); }, table.isovalues, arrays);
    arrays.push_back(owned<std::int64_t>("dark/branches", "int64", {table.branches}));
    arrays.push_back(owned<double>("dark/noise", "float64", {table.noise}));
    return arrays;
}

bool has_cavities(const Container& store) { return store.contents().has_array("dark/id"); }

CavityTable cavities_of(const Container& store) {
    CavityTable table{lines_of<CavityEntry>(store, "dark/id", "int64", [](const auto& visit) { for_cavity_members(visit); })};
    const auto branches = store.all<std::int64_t>("dark/branches", "int64");
    const auto noise = store.all<double>("dark/noise", "float64");
    if (branches.size() != 1 || noise.size() != 1) contradiction(store);
    table.branches = branches[0], table.noise = noise[0];
    table.isovalues = isovalues_of(store, "dark_isovalues");
    for (const RecommendedIsovalue& isovalue : table.isovalues) check(isovalue, true, store);
    const Extent& extent = store.contents().volume.extent;
    const auto count = static_cast<std::int64_t>(table.entries.size());
    for (CavityEntry& entry : table.entries) {
        if (entry.id < 0 || entry.id >= extent.voxels() || entry.inside < -1 || entry.inside >= count) contradiction(store);
        if (entry.reason > IsovalueReason::middle) contradiction(store);
        // A containing entry has a higher isovalue, so the chain ends.
        if (entry.inside >= 0 && !(table.entries[static_cast<std::size_t>(entry.inside)].best_tau > entry.best_tau)) contradiction(store);
        entry.position = position_of(entry.id, extent);
    }
    measure_again(store, table.entries);
    return table;
}

}  // namespace isoatlas
