// Writes HDF5 files for tests.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace isoatlas::test {

struct Hdf5Storage {
    std::vector<hsize_t> chunk{};
    int gzip = -1;
    bool shuffle = false, fletcher = false, szip = false;
    std::vector<hsize_t> most{};  ///< sizes up to which it may grow
};

/// Objects are closed with the file, when this goes.
class Hdf5Maker {
public:
    using Storage = Hdf5Storage;

    explicit Hdf5Maker(const std::string& path, hsize_t user_block = 0) {
        const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
        H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
        H5Pset_userblock(creation, user_block);
        file = made(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access));
        H5Pclose(access), H5Pclose(creation);
        links = H5Pcreate(H5P_LINK_CREATE);
        H5Pset_create_intermediate_group(links, 1);
    }
    Hdf5Maker(const Hdf5Maker&) = delete;
    Hdf5Maker& operator=(const Hdf5Maker&) = delete;
    ~Hdf5Maker() {
        H5Pclose(links);
        H5Fclose(file);
    }

    void group(const std::string& path) const { made(H5Gcreate2(file, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT)); }
    /// dims: the slowest first. samples: of the memory type; nullptr: none are written.
    hid_t array(const std::string& path, const std::vector<hsize_t>& dims, hid_t type, hid_t memory, const void* samples,
                const Storage& storage = {}) const {
        const hid_t space =
            made(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), storage.most.empty() ? nullptr : storage.most.data()));
        const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
        if (!storage.chunk.empty()) H5Pset_chunk(creation, static_cast<int>(dims.size()), storage.chunk.data());
        if (storage.shuffle) H5Pset_shuffle(creation);
        if (storage.gzip >= 0) H5Pset_deflate(creation, static_cast<unsigned>(storage.gzip));
        if (storage.szip) H5Pset_szip(creation, H5_SZIP_NN_OPTION_MASK, 8);
        if (storage.fletcher) H5Pset_fletcher32(creation);
        const hid_t set = made(H5Dcreate2(file, path.c_str(), type, space, links, creation, H5P_DEFAULT));
        if (samples != nullptr) made(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples));
        H5Pclose(creation), H5Sclose(space);
        return set;
    }
    void bytes(const std::string& path, const std::vector<hsize_t>& dims, const std::string& samples) const {
        array(path, dims, H5T_STD_U8LE, H5T_NATIVE_UINT8, samples.data());
    }
    void doubles(const std::string& path, const std::vector<double>& values, std::vector<hsize_t> dims = {}) const {
        if (dims.empty()) dims = {values.size()};
        array(path, dims, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
    }
    void set_numbers(const std::string& object, const std::string& name, const std::vector<double>& values) const {
        const hsize_t count = values.size();
        attribute(object, name, H5T_IEEE_F64LE, made(H5Screate_simple(1, &count, nullptr)), values.data());
    }
    void set(const std::string& object, const std::string& name, const std::string& text) const {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size() + 1);
        attribute(object, name, type, H5Screate(H5S_SCALAR), text.c_str());
    }
    void set_list(const std::string& object, const std::string& name, const std::vector<std::string>& texts) const {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, H5T_VARIABLE);
        std::vector<const char*> pointers;
        for (const std::string& text : texts) pointers.push_back(text.c_str());
        const hsize_t count = texts.size();
        attribute(object, name, type, made(H5Screate_simple(1, &count, nullptr)), static_cast<const void*>(pointers.data()));
    }
    /// A list of characters, as Imaris writes texts.
    void set_characters(const std::string& object, const std::string& name, const std::string& text) const {
        const hsize_t count = text.size();
        attribute(object, name, H5T_C_S1, made(H5Screate_simple(1, &count, nullptr)), text.data());
    }

    static hid_t made(hid_t id) {
        if (id < 0) throw std::runtime_error("HDF5 cannot write a file for a test");
        return id;
    }

    hid_t file = -1, links = -1;

private:
    void attribute(const std::string& object, const std::string& name, hid_t type, hid_t space, const void* values) const {
        const hid_t made_one =
            made(H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        made(H5Awrite(made_one, type, values));
        H5Aclose(made_one);
        H5Sclose(space);
    }
};

inline std::string file_content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace isoatlas::test
