#include "data/movie.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "options/suggest.h"
#include "text/interrupt.h"

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

/// Frames as image files in a temporary folder beside the output; the destructor removes it.
class FrameFolder {
public:
    explicit FrameFolder(const fs::path& output) : path_((output.parent_path() / ".isoatlas-frames-XXXXXX").string()) {
        if (::mkdtemp(path_.data()) == nullptr)
            throw Error(ErrorKind::resource, {.file = path_, .what = std::strerror(errno), .next = "choose another folder with -o"});
    }
    ~FrameFolder() {
        std::error_code ignored;
        for (const std::string& name : names_) fs::remove(path_ + "/" + name, ignored);
        fs::remove(path_, ignored);
    }
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;
    /// Path of a file of that name in the folder; it is removed too.
    [[nodiscard]] std::string file(const std::string& name) {
        names_.push_back(name);
        return path_ + "/" + name;
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
    std::vector<std::string> names_;
};

/// Synced to disk before it is renamed, as all outputs.
std::string give_name(const std::string& film, const std::string& output) {
    const int file = ::open(film.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) return std::strerror(errno);
    const bool is_written = ::fsync(file) == 0;
    std::string reason = std::strerror(errno);
    (void)::close(file);
    if (!is_written) return reason;
    return ::rename(film.c_str(), output.c_str()) == 0 ? "" : std::strerror(errno);
}

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
        const WritingGuard guard;
        write_animation(output, animation);
        return;
    }
    const std::string target = output_target(output);
    FrameFolder folder(target);
    for (std::size_t i = 0; i < animation.frames.size(); ++i) {
        stop_if_interrupted();
        write_image(folder.file(fmt::format("{:06}.png", i)), animation.frames[i]);
    }
    const std::string film = folder.file("film.mp4");
    const int code = run_program({find_ffmpeg(), "-nostdin", "-y", "-loglevel", "error", "-framerate",
                                  fmt::format("{}", animation.frames_per_second), "-i", folder.path() + "/%06d.png", "-vf",
                                  "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart", film});
    stop_if_interrupted();
    const std::string failed = code != 0 ? fmt::format("ffmpeg failed with exit code {}", code) : give_name(film, target);
    if (!failed.empty()) throw Error(ErrorKind::resource, {.file = output, .what = failed, .next = "write .webp, .gif or .png"});
}

}  // namespace isoatlas::cli
