// Pictures of many objects, in the order of a page.
#pragma once

#include <cstddef>
#include <functional>

#include "catalogue/page_mesh.h"
#include "catalogue/turntable.h"

namespace isoatlas {

/// What a page shows at its top: it is written for the first time with so many pictures.
inline constexpr std::size_t kFirstCards = 5;

struct CardPicture {
    Turntable picture;
    CoarseSurface coarse;
};

/// A picture of a surface, and the surface with fewer triangles for page_meshes(). Draws no more triangles than pixels can show.
[[nodiscard]] CardPicture draw_card(Surface surface, const Colour& colour, const PageOptions& options, const Context& context);

/// Calls draw(i, context) for every card, two at a time, each with half of the threads; with a memory budget one at a time, as surfaces are
/// large. drawn(n): the first n cards are there, n = kFirstCards and twice as many each time, but not at the end. Calls context.progress
/// and context.cancelled on the calling thread only. Throws Error: cancelled.
void draw_cards(std::size_t cards, const std::function<void(std::size_t, const Context&)>& draw,
                const std::function<void(std::size_t)>& drawn, const Context& context);

}  // namespace isoatlas
