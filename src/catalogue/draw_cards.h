// Pictures of many objects, in the order of a page.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "catalogue/page_mesh.h"
#include "catalogue/turntable.h"

namespace isoatlas {

/// What a page shows at its top: it is written for the first time with so many pictures.
inline constexpr std::size_t kFirstCards = 5;

struct CardPicture {
    Turntable picture;
    std::optional<CoarseSurface> coarse;  ///< nullopt: coarse_for_page() is to be called, which takes longer than the picture
};

/// A picture of a surface. Draws no more triangles than pixels can show.
[[nodiscard]] CardPicture draw_card(Surface surface, const Colour& colour, const PageOptions& options, const Context& context);

/// Calls draw(i, context) for every card, two at a time, each with half of the threads; with a memory budget one at a time, as surfaces are
/// large. drawn(n): the first n cards are there, n = kFirstCards and twice as many each time, in the end all. Calls context.progress and
/// context.cancelled on the calling thread only. Throws Error: cancelled.
void draw_cards(std::size_t cards, const std::function<void(std::size_t, const Context&)>& draw,
                const std::function<void(std::size_t)>& drawn, const Context& context);

/// The surfaces of cards for page_meshes(), in their order: coarse_for_page(surface_of(i, context)) of those that draw_card() left out.
/// Calls and errors as those of draw_cards().
[[nodiscard]] std::vector<CoarseSurface> coarse_cards(std::vector<std::optional<CoarseSurface>> coarse,
                                                      const std::function<Surface(std::size_t, const Context&)>& surface_of,
                                                      const Context& context);

}  // namespace isoatlas
