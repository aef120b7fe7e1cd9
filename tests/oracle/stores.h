// What the tests of stores share: a file that goes with the test, and volumes of several bricks.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "oracle/mesh_checks.h"

namespace oracle {

class Stores : public testing::Test {
protected:
    Stores() : path_((std::filesystem::temp_directory_path() / ("isoatlas_atlas_" + std::to_string(::getpid()) + ".atlas")).string()) {}
    ~Stores() override { std::filesystem::remove(path_); }
    Stores(const Stores&) = delete;
    Stores& operator=(const Stores&) = delete;

public:
    std::string path_;
};

/// Calls ask(asker, context of one thread) in four threads at once.
template <class Ask>
void ask_at_once(const Ask& ask) {
    std::vector<std::thread> askers;
    for (int asker = 0; asker < 4; ++asker) {
        askers.emplace_back([&ask, asker] {
            isoatlas::Context context;
            context.threads = 1;
            ask(asker, context);
        });
    }
    for (std::thread& asker : askers) asker.join();
}

inline bool same(const isoatlas::Surface& p, const isoatlas::Surface& q) {
    return p.points == q.points && p.normals == q.normals && p.triangles == q.triangles && p.segments == q.segments &&
           p.object == q.object && p.contour == q.contour && p.tau == q.tau && p.interpolant == q.interpolant && p.closed == q.closed;
}

/// Bricks of 16 samples a side need larger volumes than the oracle can bear; classes come in words of 64 samples along x.
inline Grid arbitrary_volume() {
    std::array<Index, 3> size{};
    const bool is_long = *rc::gen::inRange(0, 3) == 0;
    for (Index& n : size) n = *rc::gen::inRange<Index>(1, is_long ? 20 : 36);
    if (is_long) size[0] = *rc::gen::inRange<Index>(60, 200);
    const int rank = *rc::gen::inRange(0, 5) == 0 ? 2 : 3;
    if (rank == 2) size[2] = 1;
    const auto texture = static_cast<Texture>(*rc::gen::inRange(0, kTextures));
    const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    std::vector<int> raw(static_cast<std::size_t>(size[0] * size[1] * size[2]) + 40);
    std::uint64_t state = seed * 2 + 1;
    for (int& r : raw) r = static_cast<int>((state = state * 6364136223846793005U + 1442695040888963407U) >> 33) % 10000;
    return make_grid(rank, size, texture, raw);
}

}  // namespace oracle
