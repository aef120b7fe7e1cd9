// Phases 2 to 4 of section 10.1: which cells are in which list, the components of the lists, each sorted, each written.
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/zone_files.h"
#include "methods/zones/components.h"
#include "methods/zones/file_cells.h"
#include "methods/zones/list_writer.h"

namespace isoatlas {
namespace {

/// Writes the lists of all nodes.
template <class T>
Spool<ZoneList> write_lists(BlockWriter& file, const CellGrid<T>& grid, FilingRuns<T>& filings, ZoneLayout layout, const Context& context) {
    Spool<ZoneList> lists;
    ListWriter<T> writer(file, context);
    ComponentsOfList<T> components(grid);
    const auto write = [&](std::span<const Filing<T>> cells) { lists.add(writer.write(cells)); };
    filings.for_lists([&](std::span<Filing<T>> cells) {
        stop_if_cancelled(context);
        if (layout == ZoneLayout::by_zone)
            components.visit(cells, write);
        else
            write(cells);
    });
    writer.flush();
    return lists;
}

void require_zones(const Volume& volume, const Analysis& analysis) {
    if (analysis.extent() == volume.info.extent) return;
    throw Error(ErrorKind::usage, {.where = volume.info.path, .what = "the analysis is that of another volume"});
}

/// By zone, without making any. Throws Error{resource} for more than `limit` has.
template <class T>
void count_by_zone(const FiledVolume& of, FilingLimit<T>& limit, const Context& context) {
    for_slabs_of_cells(of.volume.info.extent, context, [&](const Slab& slab) {
        std::vector<Chain> pieces;
        WaitingVoxels(of.volume, of.analysis, of.events)
            .run(
                slab, [](const Tops&) {},
                [&](std::span<const std::int64_t>, std::span<const Tops* const> tops) {
                    std::int64_t count = 0;
                    pieces.clear();
                    cut_into_pieces(of.events, tops, pieces);
                    for (const Chain& piece : pieces)
                        of.events.for_ranges(piece, [&](std::int64_t first, std::int64_t last) { count += last - first + 1; });
                    limit.add(count);
                });
    });
}

template <class T>
std::int64_t count_entries(const FiledVolume& of, const Context& context) {
    FilingLimit<T> limit(std::numeric_limits<std::int64_t>::max(), of.volume.info.path);
    if (of.layout == ZoneLayout::by_path)
        file_cells<T>(of, context, [&](std::span<const Filing<T>> some) { limit.add(std::ssize(some)); });
    else
        count_by_zone<T>(of, limit, context);
    return limit.count();
}

/// Which cell is in which list. Throws Error{resource}: more than allowed.
template <class T>
void file_all(const FiledVolume& of, std::int64_t max_entries, FilingRuns<T>& filings, const Context& context) {
    if (of.layout == ZoneLayout::by_zone) {
        FilingLimit<T> limit(max_entries, of.volume.info.path);
        count_by_zone<T>(of, limit, context);
    }
    FilingLimit<T> limit(max_entries, of.volume.info.path);
    file_cells<T>(of, context, [&](std::span<const Filing<T>> some) {
        limit.add(std::ssize(some));
        filings.add(some);
    });
}

/// What is accessed at random: in memory, as long as there is room for it.
struct TreeInMemory {
    EventChains events;
    NodesOfEvents nodes;
};
TreeInMemory tree_in_memory(const Analysis& analysis, ZoneLayout layout) {
    const PinInMemory pinned;
    EventChains events(analysis);
    NodesOfEvents nodes = nodes_of_events(events, layout);
    return {std::move(events), std::move(nodes)};
}

}  // namespace

std::int64_t count_zone_file_entries(const Volume& volume, const Analysis& analysis, ZoneLayout layout, const Context& context) {
    const EnvironmentScope scope(context);
    require_zones(volume, analysis);
    const TreeInMemory tree = tree_in_memory(analysis, layout);
    const FiledVolume of{volume, analysis, tree.events, tree.nodes.node, layout};
    return visit_type(volume.info.type, [&]<class T>(T) { return count_entries<T>(of, context); });
}

void write_zone_files(const std::string& path, const Volume& volume, const Analysis& analysis, const ZoneFileOptions& options,
                      const Context& context) {
    const EnvironmentScope scope(context);
    require_zones(volume, analysis);
    BlockWriter file(path, kZoneMagic, options.block_bytes);
    const TreeInMemory tree = tree_in_memory(analysis, options.layout);
    const FiledVolume of{volume, analysis, tree.events, tree.nodes.node, options.layout};
    const StreamPlace directory = visit_type(volume.info.type, [&]<class T>(T) {
        const CellGrid<T> grid(volume.info.extent, volume.samples<T>());
        require_countable(grid.count(), volume.info.path);
        FilingRuns<T> filings(tree.nodes.count, context.threads);
        file_all<T>(of, options.max_entries, filings, context);
        const Spool<ZoneList> lists = write_lists(file, grid, filings, options.layout, context);
        StreamWriter stream(file);
        put_directory(stream, volume.info, tree.events, lists);
        return stream.finish();
    });
    HeaderNumbers numbers{};
    numbers[kZoneLayout] = static_cast<std::int64_t>(options.layout);
    numbers[kDirectory] = directory.first, numbers[kDirectoryBytes] = directory.bytes;
    file.commit(numbers);
}

}  // namespace isoatlas
