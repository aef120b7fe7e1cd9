#include "formats/volume/hdf5_virtual.h"

#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr int kDeepestSource = 8;            // sources of sources
constexpr std::size_t kMostNumbers = 65536;  // of a series of sources

std::string name_of_file(hid_t file) {
    std::array<char, 4096> name{};
    return H5Fget_name(file, name.data(), name.size() - 1) < 0 ? std::string() : std::string(name.data());
}

/// A name with numbers for %b, as HDF5 makes it; without %b: the name, and false.
std::pair<std::string, bool> with_number(const std::string& name, std::size_t number) {
    std::string made;
    bool is_numbered = false;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char next = name[i] == '%' && i + 1 < name.size() ? name[i + 1] : '\0';
        if (next == 'b') made += std::to_string(number), is_numbered = true;
        if (next == '%') made += '%';
        if (next == 'b' || next == '%')
            ++i;
        else
            made += name[i];
    }
    return {made, is_numbered};
}

/// Walks from an array through its sources to those of its virtual sources.
class VirtualSources {
public:
    VirtualSources(Hdf5File::Data& data, std::string path) : data_(data), path_(std::move(path)) {}

    void check_all(hid_t array) {
        if (H5Oget_info2(array, &first_, H5O_INFO_BASIC) < 0) data_.fail(path_, "the array cannot be read");
        check(array, 1);
        while (!pending_.empty()) {
            const auto [next, depth] = std::move(pending_.back());
            pending_.pop_back();
            check(next, depth);
        }
    }

private:
    /// All sources of one array.
    void check(hid_t array, int depth) {
        const Hdf5Handle creation(H5Dget_create_plist(array), H5Pclose), own(H5Iget_file_id(array), H5Fclose);
        std::size_t count = 0;
        if (creation < 0 || own < 0 || H5Pget_virtual_count(creation, &count) < 0) data_.fail(path_, "the array cannot be read");
        const std::string header = name_of_file(own);
        Hdf5Handle other;  // the last file beside, as many sources in a row lie in one
        std::string name_of_other;
        for (std::size_t i = 0; i < count; ++i) {
            const std::string files = text_of(H5Pget_virtual_filename, creation, i), sets = text_of(H5Pget_virtual_dsetname, creation, i);
            for (std::size_t number = 0; number < kMostNumbers; ++number) {
                const auto [file, many_files] = with_number(files, number);
                const auto [set, many_sets] = with_number(sets, number);
                const bool is_own = file == ".";
                if (!is_own && std::exchange(name_of_other, file) != file) other = open(header, file, many_files);
                const hid_t in = is_own ? hid_t{own} : hid_t{other};
                const bool is_there = in >= 0 && check_source(in, set, creation, i, depth), is_series = many_files || many_sets;
                if (!is_there && !is_series) data_.fail(path_, "a source is not there: " + shown_name(file + ":" + set));
                if (!is_there || !is_series) break;
            }
        }
    }

    template <class Get>
    static std::string text_of(const Get& get, hid_t creation, std::size_t i) {
        std::array<char, 4096> name{};
        return get(creation, i, name.data(), name.size() - 1) <= 0 ? std::string() : std::string(name.data());
    }

    /// may_end: of a series of files, of which the first missing one is the end.
    Hdf5Handle open(const std::string& header, const std::string& name, bool may_end) {
        if (name.empty()) return {};
        const std::string file = file_beside(data_.access, header, name);
        if (may_end && !file_exists(file)) return {};
        (void)file_size(file);  // throws when it is not there: HDF5 would fill the samples in
        const Hdf5Handle properties = hdf5_access_properties(data_.access);
        Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, properties), H5Fclose);
        if (opened < 0) data_.fail(path_, "a file of its sources cannot be opened");
        return opened;
    }

    /// false: there is none of that name.
    bool check_source(hid_t file, const std::string& name, hid_t creation, std::size_t i, int depth) {
        Hdf5Info info{};
        if (name.empty() || !data_.find(file, name, info) || info.type != H5O_TYPE_DATASET) return false;
        if (info.fileno == first_.fileno && info.addr == first_.addr) data_.fail(path_, "its samples come from itself, in a circle");
        if (const std::string damage = data_.damage_at(info.fileno, info.addr); !damage.empty()) data_.fail(path_, "a source: " + damage);
        Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
        if (set < 0) data_.fail(path_, "a source cannot be opened");
        check_selection(set, creation, i);
        const Hdf5Handle own(H5Dget_create_plist(set), H5Pclose);
        if (H5Pget_layout(own) != H5D_VIRTUAL) {
            data_.check_storage(set, name);
            check_compact(set, own);
            return true;
        }
        if (depth == kDeepestSource)
            data_.fail(path_, "its samples come from virtual arrays, from others, in a circle or through more than 8");
        if (seen_.emplace(info.fileno, info.addr, depth).second) pending_.emplace_back(std::move(set), depth + 1);
        return true;
    }

    void check_selection(hid_t set, hid_t creation, std::size_t i) {
        const Hdf5Handle space(H5Dget_space(set), H5Sclose), wanted(H5Pget_virtual_srcspace(creation, i), H5Sclose);
        std::array<hsize_t, H5S_MAX_RANK> first{}, last{}, dims{};
        const int rank = H5Sget_simple_extent_ndims(space);
        if (rank < 0) data_.fail(path_, "a source cannot be opened");
        if (H5Sget_select_type(wanted) == H5S_SEL_ALL || H5Sget_select_npoints(wanted) == 0) return;
        if (rank != H5Sget_simple_extent_ndims(wanted)) data_.fail(path_, "a source has other dimensions than the array takes of it");
        if (H5Sget_select_bounds(wanted, first.data(), last.data()) < 0 || H5Sget_simple_extent_dims(space, dims.data(), nullptr) < 0)
            return;
        for (std::size_t d = 0; d < static_cast<std::size_t>(rank); ++d) {
            const bool is_bounded = last[d] < HSIZE_UNDEF - 1;  // else the source may grow
            if (is_bounded && last[d] >= dims[d]) data_.fail(path_, "a source has fewer samples than the array takes of it");
        }
    }

    void check_compact(hid_t set, hid_t creation) {
        const Hdf5Handle space(H5Dget_space(set), H5Sclose), type(H5Dget_type(set), H5Tclose);
        const double samples = static_cast<double>(H5Sget_simple_extent_npoints(space)) * static_cast<double>(H5Tget_size(type));
        if (H5Pget_layout(creation) == H5D_COMPACT && static_cast<double>(H5Dget_storage_size(set)) < samples)
            data_.fail(path_, "samples of a source are missing");
    }

    Hdf5File::Data& data_;
    std::string path_;
    Hdf5Info first_{};
    std::vector<std::pair<Hdf5Handle, int>> pending_;         ///< virtual sources, and how deep they are
    std::set<std::tuple<unsigned long, haddr_t, int>> seen_;  ///< virtual sources, by file, address and depth
};

}  // namespace

void check_sources(Hdf5File::Data& data, hid_t array, const std::string& path) { VirtualSources(data, path).check_all(array); }

}  // namespace isoatlas
