// The program at the top of <isoatlas/isoatlas.h>, built against the installed package: every object of a volume, best one first,
// and the surface of the first at the isovalue that shows it best.
#include <isoatlas/isoatlas.h>

#include <cstdio>

int main(int argc, char** argv) try {
    const isoatlas::Volume volume = argc > 1 ? isoatlas::load_volume(argv[1]) : isoatlas::make_phantom("torus-chain", {.size = 40});
    const isoatlas::Analysis analysis = isoatlas::analyse(volume);
    const isoatlas::ObjectTable table = isoatlas::rank_objects(volume, analysis);
    for (const isoatlas::ObjectEntry& object : table.entries) {
        std::printf("voxel %lld: best at %g, %lld voxels, %lld tunnels\n", static_cast<long long>(object.id), object.best_tau,
                    static_cast<long long>(object.voxels), static_cast<long long>(object.tunnels));
    }
    if (table.entries.empty()) return 1;

    const isoatlas::ObjectEntry& best = table.entries.front();
    const isoatlas::Surface surface = isoatlas::extract(volume, best.best_tau, {.surface = {.objects = {best.id}}});
    isoatlas::write_surface("surface.ply", surface);
    const isoatlas::SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    std::printf("surface.ply: %lld triangles\n", static_cast<long long>(report.triangles));
    return report.is_closed() && report.is_manifold() && report.is_oriented() ? 0 : 1;
} catch (const isoatlas::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.kind());
}
