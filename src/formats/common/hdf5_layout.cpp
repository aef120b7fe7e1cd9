// HDF5 writes into a virtual file that records the written pieces: it never fails, so HDF5 never sees a full disk (after which its cleanup
// would crash), and its structures are written by the same calls as the arrays.
#include "formats/common/hdf5_layout.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "formats/common/hdf5_handle.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using Piece = Hdf5Layout::Piece;

/// The pieces written by HDF5.
struct Memory {
    std::vector<Piece> pieces;
    haddr_t end_of_allocation = 0;  ///< address of the next allocation of HDF5
    haddr_t end_of_file = 0;        ///< end of the written bytes
    const void* blank = nullptr;    ///< what HDF5 is given for the bytes of a chunk
    haddr_t last_chunk = 0;         ///< address of its last write

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
        if (kind == H5FD_MEM_DRAW && bytes == memory_of(file).blank) {  // of chunks only the position is recorded
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

/// Of several values; of one a scalar.
Hdf5Handle line_of(std::size_t values) {
    const hsize_t count = values;
    return {count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose};
}

/// Of `size` bytes each.
Hdf5Handle text_type(std::string_view text, std::size_t size) {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, size);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const bool is_ascii = std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (!is_ascii) H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

hid_t create(Memory& memory, std::int64_t user_block) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_userblock(creation, static_cast<hsize_t>(user_block));
    H5Pset_obj_track_times(creation, 0);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);  // its structures have checksums
    Memory* const argument = &memory;
    H5Pset_driver(access, Driver::id(), static_cast<const void*>(&argument));
    return H5Fcreate("layout", H5F_ACC_TRUNC, creation, access);
}

/// HDF5 does not always check allocations: ensures the memory of an empty file. Throws std::bad_alloc.
void require_room() {
    constexpr std::size_t kTaken = std::size_t{4} << 20;
    std::byte* volatile room = new std::byte[kTaken];  // volatile: else the compiler removes both lines
    delete[] room;
}

}  // namespace

struct Hdf5Layout::Data {
    std::string path;
    Memory memory;
    hid_t file = -1;
    hid_t chunked = -1;  ///< the array of the next chunks
    std::int64_t next_chunk = 0;
    std::vector<std::int64_t> shape, chunk;  ///< of it
    std::vector<std::byte> blank;            ///< HDF5 requires some bytes
    struct Rows {
        std::string name;
        hid_t set;
        hsize_t columns, chunk_rows, rows;
        std::size_t chunk_bytes;
    };
    std::vector<Rows> growing;

    void end_chunks() {
        if (chunked >= 0) H5Dclose(std::exchange(chunked, -1));
    }
    void end_rows() {
        for (Rows& rows : growing) {
            if (rows.set >= 0) H5Dclose(std::exchange(rows.set, -1));
        }
    }
    /// Offset of a chunk that begins at `first`.
    std::int64_t allocate(hid_t set, const std::string& name, const hsize_t* first, std::size_t bytes) {
        if (blank.size() < bytes) blank.resize(bytes);
        memory.blank = blank.data();
        if (H5Dwrite_chunk(set, H5P_DEFAULT, 0, first, bytes, blank.data()) < 0) no_memory("a chunk of " + name);
        return static_cast<std::int64_t>(memory.last_chunk);
    }
    [[noreturn]] void no_memory(const std::string& what) const {
        throw Error(
            ErrorKind::resource,
            {.file = path, .what = "cannot be written: HDF5 has no room for " + what, .next = "free some memory, then write it again"});
    }
    /// Groups that HDF5 creates implicitly have time stamps.
    void add_groups(const std::string& name) const {
        const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
        H5Pset_obj_track_times(creation, 0);
        for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1)) {
            const std::string group = name.substr(0, slash);
            if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
            const Hdf5Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
            if (made < 0) no_memory("the group " + group);
        }
    }
    void set_attribute(const std::string& object, const char* name, hid_t type, hid_t space, const void* value) {
        end_chunks();
        add_groups(object + "/");
        const Hdf5Handle owner(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
        const Hdf5Handle attribute(H5Acreate2(owner, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        if (attribute < 0 || H5Awrite(attribute, type, value) < 0) no_memory(std::string("the attribute ") + name);
    }
};

Hdf5Layout::Hdf5Layout(std::string path, std::int64_t user_block) : data_(std::make_unique<Data>()) {
    const std::lock_guard lock(hdf5_mutex());
    data_->path = std::move(path);
    require_room();
    data_->file = create(data_->memory, user_block);
    if (data_->file < 0) data_->no_memory("a file");
}

Hdf5Layout::~Hdf5Layout() {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    data_->end_rows();
    if (data_->file >= 0) H5Fclose(data_->file);
}

std::int64_t Hdf5Layout::add(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape) {
    const std::lock_guard lock(hdf5_mutex());
    const std::vector<hsize_t> dims(shape.begin(), shape.end());
    data_->end_chunks();
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_layout(creation, H5D_CONTIGUOUS);
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, 0);
    const Hdf5Handle set(H5Dcreate2(data_->file, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    if (set < 0) data_->no_memory("the array " + name);
    const haddr_t address = H5Dget_offset(set);
    return address == HADDR_UNDEF ? 0 : static_cast<std::int64_t>(address);
}

void Hdf5Layout::begin_chunks(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape,
                              const std::vector<std::int64_t>& chunk, int level) {
    const std::lock_guard lock(hdf5_mutex());
    ISOATLAS_CHECK(shape.size() == chunk.size());
    data_->end_chunks();
    data_->shape = shape, data_->chunk = chunk, data_->next_chunk = 0;
    const std::vector<hsize_t> all(shape.begin(), shape.end()), part(chunk.begin(), chunk.end());
    const auto rank = static_cast<int>(all.size());
    const Hdf5Handle space(H5Screate_simple(rank, all.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_chunk(creation, rank, part.data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, static_cast<unsigned>(level));
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, 0);
    data_->chunked = H5Dcreate2(data_->file, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (data_->chunked < 0) data_->no_memory("the array " + name);
}

std::int64_t Hdf5Layout::add_chunk(std::int64_t bytes) {
    const std::lock_guard lock(hdf5_mutex());
    std::vector<hsize_t> first(data_->shape.size());
    std::int64_t rest = data_->next_chunk++;
    for (std::size_t d = first.size(); d-- > 0;) {
        const std::int64_t chunk = data_->chunk[d], count = (data_->shape[d] + chunk - 1) / chunk;
        first[d] = static_cast<hsize_t>(rest % count) * static_cast<hsize_t>(chunk);
        rest /= count;
    }
    return data_->allocate(data_->chunked, "an array", first.data(), static_cast<std::size_t>(bytes));
}

std::size_t Hdf5Layout::begin_rows(const std::string& name, const std::string& type, std::int64_t columns, std::int64_t chunk_rows) {
    const std::lock_guard lock(hdf5_mutex());
    const auto width = static_cast<hsize_t>(columns), height = static_cast<hsize_t>(chunk_rows);
    const std::array<hsize_t, 2> none{0, width}, most{H5S_UNLIMITED, width}, chunk{height, width};
    const int rank = columns > 1 ? 2 : 1;
    const Hdf5Handle space(H5Screate_simple(rank, none.data(), most.data()), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_chunk(creation, rank, chunk.data());
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(creation, 0);
    const hid_t number = hdf5_type(type);
    const hid_t set = H5Dcreate2(data_->file, name.c_str(), number, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (set < 0) data_->no_memory("the array " + name);
    data_->growing.push_back({name, set, width, height, 0, static_cast<std::size_t>(width * height) * H5Tget_size(number)});
    return data_->growing.size() - 1;
}

std::int64_t Hdf5Layout::add_rows(std::size_t array, std::int64_t rows) {
    const std::lock_guard lock(hdf5_mutex());
    Data::Rows& growing = data_->growing[array];
    ISOATLAS_CHECK(rows > 0 && static_cast<hsize_t>(rows) <= growing.chunk_rows && growing.rows % growing.chunk_rows == 0);
    const std::array<hsize_t, 2> first{growing.rows, 0}, extent{growing.rows + static_cast<hsize_t>(rows), growing.columns};
    if (H5Dset_extent(growing.set, extent.data()) < 0) data_->no_memory(growing.name);
    growing.rows = extent[0];
    return data_->allocate(growing.set, growing.name, first.data(), growing.chunk_bytes);
}

void Hdf5Layout::add_texts(const std::string& name, std::span<const std::string> texts) {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    const hsize_t count = texts.size();
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);  // UTF-8 that is called ASCII: VTK reads texts as ASCII, and HDF5 converts neither into the other
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    data_->add_groups(name);
    H5Pset_obj_track_times(creation, 0);
    const Hdf5Handle set(H5Dcreate2(data_->file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    const void* const bytes = static_cast<const void*>(pointers.data());
    if (set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) < 0) data_->no_memory("the texts " + name);
}

void Hdf5Layout::set_attribute(const std::string& object, const char* name, std::span<const std::int64_t> numbers) {
    const std::lock_guard lock(hdf5_mutex());
    data_->set_attribute(object, name, H5T_STD_I64LE, line_of(numbers.size()), numbers.data());
}

void Hdf5Layout::set_attribute(const std::string& object, const char* name, std::span<const double> numbers) {
    const std::lock_guard lock(hdf5_mutex());
    data_->set_attribute(object, name, H5T_IEEE_F64LE, line_of(numbers.size()), numbers.data());
}

void Hdf5Layout::set_attribute(const std::string& object, const char* name, std::string_view text) {
    const std::lock_guard lock(hdf5_mutex());
    data_->set_attribute(object, name, text_type(text, text.size()), line_of(1), text.data());
}

void Hdf5Layout::set_letters(const std::string& object, const char* name, std::string_view letters) {
    const std::lock_guard lock(hdf5_mutex());
    data_->set_attribute(object, name, text_type(letters, 1), line_of(letters.size()), letters.data());
}

std::int64_t Hdf5Layout::size() const { return static_cast<std::int64_t>(data_->memory.end_of_allocation); }

const std::vector<Hdf5Layout::Piece>& Hdf5Layout::finish() {
    const std::lock_guard lock(hdf5_mutex());
    data_->end_chunks();
    data_->end_rows();
    if (H5Fclose(std::exchange(data_->file, -1)) < 0) data_->no_memory("its structures");
    return data_->memory.pieces;
}

}  // namespace isoatlas
