// APNG: a PNG file with further frames in chunks of their own (W3C PNG, third edition).
#include <cmath>

#include "image/animation.h"
#include "image/png.h"
#include "isoatlas/error.h"

namespace isoatlas {

void check_animation(const Animation& animation, std::int64_t max) {
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw Error(ErrorKind::usage, {.what = what, .expected = expected});
    };
    if (animation.frames.empty()) refuse("an animation without frames", "at least one");
    if (!(animation.frames_per_second >= 0.1 && animation.frames_per_second <= 100)) refuse("frames per second out of range", "0.1 to 100");
    const Image& first = animation.frames[0];
    if (first.width < 1 || first.height < 1 || first.width > max || first.height > max)
        refuse("frames of " + std::to_string(first.width) + " x " + std::to_string(first.height) + " pixels",
               "1 to " + std::to_string(max));
    for (const Image& frame : animation.frames) {
        if (frame.width != first.width || frame.height != first.height) refuse("frames of different sizes", "one size");
    }
}

namespace {

constexpr std::int64_t kMaxPngSide = 16384;

std::vector<std::uint8_t> frame_control(std::uint32_t sequence, const Animation& animation) {
    std::vector<std::uint8_t> control;
    put_number(control, sequence);
    put_number(control, static_cast<std::uint32_t>(animation.frames[0].width));
    put_number(control, static_cast<std::uint32_t>(animation.frames[0].height));
    put_number(control, 0);
    put_number(control, 0);
    const auto milliseconds = static_cast<std::uint16_t>(std::lround(1000 / animation.frames_per_second));
    for (const std::uint16_t n : {milliseconds, std::uint16_t{1000}})
        control.push_back(static_cast<std::uint8_t>(n >> 8)), control.push_back(static_cast<std::uint8_t>(n));
    control.push_back(0);  // the frame is kept
    control.push_back(0);  // and overwrites the previous one
    return control;
}

}  // namespace

std::vector<std::byte> encode_apng(const Animation& animation) {
    check_animation(animation, kMaxPngSide);
    bool with_alpha = false;
    for (const Image& frame : animation.frames) with_alpha = with_alpha || has_transparency(frame);
    PngChunks chunks;
    chunks.begin(animation.frames[0].width, animation.frames[0].height, with_alpha);
    std::vector<std::uint8_t> control;
    put_number(control, static_cast<std::uint32_t>(animation.frames.size()));
    put_number(control, 0);  // endless loop
    chunks.chunk("acTL", control);
    std::uint32_t sequence = 0;
    for (std::size_t i = 0; i < animation.frames.size(); ++i) {
        chunks.chunk("fcTL", frame_control(sequence++, animation));
        std::vector<std::uint8_t> pixels = deflated_pixels(animation.frames[i], with_alpha);
        if (i > 0) {
            std::vector<std::uint8_t> numbered;
            put_number(numbered, sequence++);
            numbered.insert(numbered.end(), pixels.begin(), pixels.end());
            pixels = std::move(numbered);
        }
        chunks.chunk(i == 0 ? "IDAT" : "fdAT", pixels);
    }
    chunks.chunk("IEND", {});
    return std::move(chunks.bytes);
}

}  // namespace isoatlas
