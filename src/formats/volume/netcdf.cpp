// NetCDF: variables by the conventions of CF. Coordinate variables place the samples, time is a choice, missing samples are marked.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/choose.h"
#include "formats/volume/formats.h"
#include "formats/volume/hdf5_conventions.h"
#include "formats/volume/netcdf_file.h"
#include "formats/volume/placed_axes.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

/// A number as short as it can be told.
std::string cf_number(double value) {
    std::array<char, 32> text{};
    const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

/// The coordinate variable of a dimension: of its name, along it alone. nullptr: none.
const NetcdfVariable* coordinates_of(const NetcdfFile& file, std::size_t dimension) {
    const std::string& name = file.dimensions[dimension].name;
    if (name.empty()) return nullptr;
    for (const NetcdfVariable& variable : file.variables) {
        const bool is_along = variable.dimensions.size() == 1 && file.dimensions[variable.dimensions[0]].name == name &&
                              file.dimensions[variable.dimensions[0]].size == file.dimensions[dimension].size;
        if (is_along && variable.type.is_number && variable.name() == name) return &variable;
    }
    return nullptr;
}

bool is_time(const NetcdfFile& file, std::size_t dimension) {
    const NetcdfVariable* axis = coordinates_of(file, dimension);
    const std::string name = lower(file.dimensions[dimension].name);
    if (axis == nullptr) return name == "time" || name == "t" || file.dimensions[dimension].is_unlimited;
    const std::string mark = lower(file.text(*axis, "axis"));
    if (!mark.empty()) return mark == "t";
    return file.text(*axis, "units").find(" since ") != std::string::npos || file.text(*axis, "standard_name") == "time" || name == "time";
}

/// Which dimensions of a variable are the volume: those with more than one sample, the slowest first.
struct CfShape {
    std::vector<std::size_t> space{};  ///< places in NetcdfVariable::dimensions
    std::optional<std::size_t> time{};
    bool has_samples = true;
    /// Time is an axis of the image where there is only one more.
    [[nodiscard]] std::vector<std::size_t> axes() const {
        std::vector<std::size_t> all = space;
        if (space.size() == 1 && time) all.push_back(*time);
        std::ranges::sort(all);
        return all;
    }
    [[nodiscard]] bool has_steps() const { return time && space.size() != 1; }
    [[nodiscard]] bool is_volume() const { return has_samples && (axes().size() == 2 || axes().size() == 3); }
};

CfShape shape_of_variable(const NetcdfFile& file, const NetcdfVariable& variable) {
    CfShape shape;
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i) {
        const std::size_t d = variable.dimensions[i];
        const std::int64_t size = file.dimensions[d].size;
        if (size < 1) shape.has_samples = false;
        if (size <= 1) continue;
        if (!shape.time && is_time(file, d))
            shape.time = i;
        else
            shape.space.push_back(i);
    }
    return shape;
}

/// Variables that say something about others: bounds of cells, coordinates of two dimensions.
std::set<std::string> helping_variables(const NetcdfFile& file) {
    std::set<std::string> names;
    for (const NetcdfVariable& variable : file.variables) {
        for (const char* attribute :
             {"bounds", "climatology", "coordinates", "cell_measures", "ancillary_variables", "grid_mapping", "formula_terms"}) {
            const std::string text = file.text(variable, attribute);
            for (const std::string_view word : split_words(text)) names.emplace(word);
        }
    }
    return names;
}

std::vector<ErrorChoice> cf_choices(const NetcdfFile& file, std::vector<const NetcdfVariable*>& chosen) {
    std::vector<ErrorChoice> choices;
    const std::set<std::string> helping = helping_variables(file);
    for (const bool with_time : {false, true}) {  // images over time and one axis only where there is nothing else
        for (const NetcdfVariable& variable : file.variables) {
            if (!variable.type.is_number || helping.contains(variable.name())) continue;
            const CfShape shape = shape_of_variable(file, variable);
            if (!shape.is_volume() || (!with_time && shape.time && !shape.has_steps())) continue;
            choices.push_back({variable.path, shape_of(file.array(variable))});
            chosen.push_back(&variable);
        }
        if (!choices.empty()) break;
    }
    return choices;
}

[[noreturn]] void no_variables(const NetcdfFile& file) {
    std::string others;
    for (const NetcdfVariable& variable : file.variables) {
        if (others.size() < 200)
            others += (others.empty() ? "" : ", ") + shown_name(variable.path) + " (" + shape_of(file.array(variable)) + ")";
    }
    throw Error(ErrorKind::unsupported,
                {.file = file.path,
                 .what = "has no variable with 2 or 3 dimensions of space" + (others.empty() ? "" : "; it has " + others),
                 .expected = "samples on a grid; cells in a list (an unstructured grid) are none",
                 .next = "resample the variable to a grid, e.g. with cdo remapbil"});
}

/// The variable that options.dataset names, with any number of dimensions; nullptr: none.
const NetcdfVariable* named_variable(const NetcdfFile& file, const std::string& dataset) {
    const std::string wanted = dataset.starts_with('/') ? dataset : "/" + dataset;
    const auto found = std::ranges::find(file.variables, wanted, &NetcdfVariable::path);
    return found == file.variables.end() ? nullptr : &*found;
}

void check_shape(const NetcdfFile& file, const NetcdfVariable& variable, const CfShape& shape) {
    if (shape.is_volume() && variable.type.is_number) return;
    std::string dimensions;
    for (const std::size_t d : variable.dimensions) {
        dimensions +=
            (dimensions.empty() ? "" : ", ") + shown_name(file.dimensions[d].name) + " " + std::to_string(file.dimensions[d].size);
    }
    throw Error(ErrorKind::unsupported, {.file = file.path,
                                         .where = shown_name(variable.path),
                                         .what = "the variable is " + std::string(variable.type.name) + " with the dimensions " +
                                                 (dimensions.empty() ? "none" : dimensions),
                                         .expected = "2 or 3 dimensions of space with more than one sample, and time",
                                         .next = "choose another variable, or take a part of it, e.g. with ncks"});
}

Hdf5Place place_variable(const NetcdfFile& file, const NetcdfVariable& variable, const CfShape& shape, VolumeInfo& info) {
    const std::vector<std::size_t> axes = shape.axes();
    const Hdf5Array array = file.array(variable);
    Hdf5Place place = place_volume(array, static_cast<int>(axes.size()), info);
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const std::size_t d = axes[axes.size() - 1 - a];
        place.dimension[a] = static_cast<int>(d);
        info.extent.size[a] = array.dims[d];
        if (!array.chunk.empty()) info.chunk[a] = std::clamp<std::int64_t>(array.chunk[d], 1, array.dims[d]);
    }
    if (shape.has_steps()) place.index[*shape.time] = info.volumes.time_step;
    return place;
}

void set_cf_axes(const NetcdfFile& file, const NetcdfVariable& variable, Hdf5Place& place, VolumeInfo& info) {
    std::array<PlacedAxis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        if (place.dimension[a] < 0) continue;
        const std::size_t d = variable.dimensions[static_cast<std::size_t>(place.dimension[a])];
        axes[a].name = file.dimensions[d].name;
        const NetcdfVariable* axis = coordinates_of(file, d);
        if (axis == nullptr) continue;
        axes[a].unit = file.text(*axis, "units");
        axes[a].places = file.line(*axis);
        const std::vector<double> factor = file.numbers(*axis, "scale_factor"), offset = file.numbers(*axis, "add_offset");
        for (double& value : axes[a].places)
            value = value * (are_numbers(factor, 1) ? factor[0] : 1) + (are_numbers(offset, 1) ? offset[0] : 0);
    }
    set_placed_axes(info, std::move(axes), place.flipped);
    std::string grid;
    const std::string named = file.text(variable, "coordinates");
    for (const std::string_view word : split_words(named)) {
        for (const NetcdfVariable& other : file.variables) {
            if (other.name() == word && other.dimensions.size() > 1) grid += (grid.empty() ? "" : ", ") + shown_name(word);
        }
    }
    if (!grid.empty()) info.notes.push_back("the grid is curvilinear (coordinates " + grid + "): the samples are placed by their indices");
}

void set_cf_times(const NetcdfFile& file, const NetcdfVariable& variable, const CfShape& shape, FileVolumes& volumes) {
    if (!shape.has_steps()) return;
    const std::size_t d = variable.dimensions[*shape.time];
    const NetcdfVariable* axis = coordinates_of(file, d);
    if (axis == nullptr) return;
    const std::vector<double> times = file.line(*axis);
    if (!are_numbers(times, static_cast<std::size_t>(file.dimensions[d].size))) return;
    volumes.times = times;
    volumes.time_unit = file.text(*axis, "units");
}

/// Values that stand for missing samples, as they are stored.
std::vector<double> cf_missing(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::vector<double> values = file.numbers(variable, "_FillValue");
    for (const double value : file.numbers(variable, "missing_value")) values.push_back(value);
    constexpr double kDefaultFill = 9.9692099683868690e+36;  // of NetCDF, for samples that were never written
    if (variable.type.value && is_floating(*variable.type.value)) values.push_back(kDefaultFill);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values;
}

/// The bits of the same of a variable of 64-bit integers.
std::vector<std::uint64_t> cf_missing_integers(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::vector<std::uint64_t> values = file.integers(variable, "_FillValue");
    for (const std::uint64_t value : file.integers(variable, "missing_value")) values.push_back(value);
    constexpr std::int64_t kDefaultFill = -9223372036854775806;  // of NetCDF, for samples that were never written
    constexpr std::uint64_t kDefaultUnsignedFill = 18446744073709551614U;
    values.push_back(variable.type.wide == WideInteger::int64 ? static_cast<std::uint64_t>(kDefaultFill) : kDefaultUnsignedFill);
    return values;
}

class BlankingReader final : public VolumeReader {
public:
    BlankingReader(std::unique_ptr<VolumeReader> inner, std::vector<double> values) : inner_(std::move(inner)), values_(std::move(values)) {
        info_ = inner_->info();
    }
    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        inner_->read(z_begin, z_end, out);
        blank(out);
    }
    void read_box(const SampleBox& box, std::span<std::byte> out) override {
        inner_->read_box(box, out);
        blank(out);
    }

private:
    static constexpr std::size_t kBlock = 1024;

    template <class T>
    static bool holds(std::span<const T, kBlock> block, T value) {
        int found = 0;  // no early exit and a known length, so that the loop is vectorised
        for (const T sample : block) found |= sample == value ? 1 : 0;
        return found != 0;
    }
    /// By blocks: few have missing samples, and all are looked at in the cache.
    template <class T>
    void blank_each(std::span<std::byte> bytes) const {
        const std::span<T> samples(reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T));
        for (std::size_t begin = 0; begin < samples.size(); begin += kBlock) {
            const std::span<T> block = samples.subspan(begin, std::min(kBlock, samples.size() - begin));
            for (const double value : values_) {
                const T missing = static_cast<T>(value);
                if (block.size() == kBlock && !holds<T>(block.template first<kBlock>(), missing)) continue;
                std::ranges::replace(block, missing, std::numeric_limits<T>::quiet_NaN());
            }
        }
    }
    void blank(std::span<std::byte> out) const {
        if (info_.type == ValueType::f32) blank_each<float>(out);
        if (info_.type == ValueType::f64) blank_each<double>(out);
    }

    std::unique_ptr<VolumeReader> inner_;
    std::vector<double> values_;
};

/// The convention of files that have no unsigned types.
void set_unsigned(const NetcdfFile& file, const NetcdfVariable& variable, Hdf5Place& place, VolumeInfo& info) {
    if (lower(file.text(variable, "_Unsigned")) != "true") return;
    if (info.type == ValueType::i8) info.type = ValueType::u8;
    if (info.type == ValueType::i16) info.type = ValueType::u16;
    if (info.type == ValueType::i32) info.type = ValueType::u32;
    if (place.wide.type == WideInteger::int64) place.wide.type = WideInteger::uint64;
}

void describe_cf(const NetcdfFile& file, const NetcdfVariable& variable, Hdf5Place& place, VolumeInfo& info) {
    set_unsigned(file, variable, place, info);
    info.value_unit = file.text(variable, "units");
    info.description = file.text(variable, "long_name");
    if (info.description.empty()) info.description = file.text(variable, "standard_name");
    const std::vector<double> factor = file.numbers(variable, "scale_factor"), offset = file.numbers(variable, "add_offset");
    if (are_numbers(factor, 1) || are_numbers(offset, 1))
        set_calibration(info, are_numbers(factor, 1) ? factor[0] : 1, are_numbers(offset, 1) ? offset[0] : 0);
}

}  // namespace

std::unique_ptr<VolumeReader> blank_values(std::unique_ptr<VolumeReader> reader, std::vector<double> values) {
    return std::make_unique<BlankingReader>(std::move(reader), std::move(values));
}

std::unique_ptr<VolumeReader> open_cf_variable(const NetcdfFile& file, const OpenOptions& options) {
    const NetcdfVariable* variable = options.dataset ? named_variable(file, *options.dataset) : nullptr;
    if (variable == nullptr) {
        std::vector<const NetcdfVariable*> chosen;
        const std::vector<ErrorChoice> choices = cf_choices(file, chosen);
        if (options.dataset && file.format.find("NetCDF classic") == std::string::npos && file.format.find("64-bit") == std::string::npos)
            return nullptr;  // perhaps another array of HDF5
        if (choices.empty()) no_variables(file);
        variable = chosen[choose_dataset(file.path, options, choices)];
    }
    const CfShape shape = shape_of_variable(file, *variable);
    check_shape(file, *variable, shape);
    VolumeInfo info;
    info.path = file.path;
    info.format = file.format;
    info.file_bytes = file_size(file.path);
    info.volumes.has_datasets = true;
    info.notes = file.notes;
    info.notes.insert(info.notes.begin(), "the variable " + shown_name(variable->path));
    info.volumes.time_steps = shape.has_steps() ? file.dimensions[variable->dimensions[*shape.time]].size : 1;
    info.volumes.time_step = choose_time_step(file.path, options, info.volumes.time_steps).index;
    Hdf5Place place = place_variable(file, *variable, shape, info);
    set_cf_axes(file, *variable, place, info);
    set_cf_times(file, *variable, shape, info.volumes);
    describe_cf(file, *variable, place, info);
    const bool is_wide = place.wide.type != WideInteger::none;
    if (is_wide) place.wide.missing = cf_missing_integers(file, *variable);
    std::vector<double> missing = is_wide ? std::vector<double>() : cf_missing(file, *variable);
    if (!is_floating(info.type)) {
        std::string list;
        for (const double value : missing) list += (list.empty() ? "" : ", ") + cf_number(value);
        if (!list.empty())
            info.notes.push_back("samples of " + list + " are missing ones (_FillValue): give the value as the no-data value");
        missing.clear();
    }
    std::unique_ptr<VolumeReader> reader = file.reader(std::move(info), *variable, place);
    return missing.empty() ? std::move(reader) : blank_values(std::move(reader), std::move(missing));
}

bool looks_like_netcdf(FirstBytes first, const std::string&) {
    constexpr std::size_t kSmallest = 8;
    if (first.size() < kSmallest || std::memcmp(first.data(), "CDF", 3) != 0) return false;
    const int version = std::to_integer<int>(first[3]);
    return version == 1 || version == 2 || version == 5;
}

std::unique_ptr<VolumeReader> open_netcdf(const std::string& path, const OpenOptions& options) {
    return open_cf_variable(*open_classic_netcdf(path), options);
}

}  // namespace isoatlas
