#include "base/big_vector.h"
#include "base/cancel.h"
#include "base/streamed.h"
#include "field/volume_view.h"
#include "formats/volume/load_samples.h"
#include "isoatlas/disk_search.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "methods/disk/block_file.h"
#include "methods/disk/interval_tree_query.h"
#include "methods/disk/interval_tree_writer.h"

namespace isoatlas {
namespace {

constexpr std::string_view kTreeMagic = "isoatlas BITREE\n";

/// Numbers of the header.
constexpr std::size_t kType = 0, kCells = 1, kSlabs = 2, kLevels = 3, kRoot = 4, kFirst = 5, kCount = 6;

IntervalTreePlace place_of(const HeaderNumbers& numbers) {
    return {numbers[kLevels], numbers[kRoot], {numbers[kFirst], static_cast<std::uint32_t>(numbers[kCount])}};
}

/// All that are active at some isovalue, in the order of their numbers.
template <class T>
Array<CellInterval<T>> all_intervals(const CellGrid<T>& grid, const Context& context) {
    constexpr std::int64_t kBetweenLooks = 1 << 20;
    Array<CellInterval<T>> cells(static_cast<std::size_t>(grid.count()));
    std::size_t count = 0;
    for (const auto i : streamed<std::int64_t>(cells.size(), in_order(4))) {
        if (i % kBetweenLooks == 0) stop_if_cancelled(context);
        const std::array<T, 2> ends = grid.interval(grid.place(CellId(i)));
        if (ends[0] < ends[1]) cells[count++] = {ends[0], ends[1], CellId(i)};
    }
    cells.resize(count);
    return cells;
}

/// release(): the samples are no longer needed.
template <class Release>
void write_tree(const std::string& path, const VolumeView& volume, const Release& release, const IntervalTreeFileOptions& options,
                const Context& context) {
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const CellGrid<T> grid(volume.info->extent, samples);
        require_countable(grid.count(), volume.info->path);
        BlockWriter file(path, kTreeMagic, options.block_bytes);
        Array<CellInterval<T>> cells = all_intervals(grid, context);
        release();
        const std::int64_t count = std::ssize(cells);
        IntervalTreeWriter<CellInterval<T>> writer(file);
        const IntervalTreePlace place = writer.write(std::move(cells), context);
        file.commit({static_cast<std::int64_t>(volume.info->type), count, writer.slabs(), place.levels, place.root, place.list.first,
                     place.list.count, 0});
    });
}

}  // namespace

void write_interval_tree(const std::string& path, const Volume& volume, const IntervalTreeFileOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    write_tree(path, volume, [] {}, options, context);
}

void write_interval_tree(const std::string& path, VolumeReader& reader, const MissingPolicy& missing,
                         const IntervalTreeFileOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    Array<std::byte> samples;
    const Allocate allocate = [&](std::size_t bytes) {
        samples.resize(bytes);
        return std::span<std::byte>(samples);
    };
    const VolumeInfo info = load_samples(reader, missing, allocate, context);
    write_tree(path, {info, samples.data()}, [&] { release(samples); }, options, context);
}

struct IntervalTreeFile::Data {
    BlockReader file;
};

IntervalTreeFile::IntervalTreeFile(const std::string& path) : data_(std::make_unique<Data>(BlockReader(path, kTreeMagic))) {
    const HeaderNumbers& numbers = data_->file.numbers();
    if (numbers[kType] < 0 || numbers[kType] > static_cast<std::int64_t>(ValueType::f64))
        data_->file.fail("the type of the samples is unknown");
}
IntervalTreeFile::~IntervalTreeFile() = default;

std::vector<CellId> IntervalTreeFile::active(double tau, CellSearchCost& cost) {
    require_isovalue(tau);
    cost = {};
    std::vector<CellId> found;
    visit_type(static_cast<ValueType>(data_->file.numbers()[kType]), [&]<class T>(T) {
        IntervalTreeQuery<CellInterval<T>>(data_->file, tau, cost).run(place_of(data_->file.numbers()), [&](const CellInterval<T>& c) {
            found.push_back(c.cell);
        });
    });
    cost.active = std::ssize(found);
    return found;
}

void IntervalTreeFile::drop_pages() { data_->file.drop_pages(); }
std::int64_t IntervalTreeFile::bytes() const { return 2 * block_bytes(); }
std::int64_t IntervalTreeFile::file_bytes() const { return data_->file.blocks() * data_->file.block_bytes(); }
std::int64_t IntervalTreeFile::block_bytes() const { return data_->file.block_bytes(); }
std::int64_t IntervalTreeFile::cells() const { return data_->file.numbers()[kCells]; }
int IntervalTreeFile::slabs() const { return static_cast<int>(data_->file.numbers()[kSlabs]); }
int IntervalTreeFile::levels() const { return static_cast<int>(data_->file.numbers()[kLevels]); }

}  // namespace isoatlas
