// bench_reads: what do the reads at random that find the zones of a noisy field cost, if nothing is computed?
//
//   bench_reads [VOXELS ELEMENTS RUN]      default: the noisy field of 256^3, 16777216 7547329 2.2; on two threads
//
// Of each voxel the path of its maximum, a bucket and two stops are read, and a zone is counted, as src/zones does. Maxima are random,
// but for RUN voxels of a row on average the same. Prints JSON: the seconds of every repeat.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>
#include <vector>

namespace {

using Number = std::uint32_t;

struct Tables {
    std::vector<Number> maximum;              // of each voxel
    std::vector<std::array<Number, 4>> path;  // of each element: a bucket and two stops in one line
    std::vector<std::atomic<Number>> zones;

    Tables(std::size_t voxels, std::size_t elements, double run) : maximum(voxels), path(elements), zones(elements) {
        std::mt19937 random(1);
        std::uniform_int_distribution<Number> element(0, static_cast<Number>(elements - 1));
        std::bernoulli_distribution changes(1 / run);
        Number current = 0;
        for (Number& one : maximum) one = current = changes(random) ? element(random) : current;
        for (auto& one : path) one = {element(random), element(random), element(random), element(random)};
    }

    void find(std::size_t begin, std::size_t end) {
        for (std::size_t voxel = begin; voxel < end; ++voxel) {
            const std::array<Number, 4>& stops = path[path[maximum[voxel]][0]];
            zones[stops[0] < stops[1] ? stops[2] : stops[3]].fetch_add(1, std::memory_order_relaxed);
        }
    }
};

}  // namespace

int main(int argc, char** argv) {
    const std::size_t voxels = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 16777216;
    Tables tables(voxels, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 7547329, argc > 3 ? std::strtod(argv[3], nullptr) : 2.2);
    std::printf("{\"seconds\":[");
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        std::thread other([&] { tables.find(voxels / 2, voxels); });
        tables.find(0, voxels / 2);
        other.join();
        std::printf("%s%.4f", i == 0 ? "" : ",", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::puts("]}");
}
