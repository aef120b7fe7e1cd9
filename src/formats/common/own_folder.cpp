#include "formats/common/own_folder.h"

#include <algorithm>
#include <filesystem>

#include "base/file_system.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

bool is_below(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& file) {
    throw Error(ErrorKind::input,
                {.file = path,
                 .what = what + " outside its folder: " + file,
                 .expected = "files in the folder or below it",
                 .next = "copy the file into the folder, or let links be followed if you trust where this volume comes from",
                 .reason = Reason::file_outside_folder});
}

}  // namespace

void require_own_folder(const std::string& header, const std::string& file) {
    const fs::path real = file_system().resolved(file);
    if (is_below(file_system().resolved(folder_of(header).string()), real)) return;
    if (!is_below(folder_of(file_system().resolved(header)), real)) refuse(header, "the header refers to a file", file);
}

void require_inside(const std::string& folder, const std::string& file, const std::string& what) {
    if (!is_below(file_system().resolved(folder), file_system().resolved(file))) refuse(folder, what, file);
}

}  // namespace isoatlas
