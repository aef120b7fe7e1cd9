// A checked grid as OpenVDB reads it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/file_access.h"
#include "formats/volume/vdb_file.h"
#include "isoatlas/error.h"
#include "isoatlas/text.h"

namespace isoatlas {

[[noreturn]] inline void refuse_vdb(const std::string& path, const std::string& reason) {
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "OpenVDB cannot read it: " + shown_name(reason),
                                   .expected = "a sound .vdb file",
                                   .next = "the file is truncated or damaged: get it again"});
}

/// Pieces one after another, as a stream that throws at its end: OpenVDB takes what it could not read for zeros.
class VdbStreamBuffer final : public std::streambuf {
public:
    VdbStreamBuffer(const std::string& path, std::vector<VdbPiece> pieces)
        : path_(path), file_(open_file(path)), pieces_(std::move(pieces)) {}

protected:
    int_type underflow() override {
        while (next_ < pieces_.size() && size_of_piece() == within_) ++next_, within_ = 0;
        if (next_ == pieces_.size()) refuse_vdb(path_, "it ends early");
        const VdbPiece& piece = pieces_[next_];
        const auto count = static_cast<std::size_t>(std::min(size_of_piece() - within_, kBytes));
        buffer_.resize(count);
        if (piece.own.empty())
            read_fully(*file_, path_, piece.begin + within_, std::as_writable_bytes(std::span(buffer_)));
        else
            std::copy_n(piece.own.begin() + within_, count, buffer_.begin());
        within_ += static_cast<std::int64_t>(count), behind_ += static_cast<std::int64_t>(count);
        setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
        return traits_type::to_int_type(*gptr());
    }
    /// OpenVDB asks where it is, and goes nowhere.
    pos_type seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode) override {
        if (from != std::ios::cur || offset != 0) refuse_vdb(path_, "it refers to other parts of the file");
        return behind_ - (egptr() - gptr());
    }

private:
    static constexpr std::int64_t kBytes = std::int64_t{1} << 18;

    [[nodiscard]] std::int64_t size_of_piece() const {
        const VdbPiece& piece = pieces_[next_];
        return piece.own.empty() ? piece.end - piece.begin : static_cast<std::int64_t>(piece.own.size());
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::vector<VdbPiece> pieces_;
    std::size_t next_ = 0;                  ///< piece that is read
    std::int64_t within_ = 0, behind_ = 0;  ///< bytes of it that were, and of all
    std::vector<char> buffer_;
};

}  // namespace isoatlas
