// Runs a fuzz target once over every file of the folders given, and over every truncation of each. An empty folder is a failure:
// a replay that replays nothing proves nothing.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** arguments) {
    constexpr std::size_t kAllCuts = 4096;  // larger seeds are replayed whole only
    int replayed = 0;
    for (int i = 1; i < count; ++i) {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i])) {
            if (entry.is_regular_file()) paths.push_back(entry.path());
        }
        std::sort(paths.begin(), paths.end());
        for (const std::filesystem::path& path : paths) {
            std::printf("%s\n", path.filename().c_str());
            std::fflush(stdout);  // the last name printed is the one that failed
            std::ifstream file(path, std::ios::binary);
            const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
            const std::vector<std::uint8_t> bytes(text.begin(), text.end());
            for (std::size_t size = bytes.size() <= kAllCuts ? 0 : bytes.size(); size < bytes.size(); ++size) {
                const std::vector<std::uint8_t> cut(bytes.begin(),
                                                    bytes.begin() + static_cast<std::ptrdiff_t>(size));  // its end is the heap's
                LLVMFuzzerTestOneInput(cut.data(), cut.size());
            }
            LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
            ++replayed;
        }
    }
    std::printf("%d seeds replayed\n", replayed);
    return replayed > 0 ? 0 : 1;
}
