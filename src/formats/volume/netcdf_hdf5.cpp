// NetCDF-4 files: arrays of HDF5 whose dimensions are scales of HDF5.
#include <algorithm>
#include <map>

#include "formats/volume/hdf5_conventions.h"
#include "formats/volume/netcdf_file.h"

namespace isoatlas {
namespace {

constexpr const char* kNoVariable = "This is a netCDF dimension but not a netCDF variable";
constexpr const char* kNoCoordinates = "_nc4_non_coord_";  // in front of a variable that has the name of a dimension, but other dimensions

bool is_scale(const Hdf5File& file, const std::string& path) { return file.text(path, "CLASS") == "DIMENSION_SCALE"; }

class Netcdf4File final : public NetcdfFile {
public:
    explicit Netcdf4File(std::shared_ptr<const Hdf5File> file) : file_(std::move(file)) {
        path = file_->path();
        format = file_->has_attribute("/", "_NCProperties") ? "NetCDF-4" : "HDF5";
        Hdf5Walk walk = walk_hdf5(*file_, "/");
        notes = std::move(walk.notes);
        for (const Hdf5Array& array : walk.arrays) {
            if (!is_scale(*file_, array.path)) continue;
            const std::vector<double> number = file_->numbers(array.path, "_Netcdf4Dimid");
            if (are_numbers(number, 1)) by_number_[number[0]] = dimensions.size();
            by_identity_[file_->identity(array.path)] = dimensions.size();
            dimensions.push_back({name_of_scale(array.path), array.dims.empty() ? 1 : array.dims[0], false});
        }
        for (Hdf5Array& array : walk.arrays) {
            if (file_->text(array.path, "NAME").starts_with(kNoVariable)) continue;
            NetcdfVariable variable{.path = array.path, .dimensions = dimensions_of(array), .type = array.type};
            variables.push_back(std::move(variable));
            arrays_.push_back(std::move(array));
        }
    }

    [[nodiscard]] std::string text(const NetcdfVariable& variable, const std::string& attribute) const override {
        return file_->text(variable.path, attribute);
    }
    [[nodiscard]] std::vector<double> numbers(const NetcdfVariable& variable, const std::string& attribute) const override {
        return file_->numbers(variable.path, attribute);
    }
    [[nodiscard]] std::vector<std::uint64_t> integers(const NetcdfVariable& variable, const std::string& attribute) const override {
        return file_->integers(variable.path, attribute, variable.type.wide);
    }
    [[nodiscard]] std::vector<double> line(const NetcdfVariable& variable) const override { return file_->line(variable.path); }
    [[nodiscard]] Hdf5Array array(const NetcdfVariable& variable) const override {
        return arrays_[static_cast<std::size_t>(&variable - variables.data())];
    }
    [[nodiscard]] std::unique_ptr<VolumeReader> reader(VolumeInfo info, const NetcdfVariable& variable,
                                                       const Hdf5Place& place) const override {
        return make_hdf5_reader(std::move(info), file_, array(variable), place);
    }

private:
    static std::string name_of_scale(const std::string& path) {
        const std::string name = path.substr(path.rfind('/') + 1);
        return name.starts_with(kNoCoordinates) ? name.substr(std::string(kNoCoordinates).size()) : name;
    }
    std::size_t nameless(std::int64_t size) {
        dimensions.push_back({"", size, false});
        return dimensions.size() - 1;
    }
    std::vector<std::size_t> dimensions_of(const Hdf5Array& array) {
        std::vector<std::size_t> found;
        const auto own = by_identity_.find(file_->identity(array.path));
        const std::vector<std::vector<std::string>> lists = file_->references(array.path, "DIMENSION_LIST");
        const std::vector<double> numbers = file_->numbers(array.path, "_Netcdf4Coordinates");
        for (std::size_t d = 0; d < array.dims.size(); ++d) {
            std::optional<std::size_t> dimension;
            if (own != by_identity_.end() && array.dims.size() == 1) dimension = own->second;
            if (!dimension && d < lists.size() && !lists[d].empty()) {
                const auto scale = by_identity_.find(lists[d][0]);
                if (scale != by_identity_.end()) dimension = scale->second;
            }
            if (!dimension && numbers.size() == array.dims.size()) {
                const auto scale = by_number_.find(numbers[d]);
                if (scale != by_number_.end()) dimension = scale->second;
            }
            // An unlimited dimension is longer than a variable that was not written to its end.
            if (dimension && dimensions[*dimension].size != array.dims[d]) {
                dimensions.push_back({dimensions[*dimension].name, array.dims[d], false});
                dimension = dimensions.size() - 1;
            }
            found.push_back(dimension ? *dimension : nameless(array.dims[d]));
        }
        return found;
    }

    std::shared_ptr<const Hdf5File> file_;
    std::vector<Hdf5Array> arrays_;  ///< for each of variables
    std::map<std::string, std::size_t> by_identity_;
    std::map<double, std::size_t> by_number_;
};

}  // namespace

std::unique_ptr<NetcdfFile> open_netcdf4(const std::shared_ptr<const Hdf5File>& file) {
    constexpr std::size_t kMostLooked = 1000;
    bool is_netcdf = file->has_attribute("/", "_NCProperties");
    const std::vector<std::string> names = file->names("/");
    for (std::size_t i = 0; i < std::min(names.size(), kMostLooked) && !is_netcdf; ++i) {
        const std::string path = join_path("/", names[i]);
        is_netcdf = file->kind(path) == Hdf5File::Kind::array && is_scale(*file, path);
    }
    return is_netcdf ? std::make_unique<Netcdf4File>(file) : nullptr;
}

}  // namespace isoatlas
