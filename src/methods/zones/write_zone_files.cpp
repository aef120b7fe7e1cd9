// Phases 2 to 4 of section 10.1: which cells are in which list, the components of the lists, each sorted, each written.
#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "base/cancel.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/zone_files.h"
#include "methods/disk/interval_tree_writer.h"
#include "methods/zones/block_stream.h"
#include "methods/zones/components.h"
#include "methods/zones/file_cells.h"
#include "methods/zones/zone_cell.h"
#include "methods/zones/zone_directory.h"

namespace isoatlas {
namespace {

/// Writes lists: short ones one after another, none in two blocks.
template <class T>
class ListWriter {
public:
    using Entry = ZoneCell<T>;

    ListWriter(BlockWriter& file, const CellGrid<T>& grid, const Context& context)
        : file_(file), grid_(grid), context_(context), in_block_(static_cast<std::size_t>(entries_of_block<Entry>(file.payload_bytes()))) {}

    /// Of one component.
    [[nodiscard]] ZoneList write(std::span<const Filing<T>> cells) {
        ZoneList list{.node = cells.front().node, .filed = static_cast<std::uint32_t>(cells.size())};
        Array<Entry> entries;
        for (const Filing<T>& filing : cells) {
            if (filing.low < filing.high) entries.push_back(entry_of(filing));
        }
        if (entries.empty()) return list;
        std::ranges::sort(
            entries, [](const Entry& p, const Entry& q) { return std::tuple(q.high, q.low, p.cell) < std::tuple(p.high, p.low, q.cell); });
        list.count = static_cast<std::uint32_t>(entries.size());
        list.high = static_cast<double>(entries.front().high);
        list.low = static_cast<double>(std::ranges::min_element(entries, {}, &Entry::low)->low);
        if (entries.size() <= in_block_) {
            list.place.list = put(entries);
        } else {
            flush();
            list.place = IntervalTreeWriter<Entry>(file_).write(std::move(entries), context_);
        }
        return list;
    }
    void flush() {
        if (short_) short_->flush();
        short_.reset();
    }

private:
    [[nodiscard]] Entry entry_of(const Filing<T>& filing) const {
        Entry entry{{filing.low, filing.high, filing.cell}, {}};
        const Index3 place = grid_.place(filing.cell);
        for (int k = 0; k < grid_.corners(); ++k) entry.samples[static_cast<std::size_t>(k)] = grid_.sample(place, k);
        return entry;
    }
    [[nodiscard]] EntryRange put(std::span<const Entry> entries) {
        const std::int64_t size = std::ssize(entries), in_block = static_cast<std::int64_t>(in_block_);
        if (short_ && short_->ranges(std::span(&size, 1)).front().first % in_block + size > in_block) flush();
        if (!short_) short_.emplace(file_);
        return short_->put(entries);
    }

    BlockWriter& file_;
    const CellGrid<T>& grid_;
    const Context& context_;
    std::size_t in_block_;
    std::optional<EntryStream<Entry>> short_;
};

template <class T>
std::vector<ZoneList> write_lists(BlockWriter& file, const CellGrid<T>& grid, std::vector<Filing<T>> filings, ZoneLayout layout,
                                  const Context& context) {
    std::ranges::sort(filings,
                      [](const Filing<T>& p, const Filing<T>& q) { return std::pair(p.node, p.cell) < std::pair(q.node, q.cell); });
    std::vector<ZoneList> lists;
    ListWriter<T> writer(file, grid, context);
    for (std::size_t begin = 0, end = 0; begin < filings.size(); begin = end) {
        stop_if_cancelled(context);
        while (end < filings.size() && filings[end].node == filings[begin].node) ++end;
        const auto own = std::span(filings).subspan(begin, end - begin);
        const auto write = [&](std::span<const Filing<T>> cells) { lists.push_back(writer.write(cells)); };
        if (layout == ZoneLayout::by_zone)
            for_components(grid, own, write);
        else
            write(own);
    }
    writer.flush();
    return lists;
}

void require_zones(const Volume& volume, const Analysis& analysis) {
    if (analysis.extent() == volume.info.extent) return;
    throw Error(ErrorKind::usage, {.where = volume.info.path, .what = "the analysis is that of another volume"});
}

template <class T>
std::int64_t count_entries(const Volume& volume, const Analysis& analysis, const EventChains& events, ZoneLayout layout,
                           const Context& context) {
    constexpr std::int64_t kAny = std::numeric_limits<std::int64_t>::max();
    if (layout == ZoneLayout::by_path)
        return std::ssize(file_cells<T>(volume, analysis, events, node_of_events(stored_tree(events), layout), layout, kAny, context));
    std::int64_t count = 0;
    std::vector<Chain> pieces;
    for (std::int64_t z = 0; z < volume.info.extent.size[2]; ++z) {
        stop_if_cancelled(context);
        WaitingVoxels(volume, analysis, events)
            .run(
                {z, z + 1}, [](const Tops&) {},
                [&](std::span<const std::int64_t>, std::span<const Tops* const> tops) {
                    pieces.clear();
                    cut_into_pieces(events, tops, pieces);
                    for (const Chain& piece : pieces)
                        events.for_ranges(piece, [&](std::int64_t first, std::int64_t last) { count += last - first + 1; });
                });
    }
    return count;
}

}  // namespace

std::int64_t count_zone_file_entries(const Volume& volume, const Analysis& analysis, ZoneLayout layout, const Context& context) {
    const EnvironmentScope scope(context);
    require_zones(volume, analysis);
    const EventChains events(analysis);
    return visit_type(volume.info.type, [&]<class T>(T) { return count_entries<T>(volume, analysis, events, layout, context); });
}

void write_zone_files(const std::string& path, const Volume& volume, const Analysis& analysis, const ZoneFileOptions& options,
                      const Context& context) {
    const EnvironmentScope scope(context);
    require_zones(volume, analysis);
    BlockWriter file(path, kZoneMagic, options.block_bytes);
    const EventChains events(analysis);
    ZoneDirectory directory{volume.info, stored_tree(events), {}};
    const std::vector<ZoneNodeId> nodes = node_of_events(directory.tree, options.layout);
    visit_type(volume.info.type, [&]<class T>(T) {
        const CellGrid<T> grid(volume.info.extent, volume.samples<T>());
        require_countable(grid.count(), volume.info.path);
        if (options.layout == ZoneLayout::by_zone)
            refuse_if_too_many(count_entries<T>(volume, analysis, events, options.layout, context), options.max_entries, volume.info.path);
        directory.lists =
            write_lists(file, grid, file_cells<T>(volume, analysis, events, nodes, options.layout, options.max_entries, context),
                        options.layout, context);
    });
    PayloadWriter payload;
    put_directory(payload, directory);
    const StreamPlace place = write_stream(file, payload.bytes());
    HeaderNumbers numbers{};
    numbers[kZoneLayout] = static_cast<std::int64_t>(options.layout);
    numbers[kDirectory] = place.first, numbers[kDirectoryBytes] = place.bytes;
    file.commit(numbers);
}

}  // namespace isoatlas
