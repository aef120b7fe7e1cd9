// The HDF5 reader takes any bytes: a documented error or a sound volume, and nothing stays open.
#include <hdf5.h>

#include "formats/volume/formats.h"
#include "fuzz/volume_target.h"

/// libhdf5 forgets the headers of objects that it cannot read, some hundred bytes each (HDFGroup/hdf5, issues 4586 and 5578). What we
/// forget to close is counted instead: looking for leaks after each input (hdf5_volume.flags) takes most of the time, as it keeps free
/// lists.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }  // NOLINT(bugprone-reserved-identifier)

/// It asks for as many bytes as a damaged length says, and takes no for an answer.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }  // NOLINT(bugprone-reserved-identifier)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int kMostOpenings = 20;  // libhdf5 needs milliseconds for each
    const int result = fuzz::open_and_read(isoatlas::open_hdf5, data, size, kMostOpenings);
    fuzz::require_volume(H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_ALL) == 0);
    return result;
}
