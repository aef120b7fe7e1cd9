// A file as OpenVDB reads it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <streambuf>
#include <string>
#include <vector>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"
#include "isoatlas/text.h"

namespace isoatlas {

[[noreturn]] inline void refuse_vdb(const std::string& path, const std::string& reason) {
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "OpenVDB cannot read it: " + shown_name(reason),
                                   .expected = "a sound .vdb file",
                                   .next = "the file is truncated or damaged: get it again"});
}

/// A file as a stream that throws at its end: OpenVDB takes what it could not read for zeros, and counts that it made of them.
class FileBuffer final : public std::streambuf {
public:
    explicit FileBuffer(const std::string& path)
        : path_(path), file_(open_file(path)), size_(file_->size()), buffer_(std::size_t{1} << 18) {}

protected:
    int_type underflow() override {
        if (behind_ >= size_) refuse_vdb(path_, "it ends early, at byte " + std::to_string(size_));
        const auto count = static_cast<std::size_t>(std::min<std::int64_t>(size_ - behind_, static_cast<std::int64_t>(buffer_.size())));
        read_fully(*file_, path_, behind_, std::as_writable_bytes(std::span(buffer_).first(count)));
        behind_ += static_cast<std::int64_t>(count);
        setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
        return traits_type::to_int_type(*gptr());
    }
    pos_type seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode) override {
        const std::int64_t here = behind_ - (egptr() - gptr());
        const std::int64_t base = from == std::ios::beg ? 0 : from == std::ios::cur ? here : size_;
        if (offset < -base || offset > size_ - base) refuse_vdb(path_, "it refers to bytes behind its end");
        if (base + offset == here) return here;
        setg(buffer_.data(), buffer_.data(), buffer_.data());
        behind_ = base + offset;
        return behind_;
    }
    pos_type seekpos(pos_type place, std::ios::openmode which) override { return seekoff(off_type(place), std::ios::beg, which); }

private:
    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t size_, behind_ = 0;  ///< bytes of the file up to the end of the buffer
    std::vector<char> buffer_;
};

}  // namespace isoatlas
