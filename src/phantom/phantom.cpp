// The catalogue of phantoms, checks of their options, and post-processing: noise, then quantisation.
#include "isoatlas/phantom.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable.h"
#include "phantom/makers.h"

namespace isoatlas {
namespace {

struct Entry {
    const char* name;
    const char* summary;
    std::int64_t default_size, min_size;
    bool fixed_size;
    Volume (*make)(const PhantomOptions&);
};

constexpr Entry kCatalogue[] = {
    {"demo", "two balls joined by a neck, a hollow shell hidden in one, a ring on a thin bridge", 96, 32, false, demo},
    {"figure-plateau", "the dissertation's figure 12.1 as boxes of grey values: exactly 14 events", 24, 24, true,
     [](const PhantomOptions&) { return figure_plateau(); }},
    {"figure-smooth", "the same figure with distinct values: exactly 15 events", 32, 32, true,
     [](const PhantomOptions&) { return figure_smooth(); }},
    {"torus-chain", "--genus tori in a row, touching: one object of that genus for tau in 0.3..0.7", 32, 24, false, torus_chain},
    {"nested-shells", "--shells hollow spheres inside each other: at tau 0.5 each is an object with one cavity", 64, 16, false,
     nested_shells},
    {"marschner-lobb", "the Marschner-Lobb test signal: critical voxels in the first and last slice only", 41, 2, false, marschner_lobb},
    {"gyroid", "two interleaved labyrinths, 2 periods a side, surface at tau 0", 48, 2, false, gyroid},
    {"checkerboard", "0 and 1 alternating: every face ambiguous, ceil(n^3 / 2) objects above 0.5", 16, 1, false, checkerboard},
    {"random-field", "smooth random field, 60 cosines of 2 to 10 periods a side, --seed", 64, 1, false, random_field},
    {"noise", "independent uniform values in [0, 1), --seed", 32, 1, false, noise},
};

[[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& next = {}) {
    throw Error(ErrorKind::usage, {.what = what, .expected = expected, .next = next});
}

/// Number of single-letter changes that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

const Entry& find_entry(const std::string& name) {
    std::string all;
    const Entry* nearest = nullptr;
    std::size_t best = 5;  // larger distances are not typing errors
    for (const Entry& entry : kCatalogue) {
        if (name == entry.name) return entry;
        all += (all.empty() ? "" : ", ") + std::string(entry.name);
        const std::size_t distance = edit_distance(name, entry.name);
        if (distance < best) {
            best = distance;
            nearest = &entry;
        }
    }
    refuse("there is no phantom '" + name + "'", "one of " + all, nearest ? "did you mean '" + std::string(nearest->name) + "'?" : "");
}

void check_size(const Entry& entry, const PhantomOptions& options) {
    constexpr std::int64_t kLargest = 4096;
    const std::string name = "phantom '" + std::string(entry.name) + "'";
    if (entry.fixed_size && options.size != entry.default_size) {
        refuse(name + " has a fixed size, not " + std::to_string(options.size), std::to_string(entry.default_size), "omit the size");
    }
    if (options.size < entry.min_size || options.size > kLargest) {
        refuse(name + " cannot have size " + std::to_string(options.size),
               std::to_string(entry.min_size) + " to " + std::to_string(kLargest) + " samples a side");
    }
}

void check_options(const Entry& entry, const PhantomOptions& options) {
    check_size(entry, options);
    if (options.genus < 1 || options.genus > 1000) refuse("genus " + std::to_string(options.genus) + " is not possible", "1 to 1000");
    const std::int64_t max_shells = options.size / 16;  // a period needs 8 voxels for a clean shell
    if (entry.make == nested_shells && (options.shells < 1 || options.shells > max_shells)) {
        refuse(std::to_string(options.shells) + " shells do not fit into " + std::to_string(options.size) + " samples a side",
               "1 to " + std::to_string(max_shells) + " shells", "ask for at least 16 samples a side per shell");
    }
    if (!(options.noise >= 0 && options.noise <= 1)) refuse("noise must be a fraction of the range of values", "0 to 1");
    if (options.quantise != 0 && (options.quantise < 2 || options.quantise > 65536)) {
        refuse("quantisation to " + std::to_string(options.quantise) + " levels is not possible", "2 to 65536 levels");
    }
}

struct Range {
    double low, high;
};

Range value_range(const Volume& volume) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    visit_samples(volume, [&range](auto samples) {
        for (const auto sample : samples) {
            range.low = std::min(range.low, static_cast<double>(sample));
            range.high = std::max(range.high, static_cast<double>(sample));
        }
    });
    return range;
}

/// A copy as T; convert(value) gives the new sample.
template <class T, class Convert>
Volume converted(const Volume& volume, Convert&& convert) {
    Volume result = make_volume(volume.info.extent, value_type_of<T>, volume.info.geometry);
    visit_samples(volume, [&](auto samples) {
        std::transform(samples.begin(), samples.end(), result.samples<T>().begin(),
                       [&](auto sample) { return static_cast<T>(convert(static_cast<double>(sample))); });
    });
    return result;
}

Volume with_noise(const Volume& volume, double fraction, std::uint64_t seed) {
    const Range range = value_range(volume);
    const double amplitude = fraction * (range.high - range.low);
    Random random(seed ^ 0x6e6f697365u);  // a different sequence than that of the volume
    return converted<float>(volume, [&](double value) { return value + random.between(-amplitude, amplitude); });
}

Volume with_levels(const Volume& volume, std::int64_t levels) {
    const Range range = value_range(volume);
    const double scale = range.high > range.low ? static_cast<double>(levels - 1) / (range.high - range.low) : 0;
    const auto level = [&](double value) { return std::floor((value - range.low) * scale + 0.5); };
    return levels <= 256 ? converted<std::uint8_t>(volume, level) : converted<std::uint16_t>(volume, level);
}

}  // namespace

const std::vector<PhantomDescription>& phantoms() {
    static const std::vector<PhantomDescription> list = [] {
        std::vector<PhantomDescription> descriptions;
        for (const Entry& entry : kCatalogue) descriptions.push_back({entry.name, entry.summary, entry.default_size});
        return descriptions;
    }();
    return list;
}

Volume make_phantom(const std::string& name, const PhantomOptions& options) {
    const Entry& entry = find_entry(name);
    PhantomOptions checked = options;
    if (checked.size == 0) checked.size = entry.default_size;
    check_options(entry, checked);
    Volume volume = entry.make(checked);
    if (checked.noise > 0) volume = with_noise(volume, checked.noise, checked.seed);
    if (checked.quantise > 0) volume = with_levels(volume, checked.quantise);
    volume.info.path = entry.name;
    volume.info.format = "phantom";
    volume.info.description = entry.summary;
    return volume;
}

}  // namespace isoatlas
