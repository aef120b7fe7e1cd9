// bzip2, for files of tests.
#pragma once

#include <bzlib.h>

#include <stdexcept>
#include <string>

namespace isoatlas::test {

inline std::string bzip2(std::string plain, int level = 9) {
    std::string out(plain.size() + plain.size() / 100 + 600, '\0');  // as libbz2 documents
    auto size = static_cast<unsigned>(out.size());
    if (::BZ2_bzBuffToBuffCompress(out.data(), &size, plain.data(), static_cast<unsigned>(plain.size()), level, 0, 0) != BZ_OK)
        throw std::runtime_error("bzip2 failed");
    out.resize(size);
    return out;
}

}  // namespace isoatlas::test
