// EvolutionFile: the arrays of .vtkhdf files grow step by step, chunk by chunk; where each step begins is written at the end.
#include "isoatlas/evolution_file.h"

#include <algorithm>
#include <optional>

#include "base/atomic_file.h"
#include "base/check.h"
#include "formats/common/file_extension.h"
#include "formats/mesh/vtkhdf.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::int64_t kLongChunk = 1 << 16, kShortChunk = 1 << 10;  ///< bytes

/// The rows of an array, of all steps: whole chunks are written, the rest waits.
class Rows final : public Sink {
public:
    Rows(Sink& file, Hdf5Layout& layout, const VtkhdfArray& array) : Sink(file.name()), file_(file), layout_(layout) {
        const std::string type = array.type;
        row_bytes_ = array.columns * (type == "uint8" ? 1 : type == "float32" ? 4 : 8);
        chunk_rows_ = (array.is_long ? kLongChunk : kShortChunk) / row_bytes_;
        number_ = layout.begin_rows(array.name, array.type, array.columns, chunk_rows_);
    }
    using Sink::write;
    void write(std::span<const std::byte> bytes) override {
        size_ += static_cast<std::int64_t>(bytes.size());
        while (!bytes.empty()) {
            const std::size_t part = std::min(bytes.size(), chunk_bytes() - waiting_.size());
            waiting_.insert(waiting_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(part));
            bytes = bytes.subspan(part);
            if (waiting_.size() == chunk_bytes()) put_chunk();
        }
    }
    void write_at(std::int64_t, std::span<const std::byte>) override { ISOATLAS_CHECK(false); }
    [[nodiscard]] std::int64_t size() const override { return size_; }
    void finish() {
        if (!waiting_.empty()) put_chunk();
    }

private:
    [[nodiscard]] std::size_t chunk_bytes() const { return static_cast<std::size_t>(chunk_rows_ * row_bytes_); }
    void put_chunk() {
        const std::int64_t rows = static_cast<std::int64_t>(waiting_.size()) / row_bytes_;
        waiting_.resize(chunk_bytes());  // the last one is filled up
        file_.write_at(layout_.add_rows(number_, rows), waiting_);
        waiting_.clear();
    }

    Sink& file_;
    Hdf5Layout& layout_;
    std::size_t number_ = 0;
    std::int64_t row_bytes_ = 0, chunk_rows_ = 0, size_ = 0;
    std::vector<std::byte> waiting_;
};

using Counts = std::array<std::int64_t, kVtkhdfCells.size()>;  ///< for each kind of cells

/// Where a step begins.
struct Begin {
    double value = 0;
    std::int64_t points = 0;
    Counts cells{}, connectivity{};
};

/// What all steps have in common.
struct Common {
    std::string space, unit;
    bool has_normals, has_object, has_contour, is_curves;
    Interpolant interpolant;
    double tunnel_height;
    Polarity polarity;
    bool operator==(const Common&) const = default;
};

Common common_of(const MeshParts& parts) {
    const Connectivity connectivity = connectivity_of(parts);
    return {parts.space,          parts.unit,        parts.has_normals,        parts.has_object,
            parts.has_contour,    parts.is_curves(), connectivity.interpolant, connectivity.tunnel_height,
            connectivity.polarity};
}

}  // namespace

struct EvolutionFile::Data {
    Data(const std::string& path, const SurfaceFileOptions& given) : file(path), layout(path, 0), options(given) {}

    AtomicFile file;
    Hdf5Layout layout;
    SurfaceFileOptions options;
    std::optional<Common> common{};
    std::vector<std::string> point_data{};
    std::vector<std::unique_ptr<Rows>> rows{};
    VtkhdfFields fields{};  ///< `Tau` has one value a step
    std::vector<Begin> begins{};
    Begin end{};

    void begin(const MeshParts& parts, const std::vector<VtkhdfArray>& arrays);
    void place(const std::string& name, const char* type, std::int64_t columns, const std::function<void(ByteWriter&, const Begin&)>& put);
    void place_field(const std::string& name, std::int64_t step);
    void place_steps();
};

EvolutionFile::EvolutionFile(const std::string& path, const SurfaceFileOptions& options) {
    (void)known_extension(path, {".vtkhdf"}, {"the format of the steps", "format of several steps", ".vtkhdf"});
    data_ = std::make_unique<Data>(path, options);
}

EvolutionFile::~EvolutionFile() = default;

std::int64_t EvolutionFile::steps() const { return static_cast<std::int64_t>(data_->begins.size()); }

void EvolutionFile::Data::begin(const MeshParts& parts, const std::vector<VtkhdfArray>& arrays) {
    common = common_of(parts);
    fields = vtkhdf_fields(parts);
    fields.numbers.front().second.clear();
    set_attributes(layout, parts);
    const std::string group = "/VTKHDF/PointData/";
    for (const VtkhdfArray& array : arrays) {
        rows.push_back(std::make_unique<Rows>(file, layout, array));
        if (array.name.starts_with(group)) point_data.push_back(array.name.substr(group.size()));
    }
}

void EvolutionFile::add(const Surface& surface) {
    const std::string& path = data_->file.name();
    const MeshParts parts = mesh_parts(surface, data_->options, path);
    if (parts.triangles == 0 && parts.segments == 0) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the surface at " + number_text(surface.reported_tau) + " is empty, and a step must not be",
                                       .next = "leave this isovalue out"});
    }
    if (!data_->begins.empty() && !(surface.reported_tau > data_->begins.back().value)) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "a step at " + number_text(surface.reported_tau) + " follows one at " +
                                               number_text(data_->begins.back().value),
                                       .expected = "isovalues that ascend",
                                       .next = "sort them, and leave out what is there twice"});
    }
    const std::vector<VtkhdfArray> arrays = vtkhdf_arrays(parts, Real::f64);
    if (!data_->common) data_->begin(parts, arrays);
    if (common_of(parts) != *data_->common) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the surface at " + number_text(surface.reported_tau) + " is not like the first one",
                                       .expected = "the same space, unit, interpolant, polarity and arrays",
                                       .next = "write the surfaces of each volume into a file of their own"});
    }
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        ByteWriter out(*data_->rows[i]);
        arrays[i].put(out);
        out.finish();
    }
    Begin& end = data_->end;
    end.value = surface.reported_tau;
    data_->begins.push_back(end);
    data_->fields.numbers.front().second.push_back(surface.reported_tau);
    end.points += parts.points;
    end.cells[kVtkhdfLines] += parts.segments, end.connectivity[kVtkhdfLines] += 2 * parts.segments;
    end.cells[kVtkhdfPolygons] += parts.triangles, end.connectivity[kVtkhdfPolygons] += 3 * parts.triangles;
}

/// An array of the group Steps, with a row for each step.
void EvolutionFile::Data::place(const std::string& name, const char* type, std::int64_t columns,
                                const std::function<void(ByteWriter&, const Begin&)>& put) {
    std::vector<std::int64_t> shape{static_cast<std::int64_t>(begins.size())};
    if (columns > 1) shape.push_back(columns);
    place_array(file, layout, "/VTKHDF/Steps/" + name, type, shape, [&](ByteWriter& out) {
        for (const Begin& step : begins) put(out, step);
    });
}

/// step: by how many values each step is behind the one before.
void EvolutionFile::Data::place_field(const std::string& name, std::int64_t step) {
    place("FieldDataOffsets/" + name, "int64", 1, [&](ByteWriter& out, const Begin& one) { out.put(step * (&one - begins.data())); });
    place("FieldDataSizes/" + name, "int64", 2, [](ByteWriter& out, const Begin&) { out.put(std::array<std::int64_t, 2>{1, 1}); });
}

void EvolutionFile::Data::place_steps() {
    const std::array<std::int64_t, 1> count{static_cast<std::int64_t>(begins.size())};
    layout.set_attribute("/VTKHDF/Steps", "NSteps", count);
    place("Values", "float64", 1, [](ByteWriter& out, const Begin& step) { out.put(step.value); });
    place("PartOffsets", "int64", 1,
          [&](ByteWriter& out, const Begin& step) { out.put(static_cast<std::int64_t>(&step - begins.data())); });
    place("NumberOfParts", "int64", 1, [](ByteWriter& out, const Begin&) { out.put(std::int64_t{1}); });
    const auto put_points = [](ByteWriter& out, const Begin& step) { out.put(step.points); };
    place("PointOffsets", "int64", 1, put_points);
    place("CellOffsets", "int64", kVtkhdfCells.size(), [](ByteWriter& out, const Begin& step) { out.put(step.cells); });
    place("ConnectivityIdOffsets", "int64", kVtkhdfCells.size(), [](ByteWriter& out, const Begin& step) { out.put(step.connectivity); });
    for (const std::string& name : point_data) place("PointDataOffsets/" + name, "int64", 1, put_points);
    for (const auto& [name, numbers] : fields.numbers) place_field(name, name == "Tau" ? 1 : 0);
}

void EvolutionFile::commit() {
    if (data_->begins.empty())
        throw Error(ErrorKind::usage,
                    {.file = data_->file.name(), .what = "there is no step to write", .next = "give at least one isovalue"});
    for (const std::unique_ptr<Rows>& rows : data_->rows) rows->finish();
    data_->place_steps();
    place_fields(data_->file, data_->layout, data_->fields);
    finish_vtkhdf(data_->file, data_->layout);
    data_->file.commit();
}

}  // namespace isoatlas
