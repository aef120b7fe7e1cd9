#include "data/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <isoatlas/error.h>

namespace isoatlas::cli {

void temporary_file_failed(const char* file, int error) {
    throw Error(ErrorKind::resource, {.file = file,
                                      .what = std::string("cannot be read or kept: ") + std::strerror(error),
                                      .next = "set TMPDIR to a folder with free space"});
}

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    path_ = (std::filesystem::temp_directory_path(error) / "isoatlas-XXXXXX").string();
    if (error || ::mkdtemp(path_.data()) == nullptr) temporary_file_failed("TMPDIR", errno);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace isoatlas::cli
