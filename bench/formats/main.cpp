// bench_formats FILE [REPEATS] [RAW]: reads all samples of a file in slabs of its own, as an analysis does; prints the seconds of each run
// as JSON. RAW: gets the samples.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <sys/mman.h>

#include <isoatlas/error.h>
#include <isoatlas/volume.h>
#include <nlohmann/json.hpp>

namespace {

using namespace isoatlas;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kSlabBytes = std::int64_t{16} << 20;

std::int64_t slices_of(const VolumeInfo& info) {
    const std::int64_t slice = info.extent.slice() * static_cast<std::int64_t>(size_of(info.type));
    const std::int64_t chunk = std::max<std::int64_t>(info.chunk[2], 1);  // whole layers of chunks
    return std::max<std::int64_t>(kSlabBytes / slice / chunk, 1) * chunk;
}

struct Free {
    void operator()(std::byte* bytes) const { std::free(bytes); }
};

struct Samples {
    std::unique_ptr<std::byte[], Free> bytes;
    std::size_t size = 0;

    /// In huge pages, as the arrays of NumPy, which the libraries read into.
    void make(std::size_t wanted) {
        constexpr std::size_t kHugePage = std::size_t{2} << 20;
        size = wanted;
        const std::size_t whole = (wanted + kHugePage - 1) / kHugePage * kHugePage;
        bytes.reset(static_cast<std::byte*>(std::aligned_alloc(kHugePage, whole)));
        if (bytes == nullptr) throw std::bad_alloc();
        (void)::madvise(bytes.get(), whole, MADV_HUGEPAGE);
    }
};

/// The most that was resident; that of getrusage() counts what the process was started from.
std::int64_t peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) return 1024 * std::atoll(line.c_str() + 6);
    }
    return 0;
}

/// Opens the file, reads all of it into a new buffer, slab by slab.
double read_once(const char* path, Samples& samples) {
    samples = {};
    const Clock::time_point start = Clock::now();
    const std::unique_ptr<VolumeReader> reader = open_volume(path, {});
    const VolumeInfo& info = reader->info();
    const auto slice = static_cast<std::size_t>(info.extent.slice()) * size_of(info.type);
    samples.make(slice * static_cast<std::size_t>(info.extent.size[2]));
    const std::int64_t step = slices_of(info);
    for (std::int64_t z = 0; z < info.extent.size[2]; z += step) {
        const std::int64_t end = std::min(z + step, info.extent.size[2]);
        reader->read(z, end,
                     std::span(samples.bytes.get(), samples.size)
                         .subspan(slice * static_cast<std::size_t>(z), slice * static_cast<std::size_t>(end - z)));
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    try {
        Samples samples;
        std::vector<double> seconds;
        const int repeats = argc > 2 ? std::atoi(argv[2]) : 1;
        for (int run = 0; run < repeats; ++run) seconds.push_back(read_once(argv[1], samples));
        if (argc > 3)
            std::ofstream(argv[3], std::ios::binary)
                .write(reinterpret_cast<const char*>(samples.bytes.get()), static_cast<std::streamsize>(samples.size));
        std::cout << nlohmann::json{{"seconds", seconds}, {"bytes", samples.size}, {"peak", peak_bytes()}} << '\n';
    } catch (const Error& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
