// A query (section 11.2): from the tree to the active zones, from these to their components, and to their active cells.
#include <algorithm>
#include <utility>

#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/zone_files.h"
#include "levelset/volume_cells.h"
#include "methods/zones/block_stream.h"
#include "methods/zones/list_reader.h"
#include "methods/zones/restore_samples.h"

namespace isoatlas {
namespace {

ZoneLayout layout_of(const BlockReader& file) {
    const std::int64_t number = file.numbers()[kZoneLayout];
    if (number != 0 && number != 1) file.fail("the layout is unknown");
    return static_cast<ZoneLayout>(number);
}

ZoneDirectory directory_of(const BlockReader& file) {
    const std::vector<std::byte> bytes = read_stream(file, {file.numbers()[kDirectory], file.numbers()[kDirectoryBytes]});
    PayloadReader payload(bytes, file);
    return get_directory(payload, file, layout_of(file));
}

/// Is the surface one of active cells alone?
void require_cells(const ExtractOptions& options, const Extent& extent) {
    const SurfaceOptions& surface = options.surface;
    if (surface.normals || surface.ids || !surface.objects.empty() || !surface.contours.empty() || surface.shell != ShellChoice::all)
        throw Error(ErrorKind::usage, {.what = "normals, ids and chosen objects need samples beyond active cells",
                                       .expected = "a whole surface without normals and ids",
                                       .next = "extract it from the volume, or from a store"});
    if (surface.boundary == Boundary::closed && cell_count(extent) == 0)
        throw Error(ErrorKind::usage, {.what = "a volume that is one sample thick has no cells to close a surface from",
                                       .expected = "an open surface",
                                       .next = "extract it from the volume, or from a store"});
}

}  // namespace

struct ZoneFileSearch::Data {
    BlockReader file;
    ZoneLayout layout;
    VolumeInfo info;
    ZoneTree tree;
    std::vector<ZoneList> lists;
    std::vector<std::size_t> first_list;  ///< per node, and one more
    std::int64_t events, entries = 0;
    double highest;  ///< value of an event, and of a sample
    ZoneFileReads reads{};

    Data(BlockReader reader, ZoneDirectory directory)
        : file(std::move(reader)),
          layout(layout_of(file)),
          info(std::move(directory.info)),
          tree(directory.tree, layout),
          lists(std::move(directory.lists)),
          first_list(static_cast<std::size_t>(tree.size()) + 1),
          events(std::ssize(directory.tree.values)),
          highest(std::ranges::max(directory.tree.values)) {
        for (const ZoneList& list : lists) ++first_list[list.node.index() + 1], entries += list.count;
        for (std::size_t i = 1; i < first_list.size(); ++i) first_list[i] += first_list[i - 1];
    }

    /// The active cells, ascending.
    template <class T>
    std::vector<ZoneCell<T>> find(double tau, CellSearchCost& cost) {
        cost = {}, reads = {};
        std::vector<const ZoneList*> active;
        cost.nodes = tree.for_active(tau, [&](ZoneNodeId node) {
            ++reads.zones;
            for (std::size_t i = first_list[node.index()]; i < first_list[node.index() + 1]; ++i) {
                reads.cells_filed += lists[i].filed;
                if (lists[i].low < tau && tau <= lists[i].high) active.push_back(&lists[i]);
            }
        });
        std::ranges::sort(active);  // as they lie in the file
        ListReader<T> reader(file, info.extent, tau, cost, reads);
        for (const ZoneList* list : active) reader.read(*list);
        std::vector<ZoneCell<T>> found = reader.result();
        cost.active = std::ssize(found), reads.cells_visited = cost.cells;
        return found;
    }
};

ZoneFileSearch::ZoneFileSearch(const std::string& path) {
    BlockReader file(path, kZoneMagic);
    ZoneDirectory directory = directory_of(file);
    directory.info.path = path;
    data_ = std::make_unique<Data>(std::move(file), std::move(directory));
}
ZoneFileSearch::~ZoneFileSearch() = default;

std::vector<CellId> ZoneFileSearch::active(double tau, CellSearchCost& cost) {
    require_isovalue(tau);
    std::vector<CellId> cells;
    visit_type(data_->info.type, [&]<class T>(T) {
        for (const ZoneCell<T>& cell : data_->find<T>(tau, cost)) cells.push_back(cell.cell);
    });
    return cells;
}

Surface ZoneFileSearch::extract(double tau, const ExtractOptions& options, CellSearchCost& cost, const Context& context) {
    const EnvironmentScope scope(context);
    require_isovalue(tau);
    require_cells(options, data_->info.extent);
    return visit_type(data_->info.type, [&]<class T>(T) {
        const std::vector<ZoneCell<T>> active = data_->find<T>(tau, cost);
        const Volume volume = restore_samples<T>(data_->info, active, tau, tau <= data_->highest);
        return isoatlas::extract(volume, tau, options, context);
    });
}

const ZoneFileReads& ZoneFileSearch::reads() const { return data_->reads; }
void ZoneFileSearch::drop_pages() { data_->file.drop_pages(); }
std::int64_t ZoneFileSearch::bytes() const {
    const Data& data = *data_;
    return data.tree.bytes() +
           static_cast<std::int64_t>(data.lists.size() * sizeof(ZoneList) + data.first_list.size() * sizeof(std::size_t));
}
std::int64_t ZoneFileSearch::file_bytes() const { return data_->file.blocks() * data_->file.block_bytes(); }
std::int64_t ZoneFileSearch::block_bytes() const { return data_->file.block_bytes(); }
ZoneLayout ZoneFileSearch::layout() const { return data_->layout; }
std::int64_t ZoneFileSearch::events() const { return data_->events; }
std::int64_t ZoneFileSearch::zones() const { return data_->tree.size(); }
std::int64_t ZoneFileSearch::components() const { return std::ssize(data_->lists); }
std::int64_t ZoneFileSearch::entries() const { return data_->entries; }

}  // namespace isoatlas
