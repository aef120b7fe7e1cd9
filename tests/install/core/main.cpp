// The objects of an array, with isoatlas::core alone.
#include <isoatlas/objects.h>

#include <cstdio>

int main() {
    isoatlas::Volume volume;
    volume.info.extent.size = {16, 16, 16};
    for (int v = 0; v < 16 * 16 * 16; ++v) volume.bytes.push_back(static_cast<std::byte>(v % 5 * (v / 256 % 7)));
    const isoatlas::Analysis analysis = isoatlas::analyse(volume);
    std::printf("%lld events\n", static_cast<long long>(analysis.event_count()));
    for (const isoatlas::ObjectEntry& object : isoatlas::rank_objects(volume, analysis).entries)
        std::printf("voxel %lld: best at %g\n", static_cast<long long>(object.id), object.best_tau);
}
