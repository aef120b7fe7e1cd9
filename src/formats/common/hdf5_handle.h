// What all that calls HDF5 shares: its identifiers as objects, and its lock.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

namespace isoatlas {

/// Closes an identifier of HDF5.
class Hdf5Handle {
public:
    Hdf5Handle() = default;
    Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
        std::swap(id_, other.id_), std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): implicit conversion to the number

private:
    hid_t id_ = -1;
    herr_t (*close_)(hid_t) = nullptr;
};

/// HDF5 is not thread safe: held during every call.
inline std::mutex& hdf5_mutex() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace isoatlas
