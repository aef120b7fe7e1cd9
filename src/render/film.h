// Accumulation buffers of a picture: means over the samples of every pixel, before shadows are applied.
#pragma once

#include <vector>

#include "isoatlas/render.h"
#include "render/tracer.h"

namespace isoatlas {

struct FilmPixel {
    std::array<float, 3> glow{};
    float opacity = 0;
};

/// What a pixel shows of opaque surfaces.
struct FilmSurface {
    std::array<float, 3> ambient{}, key{};
    float open_sky = 1, open_key = 1;
    float part = 0;   ///< of the samples that hit one
    float depth = 0;  ///< mean over those
    std::array<float, 3> normal{};
};

class FilmSum {
public:
    void add(const Seen& seen);
    [[nodiscard]] FilmPixel mean() const;
    [[nodiscard]] FilmSurface mean_surface() const;

private:
    Vec3 glow_{}, ambient_{}, key_{}, normal_{};
    double opacity_ = 0, sky_ = 0, key_light_ = 0, depth_ = 0;
    int samples_ = 0, hits_ = 0;
};

struct Film {
    std::int64_t width, height;
    std::vector<FilmPixel> pixels;
    std::vector<FilmSurface> surfaces;  ///< of every pixel; empty: none has any
    Film(std::int64_t columns, std::int64_t rows, bool has_surfaces = false)
        : width(columns), height(rows), pixels(columns * rows), surfaces(has_surfaces ? columns * rows : 0) {}
};

/// Denoises sky and key light visibility over neighbouring pixels of the same surface, as it is sampled with few rays.
void smooth_light(Film& film, double pixel, int threads);

/// Composes light and background, in sRGB.
[[nodiscard]] Image developed(const Film& film, Background background, int threads);

}  // namespace isoatlas
