#include "isoatlas/brick_search.h"

#include "bricks/stored_samples.h"
#include "levelset/active_cells.h"
#include "methods/search/cell_grid.h"
#include "store/container.h"

namespace isoatlas {
namespace {

/// Numbers of the active cells in the words that may have some.
template <int kRows>
void add_active(const CellRow<kRows>& rows, const Index3& first, const Index3& size, std::vector<CellId>& found) {
    for_active_cells(rows, CellWindow::real(size[0] + 1), [&](std::int64_t p, int) {  // cell p lies between the samples p - 1 and p
        found.push_back(CellId(p - 1 + size[0] * (first[1] + size[1] * first[2])));
    });
}

std::vector<CellId> active_cells(const HighBits& high, const Extent& extent) {
    Index3 size = extent.size;
    for (int axis = 0; axis < extent.rank; ++axis) --size[axis];
    std::vector<CellId> found;
    for (std::int64_t z = 0; z < size[2]; ++z) {
        for (std::int64_t y = 0; y < size[1]; ++y) {
            if (extent.rank == 2)
                add_active(square_row(high, y), {0, y, z}, size, found);
            else
                add_active(cell_row(high, y, z), {0, y, z}, size, found);
        }
    }
    return found;
}

}  // namespace

struct BrickSearch::Data {
    Container store;
    std::unique_ptr<StoredSamples> samples;

    explicit Data(const std::string& path) : store(path, std::nullopt), samples(stored_samples(store, 0)) {}
};

BrickSearch::BrickSearch(const std::string& path) : data_(std::make_unique<Data>(path)) {
    require_countable(data_->store.contents().volume.extent.voxels(), path);
}
BrickSearch::~BrickSearch() = default;

std::vector<CellId> BrickSearch::active(double tau, CellSearchCost& cost) {
    require_isovalue(tau);
    cost = {};
    data_->samples->clear();
    LevelQuery query;
    const StoredLevel level = data_->samples->classify(tau, BrickFlags(), {.threads = 1}, query);
    std::vector<CellId> found = active_cells(level.high, data_->store.contents().volume.extent);
    cost.active = std::ssize(found);
    cost.cells = query.visited;
    cost.nodes = data_->samples->grid().count();
    cost.blocks = query.bricks, cost.bytes_read = query.bytes;
    return found;
}

std::int64_t BrickSearch::bytes() const { return 2 * data_->samples->grid().count() * size_of(data_->store.contents().volume.type); }
void BrickSearch::drop_pages() { data_->store.drop_pages(); }
std::int64_t BrickSearch::file_bytes() const { return data_->store.file_size(); }

}  // namespace isoatlas
