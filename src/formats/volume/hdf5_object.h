// Inside of Hdf5File, for those who call HDF5. The caller of every function holds hdf5_mutex().
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/volume/hdf5_driver.h"
#include "formats/volume/hdf5_file.h"

namespace isoatlas {

#if H5_VERSION_GE(1, 12, 0)
using Hdf5Info = H5O_info1_t;
#else
using Hdf5Info = H5O_info_t;
#endif

struct Hdf5File::Data {
    Hdf5Access access;
    Hdf5Handle file, links;  ///< links: properties with which they are followed

    std::set<std::pair<unsigned long, haddr_t>> sound{};  ///< objects whose headers were checked, by file and address

    /// What is damaged in the header of an object, or that there is none, so that HDF5 must not open it or its attributes; "": nothing.
    [[nodiscard]] std::string damage(const std::string& object);
    /// Follows a path, group by group, none of which may be damaged: Error{input}. false: it leads nowhere. The first group of a file was
    /// checked when that was opened (formats/volume/hdf5_driver.cpp).
    [[nodiscard]] bool find(const std::string& object, Hdf5Info& info) { return find(file, object, info); }
    /// The same in another file.
    [[nodiscard]] bool find(hid_t in, const std::string& object, Hdf5Info& info);
    [[nodiscard]] std::string damage_at(unsigned long number, haddr_t address);
    /// The error of the last call: that of a file, else what HDF5 says.
    [[noreturn]] void fail(const std::string& where, const std::string& what);
    /// Throws Error{input}, also when it is no array.
    [[nodiscard]] Hdf5Handle open_array(const std::string& path, hid_t properties = H5P_DEFAULT);
    /// Throws Error: unsupported (a filter that is not there), input (files outside the folder, samples beyond the end of the file).
    void check_storage(hid_t set, const std::string& path);
};

/// A file that one of HDF5 names, which lies beside it. Throws Error{input} when it may not be opened.
[[nodiscard]] std::string file_beside(const Hdf5Access& access, const std::string& header, const std::string& name);

[[nodiscard]] Hdf5Type hdf5_type_of(hid_t type);

/// Where the samples of an array without chunks begin in their file; HADDR_UNDEF: none was written.
[[nodiscard]] haddr_t offset_of_samples(hid_t set);

struct Hdf5Filter {
    H5Z_filter_t id;
    std::string name;  ///< as the file calls it, or empty
};
/// Of the creation properties of an array.
[[nodiscard]] std::vector<Hdf5Filter> hdf5_filters(hid_t creation);

}  // namespace isoatlas
