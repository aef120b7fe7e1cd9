// Building a store: analyse, then pack bricks and trees.
#include "isoatlas/atlas.h"
#include "store/brick_writer.h"
#include "store/checksum.h"
#include "store/tree_arrays.h"

namespace isoatlas {

void build_atlas(const std::string& path, const Volume& volume, const AnalysisOptions& options, const Context& context) {
    const Analysis analysis = analyse(volume, options, context);
    store::Contents contents;
    contents.volume = volume.info;
    const std::size_t slash = volume.info.path.rfind('/');
    if (slash != std::string::npos) contents.volume.path = volume.info.path.substr(slash + 1);  // where it lay does not matter
    contents.parameters = {options.interpolant, options.tunnel_height, store::checksum(volume.bytes)};
    std::vector<store::PackedArray> arrays = store::brick_arrays(volume, context);
    for (store::PackedArray& array : store::tree_arrays(analysis)) arrays.push_back(std::move(array));
    store::pack_store(path, contents, arrays);
}

}  // namespace isoatlas
