// What a build says of itself is read again, by anybody, for as long as it runs.
#include <gtest/gtest.h>

#include <filesystem>

#include "atlas/build_folder.h"
#include "atlas/lock_text.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"

namespace isoatlas {
namespace {

const BuildState kState{.phase = "sublevel zones",
                        .phase_index = 3,
                        .phase_count = 8,
                        .fraction = 0.43,
                        .seconds_left = 12.5,
                        .voxels_per_second = 3e6,
                        .peak_memory = std::int64_t{1} << 33};

TEST(LockText, IsReadAgain) {
    EXPECT_EQ(state_in(lock_text(kState)), kState);
    BuildState early = kState;
    early.seconds_left.reset();
    early.voxels_per_second.reset();
    EXPECT_EQ(state_in(lock_text(early) + "and what an earlier, longer text has left"), early);
    EXPECT_EQ(holder_in(lock_text({})), std::to_string(::getpid()));
    EXPECT_EQ(state_in(lock_text({})), BuildState{});
}

TEST(LockText, AnythingElseIsABuildThatHasBegun) {
    const std::string good = lock_text(kState);
    for (std::size_t size = 0; size < good.size(); ++size) EXPECT_EQ(state_in(good.substr(0, size)), BuildState{}) << size;
    for (const char* line :
         {"", "x", "1 8 0 0.5 1 1", "-1 8 0 0.5 1 1 p", "8 8 0 0.5 1 1 p", "1 8 0 1.5 1 1 p", "1 8 0 nan 1 1 p", "1 1000 0 0.5 1 1 p"})
        EXPECT_EQ(state_in(std::string(kBuildMark) + "1\n" + line + "\n"), BuildState{}) << line;
    EXPECT_EQ(state_in(std::string(kBuildMark) + "1\n1 8 0 0.5 inf nan p\n").phase, "p");
    EXPECT_EQ(state_in(std::string(kBuildMark) + "1\n1 8 0 0.5 inf nan p\n").seconds_left, std::nullopt);
    EXPECT_EQ(state_in("1\n1 8 0 0.5 1 1 p\n"), BuildState{}) << "without the mark";
    EXPECT_EQ(holder_in("1\n"), "");
}

TEST(BuildClock, GoesForwardsOnly) {
    for (const int phases : {8, 14}) {  // of one polarity, of both
        BuildClock clock;
        double before = 0;
        for (int phase = 0; phase < phases; ++phase) {
            for (const double fraction : {0.0, 0.5, 0.2, 1.0}) {
                const BuildState state = clock.at({"phase", phase, phases, fraction});
                EXPECT_GE(state.fraction, before);
                EXPECT_LE(state.fraction, 1);
                before = state.fraction;
            }
        }
        EXPECT_DOUBLE_EQ(before, 1);
    }
}

class BuildStates : public oracle::Stores {};

TEST_F(BuildStates, AreThereWhileItRuns) {
    EXPECT_FALSE(build_state(path_));
    bool asked = false;
    Context context;
    context.progress = [&](const Progress&) { asked = asked || build_state(path_).has_value(); };
    build_atlas(path_, make_phantom("demo", {.size = 32}), {}, context);
    EXPECT_TRUE(asked);
    EXPECT_FALSE(build_state(path_));
}

TEST_F(BuildStates, OfBothPolaritiesAreNumberedThrough) {
    std::vector<int> phases;
    Context context;
    context.progress = [&](const Progress& progress) {
        EXPECT_EQ(progress.phase_count, 14);
        if (phases.empty() || phases.back() != progress.phase_index) phases.push_back(progress.phase_index);
    };
    build_atlas(path_, make_phantom("demo", {.size = 32}), {}, context, PolarityChoice::both);
    EXPECT_TRUE(std::ranges::is_sorted(phases));
    EXPECT_EQ(phases.back(), 13);
}

TEST_F(BuildStates, AskingIsInNobodysWay) {
    std::atomic<bool> done = false;
    std::thread asker([&] {
        while (!done) (void)build_state(path_);
    });
    for (int i = 0; i < 200; ++i) EXPECT_NO_THROW(BuildFolder(path_, false));
    done = true;
    asker.join();
}

}  // namespace
}  // namespace isoatlas
