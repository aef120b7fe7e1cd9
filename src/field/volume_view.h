// A volume whose samples lie anywhere, for stages that look at some of them: what is not looked at need not be there.
#pragma once

#include <cstddef>
#include <span>

#include "isoatlas/volume.h"

namespace isoatlas {

struct VolumeView {
    const VolumeInfo* info;
    const std::byte* bytes;  ///< of info->extent.voxels() samples

    VolumeView(const VolumeInfo& of, const std::byte* samples) : info(&of), bytes(samples) {}
    VolumeView(const Volume& volume) : info(&volume.info), bytes(volume.bytes.data()) {}  // NOLINT(google-explicit-constructor): it is one

    template <class T>
    [[nodiscard]] std::span<const T> samples() const {
        return {reinterpret_cast<const T*>(bytes), static_cast<std::size_t>(info->extent.voxels())};
    }
};

/// Calls function(std::span<const T>) with the samples.
template <class Function>
decltype(auto) visit_samples(const VolumeView& volume, Function&& function) {
    switch (volume.info->type) {
        case ValueType::u8: return function(volume.samples<std::uint8_t>());
        case ValueType::i8: return function(volume.samples<std::int8_t>());
        case ValueType::u16: return function(volume.samples<std::uint16_t>());
        case ValueType::i16: return function(volume.samples<std::int16_t>());
        case ValueType::u32: return function(volume.samples<std::uint32_t>());
        case ValueType::i32: return function(volume.samples<std::int32_t>());
        case ValueType::f32: return function(volume.samples<float>());
        case ValueType::f64: break;
    }
    return function(volume.samples<double>());
}

}  // namespace isoatlas
