#include "render/colours.h"

namespace isoatlas {

Colour palette(std::int64_t i) {
    const SrgbBytes c = object_colour(i);
    return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0};
}

SrgbEncoder::SrgbEncoder() {
    least_.front() = 0, least_.back() = 2;
    for (std::size_t byte = 1; byte < 256; ++byte) {
        double below = 0, above = 1;  // has a smaller byte, has it
        for (double middle = 0.5; middle > below && middle < above; middle = (below + above) / 2)
            (srgb_byte(middle) < byte ? below : above) = middle;
        least_[byte] = above;
    }
    for (std::size_t i = 0; i <= kSteps; ++i) first_[i] = srgb_byte(static_cast<double>(i) / kSteps);
}

const SrgbEncoder& SrgbEncoder::instance() {
    static const SrgbEncoder encoder;
    return encoder;
}

Colour colour_of_object(std::int64_t number) { return palette(number - 1); }
Colour colour_of_cavity(std::int64_t number) { return palette(number + 2); }  // mostly not that of the object around it

Vec3 background_light(Background background, double down) {
    if (background == Background::transparent) return {0, 0, 0};
    const bool light = background == Background::light;
    const Vec3 top = light ? Vec3{1, 1, 1} : Vec3{0.020, 0.023, 0.030};
    const Vec3 bottom = light ? Vec3{0.80, 0.82, 0.85} : Vec3{0.004, 0.005, 0.007};
    return mix(top, bottom, down * down);
}

Colour ink_of(Background background) { return background == Background::dark ? Colour{0.92, 0.92, 0.92} : Colour{0.12, 0.13, 0.15}; }

}  // namespace isoatlas
