#include "formats/volume/dicom_input.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kWindowBytes = 16 * 1024;

class PlainDicomInput final : public DicomInput {
public:
    explicit PlainDicomInput(const std::string& path) : path_(path), file_(open_file(path)), window_(kWindowBytes) {}

    [[nodiscard]] std::int64_t position() const override { return position_; }
    [[nodiscard]] std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        if (out.size() > window_.size()) {
            done = read_available(*file_, path_, position_, out);
            position_ += static_cast<std::int64_t>(done);
            return done;
        }
        while (done < out.size()) {
            const std::span<const std::byte> there = present();
            if (there.empty()) break;
            const std::size_t count = std::min(there.size(), out.size() - done);
            std::memcpy(out.data() + done, there.data(), count);
            done += count;
            position_ += static_cast<std::int64_t>(count);
        }
        return done;
    }
    void seek(std::int64_t position) override { position_ = position; }
    [[nodiscard]] std::int64_t size_bound() const override { return file_->size(); }
    [[nodiscard]] bool is_deflated() const override { return false; }

private:
    /// What the window holds from the position on; empty: the end of the file.
    std::span<const std::byte> present() {
        if (position_ < begin_ || position_ >= begin_ + filled_) {
            begin_ = position_;
            filled_ = static_cast<std::int64_t>(read_available(*file_, path_, begin_, window_));
        }
        return std::span(window_).subspan(static_cast<std::size_t>(position_ - begin_),
                                          static_cast<std::size_t>(filled_ - (position_ - begin_)));
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::vector<std::byte> window_;
    std::int64_t position_ = 0, begin_ = 0, filled_ = 0;
};

class DeflatedDicomInput final : public DicomInput {
public:
    DeflatedDicomInput(const std::string& path, std::int64_t offset) : path_(path), file_(open_file(path)), first_(offset) {
        packed_.resize(kWindowBytes);
        constexpr int kRaw = -15;  // windowBits: the largest window, no header
        if (inflateInit2(&stream_, kRaw) != Z_OK) {
            throw Error(ErrorKind::resource, {.file = path, .what = "not enough memory", .next = "close other programs"});
        }
        next_ = first_;
    }
    DeflatedDicomInput(const DeflatedDicomInput&) = delete;
    DeflatedDicomInput& operator=(const DeflatedDicomInput&) = delete;
    ~DeflatedDicomInput() override { inflateEnd(&stream_); }

    [[nodiscard]] std::int64_t position() const override { return position_; }
    [[nodiscard]] std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        while (done < out.size() && !ended_) done += inflate_some(out.subspan(done));
        position_ += static_cast<std::int64_t>(done);
        return done;
    }
    void seek(std::int64_t position) override {
        if (position < position_) {
            inflateReset(&stream_);
            stream_.avail_in = 0;
            next_ = first_, position_ = 0, ended_ = false;
        }
        std::array<std::byte, kWindowBytes> scratch;
        while (position_ < position && !ended_) {
            const auto count = static_cast<std::size_t>(std::min<std::int64_t>(scratch.size(), position - position_));
            static_cast<void>(read(std::span(scratch).first(count)));
        }
        position_ = position;
    }
    [[nodiscard]] std::int64_t size_bound() const override {
        constexpr std::int64_t kMostPerByte = 1032;  // of deflate
        const std::int64_t bytes = std::max<std::int64_t>(0, file_->size() - first_);
        return std::min(bytes, std::numeric_limits<std::int64_t>::max() / kMostPerByte) * kMostPerByte;
    }
    [[nodiscard]] bool is_deflated() const override { return true; }

private:
    std::size_t inflate_some(std::span<std::byte> out) {
        if (stream_.avail_in == 0) {
            const std::size_t count = read_available(*file_, path_, next_, packed_);
            next_ += static_cast<std::int64_t>(count);
            stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
            stream_.avail_in = static_cast<uInt>(count);
            if (count == 0) {
                ended_ = true;
                return 0;
            }
        }
        constexpr std::size_t kMost = 1U << 30;
        const std::size_t room = std::min(out.size(), kMost);
        stream_.next_out = reinterpret_cast<Bytef*>(out.data());
        stream_.avail_out = static_cast<uInt>(room);
        const int result = inflate(&stream_, Z_NO_FLUSH);
        if (result == Z_STREAM_END) {
            ended_ = true;
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            throw Error(ErrorKind::input, {.file = path_,
                                           .where = "byte " + std::to_string(position_) + " of the decompressed data set",
                                           .what = "the deflated data set is corrupt",
                                           .next = "the file is damaged: get it again"});
        }
        return room - stream_.avail_out;
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t first_, next_ = 0, position_ = 0;
    std::vector<std::byte> packed_;
    z_stream stream_{};
    bool ended_ = false;
};

}  // namespace

std::unique_ptr<DicomInput> open_dicom_input(const std::string& path) { return std::make_unique<PlainDicomInput>(path); }

std::unique_ptr<DicomInput> open_deflated_dicom_input(const std::string& path, std::int64_t offset) {
    return std::make_unique<DeflatedDicomInput>(path, offset);
}

}  // namespace isoatlas
