#include "mesh/keep_contours.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

/// The elements i of some arrays for which has(i).
template <class Has>
class Kept {
public:
    Kept(std::size_t size, int threads, Has has)
        : size_(size),
          portions_(static_cast<std::int64_t>((size + kPortion - 1) / kPortion)),
          threads_(threads),
          has_(has),
          first_(static_cast<std::size_t>(portions_) + 1) {
        for_each_block(threads_, portions_, [&](std::int64_t portion) {
            std::size_t count = 0;
            for_each_of(portion, [&](std::size_t i) { count += has_(i) ? 1 : 0; });
            first_[portion + 1] = count;
        });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
    }

    [[nodiscard]] bool all() const { return first_.back() == size_; }

    /// visit(i, the number of kept elements before i) for each that is kept.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for_each_block(threads_, portions_, [&](std::int64_t portion) {
            std::size_t place = first_[portion];
            for_each_of(portion, [&](std::size_t i) {
                if (has_(i)) visit(i, place++);
            });
        });
    }

    /// Leaves one of the arrays nothing else, each element as map makes it.
    template <class Element, class Map>
    void keep(Array<Element>& elements, Map&& map) const {
        Array<Element> kept;
        kept.resize(first_.back());
        for_each([&](std::size_t i, std::size_t place) { kept[place] = map(elements[i]); });
        elements.swap(kept);
    }

private:
    static constexpr std::size_t kPortion = std::size_t{1} << 14;  ///< elements that a thread takes at once

    template <class Visit>
    void for_each_of(std::int64_t portion, Visit&& visit) const {
        const std::size_t begin = static_cast<std::size_t>(portion) * kPortion, end = std::min(begin + kPortion, size_);
        for (std::size_t i = begin; i < end; ++i) visit(i);
    }

    std::size_t size_;
    std::int64_t portions_;
    int threads_;
    Has has_;
    std::vector<std::size_t> first_;  ///< per portion: how many elements of the portions before are kept
};

constexpr std::int64_t kNone = -1;

/// place: of every point, among those that are kept, or kNone.
template <class Simplex>
void keep_simplices(const BigVector<std::int64_t>& place, int threads, Array<Simplex>& simplices) {
    const auto has = [&](std::size_t i) { return place[simplices[i][0]] != kNone; };  // its other points are of the same contour
    Kept(simplices.size(), threads, has).keep(simplices, [&](Simplex simplex) {
        for (std::int64_t& point : simplex) point = place[point];
        return simplex;
    });
}

}  // namespace

void keep_contours(IdSpan<ContourNumber, const std::uint8_t> chosen, const Context& context, Surface& surface) {
    const std::size_t points = surface.points.size();
    const Kept kept(points, context.threads, [&](std::size_t i) { return chosen[ContourNumber(surface.contour[i])] != 0; });
    if (kept.all()) return;
    BigVector<std::int64_t> place;
    resize_for_overwrite(place, points);
    for_each_index(context.threads, points, [&](std::size_t i) { place[i] = kNone; });
    kept.for_each([&](std::size_t i, std::size_t at) { place[i] = static_cast<std::int64_t>(at); });
    keep_simplices(place, context.threads, surface.triangles);
    keep_simplices(place, context.threads, surface.segments);

    const auto same = [](const auto& element) { return element; };
    kept.keep(surface.points, same);
    if (!surface.normals.empty()) kept.keep(surface.normals, same);
    kept.keep(surface.contour, same);  // last: it says what is kept
}

}  // namespace isoatlas
