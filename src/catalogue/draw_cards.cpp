#include "catalogue/draw_cards.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/phase.h"
#include "catalogue/shared_context.h"
#include "isoatlas/environment.h"
#include "preview/coarse_surface.h"

namespace isoatlas {

namespace {

/// Work on single cards, two at a time.
class Cards {
public:
    Cards(const char* phase, std::size_t count, const Context& context)
        : phase_(phase), count_(count), context_(context), shared_(context) {
        constexpr int kAtOnce = 2;
        const int threads = thread_count(context.threads);
        at_once_ = current_environment().memory != nullptr ? 1 : std::min(threads, kAtOnce);
        shared_.set_threads(std::max(1, threads / at_once_));
    }

    /// Calls work(i, context) for i in [begin, end). has_threads: the work uses those of its context, so that of an odd number of cards the
    /// last one is done by all.
    void each(std::size_t begin, std::size_t end, bool has_threads, const std::function<void(std::size_t, const Context&)>& work) {
        const auto one = [&](std::size_t i) {
            stop_if_cancelled(shared_.context());
            if (shared_.is_caller()) report(context_, only_phase(phase_), static_cast<double>(done_) / static_cast<double>(count_));
            work(i, shared_.context());
            ++done_;
        };
        const std::size_t alone = has_threads ? (end - begin) % static_cast<std::size_t>(at_once_) : 0;
        for_each_block(at_once_, static_cast<std::int64_t>(end - begin - alone),
                       [&](std::int64_t block) { one(begin + static_cast<std::size_t>(block)); });
        if (alone == 0) return;
        shared_.set_threads(thread_count(context_.threads));
        one(end - 1);
        shared_.set_threads(std::max(1, thread_count(context_.threads) / at_once_));
    }

private:
    const char* phase_;
    std::size_t count_;
    const Context& context_;
    int at_once_ = 1;
    std::atomic<std::size_t> done_ = 0;
    SharedContext shared_;
};

}  // namespace

CardPicture draw_card(Surface surface, const Colour& colour, const PageOptions& options, const Context& context) {
    constexpr std::int64_t kTrianglesOfPixel = 6;
    CardPicture card;
    if (surface.triangles.size() <= kMaxPageTriangles) card.coarse = coarse_for_page(surface, context);
    const auto most = static_cast<std::size_t>(kTrianglesOfPixel * options.picture_size * options.picture_size);
    card.picture = draw_turntable(coarse_surface(std::move(surface), most), colour, options, context);
    return card;
}

void draw_cards(std::size_t cards, const std::function<void(std::size_t, const Context&)>& draw,
                const std::function<void(std::size_t)>& drawn, const Context& context) {
    Cards all("draw", cards, context);
    for (std::size_t begin = 0, end = kFirstCards; begin < cards; begin = end, end *= 2) {
        const std::size_t last = std::min(end, cards);
        all.each(begin, last, true, draw);
        drawn(last);
    }
}

std::vector<CoarseSurface> coarse_cards(std::vector<std::optional<CoarseSurface>> coarse,
                                        const std::function<Surface(std::size_t, const Context&)>& surface_of, const Context& context) {
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        if (!coarse[i]) missing.push_back(i);
    }
    Cards all("reduce surfaces", missing.size(), context);
    all.each(0, missing.size(), false, [&](std::size_t place, const Context& own) {
        coarse[missing[place]] = coarse_for_page(surface_of(missing[place], own), own);
    });
    std::vector<CoarseSurface> surfaces;
    for (std::optional<CoarseSurface>& surface : coarse) surfaces.push_back(std::move(*surface));
    return surfaces;
}

}  // namespace isoatlas
