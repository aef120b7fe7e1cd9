// TIFF files made with libtiff, for the tests of the TIFF and folder readers.
#pragma once

#include <tiffio.h>

#include <string>

#include "isoatlas/volume.h"

namespace isoatlas::test {

struct TiffRecipe {
    std::int64_t width = 5, height = 4, pages = 3;
    ValueType type = ValueType::u16;
    int compression = COMPRESSION_NONE;
    const char* mode = "wl";  ///< l, b: byte order; 8: BigTIFF
    std::int64_t rows_per_strip = 2;
    int tile = 0;  ///< side of a tile; 0: strips
    int samples_per_pixel = 1;
    int photometric = PHOTOMETRIC_MINISBLACK;
    std::string description{};
    float x_resolution = 0, y_resolution = 0;
    int resolution_unit = 0;
    int bits = 0;       ///< 0: those of the type
    int predictor = 0;  ///< 0: none is written
};

/// Samples in host byte order, page after page; tiles are padded with zeros.
inline void write_tiff_file(const std::string& path, const TiffRecipe& r, const std::string& samples) {
    TIFF* tiff = TIFFOpen(path.c_str(), r.mode);
    const std::size_t sample = size_of(r.type),
                      row = static_cast<std::size_t>(r.width) * sample * static_cast<std::size_t>(r.samples_per_pixel);
    const std::size_t page = row * static_cast<std::size_t>(r.height);
    const bool is_signed = r.type == ValueType::i8 || r.type == ValueType::i16 || r.type == ValueType::i32;
    for (std::int64_t z = 0; z < r.pages; ++z) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(r.width));
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(r.height));
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, r.bits != 0 ? r.bits : static_cast<int>(8 * sample));
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, r.samples_per_pixel);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, r.photometric);
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
                     is_floating(r.type) ? SAMPLEFORMAT_IEEEFP
                     : is_signed         ? SAMPLEFORMAT_INT
                                         : SAMPLEFORMAT_UINT);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, r.compression);
        if (r.predictor != 0) TIFFSetField(tiff, TIFFTAG_PREDICTOR, r.predictor);
        if (!r.description.empty() && z == 0) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, r.description.c_str());
        if (r.x_resolution > 0) {
            TIFFSetField(tiff, TIFFTAG_XRESOLUTION, static_cast<double>(r.x_resolution));
            TIFFSetField(tiff, TIFFTAG_YRESOLUTION, static_cast<double>(r.y_resolution));
        }
        if (r.resolution_unit != 0) TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, r.resolution_unit);
        std::string data = samples.substr(static_cast<std::size_t>(z) * page, page);
        if (r.tile > 0) {
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, r.tile);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, r.tile);
            std::uint32_t number = 0;
            for (std::int64_t y = 0; y < r.height; y += r.tile) {
                for (std::int64_t x = 0; x < r.width; x += r.tile, ++number) {
                    std::string tile(static_cast<std::size_t>(r.tile * r.tile) * sample, '\0');
                    for (std::int64_t ty = 0; ty < std::min<std::int64_t>(r.tile, r.height - y); ++ty) {
                        const auto count = static_cast<std::size_t>(std::min<std::int64_t>(r.tile, r.width - x)) * sample;
                        tile.replace(static_cast<std::size_t>(ty * r.tile) * sample, count, data,
                                     static_cast<std::size_t>((y + ty) * r.width + x) * sample, count);
                    }
                    TIFFWriteEncodedTile(tiff, number, tile.data(), static_cast<tmsize_t>(tile.size()));
                }
            }
        } else {
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(r.rows_per_strip));
            const std::size_t strip = row * static_cast<std::size_t>(r.rows_per_strip);
            for (std::size_t begin = 0, number = 0; begin < data.size(); begin += strip, ++number) {
                TIFFWriteEncodedStrip(tiff, static_cast<std::uint32_t>(number), data.data() + begin,
                                      static_cast<tmsize_t>(std::min(strip, data.size() - begin)));
            }
        }
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
}

}  // namespace isoatlas::test
