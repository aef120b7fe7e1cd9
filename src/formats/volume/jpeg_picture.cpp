// JPEG by libjpeg: grey levels and colours of 8 bits. Its warnings are about damage, and are errors here; it prints nothing.
#include <cstdio>  // before jpeglib.h, which needs it

#include <jpeglib.h>

#include <jerror.h>

#include "formats/volume/bad_header.h"
#include "formats/volume/picture.h"
#include "formats/volume/picture_input.h"

namespace isoatlas {
namespace {

PictureInput& input_of_jpeg(j_common_ptr jpeg) { return *static_cast<PictureInput*>(jpeg->client_data); }
[[noreturn]] void fail_jpeg(j_common_ptr jpeg) {
    char message[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, message);
    input_of_jpeg(jpeg).fail(message);
}
/// Warnings have level -1, traces 0 and more.
void on_jpeg_message(j_common_ptr jpeg, int level) {
    if (level < 0) fail_jpeg(jpeg);
}
void print_nothing(j_common_ptr) {}

void start_jpeg_source(j_decompress_ptr) {}
boolean fill_jpeg_source(j_decompress_ptr jpeg) {
    const std::span<const std::byte> bytes = input_of_jpeg(reinterpret_cast<j_common_ptr>(jpeg)).next(PictureInput::kBufferBytes);
    if (bytes.empty()) ERREXIT(jpeg, JERR_INPUT_EOF);
    jpeg->src->next_input_byte = reinterpret_cast<const JOCTET*>(bytes.data());
    jpeg->src->bytes_in_buffer = bytes.size();
    return TRUE;
}
void skip_jpeg_source(j_decompress_ptr jpeg, long count) {
    if (count <= 0) return;
    jpeg_source_mgr& source = *jpeg->src;
    const std::size_t inside = std::min(static_cast<std::size_t>(count), source.bytes_in_buffer);
    source.next_input_byte += inside;
    source.bytes_in_buffer -= inside;
    input_of_jpeg(reinterpret_cast<j_common_ptr>(jpeg)).skip(static_cast<std::int64_t>(count) - static_cast<std::int64_t>(inside));
}
/// A forged file can have a great many scans, each over the whole picture.
void limit_jpeg_scans(j_common_ptr jpeg) {
    constexpr int kMaxScans = 500;
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMaxScans) input_of_jpeg(jpeg).fail("it has more than 500 scans");
}

class JpegPicture final : public PictureFile {
public:
    explicit JpegPicture(const std::string& path) : input_(path) {
        picture_.kind = PictureKind::jpeg;
        picture_.file_bytes = input_.file_bytes();
        jpeg_.err = jpeg_std_error(&errors_);
        errors_.error_exit = fail_jpeg;
        errors_.emit_message = on_jpeg_message;
        errors_.output_message = print_nothing;
        jpeg_.client_data = &input_;
        try {
            read_header();
        } catch (...) {
            jpeg_destroy_decompress(&jpeg_);
            throw;
        }
    }
    JpegPicture(const JpegPicture&) = delete;
    JpegPicture& operator=(const JpegPicture&) = delete;
    ~JpegPicture() override { jpeg_destroy_decompress(&jpeg_); }

    void read(const TakeRow& take) override {
        step([&] { jpeg_start_decompress(&jpeg_); });
        std::vector<std::byte> row(picture_.row_bytes());
        for (std::int64_t y = 0; y < picture_.height; ++y) {
            JSAMPROW samples = reinterpret_cast<JSAMPROW>(row.data());
            step([&] { jpeg_read_scanlines(&jpeg_, &samples, 1); });
            take(y, row);
        }
        step([&] { jpeg_finish_decompress(&jpeg_); });
    }

private:
    template <class Step>
    void step(const Step& call) {
        if (input_.guarded(call)) return;
        const int code = errors_.msg_code;
        if (code == JERR_SOF_UNSUPPORTED || code == JERR_BAD_PRECISION || code == JERR_ARITH_NOTIMPL || code == JERR_NOT_COMPILED ||
            code == JERR_CONVERSION_NOTIMPL)
            unsupported("the picture is coded in a way that libjpeg does not decode");
        input_.report("JPEG");
    }

    [[noreturn]] void unsupported(const std::string& what) const {
        throw Error(ErrorKind::unsupported, {.file = input_.path(),
                                             .what = what,
                                             .expected = "grey levels, or YCbCr or RGB colours, of 8 bits in Huffman codes",
                                             .next = "convert the pictures to PNG or TIFF"});
    }

    void read_header() {
        step([&] {
            jpeg_create_decompress(&jpeg_);  // keeps err and client_data
            source_.init_source = start_jpeg_source;
            source_.fill_input_buffer = fill_jpeg_source;
            source_.skip_input_data = skip_jpeg_source;
            source_.resync_to_restart = jpeg_resync_to_restart;
            source_.term_source = start_jpeg_source;
            jpeg_.src = &source_;
            progress_.progress_monitor = limit_jpeg_scans;
            jpeg_.progress = &progress_;
            jpeg_read_header(&jpeg_, TRUE);
        });
        picture_.width = jpeg_.image_width;
        picture_.height = jpeg_.image_height;
        const J_COLOR_SPACE colours = jpeg_.jpeg_color_space;
        const bool is_grey = colours == JCS_GRAYSCALE, is_colour = colours == JCS_YCbCr || colours == JCS_RGB;
        if (!is_grey && !is_colour) unsupported("the pixels are neither grey levels nor colours of three values (but CMYK, for example)");
        constexpr int kBits = 8;
        if (jpeg_.data_precision != kBits) unsupported("the samples have " + std::to_string(jpeg_.data_precision) + " bits");
        if (jpeg_.arith_code != FALSE) unsupported("the picture is in arithmetic codes");
        jpeg_.out_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
        picture_.pixel = is_grey ? PixelKind{} : PixelKind{.samples = 3, .is_rgb = true};
        check_size();
        take_spacing();
    }

    /// A block of 8 x 8 samples takes a bit of the file at least.
    void check_size() const {
        std::int64_t blocks = 0;
        for (int i = 0; i < jpeg_.num_components; ++i) {
            const jpeg_component_info& component = jpeg_.comp_info[i];
            blocks += std::int64_t{component.width_in_blocks} * component.height_in_blocks;
        }
        if (blocks / 8 <= picture_.file_bytes) return;
        bad_header(input_.path(), "frame",
                   "claims " + std::to_string(picture_.width) + " x " + std::to_string(picture_.height) + " pixels, more than a file of " +
                       std::to_string(picture_.file_bytes) + " bytes can hold",
                   "at least a bit for each block of 8 x 8 samples");
    }

    void take_spacing() {
        constexpr int kPerInch = 1, kPerCentimetre = 2;
        const double length = jpeg_.density_unit == kPerInch ? 25.4 : jpeg_.density_unit == kPerCentimetre ? 10 : 0;
        if (jpeg_.saw_JFIF_marker == FALSE || length == 0 || jpeg_.X_density == 0 || jpeg_.Y_density == 0) return;
        picture_.spacing = {length / jpeg_.X_density, length / jpeg_.Y_density};
    }

    PictureInput input_;
    jpeg_decompress_struct jpeg_{};
    jpeg_error_mgr errors_{};
    jpeg_source_mgr source_{};
    jpeg_progress_mgr progress_{};
};

}  // namespace

std::unique_ptr<PictureFile> open_jpeg_picture(const std::string& path) { return std::make_unique<JpegPicture>(path); }

}  // namespace isoatlas
