#include "formats/volume/hdf5_heap.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <span>

#include "formats/volume/hdf5_driver.h"
#include "formats/volume/hdf5_frame.h"

namespace isoatlas {
namespace {

constexpr const char* kPlaceTag = "isoatlas: place of a list";

/// Bytes that stand for the place of a list, told from those of other users of HDF5 in this process, such as h5py, by their tag.
Hdf5Handle place_type(std::size_t bytes) {
    Hdf5Handle type(H5Tcreate(H5T_OPAQUE, bytes), H5Tclose);
    H5Tset_tag(type, kPlaceTag);
    return type;
}

bool is_place(hid_t type) {
    char* const tag = H5Tget_tag(type);
    const bool is_own = tag != nullptr && std::strcmp(tag, kPlaceTag) == 0;
    H5free_memory(tag);
    return is_own;
}

/// Leaves what a list is in a file: its length, the address of its heap, its number there. HDF5 would follow them. Both types have one
/// size.
herr_t keep_places(hid_t from, hid_t to, H5T_cdata_t* conversion, std::size_t, std::size_t, std::size_t, void*, void*, hid_t) {
    conversion->need_bkg = H5T_BKG_NO;
    if (conversion->command == H5T_CONV_INIT) return is_place(to) ? 0 : -1;
    return conversion->command != H5T_CONV_CONV || H5Tget_size(from) == H5Tget_size(to) ? 0 : -1;
}

/// file: nullptr where HDF5 does not say it.
Hdf5Frame frame_of(hid_t attribute) {
    Hdf5Frame frame;
    const Hdf5Handle file(H5Iget_file_id(attribute), H5Fclose), creation(H5Fget_create_plist(file), H5Pclose);
    hsize_t base = 0;
    if (file < 0 || creation < 0 || H5Pget_userblock(creation, &base) < 0 ||
        H5Pget_sizes(creation, &frame.address_bytes, &frame.length_bytes) < 0)
        return frame;
    frame.base = base;
    const auto is_known = [](std::size_t bytes) { return bytes == 2 || bytes == 4 || bytes == 8; };
    if (is_known(frame.address_bytes) && is_known(frame.length_bytes)) frame.file = file_of_hdf5(file);
    return frame;
}

}  // namespace

std::vector<std::vector<std::byte>> read_hdf5_lists(hid_t attribute, std::size_t element) {
    static const bool is_registered = [] {
        const Hdf5Handle list(H5Tvlen_create(H5T_NATIVE_UCHAR), H5Tclose), place = place_type(1);
        return H5Tregister(H5T_PERS_SOFT, "isoatlas lists", list, place, keep_places) >= 0;
    }();
    std::vector<std::vector<std::byte>> lists;
    const Hdf5Frame frame = frame_of(attribute);
    const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::size_t size = 8 + frame.address_bytes;
    if (!is_registered || frame.file == nullptr || count <= 0 || H5Aget_storage_size(attribute) / size < static_cast<hsize_t>(count))
        return lists;
    const Hdf5Handle place = place_type(size);
    std::vector<std::byte> places(static_cast<std::size_t>(count) * size);
    if (H5Aread(attribute, place, places.data()) < 0) return lists;
    std::map<std::uint64_t, std::vector<std::byte>> heaps;
    for (std::size_t at = 0; at < places.size(); at += size) {
        const std::uint64_t length = hdf5_number(places, at, 4) * element, address = hdf5_number(places, at + 4, frame.address_bytes),
                            number = hdf5_number(places, at + 4 + frame.address_bytes, 4);
        std::span<const std::byte> object;
        if (length > 0 && number > 0) {
            const auto [heap, is_new] = heaps.try_emplace(address);
            if (is_new) heap->second = read_hdf5_collection(frame, address);
            object = hdf5_object(frame, heap->second, number);
        }
        object = object.size() < length ? std::span<const std::byte>{} : object.first(static_cast<std::size_t>(length));
        lists.emplace_back(object.begin(), object.end());
    }
    return lists;
}

}  // namespace isoatlas
