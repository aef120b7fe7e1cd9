#include "isoatlas/dataset_path.h"

#include "base/file_system.h"

namespace isoatlas {

DatasetPath split_dataset(const std::string& path) {
    const std::size_t colon = path.find(":/", is_address(path) ? path.find("//") + 2 : 0);
    if (colon == 0 || colon == std::string::npos) return {path, ""};
    if (!is_address(path) && file_system().status_of_name(path).kind != FileStatus::Kind::missing) return {path, ""};
    return {path.substr(0, colon), path.substr(colon + 1)};
}

}  // namespace isoatlas
