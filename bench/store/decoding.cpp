#include "decoding.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <iterator>
#include <span>
#include <stdexcept>
#include <vector>

#include "codec/brick_codec.h"
#include "field/copy_box.h"

namespace bench {
namespace {

using isoatlas::kBrickSamples;
using isoatlas::kBrickSize;
using nlohmann::ordered_json;

constexpr std::int64_t kMost = 8192;          // bricks
constexpr std::uint8_t kKeptAsTheyAre = 192;  // the first byte of a brick

template <class T>
struct Brick {
    T low{};
    std::size_t begin = 0, end = 0;  ///< among the packed bytes
    bool is_coded = false;
};

/// Packed one behind the other, as in a store.
template <class T>
struct Bricks {
    std::vector<T> samples;
    std::vector<std::byte> packed;
    std::vector<Brick<T>> bricks;

    [[nodiscard]] bool decode(const Brick<T>& brick, std::span<T> to) const {
        return isoatlas::decode_brick<T>(std::span(packed).subspan(brick.begin, brick.end - brick.begin), kBrickSize, brick.low, to);
    }
};

/// Every stride-th whole brick, those that are constant left out.
template <class T>
Bricks<T> encoded(std::span<const T> samples, const isoatlas::Index3& size) {
    const std::int64_t nx = size[0] / kBrickSize[0], ny = size[1] / kBrickSize[1], nz = size[2] / kBrickSize[2];
    const std::int64_t stride = std::max<std::int64_t>(1, nx * ny * nz / kMost);
    Bricks<T> all;
    std::vector<T> inside(kBrickSamples);
    for (std::int64_t i = 0; i < nx * ny * nz && std::ssize(all.bricks) < kMost; i += stride) {
        const isoatlas::Index3 corner{i % nx * kBrickSize[0], i / nx % ny * kBrickSize[1], i / (nx * ny) * kBrickSize[2]};
        isoatlas::copy_box(kBrickSize, {std::as_bytes(samples), size, corner},
                           {std::as_writable_bytes(std::span(inside)), kBrickSize, {0, 0, 0}}, sizeof(T));
        const auto [low, high] = isoatlas::extremes_of<T>(inside);
        if (low == high) continue;
        const isoatlas::BrickCode code = isoatlas::choose_code<T>(inside, kBrickSize, low);
        const std::size_t begin = all.packed.size();
        isoatlas::encode_brick<T>(inside, kBrickSize, low, code.head, all.packed);
        all.bricks.push_back({low, begin, all.packed.size(), code.head != kKeptAsTheyAre});
        all.samples.insert(all.samples.end(), inside.begin(), inside.end());
    }
    return all;
}

/// Processor time of a call, in seconds: other processes do not count.
template <class Function>
double processor_seconds(const Function& function) {
    const std::clock_t start = std::clock();
    function();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

template <class T>
void require_same(const Bricks<T>& all) {
    std::vector<T> buffer(kBrickSamples);
    for (std::size_t i = 0; i < all.bricks.size(); ++i) {
        if (!all.decode(all.bricks[i], buffer) ||
            std::memcmp(buffer.data(), all.samples.data() + i * kBrickSamples, kBrickSamples * sizeof(T)) != 0)
            throw std::runtime_error("a decoded brick is another one");
    }
}

template <class T>
ordered_json measure(const Bricks<T>& all, int repeats) {
    constexpr int kRounds = 4;  // longer than a tick of the clock
    require_same(all);
    std::vector<Brick<T>> coded;
    std::ranges::copy_if(all.bricks, std::back_inserter(coded), &Brick<T>::is_coded);
    std::vector<T> buffer(kBrickSamples);
    const auto decode = [&](const std::vector<Brick<T>>& bricks) {
        bool is_right = true;
        for (int round = 0; round < kRounds; ++round)
            for (const Brick<T>& brick : bricks) is_right = all.decode(brick, buffer) && is_right;
        if (!is_right) throw std::runtime_error("a brick is damaged");
    };
    const auto copy = [&] {
        for (int round = 0; round < kRounds; ++round) {
            for (std::size_t i = 0; i < all.samples.size(); i += kBrickSamples) {
                std::memcpy(buffer.data(), all.samples.data() + i, kBrickSamples * sizeof(T));
                asm volatile("" : : "r"(buffer.data()) : "memory");  // or nothing is copied
            }
        }
    };
    ordered_json result{{"bricks", all.bricks.size()},
                        {"coded_bricks", coded.size()},
                        {"sample_bytes", all.samples.size() * sizeof(T)},
                        {"coded_sample_bytes", coded.size() * kBrickSamples * sizeof(T)},
                        {"packed_bytes", all.packed.size()}};
    for (int i = 0; i < repeats; ++i) {
        result["seconds"].push_back(processor_seconds([&] { decode(all.bricks); }) / kRounds);
        result["coded_seconds"].push_back(processor_seconds([&] { decode(coded); }) / kRounds);
        result["copy_seconds"].push_back(processor_seconds(copy) / kRounds);
    }
    return result;
}

}  // namespace

ordered_json measure_decoding(const isoatlas::Volume& volume, int repeats) {
    return isoatlas::visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        ordered_json result = measure(encoded(samples, volume.info.extent.size), repeats);
        result["type"] = isoatlas::name_of(volume.info.type);
        return result;
    });
}

}  // namespace bench
