// The formats: for each a test of the first bytes and a function that opens it. open_volume.cpp chooses among them.
//
// looks_like_X(first, path): whether the file is an X, judged by its first 4096 bytes or fewer (of a gzip file: decompressed) and,
// where a format has no magic number, by its name. Never throws.
// open_X(path, options): reads the header only. Throws Error: input, unsupported, usage (see open_volume).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "isoatlas/volume.h"

namespace isoatlas {

using FirstBytes = std::span<const std::byte>;

[[nodiscard]] bool looks_like_nrrd(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_nrrd(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_metaimage(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_metaimage(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_npy(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_npy(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_nifti(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_nifti(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_vti(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_vti(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_tiff(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_tiff(const std::string& path, const OpenOptions& options);

/// A single picture is a volume of rank 2.
[[nodiscard]] bool looks_like_png(FirstBytes first, const std::string& path);
[[nodiscard]] bool looks_like_jpeg(FirstBytes first, const std::string& path);
[[nodiscard]] bool looks_like_bmp(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_picture(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_mrc(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_mrc(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_amira(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_amira(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_bov(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_bov(const std::string& path, const OpenOptions& options);

/// Headers of RAW files: .dat of volume libraries and Inviwo, .xml of MIPAV.
[[nodiscard]] bool looks_like_raw_header(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_raw_header(const std::string& path, const OpenOptions& options);

/// Of a build without OpenVDB: Error{unsupported, Reason::built_without_format}.
[[nodiscard]] bool looks_like_vdb(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_vdb(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_vtk_legacy(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_vtk_legacy(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_hdf5(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_hdf5(const std::string& path, const OpenOptions& options);

/// The classic formats; NetCDF-4 files are files of HDF5.
[[nodiscard]] bool looks_like_netcdf(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_netcdf(const std::string& path, const OpenOptions& options);

/// A zip archive: of a Zarr hierarchy, or it is Error{unsupported}.
[[nodiscard]] bool looks_like_zip(FirstBytes first, const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_zarr_zip(const std::string& path, const OpenOptions& options);
/// A directory with the metadata of a Zarr array or group. Its array or image is that of the hierarchy that it is a part of.
[[nodiscard]] bool is_zarr_folder(const std::string& path);
[[nodiscard]] std::unique_ptr<VolumeReader> open_zarr_folder(const std::string& path, const OpenOptions& options);

[[nodiscard]] bool looks_like_dicom(FirstBytes first, const std::string& path);
/// With the files beside it that are of the same series.
[[nodiscard]] std::unique_ptr<VolumeReader> open_dicom(const std::string& path, const OpenOptions& options);
/// A series of a folder and the folders below it; null: there are no DICOM pictures.
[[nodiscard]] std::unique_ptr<VolumeReader> open_dicom_folder(const std::string& path, const OpenOptions& options);

/// A directory of slices, one image file each, unless is_zarr_folder(). Without looks_like: every other directory is read as one.
[[nodiscard]] std::unique_ptr<VolumeReader> open_folder(const std::string& path, const OpenOptions& options);

/// Any file: described by options, a sidecar or its name.
[[nodiscard]] std::unique_ptr<VolumeReader> open_raw(const std::string& path, const OpenOptions& options);

}  // namespace isoatlas
