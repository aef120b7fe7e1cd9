#include "formats/volume/hdf5_driver.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "formats/common/file_access.h"
#include "formats/common/own_folder.h"
#include "formats/volume/hdf5_check.h"

namespace isoatlas {
namespace {

/// HDF5 uses the first member only.
struct OpenHdf5File {
    H5FD_t base{};
    Hdf5Access* access = nullptr;
    std::string name{};
    bool is_listed = false;  ///< in access->names: HDF5 numbers it after open()
    std::unique_ptr<File> file{};
    haddr_t end_of_allocation = 0;
};

/// HDF5 takes as much memory for the header of the first group as that says.
void require_sound_root(File& file, const std::string& name) {
    const std::optional<Hdf5Frame> frame = hdf5_frame_of(file);
    const std::string damage = frame ? damage_of_hdf5_header(*frame, frame->root) : std::string();
    if (damage.empty()) return;
    throw Error(ErrorKind::input, {.file = name, .where = "/", .what = damage, .next = "the file is damaged or cut off: get it again"});
}

/// A virtual file driver that reads alone. No exception may pass through HDF5: it is kept.
struct ReadingDriver {
    static OpenHdf5File& of(H5FD_t* file) { return *reinterpret_cast<OpenHdf5File*>(file); }
    static const OpenHdf5File& of(const H5FD_t* file) { return *reinterpret_cast<const OpenHdf5File*>(file); }

    /// Files that links lead to are opened with a copy of the properties.
    static void* get_info(H5FD_t* file) { return copy_info(static_cast<const void*>(&of(file).access)); }
    static void* copy_info(const void* info) {
        void* copy = std::malloc(sizeof(Hdf5Access*));
        if (copy != nullptr) std::memcpy(copy, info, sizeof(Hdf5Access*));
        return copy;
    }
    static herr_t free_info(void* info) {
        std::free(info);
        return 0;
    }
    static H5FD_t* open(const char* name, unsigned flags, hid_t properties, haddr_t) {
        const auto* info = static_cast<Hdf5Access* const*>(H5Pget_driver_info(properties));
        if (info == nullptr || (flags & H5F_ACC_RDWR) != 0) return nullptr;
        Hdf5Access& access = **info;
        try {
            auto opened = std::make_unique<OpenHdf5File>();
            opened->access = &access;
            opened->name = name;
            const bool is_linked = std::exchange(access.is_main_open, true);
            if (is_linked && !access.follow_links) require_own_folder(access.path, name);
            try {
                opened->file = open_file(name);
            } catch (const Error& error) {
                access.missing = error;
                return nullptr;
            }
            require_sound_root(*opened->file, name);
            return reinterpret_cast<H5FD_t*>(opened.release());
        } catch (const Error& error) {
            if (!access.failure && !access.missing) access.failure = error;  // HDF5 looks in other folders for what it misses
        } catch (const std::bad_alloc&) {
        }
        return nullptr;
    }
    static herr_t close(H5FD_t* file) {
        delete reinterpret_cast<OpenHdf5File*>(file);
        return 0;
    }
    static int compare(const H5FD_t* a, const H5FD_t* b) {
        if (of(a).access != of(b).access) return of(a).access < of(b).access ? -1 : 1;
        return of(a).name.compare(of(b).name);
    }
    static herr_t query(const H5FD_t*, unsigned long* flags) {
        // Not H5FD_FEAT_ACCUMULATE_METADATA: after a read that fails, libhdf5 1.10 copies from the buffer that it did not get.
        *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
        return 0;
    }
    static haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_allocation; }
    static herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t end) {
        of(file).end_of_allocation = end;
        return 0;
    }
    static haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return static_cast<haddr_t>(of(file).file->size()); }
    static herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
        *handle = of(file).file.get();
        return 0;
    }
    static herr_t read(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t offset, std::size_t size, void* out) {
        OpenHdf5File& opened = of(file);
        if (opened.access->noted != nullptr && kind == H5FD_MEM_DRAW) {
            *opened.access->noted = {opened.file.get(), offset, size};
            return 0;
        }
        try {
            if (!std::exchange(opened.is_listed, true)) opened.access->names.insert_or_assign(opened.base.fileno, opened.name);
            if (offset <= static_cast<haddr_t>(opened.file->size())) {
                read_fully(*opened.file, opened.name, static_cast<std::int64_t>(offset), {static_cast<std::byte*>(out), size});
                return 0;
            }
        } catch (const Error& error) {
            if (!opened.access->failure) opened.access->failure = error;
        } catch (const std::bad_alloc&) {
        }
        return -1;
    }
    static herr_t write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) { return -1; }

    static hid_t id() {
        static const H5FD_class_t functions = [] {
            H5FD_class_t f{};
            f.name = "isoatlas reading";
            f.maxaddr = HADDR_MAX;
            f.fc_degree = H5F_CLOSE_WEAK;  // that of files which links lead to, one of which may be this
            f.fapl_size = sizeof(Hdf5Access*);
            f.fapl_get = get_info;
            f.fapl_copy = copy_info;
            f.fapl_free = free_info;
            f.open = open;
            f.close = close;
            f.cmp = compare;
            f.query = query;
            f.get_eoa = get_eoa;
            f.set_eoa = set_eoa;
            f.get_eof = get_eof;
            f.get_handle = get_handle;
            f.read = read;
            f.write = write;
            constexpr H5FD_mem_t kMap[] = H5FD_FLMAP_DICHOTOMY;
            std::copy(std::begin(kMap), std::end(kMap), f.fl_map);
            return f;
        }();
        static const hid_t id = H5FDregister(&functions);
        return id;
    }
};

}  // namespace

Hdf5Handle hdf5_access_properties(Hdf5Access& access) {
    Hdf5Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    Hdf5Access* const argument = &access;
    H5Pset_driver(properties, ReadingDriver::id(), static_cast<const void*>(&argument));
    return properties;
}

File* file_of_hdf5(hid_t file) {
    void* handle = nullptr;
    return H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0 ? nullptr : static_cast<File*>(handle);
}

}  // namespace isoatlas
