// Volumes: scalar samples on a regular or rectilinear grid of 2 or 3 dimensions, with the geometry that places them in space.
//
// Axis order everywhere: x fastest. Sample (x, y, z) has index x + nx*(y + ny*z), 64-bit.
// A 2D volume has rank 2 and size[2] == 1; a 3D volume that is one voxel thick keeps rank 3 (its topology is another).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/error.h"
#include "isoatlas/index3.h"
#include "isoatlas/sample_bytes.h"
#include "isoatlas/vec3.h"

namespace isoatlas {

enum class ValueType : std::uint8_t { u8, i8, u16, i16, u32, i32, f32, f64 };
[[nodiscard]] std::size_t size_of(ValueType type);
[[nodiscard]] const char* name_of(ValueType type);  ///< "uint8", "float32", ...
[[nodiscard]] bool is_floating(ValueType type);

/// The shape of a grid. Every size is at least 1; the product fits in 63 bits.
struct Extent {
    int rank = 3;  ///< 2 or 3: decides which theory applies
    Index3 size{1, 1, 1};

    [[nodiscard]] std::int64_t voxels() const { return size.product(); }
    [[nodiscard]] std::int64_t slice() const { return size[0] * size[1]; }
    [[nodiscard]] std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const { return x + size[0] * (y + size[1] * z); }
    [[nodiscard]] std::int64_t index(const Index3& voxel) const { return index(voxel[0], voxel[1], voxel[2]); }
    [[nodiscard]] Index3 voxel(std::int64_t i) const { return {i % size[0], i / size[0] % size[1], i / (size[0] * size[1])}; }
    bool operator==(const Extent&) const = default;
};

/// Where sample (0,0,0) lies and how the axes run: physical = origin + direction * (spacing .* index).
/// Rectilinear grids carry one coordinate per sample and axis instead of spacing (coordinates[a].size() == size[a], else empty).
struct Geometry {
    Vec3 spacing{1, 1, 1};  ///< positive
    Vec3 origin{0, 0, 0};
    Mat3 direction{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< column a = unit vector of axis a
    std::array<std::vector<double>, 3> coordinates{};
    std::string space = "unknown";  ///< "LPS", "RAS", "unknown", ...: what the physical axes mean
    std::string unit{};             ///< of lengths: "mm", "µm", ... (unit_name() of units.h); empty when the file does not say
    bool operator==(const Geometry&) const = default;
};
[[nodiscard]] Vec3 to_physical(const Geometry& geometry, const Vec3& voxel_position);
/// +1 when the axes form a right-handed frame in physical space, -1 for a mirrored one.
[[nodiscard]] int handedness(const Geometry& geometry);
/// Volume (rank 2: area) that the unit vectors along the axes span, 0 to 1: 1 where they are perpendicular, within 1e-6, the rounding of
/// headers.
[[nodiscard]] double skew_of(const Geometry& geometry, int rank);
/// Physical volume of the box around one sample (area in 2D), of a sheared grid that of the parallelepiped; for rectilinear grids that of
/// the given voxel.
[[nodiscard]] double voxel_measure(const Geometry& geometry, const Extent& extent, std::int64_t index);

/// mirror - value, rounded to the least double that is not less. Applied twice to a double it gives the least one that the first result
/// names: mirrored(m, a) <= b exactly when mirrored(m, b) <= a (docs/theory/9-low-values.md#numbers).
[[nodiscard]] double mirrored(double mirror, double value);

/// reported value = slope * value of the file + intercept (NIfTI scl_slope, ...). Topology is computed on stored values.
struct Calibration {
    double slope = 1;
    double intercept = 0;
    /// Samples that were negated for objects of low values (isoatlas/polarity.h): stored value = mirror - value of the file; none: the
    /// same.
    std::optional<double> mirror{};
    [[nodiscard]] bool is_linear_identity() const { return slope == 1 && intercept == 0; }
    [[nodiscard]] bool is_identity() const { return is_linear_identity() && !mirror; }
    /// The value of the file that a stored value stands for, and back.
    [[nodiscard]] double of_file(double stored) const { return mirror ? mirrored(*mirror, stored) : stored; }
    [[nodiscard]] double of_samples(double value) const { return mirror ? mirrored(*mirror, value) : value; }
    [[nodiscard]] double reported(double stored) const {
        return is_linear_identity() ? of_file(stored) : slope * of_file(stored) + intercept;
    }
    [[nodiscard]] double stored(double reported) const {
        return of_samples(is_linear_identity() ? reported : (reported - intercept) / slope);
    }
    /// Two ends of an interval of stored values, ascending again.
    [[nodiscard]] std::array<double, 2> reported_interval(double low, double high) const {
        if (mirror) std::swap(low, high);
        return {reported(low), reported(high)};
    }
    /// Of the difference of two stored values, such as the height of a tunnel.
    [[nodiscard]] double reported_difference(double stored) const { return (slope < 0 ? -slope : slope) * stored; }
    bool operator==(const Calibration&) const = default;
};

/// Samples [begin, end) of each axis. 2D: begin[2] = 0, end[2] = 1.
struct SampleBox {
    Index3 begin, end;
    [[nodiscard]] Index3 size() const { return end - begin; }
    bool operator==(const SampleBox&) const = default;
};
/// Whether a box has samples and lies in the extent.
[[nodiscard]] bool is_inside(const SampleBox& box, const Extent& extent);
/// Where the samples of a box lie in space. The caller guarantees is_inside().
[[nodiscard]] Geometry geometry_of(const Geometry& whole, const SampleBox& box);

/// Channels, time steps and resolution levels of a file, and which of them a volume is.
struct FileVolumes {
    std::vector<std::string> channels;  ///< their names, "" where the file gives none; empty: one channel without a name
    std::int64_t channel = 0;
    std::int64_t time_steps = 1;
    std::int64_t time_step = 0;
    std::vector<double> times;  ///< of the time steps, in time_unit; empty: the file does not say
    std::string time_unit;
    std::vector<Index3> levels;  ///< their sizes, the finest first; empty: one level
    std::int64_t level = 0;
    bool has_datasets = false;  ///< a file of many arrays: OpenOptions::dataset
    bool has_series = false;    ///< OpenOptions::series
    bool operator==(const FileVolumes&) const = default;
};

/// Description of a volume file, from its header alone.
struct VolumeInfo {
    std::string path;       ///< as the user gave it
    std::string format;     ///< "NRRD", "NIfTI-1", "RAW", ...
    std::string encoding;   ///< "raw", "gzip", "zlib", "ascii", "base64", "TIFF", ...
    std::string data_file;  ///< where the samples are, if not in path
    ValueType type = ValueType::u8;
    bool big_endian = false;
    Extent extent;
    Geometry geometry;
    Calibration calibration;
    std::string value_unit;          ///< of sample values, if the file says
    std::string description;         ///< free text of the file, if any
    double gaussian = 0;             ///< sigma of the filter that made the samples (filter.h), in the unit of the spacing; 0: none
    bool slab_readable = false;      ///< any slab is read without reading what precedes it
    Index3 chunk{0, 0, 0};           ///< the samples lie in chunks of this size, each read as a whole; zeros: in slices
    FileVolumes volumes;             ///< what else the file holds
    std::int64_t file_bytes = 0;     ///< size of the file(s) on disk
    std::vector<std::string> notes;  ///< what the reader chose or ignored, for the user
};

struct OpenOptions;

/// A volume file being read slab by slab. Not thread safe. The samples come out in host byte order, bit-exact.
class VolumeReader {
public:
    virtual ~VolumeReader() = default;
    [[nodiscard]] const VolumeInfo& info() const { return info_; }
    /// Reads the slices [z_begin, z_end) of the last axis (for rank 2: rows are not split, use [0, 1)).
    /// out.size() == slices * slice() * size_of(type). Compressed files are cheap to read forwards only: going back restarts.
    /// Behind the last slice a compressed stream is read on to its end, where its checksum is.
    /// Throws Error{input} when the file ends early or is corrupt. Cost: O(slab) time and memory.
    virtual void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) = 0;
    /// Reads the samples of a box, x fastest; out.size() == box.size().product() * size_of(type). is_inside(box, info().extent).
    /// Throws as read(). Cost: the slices or chunks that the box meets, and memory for one slice, or one chunk.
    virtual void read_box(const SampleBox& box, std::span<std::byte> out);

protected:
    VolumeInfo info_;

private:
    friend std::unique_ptr<VolumeReader> open_volume(const std::string& path, const OpenOptions& options);  // corrects info_
};

/// Assumptions about RAW files; contradictions of the first four with a header are errors. Unset: read from a JSON sidecar
/// (foo.raw.json or foo.json) or parsed from the name (foo_512x512x512_float32.raw). Also what is allowed in files of any format.
struct OpenOptions {
    std::optional<std::vector<std::int64_t>> dims;  ///< x y [z]
    std::optional<ValueType> type;
    std::optional<bool> big_endian;
    std::optional<std::int64_t> skip_bytes;
    /// Instead of what any header or sidecar says, with a note for each change (correct() of units.h).
    std::optional<Vec3> spacing, origin;
    std::optional<std::string> unit, value_unit;
    bool skip_rest = false;     ///< bytes behind the samples are left out, with a note; unset: they are Error{input}
    bool follow_links = false;  ///< a header may name files outside its folder (absolute paths, "..", links); unset: Error{input}
    // Which volume of a file that holds several. Unset: such a file is an error that names the option and lists what is there
    // (ErrorText::choices).
    std::optional<std::int64_t> time_step;  ///< from 0
    std::optional<std::string> channel;     ///< its name, or its number from 0
    std::optional<std::string> series;      ///< of a DICOM folder, or image of an OME-TIFF: its identifier or name, or its number from 0
    std::optional<std::int64_t> level;      ///< of a resolution pyramid, 0 (or unset) the finest
    /// The path of an array inside a file of many, "/group/array"; as well FILE:/group/array as the path of the file.
    std::optional<std::string> dataset;
    std::optional<SampleBox> box;  ///< these samples alone, where they lie in space; nothing else is read, as far as the format allows
};

/// Chooses the reader by content and name. Allocates nothing in proportion to what a header claims.
/// Throws Error: input (missing, truncated, contradictory), unsupported (complex, 64-bit integers, ...), usage (several volumes and no
/// choice).
[[nodiscard]] std::unique_ptr<VolumeReader> open_volume(const std::string& path, const OpenOptions& options = {});
/// The samples of a box of a volume, as a volume. Throws Error{usage} when the box is empty or exceeds it.
[[nodiscard]] std::unique_ptr<VolumeReader> box_reader(std::unique_ptr<VolumeReader> whole, const SampleBox& box);

/// Policy for NaN and infinite samples (and, if given, a no-data value).
struct MissingPolicy {
    enum class Action : std::uint8_t { error, replace, below, above } action = Action::error;
    double value = 0;               ///< for replace
    std::optional<double> no_data;  ///< samples equal to this count as missing too
};

/// A volume in memory: samples of info.type in host byte order.
class Volume {
public:
    VolumeInfo info;
    SampleBytes bytes;  ///< the volume's own, or borrowed

    template <class T>
    [[nodiscard]] std::span<const T> samples() const {
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    template <class T>
    [[nodiscard]] std::span<T> samples() {
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    [[nodiscard]] double value(std::int64_t index) const;  ///< stored value, exact
    [[nodiscard]] double reported(std::int64_t index) const { return info.calibration.reported(value(index)); }
};

/// Calls function(T{}) with a value of the sample type.
template <class Function>
decltype(auto) visit_type(ValueType type, Function&& function) {
    switch (type) {
        case ValueType::u8: return function(std::uint8_t{});
        case ValueType::i8: return function(std::int8_t{});
        case ValueType::u16: return function(std::uint16_t{});
        case ValueType::i16: return function(std::int16_t{});
        case ValueType::u32: return function(std::uint32_t{});
        case ValueType::i32: return function(std::int32_t{});
        case ValueType::f32: return function(float{});
        case ValueType::f64: break;
    }
    return function(double{});
}

/// Calls function(std::span<const T>) with the samples of the volume.
template <class Function>
decltype(auto) visit_samples(const Volume& volume, Function&& function) {
    return visit_type(volume.info.type, [&]<class T>(T) -> decltype(auto) { return function(volume.samples<T>()); });
}

/// Reads everything, applies the policy for missing values, and makes superlevel sets mean what the user sees:
/// a negative calibration slope is applied to the samples (they become f64) and noted.
/// Throws Error{input} that names the first NaN or infinite voxel under Action::error. Cost: O(volume).
[[nodiscard]] Volume load_volume(VolumeReader& reader, const MissingPolicy& missing = {}, const Context& context = {});
[[nodiscard]] Volume load_volume(const std::string& path, const OpenOptions& options = {}, const MissingPolicy& missing = {},
                                 const Context& context = {});
/// The same policy for a volume that is in memory: what load_volume() does to the samples of a file, the calibration included. Borrowed
/// samples are copied if one is missing, or the calibration changes them. Throws Error as load_volume(). Cost: O(volume) time.
void replace_missing(Volume& volume, const MissingPolicy& missing = {}, const Context& context = {});
/// A reader of samples that come from elsewhere: an array of another program, a file in pieces. read(z_begin, z_end, out) is called from
/// one thread as VolumeReader::read() is, in any order and more than once, and fills `out` with samples of info.type in host byte order.
/// Throws Error{usage} for an info whose sizes are below 1.
[[nodiscard]] std::unique_ptr<VolumeReader> slab_reader(
    VolumeInfo info, std::function<void(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out)> read);

/// An empty (zero-filled) volume of a type. Throws Error{usage} for sizes below 1 or a product that does not fit.
[[nodiscard]] Volume make_volume(const Extent& extent, ValueType type, const Geometry& geometry = {});
/// A volume of samples that stay where they are (x fastest, host byte order, aligned for their type): nothing is copied, and nothing is
/// written to them (SampleBytes). owner: keeps them alive as long as the volume and its copies live. Throws Error{usage} as make_volume(),
/// when the number of bytes does not match, or they are not aligned.
[[nodiscard]] Volume borrow_volume(const Extent& extent, ValueType type, std::span<const std::byte> samples,
                                   std::shared_ptr<const void> owner, const Geometry& geometry = {});

template <class T>
inline constexpr ValueType value_type_of = ValueType::u8;
template <>
inline constexpr ValueType value_type_of<std::int8_t> = ValueType::i8;
template <>
inline constexpr ValueType value_type_of<std::uint16_t> = ValueType::u16;
template <>
inline constexpr ValueType value_type_of<std::int16_t> = ValueType::i16;
template <>
inline constexpr ValueType value_type_of<std::uint32_t> = ValueType::u32;
template <>
inline constexpr ValueType value_type_of<std::int32_t> = ValueType::i32;
template <>
inline constexpr ValueType value_type_of<float> = ValueType::f32;
template <>
inline constexpr ValueType value_type_of<double> = ValueType::f64;

/// A volume from samples that are already there (x fastest). Throws Error{usage} when the count does not match.
template <class T>
[[nodiscard]] Volume make_volume(const Extent& extent, std::span<const T> samples, const Geometry& geometry = {}) {
    Volume volume = make_volume(extent, value_type_of<T>, geometry);
    if (static_cast<std::int64_t>(samples.size()) != extent.voxels()) {
        throw Error(ErrorKind::usage, {.what = "the number of samples does not match the extent"});
    }
    std::copy(samples.begin(), samples.end(), volume.samples<T>().begin());
    return volume;
}

}  // namespace isoatlas
