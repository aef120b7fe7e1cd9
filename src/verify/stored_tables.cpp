// stored_tables_are_recomputed: recomputes every array as a build does, and compares it with the stored one byte by byte.
#include <algorithm>
#include <cstring>
#include <set>

#include "atlas/census_arrays.h"
#include "atlas/tree_arrays.h"
#include "atlas/zone_phase.h"
#include "census/level_census.h"
#include "store/brick_reader.h"
#include "store/brick_writer.h"
#include "store/container.h"
#include "verify/store_checks.h"

namespace isoatlas {
namespace {

/// A number of an array as text.
std::string number_text(std::span<const std::byte> bytes, const std::string& type) {
    const auto read = [bytes]<class T>(T number) {
        std::memcpy(&number, bytes.data(), sizeof number);
        return number;
    };
    if (type == "uint64") return std::to_string(read(std::uint64_t{}));
    if (type == "int64") return std::to_string(read(std::int64_t{}));
    for (int i = 0; i < 8; ++i) {
        if (type != name_of(static_cast<ValueType>(i))) continue;
        return visit_type(static_cast<ValueType>(i), [&](auto zero) { return exact_text(static_cast<double>(read(zero))); });
    }
    return "?";
}

/// Is it of the tables of objects and cavities?
bool has_isovalues(std::string_view array) {
    return array.starts_with("objects/") || array.starts_with("isovalues/") || array.starts_with("dark");
}

/// Does it follow from how samples are coded? That they decode to the samples is checked elsewhere.
bool follows_from_coding(std::string_view array) {
    return array == "volume/data" || array == "volume/offset" || array == "volume/bytes" || array == "volume/checksum";
}

class TableComparison {
public:
    explicit TableComparison(const Atlas& atlas)
        : store_(atlas.info().path, polarity_of(atlas.info())),
          is_present_(store_.contents().has_present_trees()),
          has_present_tables_(store_.contents().has_present_values()) {}

    [[nodiscard]] const Container& store() const { return store_; }
    [[nodiscard]] bool is_present() const { return is_present_; }

    void compare(const std::vector<PackedArray>& arrays) {
        for (const PackedArray& array : arrays) compare(array);
    }
    /// Only arrays of these names.
    void compare(const std::vector<PackedArray>& arrays, const std::set<std::string>& names) {
        for (const PackedArray& array : arrays) {
            if (names.contains(array.name)) compare(array);
        }
    }
    void expect_nothing_else() {
        for (const StoredArray& array : store_.contents().arrays) {
            if (!seen_.contains(array.name)) check_.fail(array.name + " is an unknown array");
        }
    }
    [[nodiscard]] CheckResult result() const {
        std::string counted = std::to_string(numbers_) + " numbers of " + std::to_string(seen_.size()) + " arrays";
        if (!has_present_tables_ || store_.contents().version < kFirstRawVersion)
            counted += "; the others follow the rules of an earlier version";
        return check_.result(counted);
    }

private:
    void compare(const PackedArray& made) {
        const auto& arrays = store_.contents().arrays;
        const auto stored = std::ranges::find(arrays, made.name, &StoredArray::name);
        if (stored == arrays.end() && !is_present_) return;  // not in stores of earlier versions
        seen_.insert(made.name);
        if (!has_present_tables_ && has_isovalues(made.name)) return;
        if (store_.contents().version < kFirstRawVersion && follows_from_coding(made.name)) return;
        if (stored == arrays.end()) return check_.fail(made.name + " is missing");
        if (stored->type != made.type || stored->shape != made.shape) return check_.fail(made.name + " has a different type or size");
        std::int64_t first = 0;
        std::vector<std::byte> part;
        made.feed([&](std::span<const std::byte> bytes) {
            part.resize(bytes.size());
            if (stored->block == 0) store_.read_unchecked(*stored, first, part);
            if (stored->block > 0) store_.read(*stored, first, part);
            look(made, first, part, bytes);
            first += static_cast<std::int64_t>(bytes.size());
        });
        numbers_ += stored->count();
    }
    /// Bytes of an array from `first` on.
    void look(const PackedArray& array, std::int64_t first, std::span<const std::byte> stored, std::span<const std::byte> made) {
        const auto [own, other] = std::ranges::mismatch(stored, made);
        if (own == stored.end()) return;
        const std::int64_t size = size_of_type(array.type), number = (first + (own - stored.begin())) / size;
        const auto at = static_cast<std::size_t>(number * size - first), width = static_cast<std::size_t>(size);
        check_.fail(array.name + "[" + std::to_string(number) + "] is " + number_text(stored.subspan(at, width), array.type) +
                    ", recomputed " + number_text(made.subspan(at, width), array.type));
    }

    Container store_;
    bool is_present_, has_present_tables_;
    Check check_{"stored_tables_are_recomputed"};
    std::set<std::string> seen_;
    std::int64_t numbers_ = 0;
};

}  // namespace

CheckResult stored_tables_are_recomputed(const Atlas& atlas, const Volume& samples, bool anew, const Context& context) {
    TableComparison comparison(atlas);
    const VolumeView volume(samples);
    Context silent = context;
    silent.progress = nullptr;
    const bool is_low = polarity_of(samples.info) == Polarity::low;
    const Volume as_packed = is_low ? negated(samples) : Volume();
    // Which code is chosen may differ from version to version: what it makes of the samples does not.
    std::vector<PackedArray> bricks = brick_arrays(is_low ? VolumeView(as_packed) : volume, silent, brick_heads(comparison.store()));
    if (is_low) {
        std::erase_if(bricks, [](const PackedArray& array) { return array.name == "volume/lowest" || array.name == "volume/highest"; });
        std::ranges::move(brick_place_arrays(volume, silent), std::back_inserter(bricks));
    }
    const LevelCensus census = take_census(volume, silent);
    comparison.compare(census_arrays(census));
    if (!comparison.is_present()) {
        comparison.compare(bricks, {"volume/low", "volume/high", "volume/lowest", "volume/highest"});
        return comparison.result();
    }
    comparison.compare(bricks);
    const AnalysisOptions options{.interpolant = atlas.interpolant(), .tunnel_height = atlas.tunnel_height()};
    if (!anew) {
        const Analysis stored = zoned_analysis_of(comparison.store(), volume, silent);
        const std::unique_ptr<ZonePhase> tables = zone_tables(stored, volume, silent);
        comparison.compare(tables->arrays);
        return comparison.result();
    }
    ContourArcs arcs = compute_arcs(volume, options, silent);
    comparison.compare(tree_arrays(arcs, samples.info, context.threads));
    const std::unique_ptr<ZonePhase> zones = zone_phase(std::move(arcs), volume, silent, silent, [](double) {});
    comparison.compare(zones->arrays);
    comparison.expect_nothing_else();
    return comparison.result();
}

}  // namespace isoatlas
