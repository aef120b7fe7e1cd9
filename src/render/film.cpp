#include "render/film.h"

#include <algorithm>

#include "base/parallel.h"
#include "render/colours.h"

namespace isoatlas {
namespace {

constexpr int kSmooth = 3;  // pixels to each side

std::array<float, 3> floats(const Vec3& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }
Vec3 doubles(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Weight of pixel b for pixel a: close in the picture, on the same surface, with similar normals. depth_scale: 1 / allowed difference.
double likeness(const FilmSurface& a, const FilmSurface& b, double squared_distance, double depth_scale) {
    if (b.part == 0) return 0;
    const double facing = std::max(0.0, dot(doubles(a.normal), doubles(b.normal)));
    const double f2 = facing * facing, f4 = f2 * f2, f8 = f4 * f4;
    const double depth = (a.depth - b.depth) * depth_scale;
    return b.part * f8 * f8 * std::exp(-squared_distance / 6 - depth * depth);
}

void smooth_pixel(const Film& from, std::int64_t x, std::int64_t y, double pixel, FilmSurface& to) {
    const FilmSurface& centre = from.surfaces[x + from.width * y];
    if (centre.part == 0) return;
    double weight = 0, sky = 0, key = 0;
    for (std::int64_t v = std::max<std::int64_t>(0, y - kSmooth); v <= std::min(from.height - 1, y + kSmooth); ++v) {
        for (std::int64_t u = std::max<std::int64_t>(0, x - kSmooth); u <= std::min(from.width - 1, x + kSmooth); ++u) {
            const FilmSurface& other = from.surfaces[u + from.width * v];
            const auto squared = static_cast<double>((u - x) * (u - x) + (v - y) * (v - y));
            const double w = likeness(centre, other, squared, 1 / (pixel * (4 + 3 * std::sqrt(squared))));
            weight += w, sky += w * other.open_sky, key += w * other.open_key;
        }
    }
    if (!(weight > 0)) return;
    to.open_sky = static_cast<float>(sky / weight), to.open_key = static_cast<float>(key / weight);
}

bool is_empty(const FilmPixel& pixel) { return pixel.opacity == 0 && pixel.glow == std::array<float, 3>{}; }

void develop_pixel(const FilmPixel& pixel, const FilmSurface* surface, const Vec3& behind, bool transparent, const SrgbEncoder& encoder,
                   std::uint8_t* out) {
    Vec3 light = doubles(pixel.glow);
    if (surface != nullptr) {
        light = along(light, surface->open_sky, doubles(surface->ambient));
        light = along(light, surface->open_key, doubles(surface->key));
    }
    const double opacity = std::clamp<double>(pixel.opacity, 0, 1);
    if (transparent) {
        if (opacity > 0) light = scale(light, 1 / opacity);
        out[3] = byte_of(opacity);
    } else {
        light = along(light, 1 - opacity, behind);
        out[3] = 255;
    }
    for (int c = 0; c < 3; ++c) out[c] = encoder.byte(light[c]);
}

}  // namespace

void FilmSum::add(const Seen& seen) {
    ++samples_;
    glow_ = plus(glow_, seen.glow), ambient_ = plus(ambient_, seen.shade.ambient), key_ = plus(key_, seen.shade.key);
    opacity_ += seen.opacity;
    if (seen.object < 0) return;
    ++hits_;
    normal_ = plus(normal_, seen.normal);
    sky_ += seen.open_sky, key_light_ += seen.open_key, depth_ += seen.depth;
}

FilmPixel FilmSum::mean() const {
    const double part = 1.0 / samples_;
    return {floats(scale(glow_, part)), static_cast<float>(opacity_ * part)};
}

FilmSurface FilmSum::mean_surface() const {
    if (hits_ == 0) return {};
    const double part = 1.0 / samples_, part_of_hits = 1.0 / hits_;
    FilmSurface surface{.ambient = floats(scale(ambient_, part)), .key = floats(scale(key_, part))};
    surface.open_sky = static_cast<float>(sky_ * part_of_hits), surface.open_key = static_cast<float>(key_light_ * part_of_hits);
    surface.part = static_cast<float>(hits_ * part), surface.depth = static_cast<float>(depth_ * part_of_hits);
    surface.normal = floats(unit(normal_));
    return surface;
}

void smooth_light(Film& film, double pixel, int threads) {
    if (std::ranges::none_of(film.surfaces, [](const FilmSurface& s) { return s.part > 0; })) return;
    const Film from = film;
    for_each_block(threads, film.height, [&](std::int64_t y) {
        for (std::int64_t x = 0; x < film.width; ++x) smooth_pixel(from, x, y, pixel, film.surfaces[x + film.width * y]);
    });
}

Image developed(const Film& film, Background background, int threads) {
    Image image(film.width, film.height);
    const SrgbEncoder& encoder = SrgbEncoder::instance();
    for_each_block(threads, film.height, [&](std::int64_t y) {
        const Vec3 behind = background_light(background, (static_cast<double>(y) + 0.5) / static_cast<double>(film.height));
        const auto develop = [&](const FilmPixel& pixel, const FilmSurface* surface, std::uint8_t* out) {
            develop_pixel(pixel, surface, behind, background == Background::transparent, encoder, out);
        };
        std::array<std::uint8_t, 4> nothing;
        develop({}, nullptr, nothing.data());
        for (std::int64_t x = 0; x < film.width; ++x) {
            const std::int64_t i = x + film.width * y;
            const FilmPixel& pixel = film.pixels[i];
            if (is_empty(pixel))
                std::ranges::copy(nothing, image.at(x, y));
            else
                develop(pixel, film.surfaces.empty() ? nullptr : &film.surfaces[i], image.at(x, y));
        }
    });
    return image;
}

}  // namespace isoatlas
