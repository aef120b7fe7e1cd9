// A NetCDF file to read: dimensions, variables, attributes. Two kinds have this interface: classic files, and files of HDF5.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/volume/hdf5_file.h"

namespace isoatlas {

struct NetcdfDimension {
    std::string name{};  ///< "": it has none
    std::int64_t size = 0;
    bool is_unlimited = false;
};

struct NetcdfVariable {
    std::string path{};                     ///< "/temperature"
    std::vector<std::size_t> dimensions{};  ///< numbers of dimensions, the slowest first
    Hdf5Type type{};
    [[nodiscard]] std::string name() const { return path.substr(path.rfind('/') + 1); }
};

class NetcdfFile {
public:
    virtual ~NetcdfFile() = default;
    std::string path{}, format{};
    std::vector<NetcdfDimension> dimensions{};
    std::vector<NetcdfVariable> variables{};
    std::vector<std::string> notes{};

    /// Of an attribute of a variable; empty: there is none.
    [[nodiscard]] virtual std::string text(const NetcdfVariable& variable, const std::string& attribute) const = 0;
    [[nodiscard]] virtual std::vector<double> numbers(const NetcdfVariable& variable, const std::string& attribute) const = 0;
    /// The bits of the numbers of an attribute of a variable of 64-bit integers.
    [[nodiscard]] virtual std::vector<std::uint64_t> integers(const NetcdfVariable& variable, const std::string& attribute) const = 0;
    /// All numbers of a variable of one dimension. Throws Error: input, unsupported.
    [[nodiscard]] virtual std::vector<double> line(const NetcdfVariable& variable) const = 0;
    /// Sizes, type and encoding of a variable.
    [[nodiscard]] virtual Hdf5Array array(const NetcdfVariable& variable) const = 0;
    /// Reads the samples at `place` of a variable. Throws Error: input, unsupported.
    [[nodiscard]] virtual std::unique_ptr<VolumeReader> reader(VolumeInfo info, const NetcdfVariable& variable,
                                                               const Hdf5Place& place) const = 0;
};

/// The opened file. Throws Error{input}.
[[nodiscard]] std::unique_ptr<NetcdfFile> open_classic_netcdf(const std::string& path);
/// nullptr: the file has neither marks of NetCDF nor scales of dimensions.
[[nodiscard]] std::unique_ptr<NetcdfFile> open_netcdf4(const std::shared_ptr<const Hdf5File>& file);

/// A variable of the file by the conventions of CF. Throws Error: input, unsupported, usage. nullptr: options.dataset is no variable.
[[nodiscard]] std::unique_ptr<VolumeReader> open_cf_variable(const NetcdfFile& file, const OpenOptions& options);

/// Places samples that have this value as NaN; info.type is floating.
[[nodiscard]] std::unique_ptr<VolumeReader> blank_values(std::unique_ptr<VolumeReader> reader, std::vector<double> values);

}  // namespace isoatlas
