#include "decoding.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <iterator>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include "codec/brick_codec.h"

namespace bench {
namespace {

using isoatlas::kBrickSamples;
using isoatlas::kBrickSize;
using nlohmann::ordered_json;

constexpr std::int64_t kMost = 8192;      // bricks
constexpr std::byte kKeptAsTheyAre{192};  // the first byte of a brick

template <class T>
struct Brick {
    std::vector<T> samples;
    std::vector<std::byte> packed;
    T low{};

    [[nodiscard]] bool is_coded() const { return packed.front() != kKeptAsTheyAre; }
};

template <class T>
std::vector<T> box(std::span<const T> samples, const isoatlas::Index3& size, const isoatlas::Index3& begin) {
    std::vector<T> inside;
    for (std::int64_t z = 0; z < kBrickSize[2]; ++z)
        for (std::int64_t y = 0; y < kBrickSize[1]; ++y) {
            const auto row = samples.subspan(begin[0] + size[0] * (begin[1] + y + size[1] * (begin[2] + z)), kBrickSize[0]);
            inside.insert(inside.end(), row.begin(), row.end());
        }
    return inside;
}

/// Every stride-th whole brick, those that are constant left out.
template <class T>
std::vector<Brick<T>> encoded(std::span<const T> samples, const isoatlas::Index3& size) {
    const std::int64_t nx = size[0] / kBrickSize[0], ny = size[1] / kBrickSize[1], nz = size[2] / kBrickSize[2];
    const std::int64_t stride = std::max<std::int64_t>(1, nx * ny * nz / kMost);
    std::vector<Brick<T>> bricks;
    for (std::int64_t i = 0; i < nx * ny * nz && std::ssize(bricks) < kMost; i += stride) {
        Brick<T> brick;
        brick.samples = box(samples, size, {i % nx * kBrickSize[0], i / nx % ny * kBrickSize[1], i / (nx * ny) * kBrickSize[2]});
        const auto [low, high] = isoatlas::extremes_of<T>(brick.samples);
        if (low == high) continue;
        brick.low = low;
        const isoatlas::BrickCode code = isoatlas::choose_code<T>(brick.samples, kBrickSize, low);
        isoatlas::encode_brick<T>(brick.samples, kBrickSize, low, code.head, brick.packed);
        bricks.push_back(std::move(brick));
    }
    return bricks;
}

/// Processor time of a call, in seconds: other processes do not count.
template <class Function>
double processor_seconds(const Function& function) {
    const std::clock_t start = std::clock();
    function();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

template <class T>
ordered_json measure(const std::vector<Brick<T>>& bricks, int repeats) {
    constexpr int kRounds = 4;  // longer than a tick of the clock
    std::vector<T> buffer(kBrickSamples);
    std::vector<Brick<T>> coded;
    std::copy_if(bricks.begin(), bricks.end(), std::back_inserter(coded), [](const auto& brick) { return brick.is_coded(); });
    const auto decode = [&](const std::vector<Brick<T>>& all) {
        for (int round = 0; round < kRounds; ++round)
            for (const Brick<T>& brick : all)
                if (!isoatlas::decode_brick<T>(brick.packed, kBrickSize, brick.low, buffer) || buffer.front() != brick.samples.front())
                    throw std::runtime_error("a decoded brick is another one");
    };
    const auto copy = [&] {
        for (int round = 0; round < kRounds; ++round)
            for (const Brick<T>& brick : bricks) {
                std::memcpy(buffer.data(), brick.samples.data(), kBrickSamples * sizeof(T));
                if (buffer.back() != brick.samples.back()) throw std::runtime_error("a copy is another one");
            }
    };
    for (const Brick<T>& brick : bricks) {
        if (!isoatlas::decode_brick<T>(brick.packed, kBrickSize, brick.low, buffer) ||
            std::memcmp(buffer.data(), brick.samples.data(), kBrickSamples * sizeof(T)) != 0)
            throw std::runtime_error("a decoded brick is another one");
    }
    const auto packed =
        std::accumulate(bricks.begin(), bricks.end(), std::size_t{0}, [](auto sum, const auto& b) { return sum + b.packed.size(); });
    ordered_json result{{"bricks", bricks.size()},
                        {"coded_bricks", coded.size()},
                        {"sample_bytes", bricks.size() * kBrickSamples * sizeof(T)},
                        {"coded_sample_bytes", coded.size() * kBrickSamples * sizeof(T)},
                        {"packed_bytes", packed}};
    for (int i = 0; i < repeats; ++i) {
        result["seconds"].push_back(processor_seconds([&] { decode(bricks); }) / kRounds);
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
