// A build that is killed and begun again with other options writes what an uninterrupted build with those options writes, byte for byte.
//
// Pairs of option sets are drawn; most differ in one or two members, because such phases look most alike. The build with the first set is
// killed at a drawn operation on its files: from there on every operation fails without effect, so the disk is what a killed process
// leaves. More pairs: ISOATLAS_PAIRS=100; other ones: ISOATLAS_SEED.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

#include <unistd.h>

#include "base/portable.h"
#include "faults/faulty_files.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

/// What a user may type, and what a sidecar may say.
struct OptionSet {
    int samples = 0;  ///< which file lies there
    std::string spacing_in_sidecar = "[1, 1, 1]", unit_in_sidecar = "mm";
    std::optional<Vec3> spacing, origin;
    std::optional<std::int64_t> time_step = 0;
    bool is_4d = false;
    BuildOptions build;
    int threads = 0;
};

int number_in(const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atoi(text);
}

class ResumedBuild : public testing::Test {
protected:
    static constexpr std::int64_t kSize = 12;

    ResumedBuild() : folder_(fs::temp_directory_path() / ("isoatlas_resumed_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
        Random random(5);
        for (std::string& text : samples_) {
            const std::int64_t voxels = 2 * kSize * kSize * kSize;
            for (std::int64_t i = 0; i < voxels; ++i) text += static_cast<char>(random.unit() * 40);
        }
    }
    ~ResumedBuild() override { fs::remove_all(folder_); }
    ResumedBuild(const ResumedBuild&) = delete;
    ResumedBuild& operator=(const ResumedBuild&) = delete;

    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
    static void write(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
    [[nodiscard]] std::string read(const char* name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    /// The file as it is when somebody builds with this set.
    [[nodiscard]] std::string place(const OptionSet& set) const {
        const std::string size = std::to_string(kSize), sizes = size + " " + size + " " + size;
        if (set.is_4d) {
            write(path("flow.nrrd"),
                  "NRRD0004\ntype: uint8\ndimension: 4\nsizes: " + sizes + " 2\nencoding: raw\n\n" + samples_[set.samples]);
            return path("flow.nrrd");
        }
        write(path("scan.raw"), samples_[set.samples].substr(0, static_cast<std::size_t>(kSize * kSize * kSize)));
        const std::string spacing = set.spacing ? "" : ", \"spacing\": " + set.spacing_in_sidecar;
        write(path("scan.raw.json"), "{\"dims\": [" + size + ", " + size + ", " + size + "], \"type\": \"uint8\"" + spacing +
                                         ", \"unit\": \"" + set.unit_in_sidecar + "\"}");
        return path("scan.raw");
    }

    BuildReport build(const char* store, const OptionSet& set) const {
        OpenOptions open;
        if (set.is_4d) open.time_step = set.time_step;
        if (!set.is_4d) open.spacing = set.spacing, open.origin = set.origin;  // the other file says them itself
        const std::unique_ptr<VolumeReader> reader = open_volume(place(set), open);
        BuildOptions options = set.build;
        if (set.is_4d) options.time_step = set.time_step;
        Context context;
        context.threads = set.threads;
        return build_atlas(path(store), *reader, options, context);
    }

    /// Operations on files of a build that is not killed.
    [[nodiscard]] std::int64_t operations_of(const OptionSet& set) const {
        test::FaultyFiles disk({});
        const ReplacedFileSystem in_use(disk);
        (void)build("counted.atlas", set);
        return disk.operations();
    }

    /// Returns whether it was killed before it was done.
    bool build_and_kill(const OptionSet& set, std::int64_t at) const {
        test::FaultyFiles disk({.at = at, .for_ever = true});
        const ReplacedFileSystem in_use(disk);
        try {
            (void)build("killed.atlas", set);
        } catch (const Error&) {
            return true;
        }
        return false;
    }

    fs::path folder_;
    std::array<std::string, 2> samples_;
};

/// Draws option sets.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : random_(seed) {}
    std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_.unit() * static_cast<double>(n)); }

    /// One member of a set anew; it may stay what it was.
    void change(OptionSet& set) {
        const std::vector<std::function<void()>> changes = {
            [&] { set.samples = static_cast<int>(below(2)); },
            [&] { set.spacing_in_sidecar = below(2) == 0 ? "[1, 1, 1]" : "[2, 2, 2]"; },
            [&] { set.unit_in_sidecar = below(2) == 0 ? "mm" : "um"; },
            [&] { set.spacing = below(2) == 0 ? std::nullopt : std::optional(Vec3{1, 1, static_cast<double>(1 + below(3))}); },
            [&] { set.origin = below(2) == 0 ? std::nullopt : std::optional(Vec3{0, static_cast<double>(below(3)), 0}); },
            [&] { set.time_step = below(2); },
            [&] { set.is_4d = below(2) == 0; },
            [&] {
                set.build.geometry.reset();
                if (below(2) == 0) set.build.geometry.emplace().space = "voxel";
            },
            [&] { set.build.analysis.interpolant = below(2) == 0 ? Interpolant::faces : Interpolant::trilinear; },
            [&] { set.build.analysis.tunnel_height = static_cast<double>(below(3)); },
            [&] { set.build.tunnel_height_percent = below(2) == 0 ? 0 : static_cast<double>(1 + below(4)); },
            [&] { set.build.gaussian = below(2) == 0 ? 0 : 0.4 + 0.1 * static_cast<double>(below(3)); },
            [&] {
                using Action = MissingPolicy::Action;
                constexpr Action kActions[] = {Action::error, Action::replace, Action::replace};
                set.build.missing.action = kActions[below(3)];
                set.build.missing.value = static_cast<double>(below(2));
                set.build.missing.no_data.reset();
                if (set.build.missing.action == Action::replace && below(2) == 0)
                    set.build.missing.no_data = 20.0 + static_cast<double>(below(2));
            },
            [&] { set.threads = static_cast<int>(below(4)); },
            [&] { set.build.memory = below(2) == 0 ? 0 : std::int64_t{1} << 30; },
            [&] { set.build.restart = below(8) == 0; },
        };
        changes[static_cast<std::size_t>(below(std::ssize(changes)))]();
    }

private:
    Random random_;
};

TEST_F(ResumedBuild, WithOtherOptionsItWritesWhatAnUninterruptedOneWrites) {
    const int pairs = number_in("ISOATLAS_PAIRS", 30), seed = number_in("ISOATLAS_SEED", 15);
    std::cout << "seed " << seed << ", " << pairs << " pairs\n";
    Chance chance(static_cast<std::uint64_t>(seed));
    int killed = 0, resumed = 0, not_used = 0;
    for (int pair = 0; pair < pairs && !HasFailure(); ++pair) {
        OptionSet first;
        for (std::int64_t i = chance.below(12); i > 0; --i) chance.change(first);
        OptionSet second = first;
        first.build.restart = false;
        for (std::int64_t i = pair % 4 == 0 ? 0 : pair % 4 == 3 ? 16 : 1 + chance.below(3); i > 0; --i) chance.change(second);
        (void)build("wanted.atlas", second);
        killed += build_and_kill(first, chance.below(operations_of(first)));
        if (pair % 5 == 4) killed += build_and_kill(second, chance.below(operations_of(second)));
        const BuildReport report = build("killed.atlas", second);
        resumed += report.resumed.empty() ? 0 : 1;
        not_used += report.not_used.empty() ? 0 : 1;
        EXPECT_TRUE(read("killed.atlas") == read("wanted.atlas")) << "pair " << pair;
        EXPECT_FALSE(fs::exists(path("killed.atlas.build"))) << "pair " << pair;
        fs::remove(path("killed.atlas"));
    }
    std::cout << killed << " builds killed; " << resumed << " went on from a phase, " << not_used << " did not use one\n";
    EXPECT_GT(killed, pairs / 2);
    EXPECT_GT(resumed, 0);
    EXPECT_GT(not_used, 0);
}

}  // namespace
}  // namespace isoatlas
