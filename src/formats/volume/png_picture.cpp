// PNG by libpng. Text, profiles and the like are skipped, compressed ones undecoded; every checksum is verified.
#include <png.h>

#include <bit>
#include <limits>

#include "base/check.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/picture.h"
#include "formats/volume/picture_input.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxDeflateRatio = 1032;

PictureInput& input_of_png(void* pointer) { return *static_cast<PictureInput*>(pointer); }
[[noreturn]] void fail_png(png_structp png, png_const_charp message) { input_of_png(png_get_error_ptr(png)).fail(message); }
void ignore_png_warning(png_structp, png_const_charp) {}
void read_png_bytes(png_structp png, png_bytep out, std::size_t count) {
    PictureInput& input = input_of_png(png_get_io_ptr(png));
    while (count > 0) {
        const std::span<const std::byte> bytes = input.next(count);
        if (bytes.empty()) png_error(png, "the file ends early");
        std::memcpy(out, bytes.data(), bytes.size());
        out += bytes.size();
        count -= bytes.size();
    }
}

class PngPicture final : public PictureFile {
public:
    explicit PngPicture(const std::string& path) : input_(path) {
        picture_.kind = PictureKind::png;
        picture_.file_bytes = input_.file_bytes();
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, fail_png, ignore_png_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            destroy();
            throw Error(ErrorKind::resource, {.file = path, .what = "not enough memory to open the file"});
        }
        try {
            read_header();
        } catch (...) {
            destroy();
            throw;
        }
    }
    PngPicture(const PngPicture&) = delete;
    PngPicture& operator=(const PngPicture&) = delete;
    ~PngPicture() override { destroy(); }

    void read(const TakeRow& take) override {
        prepare();
        const std::size_t rows = passes_ > 1 ? static_cast<std::size_t>(picture_.height) : 1;
        stored_.resize(rows * stored_row_);
        row_.resize(table_.size() > 0 ? picture_.row_bytes() : 0);
        for (int pass = 0; pass < passes_; ++pass) {
            for (std::int64_t y = 0; y < picture_.height; ++y) {
                std::byte* row = stored_.data() + (passes_ > 1 ? static_cast<std::size_t>(y) * stored_row_ : 0);
                step([&] { png_read_row(png_, reinterpret_cast<png_bytep>(row), nullptr); });
                if (pass + 1 == passes_) give(y, {row, stored_row_}, take);
            }
        }
        step([&] { png_read_end(png_, nullptr); });
    }

private:
    void destroy() { png_destroy_read_struct(&png_, &info_, nullptr); }

    template <class Step>
    void step(const Step& call) {
        if (!input_.guarded(call)) input_.report("PNG");
    }

    void read_header() {
        step([&] {
            png_set_read_fn(png_, &input_, read_png_bytes);
            png_set_user_limits(png_, std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max());
            png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
            png_set_benign_errors(png_, 1);                                          // a chunk out of place is ignored
            png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // all but tRNS of those that may be left out
            png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("pHYs"), 1);
            png_read_info(png_, info_);
        });
        picture_.width = png_get_image_width(png_, info_);
        picture_.height = png_get_image_height(png_, info_);
        depth_ = png_get_bit_depth(png_, info_);
        if (depth_ == 16) picture_.type = ValueType::u16;
        check_size();
        take_pixel_kind();
        take_spacing();
    }

    /// What the header claims against the size of the file.
    void check_size() const {
        const auto row = static_cast<std::int64_t>(png_get_rowbytes(png_, info_));
        if (picture_.height <= std::numeric_limits<std::int64_t>::max() / (row + 1) &&
            (row + 1) * picture_.height / kMaxDeflateRatio <= picture_.file_bytes)
            return;
        bad_header(input_.path(), "IHDR",
                   "claims " + std::to_string(picture_.width) + " x " + std::to_string(picture_.height) + " pixels, more than a file of " +
                       std::to_string(picture_.file_bytes) + " bytes can hold",
                   "at most " + std::to_string(kMaxDeflateRatio) + " bytes of pixels for each byte of the file");
    }

    void take_pixel_kind() {
        const int colour = png_get_color_type(png_, info_);
        const int channels = png_get_channels(png_, info_);
        const bool has_alpha = (colour & PNG_COLOR_MASK_ALPHA) != 0;
        if (colour == PNG_COLOR_TYPE_PALETTE) {
            png_colorp colours = nullptr;
            int count = 0;
            png_get_PLTE(png_, info_, &colours, &count);
            for (int i = 0; i < count; ++i) table_.add(colours[i].red, colours[i].green, colours[i].blue);
            picture_.pixel = table_.pixel_kind();
            if (table_.is_grey()) picture_.notes.emplace_back("the grey levels of the colour table are read, not its indices");
        } else {
            picture_.pixel = {.samples = channels, .alphas = has_alpha ? 1 : 0, .is_rgb = (colour & PNG_COLOR_MASK_COLOR) != 0};
            if (depth_ < 8) picture_.notes.push_back("grey levels of " + std::to_string(depth_) + " bits are scaled to 0 to 255");
        }
        if (!has_alpha && png_get_valid(png_, info_, PNG_INFO_tRNS) != 0)
            picture_.notes.emplace_back("the transparency (alpha) of the pixels is ignored");
    }

    void take_spacing() {
        png_uint_32 x = 0, y = 0;
        int unit = PNG_RESOLUTION_UNKNOWN;
        if (png_get_pHYs(png_, info_, &x, &y, &unit) == 0 || unit != PNG_RESOLUTION_METER || x == 0 || y == 0) return;
        constexpr double kMillimetres = 1000;
        picture_.spacing = {kMillimetres / x, kMillimetres / y};
    }

    /// One sample a byte or two, in host byte order.
    void prepare() {
        step([&] {
            png_set_benign_errors(png_, 0);  // of the pixels nothing may be wrong
            if (table_.size() > 0)
                png_set_packing(png_);
            else if (depth_ < 8)
                png_set_expand_gray_1_2_4_to_8(png_);
            if (depth_ == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
            passes_ = png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
            stored_row_ = png_get_rowbytes(png_, info_);
        });
        const std::size_t wanted = table_.size() > 0 ? static_cast<std::size_t>(picture_.width) : picture_.row_bytes();
        ISOATLAS_CHECK(stored_row_ == wanted);
    }

    void give(std::int64_t y, std::span<const std::byte> stored, const TakeRow& take) {
        if (table_.size() == 0) return take(y, stored);
        if (!table_.look_up(stored, row_)) bad_field(input_.path(), "row " + std::to_string(y), "a pixel has no colour in the table", "");
        take(y, row_);
    }

    PictureInput input_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int depth_ = 8, passes_ = 1;
    ColourTable table_;
    std::size_t stored_row_ = 0;
    std::vector<std::byte> stored_, row_;
};

}  // namespace

std::unique_ptr<PictureFile> open_png_picture(const std::string& path) { return std::make_unique<PngPicture>(path); }

}  // namespace isoatlas
