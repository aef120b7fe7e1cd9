#include "volumes.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace bench {
namespace {

using isoatlas::ValueType;
using isoatlas::Volume;

struct Field {
    const char* phantom;
    double noise;
    std::int64_t grey_levels;
    ValueType type;
};

Field field_of(const std::string& kind) {
    if (kind == "smooth") return {"random-field", 0, 0, ValueType::f32};
    if (kind == "noisy") return {"random-field", 0.02, 0, ValueType::f32};
    if (kind == "u8") return {"random-field", 0, 256, ValueType::u8};
    if (kind == "white") return {"noise", 0, 0, ValueType::f32};
    throw std::runtime_error("no such field: " + kind);
}

bool read_cached(const std::string& path, Volume& volume) {
    std::error_code error;
    if (std::filesystem::file_size(path, error) != volume.bytes.size() || error) return false;
    std::ifstream file(path, std::ios::binary);
    return static_cast<bool>(file.read(reinterpret_cast<char*>(volume.bytes.data()), static_cast<std::streamsize>(volume.bytes.size())));
}

void write_cache(const std::string& path, const Volume& volume) {
    std::ofstream file(path + ".partial", std::ios::binary);
    file.write(reinterpret_cast<const char*>(volume.bytes.data()), static_cast<std::streamsize>(volume.bytes.size()));
    file.close();
    if (file) std::filesystem::rename(path + ".partial", path);
}

Volume make_field(const std::string& kind, std::int64_t size, const Sources& sources) {
    const Field field = field_of(kind);
    Volume volume = isoatlas::make_volume({.rank = 3, .size = {size, size, size}}, field.type);
    const std::string path = sources.cache + "/" + kind + "-" + std::to_string(size) + ".raw";
    if (read_cached(path, volume)) return volume;
    volume = isoatlas::make_phantom(field.phantom, {.size = size, .seed = 1, .noise = field.noise, .quantise = field.grey_levels});
    write_cache(path, volume);
    return volume;
}

std::string data_path(const std::string& name, const Sources& sources) { return sources.data + "/" + name + "/" + name + ".nrrd"; }

}  // namespace

Volume make(const std::string& name, const Sources& sources) {
    if (std::filesystem::is_regular_file(name)) return isoatlas::load_volume(name);
    const std::size_t dash = name.rfind('-');
    if (dash == std::string::npos) {
        Volume volume = isoatlas::load_volume(data_path(name, sources));
        if (const std::string path = sources.cache + "/" + name + ".raw"; !std::filesystem::exists(path)) write_cache(path, volume);
        return volume;
    }
    return make_field(name.substr(0, dash), std::stoll(name.substr(dash + 1)), sources);
}

std::vector<std::string> default_names(const Sources& sources) {
    std::vector<std::string> names{"smooth-256", "noisy-256", "u8-256", "white-256"};
    for (const char* name : {"bonsai", "engine", "headsq", "seg3d_mr", "pet", "heptane", "emd3001", "frog_labels"}) {
        if (!sources.data.empty() && std::filesystem::exists(data_path(name, sources))) names.emplace_back(name);
    }
    return names;
}

}  // namespace bench
