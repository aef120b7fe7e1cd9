#include "catalogue/draw_cards.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/phase.h"
#include "isoatlas/environment.h"
#include "preview/coarse_surface.h"

namespace isoatlas {

CardPicture draw_card(Surface surface, const Colour& colour, const PageOptions& options, const Context& context) {
    constexpr std::int64_t kTrianglesOfPixel = 6;
    CardPicture card{.picture = {}, .coarse = coarse_for_page(surface, context)};
    const auto most = static_cast<std::size_t>(kTrianglesOfPixel * options.picture_size * options.picture_size);
    card.picture = draw_turntable(coarse_surface(std::move(surface), most), colour, options, context);
    return card;
}

void draw_cards(std::size_t cards, const std::function<void(std::size_t, const Context&)>& draw,
                const std::function<void(std::size_t)>& drawn, const Context& context) {
    constexpr int kAtOnce = 2;
    const int threads = thread_count(context.threads);
    const int at_once = current_environment().memory != nullptr ? 1 : std::min(threads, kAtOnce);
    const CallerLooks here(context);
    std::atomic<bool> is_cancelled = false;
    std::atomic<std::size_t> done = 0;
    Context own = context;
    own.progress = nullptr;
    own.threads = std::max(1, threads / at_once);
    own.cancelled = [&] {
        if (context.cancelled && here.is_caller() && context.cancelled()) is_cancelled = true;
        return is_cancelled.load();
    };
    for (std::size_t begin = 0, end = kFirstCards; begin < cards; begin = end, end *= 2) {
        const std::size_t last = std::min(end, cards);
        for_each_block(at_once, static_cast<std::int64_t>(last - begin), [&](std::int64_t block) {
            stop_if_cancelled(own);
            if (here.is_caller()) report(context, only_phase("draw"), static_cast<double>(done) / static_cast<double>(cards));
            draw(begin + static_cast<std::size_t>(block), own);
            ++done;
        });
        if (last < cards) drawn(last);
    }
}

}  // namespace isoatlas
