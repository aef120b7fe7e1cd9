#include "movie.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "suggest.h"

extern char** environ;

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

bool is_film(const std::string& output) { return output.ends_with(".mp4"); }

std::string find_ffmpeg() {
    const char* path = std::getenv("PATH");
    const std::string folders = path == nullptr ? "" : path;
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        const std::string candidate = folders.substr(begin, end - begin) + "/ffmpeg";
        if (end > begin && ::access(candidate.c_str(), X_OK) == 0) return candidate;
        begin = end + 1;
    }
    return "";
}

/// Single pictures beside the output, gone when this goes.
class FrameFolder {
public:
    explicit FrameFolder(const std::string& output) : path_(output + ".frames") {
        std::error_code failed;
        fs::create_directories(path_, failed);
        if (failed) throw Error(ErrorKind::resource, {.file = path_, .what = failed.message(), .next = "choose another folder with -o"});
    }
    ~FrameFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

/// Exit code of a program; -1: it could not be started.
int run_program(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (::posix_spawn(&process, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) != 0) return -1;
    int status = 0;
    while (::waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void check_movie(const std::string& output) {
    if (!is_film(output) || !find_ffmpeg().empty()) return;
    throw Error(ErrorKind::unsupported, {.file = output,
                                         .what = "ffmpeg, which makes .mp4 files, is not installed",
                                         .next = "install ffmpeg (apt-get install ffmpeg), or write .webp, .gif or .png"});
}

void write_movie(const std::string& output, const Animation& animation) {
    if (!is_film(output)) {
        write_animation(output, animation);
        return;
    }
    const FrameFolder folder(output);
    for (std::size_t i = 0; i < animation.frames.size(); ++i) write_image(folder.file(fmt::format("{:06}.png", i)), animation.frames[i]);
    const std::string film = folder.file("film.mp4");
    const int code = run_program({find_ffmpeg(), "-nostdin", "-y", "-loglevel", "error", "-framerate",
                                  fmt::format("{}", animation.frames_per_second), "-i", folder.file("%06d.png"), "-vf",
                                  "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart", film});
    std::error_code failed;
    if (code == 0) fs::rename(film, output, failed);
    if (code != 0 || failed) {
        throw Error(ErrorKind::resource, {.file = output,
                                          .what = code != 0 ? fmt::format("ffmpeg failed with exit code {}", code) : failed.message(),
                                          .next = "write .webp, .gif or .png"});
    }
}

}  // namespace isoatlas::cli
