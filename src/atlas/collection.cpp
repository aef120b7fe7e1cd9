#include "isoatlas/collection.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/file_system.h"
#include "formats/common/file_access.h"
#include "formats/common/json_file.h"
#include "formats/volume/choose.h"
#include "isoatlas/error.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kIndex = "collection.json";
constexpr const char* kSchema = "isoatlas/collection/1";
constexpr const char* kDamaged = "the index of stores is damaged";
constexpr const char* kNext = "build the stores again: those that are there are kept";
constexpr std::int64_t kMaxVolumes = 1'000'000;

[[noreturn]] void damaged(const std::string& path, const std::string& where, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path, .where = where, .what = kDamaged, .expected = expected, .next = kNext});
}

std::string index_of(const std::string& path) { return path.ends_with(kIndex) ? path : path + (path.ends_with('/') ? "" : "/") + kIndex; }

/// The folder of the index, as a prefix of names: "" of the current one.
std::string folder_of_index(const std::string& index) { return index.substr(0, index.size() - std::string_view(kIndex).size()); }

/// A plain name of a file of the folder.
bool is_plain(const std::string& name) {
    return name.ends_with(".atlas") && name.size() <= 255 && is_utf8(name) && name.find('/') == std::string::npos &&
           name.find('\\') == std::string::npos && name.find('\0') == std::string::npos && !name.starts_with('.');
}

const Json& member(const Json& json, const char* name, const std::string& path, const std::string& where) {
    const auto found = json.is_object() ? json.find(name) : json.end();
    if (!json.is_object() || found == json.end()) damaged(path, where + name, "a member of this name");
    return *found;
}

std::string text_at(const Json& json, const char* name, const std::string& path, const std::string& where) {
    const Json& value = member(json, name, path, where);
    if (!value.is_string()) damaged(path, where + name, "a text");
    return value.get<std::string>();
}

std::int64_t count_at(const Json& json, const char* name, std::int64_t least, std::int64_t end, const std::string& path,
                      const std::string& where) {
    const Json& value = member(json, name, path, where);
    const bool is_good =
        value.is_number_integer() && value.get<double>() >= static_cast<double>(least) && value.get<double>() < static_cast<double>(end);
    if (!is_good) damaged(path, where + name, "a number from " + std::to_string(least) + " to " + std::to_string(end - 1));
    return value.get<std::int64_t>();
}

Channels channels_at(const Json& json, const std::string& path) {
    Channels channels;
    const Json& names = member(json, "channels", path, "");
    if (!names.is_array() || names.empty() || std::ssize(names) > kMaxVolumes) damaged(path, "channels", "an array of names, at least one");
    channels.names.clear();
    for (const Json& name : names) {
        if (!name.is_string()) damaged(path, "channels", "names");
        channels.names.push_back(name.get<std::string>());
    }
    const std::int64_t most = kMaxVolumes / std::ssize(channels.names);
    channels.time_steps = count_at(json, "time_steps", 1, most + 1, path, "");
    const Json& times = member(json, "times", path, "");
    const bool is_good = times.is_array() && (times.empty() || std::ssize(times) == channels.time_steps) &&
                         std::ranges::all_of(times, [](const Json& time) { return time.is_number(); });
    if (!is_good) damaged(path, "times", "an array, empty or with a number for each time step");
    for (const Json& time : times) channels.times.push_back(time.get<double>());
    channels.time_unit = text_at(json, "time_unit", path, "");
    return channels;
}

}  // namespace

Channels channels_of(const FileVolumes& volumes) {
    Channels channels;
    if (!volumes.channels.empty()) channels.names = volumes.channels;
    channels.time_steps = volumes.time_steps;
    const bool has_times = std::ranges::all_of(volumes.times, [](double time) { return std::isfinite(time); });
    if (has_times) channels.times = volumes.times;
    channels.time_unit = volumes.time_unit;
    return channels;
}

std::string Collection::path_of(std::int64_t number) const {
    const std::string& name = stores.at(static_cast<std::size_t>(number));
    return folder.empty() ? name : folder + (folder.ends_with('/') ? "" : "/") + name;
}

std::string store_name(const Channels& channels, std::int64_t volume) {
    const auto part = [](const char* word, std::int64_t number, std::int64_t count) {
        if (count == 1) return std::string();
        const std::string digits = std::to_string(number);
        return std::string(word) + "-" + std::string(std::to_string(count - 1).size() - digits.size(), '0') + digits;
    };
    const std::string channel = part("channel", channels.channel_of(volume), std::ssize(channels.names));
    const std::string time = part("time", channels.time_step_of(volume), channels.time_steps);
    const std::string name = channel + (channel.empty() || time.empty() ? "" : "_") + time;
    return (name.empty() ? "volume" : name) + ".atlas";
}

bool is_collection(const std::string& path) {
    if (std::filesystem::path(path).filename() == kIndex) return true;
    if (is_address(path)) return false;  // a server has no folders: the index is named
    return is_directory(path) && file_exists(index_of(path));
}

Collection read_collection(const std::string& path) {
    const std::string index = index_of(path);
    const Json json = read_json_file(index, kSchema, kDamaged, kNext);
    std::string folder = folder_of_index(index);
    if (folder.size() > 1) folder.pop_back();  // the slash
    Collection collection;  // member by member: g++ 12 destroys what an aggregate has not made yet when an initializer throws
    collection.folder = folder;
    collection.volume = text_at(json, "volume", index, "");
    collection.channels = channels_at(json, index);
    collection.stores.resize(static_cast<std::size_t>(collection.channels.count()));
    const Json& stores = member(json, "stores", index, "");
    if (!stores.is_array() || std::ssize(stores) != collection.channels.count())
        damaged(index, "stores", "one for each channel and time step");
    const std::int64_t channels = std::ssize(collection.channels.names);
    for (std::size_t i = 0; i < stores.size(); ++i) {
        const std::string where = "stores[" + std::to_string(i) + "].";
        const std::int64_t channel = count_at(stores[i], "channel", 0, channels, index, where);
        const std::int64_t step = count_at(stores[i], "time_step", 0, collection.channels.time_steps, index, where);
        std::string& name = collection.stores[static_cast<std::size_t>(channel + step * channels)];
        if (!name.empty()) damaged(index, where, "each channel and time step once");
        name = text_at(stores[i], "file", index, where);
        if (!is_plain(name)) damaged(index, where + "file", "the name of a file of the folder that ends in .atlas");
    }
    return collection;
}

void write_collection(const Collection& collection) {
    const Channels& channels = collection.channels;
    const auto text_of = [](const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
    std::string text = "{\n";
    const auto add = [&](const char* name, const Json& value) { text += "  \"" + std::string(name) + "\": " + text_of(value) + ",\n"; };
    add("schema", kSchema);
    add("volume", collection.volume);
    add("channels", channels.names);
    add("time_steps", channels.time_steps);
    add("times", channels.times);
    add("time_unit", channels.time_unit);
    text += "  \"stores\": [";
    for (std::int64_t i = 0; i < channels.count(); ++i) {
        const Json store{{"channel", channels.channel_of(i)},
                         {"time_step", channels.time_step_of(i)},
                         {"file", collection.stores.at(static_cast<std::size_t>(i))}};
        text += (i == 0 ? "\n    " : ",\n    ") + text_of(store);
    }
    AtomicFile file(index_of(collection.folder));
    file.write(text + "\n  ]\n}\n");
    file.commit();
}

std::int64_t choose_volume(const Collection& collection, const OpenOptions& options) {
    const std::int64_t channel = choose_channel(collection.folder, options, collection.channels.names);
    return channel +
           choose_time_step(collection.folder, options, collection.channels.time_steps).index * std::ssize(collection.channels.names);
}

}  // namespace isoatlas
