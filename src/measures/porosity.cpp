// samples_below(): how many samples are below each isovalue.
#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/parallel.h"
#include "isoatlas/environment.h"
#include "isoatlas/measures.h"

namespace isoatlas {
namespace {

constexpr std::size_t kSampleBlock = std::size_t{1} << 20;

void check_isovalues(std::span<const double> taus) {
    const bool finite = std::ranges::all_of(taus, [](double tau) { return std::isfinite(tau); });
    if (finite && std::ranges::is_sorted(taus)) return;
    throw Error(ErrorKind::usage, {.where = "isovalues", .what = "not ascending", .expected = "finite numbers, ascending"});
}

/// How many of the isovalues each sample reaches: a sample that reaches k of them is below all others.
template <class T>
std::vector<std::int64_t> reached(std::span<const T> samples, std::span<const double> taus) {
    std::vector<std::int64_t> counts(taus.size() + 1);
    for (const T sample : samples) {
        const auto end = std::upper_bound(taus.begin(), taus.end(), static_cast<double>(sample));
        ++counts[static_cast<std::size_t>(end - taus.begin())];
    }
    return counts;
}

}  // namespace

std::vector<std::int64_t> samples_below(const Volume& volume, std::span<const double> taus, const Context& context) {
    const EnvironmentScope scope(context);
    check_isovalues(taus);
    std::vector<std::int64_t> below(taus.size());
    const auto total = static_cast<std::size_t>(volume.info.extent.voxels());
    std::vector<std::vector<std::int64_t>> counts((total + kSampleBlock - 1) / kSampleBlock);
    const CallerLooks look(context);
    for_each_block(context.threads, std::ssize(counts), [&](std::int64_t block) {
        look();
        visit_samples(volume, [&](auto samples) {
            const std::size_t first = static_cast<std::size_t>(block) * kSampleBlock;
            counts[static_cast<std::size_t>(block)] = reached(samples.subspan(first, std::min(kSampleBlock, total - first)), taus);
        });
    });
    for (const std::vector<std::int64_t>& part : counts) {
        for (std::size_t i = 0; i < taus.size(); ++i) below[i] += part[i];
    }
    for (std::size_t i = 1; i < taus.size(); ++i) below[i] += below[i - 1];
    return below;
}

std::vector<std::int64_t> samples_below(const Atlas& atlas, std::span<const double> taus, const Context& context) {
    const EnvironmentScope scope(context);
    check_isovalues(taus);
    if (taus.empty()) return {};
    const auto [low, high] = atlas.range();
    std::vector<double> edges{std::min(low, taus.front())};
    edges.insert(edges.end(), taus.begin(), taus.end());
    edges.push_back(std::max(high, taus.back()));
    std::vector<std::int64_t> below = atlas.histogram(edges, context);
    below.pop_back();
    for (std::size_t i = 1; i < below.size(); ++i) below[i] += below[i - 1];
    return below;
}

}  // namespace isoatlas
