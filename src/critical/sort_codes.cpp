#include "critical/sort_codes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"

namespace isoatlas {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 17;  // large enough not to stay in memory where that is short

}  // namespace

bool sort_codes(const VolumeView& volume, double tunnel_height, int threads, BigVector<std::uint64_t>& codes, BigVector<double>& values,
                SaddleValues saddles) {
    const std::size_t n = codes.size();
    std::vector<BigVector<KeyedElement>> chunks((n + kChunk - 1) / kChunk);
    std::atomic<bool> all_exist = true;
    for_each_block(threads, static_cast<std::int64_t>(chunks.size()), [&](std::int64_t c) {
        const std::size_t first = c * kChunk;
        const std::span<const std::uint64_t> some = std::span(codes).subspan(first, std::min(kChunk, n - first));
        std::vector<double> found(some.size());
        find_element_values(some, volume, tunnel_height, 1, found, saddles);
        if (std::any_of(found.begin(), found.end(), [](double value) { return std::isnan(value); })) all_exist = false;
        chunks[c].resize(some.size());
        for (std::size_t i = 0; i < some.size(); ++i) chunks[c][i] = {found[i], ElementCode{some[i]}};
    });
    if (!all_exist) return false;
    const Above above{GridSteps(volume.info->extent)};
    sort_chunks(
        threads, std::move(chunks), [](const KeyedElement& element) { return -element.value; }, above,
        [&](std::size_t count) { values.resize(count); },
        [&](std::size_t first, std::span<const KeyedElement> elements) {
            write_fields(std::span(values).subspan(first, elements.size()), elements, [](const KeyedElement& e) { return e.value; });
            write_fields(std::span(codes).subspan(first, elements.size()), elements, [](const KeyedElement& e) { return e.code.bits; });
        });
    return true;
}

}  // namespace isoatlas
