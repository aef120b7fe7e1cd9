// HDF5 writes into a virtual file that records the written pieces: it never fails, so HDF5 never sees a full disk (after which its cleanup
// would crash), and its structures are written by the same calls as the arrays.
#include "store/hdf5_layout.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "codec/chunk_codec.h"
#include "isoatlas/error.h"
#include "store/container.h"

namespace isoatlas {
namespace {

using Piece = Hdf5Layout::Piece;

/// The pieces written by HDF5.
struct Memory {
    std::vector<Piece> pieces;
    haddr_t end_of_allocation = 0;  ///< address of the next allocation of HDF5
    haddr_t end_of_file = 0;        ///< end of the written bytes
    haddr_t last_chunk = 0;         ///< address of the last write of array bytes

    void write(haddr_t offset, std::span<const std::byte> bytes) {
        pieces.push_back({static_cast<std::int64_t>(offset), {bytes.begin(), bytes.end()}});
        end_of_file = std::max<haddr_t>(end_of_file, offset + bytes.size());
    }
    void read(haddr_t offset, std::span<std::byte> out) const {
        std::fill(out.begin(), out.end(), std::byte{0});
        const auto begin = static_cast<std::int64_t>(offset), end = begin + static_cast<std::int64_t>(out.size());
        for (const Piece& piece : pieces) {
            const std::int64_t from = std::max(begin, piece.offset);
            const std::int64_t to = std::min(end, piece.offset + static_cast<std::int64_t>(piece.bytes.size()));
            if (from < to)
                std::memcpy(out.data() + (from - begin), piece.bytes.data() + (from - piece.offset), static_cast<std::size_t>(to - from));
        }
    }
};

/// HDF5's handle of it. HDF5 uses the first member only.
struct DriverFile {
    H5FD_t base{};
    Memory* memory = nullptr;
};

Memory& memory_of(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file)->memory; }

/// A virtual file driver that records writes in a Memory, its argument.
struct Driver {
    static H5FD_t* open(const char*, unsigned, hid_t access, haddr_t) {
        auto* file = new (std::nothrow) DriverFile;
        if (file != nullptr) file->memory = *static_cast<Memory* const*>(H5Pget_driver_info(access));
        return reinterpret_cast<H5FD_t*>(file);
    }
    static herr_t close(H5FD_t* file) {
        delete reinterpret_cast<DriverFile*>(file);
        return 0;
    }
    static herr_t query(const H5FD_t*, unsigned long* flags) {  // allocation callbacks are those of ordinary files
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA |
                 H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
        return 0;
    }
    static haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return memory_of(file).end_of_allocation; }
    static herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t end) {
        memory_of(file).end_of_allocation = end;
        return 0;
    }
    static haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return memory_of(file).end_of_file; }
    static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* out) {
        memory_of(file).read(offset, {static_cast<std::byte*>(out), size});
        return 0;
    }
    static herr_t write(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t offset, std::size_t size, const void* bytes) try {
        if (kind == H5FD_MEM_DRAW) {  // only the position of arrays is recorded
            memory_of(file).last_chunk = offset;
            memory_of(file).end_of_file = std::max<haddr_t>(memory_of(file).end_of_file, offset + size);
            return 0;
        }
        memory_of(file).write(offset, {static_cast<const std::byte*>(bytes), size});
        return 0;
    } catch (const std::bad_alloc&) {
        return -1;
    }
    static herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
        memory_of(file).end_of_file = memory_of(file).end_of_allocation;
        return 0;
    }

    static hid_t id() {
        static const H5FD_class_t functions = [] {
            H5FD_class_t f{};
            f.name = "isoatlas memory";
            f.maxaddr = HADDR_MAX;
            f.fc_degree = H5F_CLOSE_WEAK;
            f.fapl_size = sizeof(Memory*);
            f.open = open;
            f.close = close;
            f.query = query;
            f.get_eoa = get_eoa;
            f.set_eoa = set_eoa;
            f.get_eof = get_eof;
            f.read = read;
            f.write = write;
            f.truncate = truncate;
            constexpr H5FD_mem_t kMap[] = H5FD_FLMAP_DICHOTOMY;
            std::copy(std::begin(kMap), std::end(kMap), f.fl_map);
            return f;
        }();
        static const hid_t id = H5FDregister(&functions);
        return id;
    }
};

/// RAII for an HDF5 identifier.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): implicit conversion to the number

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

hid_t hdf5_type(std::string_view type) {
    if (type == "uint8") return H5T_STD_U8LE;
    if (type == "int8") return H5T_STD_I8LE;
    if (type == "uint16") return H5T_STD_U16LE;
    if (type == "int16") return H5T_STD_I16LE;
    if (type == "uint32") return H5T_STD_U32LE;
    if (type == "int32") return H5T_STD_I32LE;
    if (type == "uint64") return H5T_STD_U64LE;
    if (type == "int64") return H5T_STD_I64LE;
    if (type == "float32") return H5T_IEEE_F32LE;
    ISOATLAS_CHECK(type == "float64");
    return H5T_IEEE_F64LE;
}

hid_t create(Memory& memory) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_userblock(creation, static_cast<hsize_t>(kHeaderBytes));
    H5Pset_obj_track_times(creation, 0);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);  // its structures have checksums
    Memory* const argument = &memory;
    H5Pset_driver(access, Driver::id(), static_cast<const void*>(&argument));
    return H5Fcreate("store", H5F_ACC_TRUNC, creation, access);
}

/// HDF5 does not always check allocations: ensures the memory of an empty file. Throws std::bad_alloc.
void require_room() {
    constexpr std::size_t kTaken = std::size_t{4} << 20;
    std::byte* volatile room = new std::byte[kTaken];  // volatile: else the compiler removes both lines
    delete[] room;
}

/// HDF5 is not thread safe.
std::mutex& hdf5_mutex() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

struct Hdf5Layout::Data {
    std::string path;
    Memory memory;
    hid_t file = -1;
    hid_t chunked = -1;  ///< the array of the next chunks
    hsize_t next_chunk = 0, chunk = 0;
    std::vector<std::byte> blank;  ///< HDF5 requires some bytes

    void end_chunks() {
        if (chunked >= 0) H5Dclose(std::exchange(chunked, -1));
    }
    [[noreturn]] void no_memory(const std::string& what) const {
        throw Error(
            ErrorKind::resource,
            {.file = path, .what = "cannot be written: HDF5 has no room for " + what, .next = "free some memory, then build again"});
    }
    /// Groups that HDF5 creates implicitly have time stamps.
    void add_groups(const std::string& name) const {
        const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
        H5Pset_obj_track_times(creation, 0);
        for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
            const std::string group = name.substr(0, slash);
            if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
            const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
            if (made < 0) no_memory("the group " + group);
        }
    }
};

Hdf5Layout::Hdf5Layout(std::string path) : data_(std::make_unique<Data>()) {
    const std::lock_guard lock(hdf5_mutex());
    data_->path = std::move(path);
    require_room();
    data_->file = create(data_->memory);
    if (data_->file < 0) data_->no_memory("a file");
}

Hdf5Layout::~Hdf5Layout() {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    if (data_->file >= 0) H5Fclose(data_->file);
}

std::int64_t Hdf5Layout::add(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape) {
    const std::lock_guard lock(hdf5_mutex());
    const std::vector<hsize_t> dims(shape.begin(), shape.end());
    data_->end_chunks();
    const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_layout(creation, H5D_CONTIGUOUS);
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, 0);
    const Handle set(H5Dcreate2(data_->file, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    if (set < 0) data_->no_memory("the array " + name);
    const haddr_t address = H5Dget_offset(set);
    return address == HADDR_UNDEF ? 0 : static_cast<std::int64_t>(address);
}

void Hdf5Layout::begin_chunks(const std::string& name, const std::string& type, std::int64_t count, std::int64_t chunk) {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    const auto all = static_cast<hsize_t>(count);
    data_->chunk = static_cast<hsize_t>(chunk), data_->next_chunk = 0;
    const Handle space(H5Screate_simple(1, &all, nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_chunk(creation, 1, &data_->chunk);
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, kDeflateLevel);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, 0);
    data_->chunked = H5Dcreate2(data_->file, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (data_->chunked < 0) data_->no_memory("the array " + name);
}

std::int64_t Hdf5Layout::add_chunk(std::int64_t bytes) {
    const std::lock_guard lock(hdf5_mutex());
    if (static_cast<std::int64_t>(data_->blank.size()) < bytes) data_->blank.resize(static_cast<std::size_t>(bytes));
    const hsize_t first = std::exchange(data_->next_chunk, data_->next_chunk + data_->chunk);
    const herr_t done = H5Dwrite_chunk(data_->chunked, H5P_DEFAULT, 0, &first, static_cast<std::size_t>(bytes), data_->blank.data());
    if (done < 0) data_->no_memory("a chunk of an array");
    return static_cast<std::int64_t>(data_->memory.last_chunk);
}

std::int64_t Hdf5Layout::size() const { return static_cast<std::int64_t>(data_->memory.end_of_allocation); }

const std::vector<Hdf5Layout::Piece>& Hdf5Layout::finish() {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    if (H5Fclose(std::exchange(data_->file, -1)) < 0) data_->no_memory("its structures");
    return data_->memory.pieces;
}

}  // namespace isoatlas
