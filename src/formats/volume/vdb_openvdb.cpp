// OpenVDB: the only file that uses its library. Grids of numbers are read as the box of their active voxels and written from volumes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <istream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/memory_limit.h"
#include "formats/common/byte_source.h"
#include "formats/volume/axes.h"
#include "formats/volume/choose.h"
#include "formats/volume/chunk_reader.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/vdb_library.h"
#include "formats/volume/vdb_stream.h"
#include "isoatlas/text.h"
#include "isoatlas/units.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

namespace isoatlas {
namespace {

constexpr std::int64_t kChunk = 64;  ///< samples along each axis, eight leaves of a tree
constexpr const char* kUnitKey = "unit";

/// What `read` returns; what OpenVDB throws is an Error.
template <class Read>
auto guarded(const std::string& path, const Read& read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::resource, {.file = path, .what = "not enough memory for its grid", .next = "free some memory"});
    } catch (const std::exception& error) {
        refuse_vdb(path, error.what());
    }
}

struct VdbGrid {
    openvdb::GridBase::Ptr grid;
    std::string name;
};

constexpr std::string_view kReadTypes[] = {"float", "double", "int32", "int64", "bool"};

[[noreturn]] void unsupported_values(const std::string& path, const std::string& grid, const std::string& what) {
    throw Error(ErrorKind::unsupported, {.file = path,
                                         .where = "grid " + grid,
                                         .what = what,
                                         .expected = "a grid of float, double, int32, int64 of 32 bits, or bool",
                                         .next = "choose another grid, or convert it"});
}

/// The grid that is chosen; no other is read.
VdbGrid read_grid(const std::string& path, const OpenOptions& options) {
    const VdbFile file = read_vdb_file(path);
    std::vector<ErrorChoice> choices;
    std::map<std::string, int> words;
    for (const VdbGridPlace& grid : file.grids) {
        std::string word = "/" + shown_name(grid.name.empty() ? "grid" : grid.name);
        if (words[word]++ > 0) word += "@" + std::to_string(choices.size());
        choices.push_back({word, shown_name(grid.type)});
    }
    const std::size_t chosen = choose_dataset(path, options, choices);
    const VdbGridPlace& place = file.grids[chosen];
    if (std::ranges::find(kReadTypes, place.type) == std::end(kReadTypes))
        unsupported_values(path, choices[chosen].word, "values of type " + choices[chosen].about + " are not supported");
    openvdb::initialize();
    VdbStreamBuffer buffer(path, checked_vdb_grid(file, place));
    std::istream stream(&buffer);
    stream.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    openvdb::io::Stream read(stream, /*delayLoad=*/false);
    const openvdb::GridPtrVecPtr grids = read.getGrids();
    if (!grids || grids->empty()) refuse_vdb(path, "it has no grid");
    return {grids->back(), choices[chosen].word};
}

void set_geometry(const std::string& path, const openvdb::GridBase& grid, const openvdb::CoordBBox& box, VolumeInfo& info) {
    const auto world = [&](double x, double y, double z) { return grid.transform().indexToWorld(openvdb::Vec3d(x, y, z)); };
    const openvdb::Vec3d first = grid.transform().indexToWorld(box.min().asVec3d()), zero = world(0, 0, 0);
    const std::array<openvdb::Vec3d, 3> ends{world(1, 0, 0), world(0, 1, 0), world(0, 0, 1)};
    for (int axis = 0; axis < 3; ++axis) {
        const openvdb::Vec3d step = ends[static_cast<std::size_t>(axis)] - zero;
        set_axis_step(info, axis, {step[0], step[1], step[2]});
        if (!std::isfinite(first[axis])) refuse_vdb(path, "its first voxel is not at a finite position");
        info.geometry.origin[static_cast<std::size_t>(axis)] = first[axis];
    }
    require_frame(info);
    if (const auto unit = grid.getMetadata<openvdb::StringMetadata>(kUnitKey)) info.geometry.unit = unit->value();
}

openvdb::CoordBBox active_box(const std::string& path, const openvdb::GridBase& grid) {
    constexpr int kMaxIndex = 1 << 30;
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) {
        throw Error(ErrorKind::input,
                    {.file = path, .what = "the grid has no active voxels", .expected = "samples", .next = "choose another grid or file"});
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min()[axis] < -kMaxIndex || box.max()[axis] > kMaxIndex) refuse_vdb(path, "a voxel lies beyond 2^30");
    }
    return box;
}

/// A box that does not fit in memory is read in parts only.
void require_memory(const VolumeInfo& info, const OpenOptions& options) {
    const std::int64_t bytes = sample_bytes(info.path, info.extent, info.type), available = available_memory();
    if (options.box || bytes <= available) return;
    throw Error(ErrorKind::resource, {.file = info.path,
                                      .what = "the box of the active voxels has " + std::to_string(bytes) + " bytes",
                                      .expected = "at most " + std::to_string(available) + ", the memory of this machine",
                                      .next = "read a part of it (a box)"});
}

template <class Sample, class Grid>
std::unique_ptr<VolumeReader> reader_of(VolumeInfo info, const std::shared_ptr<const Grid>& grid, const openvdb::Coord& corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) info.chunk[axis] = std::min(kChunk, info.extent.size[axis]);
    const Index3 chunk_size = info.chunk;
    return make_chunk_reader(std::move(info), [grid, corner, chunk_size](const Index3& chunk, std::span<std::byte> out) {
        const auto at = [&](std::size_t axis) { return corner[static_cast<int>(axis)] + static_cast<int>(chunk[axis] * chunk_size[axis]); };
        const openvdb::Coord low(at(0), at(1), at(2));
        const openvdb::Coord size(static_cast<int>(chunk_size[0]), static_cast<int>(chunk_size[1]), static_cast<int>(chunk_size[2]));
        const openvdb::CoordBBox box(low, low + size.offsetBy(-1));
        openvdb::tools::Dense<Sample, openvdb::tools::LayoutXYZ> dense(box, reinterpret_cast<Sample*>(out.data()));
        openvdb::tools::copyToDense(grid->tree(), dense, /*serial=*/true);
    });
}

/// Whether all values of a tree, the background too, fit in 32 bits.
bool fits_in_32_bits(const openvdb::Int64Grid& grid) {
    const auto fits = [](std::int64_t value) { return value >= INT32_MIN && value <= INT32_MAX; };
    for (auto value = grid.cbeginValueAll(); value; ++value) {
        if (!fits(*value)) return false;
    }
    return fits(grid.background());
}

std::unique_ptr<VolumeReader> open_grid(const std::string& path, const OpenOptions& options) {
    const VdbGrid chosen = read_grid(path, options);
    const openvdb::CoordBBox box = active_box(path, *chosen.grid);
    VolumeInfo info;
    info.path = path;
    info.format = "OpenVDB";
    info.encoding = "OpenVDB";
    info.file_bytes = file_size(path);
    info.volumes.has_datasets = true;
    for (int axis = 0; axis < 3; ++axis) info.extent.size[static_cast<std::size_t>(axis)] = box.dim()[axis];
    if (info.extent.size[2] == 1) info.extent.rank = 2;
    info.notes.push_back("the grid " + chosen.name + ", in the box of its active voxels");
    if (chosen.grid->getGridClass() == openvdb::GRID_LEVEL_SET) info.notes.emplace_back("a level set: values are below 0 inside");
    set_geometry(path, *chosen.grid, box, info);
    static_cast<void>(choose_time_step(path, options, 1));
    std::unique_ptr<VolumeReader> reader;
    const auto take = [&]<class Grid, class Sample>(std::type_identity<Grid>, Sample) {
        const auto grid = openvdb::gridConstPtrCast<Grid>(chosen.grid);
        if (!grid) return false;
        info.type = value_type_of<Sample>;
        require_memory(info, options);
        reader = reader_of<Sample, Grid>(std::move(info), grid, box.min());
        return true;
    };
    const auto wide = openvdb::gridConstPtrCast<openvdb::Int64Grid>(chosen.grid);
    if (take(std::type_identity<openvdb::FloatGrid>{}, float{}) || take(std::type_identity<openvdb::DoubleGrid>{}, double{}) ||
        take(std::type_identity<openvdb::Int32Grid>{}, std::int32_t{}) || take(std::type_identity<openvdb::BoolGrid>{}, std::uint8_t{}) ||
        (wide && fits_in_32_bits(*wide) && take(std::type_identity<openvdb::Int64Grid>{}, std::int32_t{})))
        return reader;
    unsupported_values(path, chosen.name, "a value does not fit in 32 bits");
}

/// Writes a file whose grids can be found without reading them all; io::File writes to names only.
class SeekableArchive final : public openvdb::io::Archive {
public:
    [[nodiscard]] Ptr copy() const override { return std::make_shared<SeekableArchive>(*this); }
    void put(std::ostream& out, const openvdb::GridCPtrVec& grids) const { write(out, grids, /*seekable=*/true, openvdb::MetaMap()); }
};

/// The same file for the same grid: an identifier made of its bytes in place of a random one.
void set_identifier(std::string& file) {
    constexpr std::size_t kBegin = 21, kSize = 36;  // behind magic, three versions and a flag
    if (file.size() < kBegin + kSize) return;
    std::array<std::uint64_t, 2> hash{0xcbf29ce484222325U, 0x84222325cbf29ce4U};
    for (std::size_t i = kBegin + kSize; i < file.size(); ++i) {
        for (std::uint64_t& part : hash) part = (part ^ static_cast<unsigned char>(file[i])) * 0x100000001b3U;
    }
    for (std::size_t i = 0, digit = 0; i < kSize; ++i) {
        if (file[kBegin + i] == '-') continue;
        file[kBegin + i] = "0123456789abcdef"[hash[digit / 16] >> 4 * (digit % 16) & 15];
        ++digit;
    }
}

/// The most frequent value of the border, the least of those; of many different values only the first are counted.
template <class Value>
class BorderValues {
public:
    explicit BorderValues(const Extent& extent) : extent_(extent) {}
    void add(std::int64_t index, Value value) {
        constexpr std::size_t kMaxValues = 1 << 16;
        const Index3 voxel = extent_.voxel(index);
        bool is_border = false;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(extent_.rank); ++axis)
            is_border = is_border || voxel[axis] == 0 || voxel[axis] == extent_.size[axis] - 1;
        if (!is_border || value != value) return;
        const auto found = counts_.find(value);
        if (found != counts_.end())
            ++found->second;
        else if (counts_.size() < kMaxValues)
            counts_[value] = 1;
    }
    [[nodiscard]] Value most() const {
        Value best{};
        std::int64_t times = 0;
        for (const auto& [value, count] : counts_) {
            if (count > times || (count == times && value < best)) best = value, times = count;
        }
        return best;
    }

private:
    const Extent& extent_;
    std::unordered_map<Value, std::int64_t> counts_;
};

/// Calls use(index, value) with all samples of a feed, in order.
template <class Sample, class Use>
void for_each_sample(const SampleFeed& samples, const Use& use) {
    std::int64_t index = 0;
    std::vector<std::byte> rest;  // of a sample that a piece cuts
    samples([&](std::span<const std::byte> bytes) {
        const auto give = [&](const std::byte* from) {
            Sample sample;
            std::memcpy(&sample, from, sizeof sample);
            use(index++, sample);
        };
        while (!rest.empty() && rest.size() < sizeof(Sample) && !bytes.empty()) rest.push_back(bytes[0]), bytes = bytes.subspan(1);
        if (rest.size() == sizeof(Sample)) give(rest.data()), rest.clear();
        for (; bytes.size() >= sizeof(Sample); bytes = bytes.subspan(sizeof(Sample))) give(bytes.data());
        rest.insert(rest.end(), bytes.begin(), bytes.end());
    });
}

template <class Grid, class Sample>
openvdb::GridBase::Ptr grid_of(const VolumeInfo& info, const SampleFeed& samples, bool zero_is_background) {
    using Value = typename Grid::ValueType;
    const Extent& extent = info.extent;
    Value background{};
    if (!zero_is_background) {
        BorderValues<Value> border(extent);
        for_each_sample<Sample>(samples, [&](std::int64_t i, Sample sample) { border.add(i, static_cast<Value>(sample)); });
        background = border.most();
    }
    const typename Grid::Ptr grid = Grid::create(background);
    constexpr std::int64_t kLayer = 8;  // a layer of leaves
    std::vector<Value> layer(static_cast<std::size_t>(extent.slice() * std::min(kLayer, extent.size[2])));
    for_each_sample<Sample>(samples, [&](std::int64_t i, Sample sample) {
        const std::int64_t z = i / extent.slice(), within = i - z / kLayer * kLayer * extent.slice();
        layer[static_cast<std::size_t>(within)] = static_cast<Value>(sample);
        const bool is_last = i + 1 == extent.voxels();
        if (!is_last && within + 1 != extent.slice() * kLayer) return;
        const openvdb::CoordBBox box(0, 0, static_cast<int>(z / kLayer * kLayer), static_cast<int>(extent.size[0] - 1),
                                     static_cast<int>(extent.size[1] - 1), static_cast<int>(z));
        openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(box, layer.data());
        openvdb::tools::copyFromDense(dense, *grid, Value{}, /*serial=*/true);
    });
    return grid;
}

void put_grid(Sink& sink, const VolumeInfo& info, const openvdb::GridBase::Ptr& grid, const std::string& name) {
    const Geometry geometry = regular_geometry(info);
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (int row = 0; row < 3; ++row) matrix[axis][row] = geometry.direction[static_cast<std::size_t>(row)][a] * geometry.spacing[a];
        matrix[3][axis] = geometry.origin[a];
    }
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    grid->setName(name);
    if (!geometry.unit.empty()) grid->insertMeta(kUnitKey, openvdb::StringMetadata(geometry.unit));
    std::ostringstream file(std::ios::binary);
    SeekableArchive().put(file, {grid});
    std::string bytes = std::move(file).str();
    set_identifier(bytes);
    sink.write(bytes);
}

void check_sizes(const Sink& sink, const VolumeInfo& info) {
    for (const std::int64_t size : info.extent.size) {
        if (size < 1 << 30) continue;
        throw Error(ErrorKind::unsupported, {.file = sink.name(), .what = "OpenVDB has no axis of 2^30 samples", .next = "write .nrrd"});
    }
}

std::unique_ptr<VolumeReader> open(const std::string& path, const OpenOptions& options) {
    return guarded(path, [&] { return open_grid(path, options); });
}

void write(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    check_sizes(sink, info);
    guarded(sink.name(), [&] {
        openvdb::initialize();
        const openvdb::GridBase::Ptr grid = visit_type(info.type, [&]<class Sample>(Sample) {
            if constexpr (std::is_same_v<Sample, std::int32_t>) return grid_of<openvdb::Int32Grid, Sample>(info, samples, false);
            if constexpr (std::is_same_v<Sample, double> || std::is_same_v<Sample, std::uint32_t>)
                return grid_of<openvdb::DoubleGrid, Sample>(info, samples, false);
            else
                return grid_of<openvdb::FloatGrid, Sample>(info, samples, false);
        });
        put_grid(sink, info, grid, "density");
    });
}

void write_labels(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    check_sizes(sink, info);
    guarded(sink.name(), [&] {
        openvdb::initialize();
        const openvdb::GridBase::Ptr grid = visit_type(info.type, [&]<class Sample>(Sample) {
            if constexpr (std::is_same_v<Sample, std::uint32_t>) {
                for_each_sample<Sample>(samples, [&](std::int64_t, Sample label) {
                    if (label > INT32_MAX)
                        throw Error(ErrorKind::unsupported,
                                    {.file = sink.name(), .what = "a label is above 2^31 - 1", .next = "write .nrrd"});
                });
            }
            return grid_of<openvdb::Int32Grid, Sample>(info, samples, true);
        });
        put_grid(sink, info, grid, "labels");
    });
}

}  // namespace

const VdbLibrary kOpenVdb{open, write, write_labels};

}  // namespace isoatlas
