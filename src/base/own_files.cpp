#include "base/own_files.h"

#include <unistd.h>

#include <cstdlib>

namespace isoatlas {

std::string folder_in(const char* variable) {
    const char* folder = std::getenv(variable);
    return folder != nullptr && *folder == '/' ? folder : std::string();
}

bool write_all(int file, std::string_view text) { return ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()); }

}  // namespace isoatlas
