// Rule (c): no triangle meets another but in common points, and no point lies in the space that the triangles sweep. Exact.
#pragma once

#include <vector>

#include "level_of_detail/star.h"
#include "level_of_detail/triangle_grid.h"

namespace isoatlas {

class EmbeddingRule {
public:
    explicit EmbeddingRule(const SurfaceState& state) : state_(state) {}

    /// The triangles that change, and the others that can be near them.
    void set_triangles(std::span<const std::uint32_t> inside, std::span<const std::uint32_t> crossing);
    /// state.points has the new place of the kept point; the star the old ones.
    [[nodiscard]] bool holds(const Star& star);
    /// After the collapse for which holds() was just true.
    void commit();

private:
    struct Part {  ///< a triangle after
        std::uint32_t number;
        std::array<std::uint32_t, 3> corners;
        BoundingBox box, before;
    };
    void make_parts(const Star& star);
    [[nodiscard]] bool meets_itself() const;
    [[nodiscard]] bool is_on_one_side(const std::array<std::uint32_t, 3>& triangle, const std::array<std::uint32_t, 3>& other) const;
    [[nodiscard]] bool is_swept(const Star& star, std::uint32_t point);
    [[nodiscard]] BoundingBox triangle_box(std::uint32_t t) const;

    const SurfaceState& state_;
    TriangleGrid grid_;
    std::vector<Part> parts_;
    BoundingBox swept_{};
    std::vector<std::uint32_t> outside_;  ///< points that are not swept
};

}  // namespace isoatlas
