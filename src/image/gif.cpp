// GIF 89a: one palette for all frames; unchanged pixels are transparent.
#include <algorithm>
#include <cmath>

#include "image/animation.h"
#include "image/quantise.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxGifSide = 65535;
constexpr std::uint8_t kSame = 255;  // index of "as before"

class GifBytes {
public:
    std::vector<std::byte> bytes;
    void byte(int value) { bytes.push_back(static_cast<std::byte>(value)); }
    void word(std::int64_t value) {
        byte(static_cast<int>(value & 255));
        byte(static_cast<int>(value >> 8 & 255));
    }
    void text(const char* characters) {
        for (const char* c = characters; *c != 0; ++c) byte(*c);
    }
};

/// Numbers of changing width, least significant bits first, in blocks of up to 255 bytes.
class CodeStream {
public:
    explicit CodeStream(GifBytes& out) : out_(out) {}
    void put(int code, int width) {
        bits_ |= static_cast<std::uint32_t>(code) << count_;
        count_ += width;
        for (; count_ >= 8; count_ -= 8, bits_ >>= 8) push(static_cast<std::uint8_t>(bits_));
    }
    void finish() {
        if (count_ > 0) push(static_cast<std::uint8_t>(bits_));
        flush();
        out_.byte(0);
    }

private:
    void push(std::uint8_t value) {
        block_.push_back(value);
        if (block_.size() == 255) flush();
    }
    void flush() {
        if (block_.empty()) return;
        out_.byte(static_cast<int>(block_.size()));
        for (const std::uint8_t b : block_) out_.byte(b);
        block_.clear();
    }
    GifBytes& out_;
    std::uint32_t bits_ = 0;
    int count_ = 0;
    std::vector<std::uint8_t> block_;
};

/// LZW as GIF has it: 8-bit symbols, codes of 9 to 12 bits.
void compress(const std::vector<std::uint8_t>& indices, GifBytes& out) {
    constexpr int kClear = 256, kEnd = 257, kMax = 4096;
    out.byte(8);
    CodeStream codes(out);
    std::vector<std::int16_t> next(static_cast<std::size_t>(kMax) * 256, -1);  // code of (prefix, symbol)
    int used = kEnd + 1, width = 9;
    codes.put(kClear, width);
    int prefix = indices[0];
    for (std::size_t i = 1; i < indices.size(); ++i) {
        std::int16_t& code = next[static_cast<std::size_t>(prefix) * 256 + indices[i]];
        if (code >= 0) {
            prefix = code;
            continue;
        }
        codes.put(prefix, width);
        if (used < kMax) {
            code = static_cast<std::int16_t>(used);
            if (used == 1 << width) ++width;
            ++used;
        } else {
            codes.put(kClear, width);
            std::fill(next.begin(), next.end(), std::int16_t{-1});
            used = kEnd + 1, width = 9;
        }
        prefix = indices[i];
    }
    codes.put(prefix, width);
    if (used == 1 << width && width < 12) ++width;  // the decoder has one more code here
    codes.put(kEnd, width);
    codes.finish();
}

void put_header(const Animation& animation, const Quantiser& quantiser, GifBytes& out) {
    out.text("GIF89a");
    out.word(animation.frames[0].width);
    out.word(animation.frames[0].height);
    out.byte(0xF7), out.byte(0), out.byte(0);  // 256 colours for all frames
    for (std::size_t i = 0; i < 256; ++i) {
        for (int c = 0; c < 3; ++c) out.byte(i < quantiser.colours().size() ? quantiser.colours()[i][c] : 0);
    }
    out.byte(0x21), out.byte(0xFF), out.byte(11), out.text("NETSCAPE2.0");
    out.byte(3), out.byte(1), out.word(0), out.byte(0);  // endless loop
}

void put_frame(const Image& frame, int hundredths, const std::vector<std::uint8_t>& indices, GifBytes& out) {
    out.byte(0x21), out.byte(0xF9), out.byte(4), out.byte(0x05);  // kept for the next frame; has a transparent colour
    out.word(hundredths);
    out.byte(kSame), out.byte(0);
    out.byte(0x2C), out.word(0), out.word(0), out.word(frame.width), out.word(frame.height), out.byte(0);
    compress(indices, out);
}

}  // namespace

std::vector<std::byte> encode_gif(const Animation& animation) {
    check_animation(animation, kMaxGifSide);
    const Quantiser quantiser(animation.frames);
    GifBytes out;
    put_header(animation, quantiser, out);
    std::vector<std::uint8_t> shown, indices;
    for (std::size_t f = 0; f < animation.frames.size(); ++f) {
        const Image& frame = animation.frames[f];
        indices.resize(frame.width * frame.height);
        for (std::int64_t y = 0; y < frame.height; ++y) {
            for (std::int64_t x = 0; x < frame.width; ++x) indices[x + frame.width * y] = quantiser.index(frame.at(x, y), x, y);
        }
        std::vector<std::uint8_t> changed = indices;
        for (std::size_t i = 0; f > 0 && i < changed.size(); ++i) {
            if (indices[i] == shown[i]) changed[i] = kSame;
        }
        // Times are whole hundredths of a second: rounding errors do not accumulate.
        const auto due = [&](std::size_t frames) { return std::lround(100 * static_cast<double>(frames) / animation.frames_per_second); };
        put_frame(frame, static_cast<int>(due(f + 1) - due(f)), changed, out);
        shown = indices;
    }
    out.byte(0x3B);
    return std::move(out.bytes);
}

}  // namespace isoatlas
