// VolumeView: a volume whose samples lie anywhere, for stages that read some of them: the others need not be in memory.
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
    return visit_type(volume.info->type, [&]<class T>(T) -> decltype(auto) { return function(volume.samples<T>()); });
}

}  // namespace isoatlas
