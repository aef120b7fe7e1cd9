// Every phantom has the answer that src/phantom/makers.h promises, and the same bytes everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "isoatlas/analysis.h"
#include "isoatlas/phantom.h"
#include "oracle/compare.h"

namespace isoatlas {
namespace {

using oracle::Index;

struct Expected {
    double value;
    Criticality kind;
    Index chi, b1, b2;  // of the object below
};

void expect_events(const Analysis& analysis, const std::vector<Expected>& expected, double tolerance) {
    ASSERT_EQ(analysis.event_count(), static_cast<Index>(expected.size()));
    for (const EventId i : ids<EventId>(analysis.event_count())) {
        const Event event = analysis.event(i);
        const Expected& e = expected[i.index()];
        SCOPED_TRACE(i.number());
        EXPECT_NEAR(event.value, e.value, tolerance);
        EXPECT_STREQ(name_of(event.kind), name_of(e.kind));
        EXPECT_EQ(event.chi, e.chi);
        EXPECT_EQ(event.b1, e.b1);
        EXPECT_EQ(event.b2, e.b2);
    }
}

oracle::Snapshot cut_at(const Volume& volume, double tau) {
    const oracle::Elements elements(oracle::to_grid(volume));
    return oracle::snapshot(elements, elements.cut_at(tau));
}

/// FNV-1a of the samples.
std::uint64_t hash(const Volume& volume) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const std::byte b : volume.bytes) h = (h ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    return h;
}

constexpr auto kMaximum = Criticality::maximum, kMerge = Criticality::merge, kGenus = Criticality::genus, kComplex = Criticality::complex,
               kSplit = Criticality::split, kMinimum = Criticality::minimum;

TEST(Phantom, FigurePlateauHasExactlyItsFourteenEvents) {
    const Analysis analysis = analyse(make_phantom("figure-plateau"));
    expect_events(analysis,
                  {{100, kMaximum, 1, 0, 0},
                   {90, kMaximum, 1, 0, 0},
                   {80, kMaximum, 1, 0, 0},
                   {70, kMaximum, 1, 0, 0},
                   {60, kMerge, 1, 0, 0},
                   {58, kGenus, 0, 1, 0},
                   {56, kGenus, 1, 0, 0},
                   {50, kMerge, 1, 0, 0},
                   {48, kGenus, 0, 1, 0},
                   {46, kGenus, 1, 0, 0},
                   {40, kMerge, 1, 0, 0},
                   {38, kGenus, 0, 1, 0},
                   {30, kComplex, 2, 0, 1},
                   {20, kMinimum, 1, 0, 0}},
                  0);
    EXPECT_EQ(analysis.level_count(), 14);
    const Level torus_to_spheres = analysis.level(12);
    EXPECT_EQ(torus_to_spheres.in, (std::vector<Index>{1}));
    EXPECT_EQ(torus_to_spheres.out, (std::vector<Index>{0, 0}));
}

TEST(Phantom, FigureSmoothHasExactlyFifteenElements) {
    const Volume volume = make_phantom("figure-smooth");
    const Analysis analysis = analyse(volume);
    EXPECT_EQ(analysis.element_count(), 15);
    expect_events(analysis,
                  {{100, kMaximum, 1, 0, 0},
                   {90, kMaximum, 1, 0, 0},
                   {80, kMaximum, 1, 0, 0},
                   {70, kMaximum, 1, 0, 0},
                   {60, kMerge, 1, 0, 0},
                   {58, kGenus, 0, 1, 0},
                   {56, kGenus, 1, 0, 0},
                   {50, kMerge, 1, 0, 0},
                   {48, kGenus, 0, 1, 0},
                   {46, kGenus, 1, 0, 0},
                   {40, kMerge, 1, 0, 0},
                   {38, kGenus, 0, 1, 0},
                   {30, kGenus, 1, 0, 0},
                   {29.5, kSplit, 2, 0, 1},
                   {20, kMinimum, 1, 0, 0}},
                  0.06);
}

TEST(Phantom, TorusChainIsOneObjectOfItsGenus) {
    for (const Index genus : {1, 2, 5}) {
        for (const Index size : {24, 33}) {
            PhantomOptions options;
            options.genus = genus;
            options.size = size;
            const Volume volume = make_phantom("torus-chain", options);
            for (const double tau : {0.3, 0.5, 0.7}) {
                const oracle::Snapshot s = cut_at(volume, tau);
                ASSERT_EQ(s.objects.size(), 1u) << "genus " << genus << " size " << size << " tau " << tau;
                EXPECT_EQ(s.objects[0].b1, genus);
                EXPECT_EQ(s.objects[0].b2, 0);
            }
        }
    }
}

TEST(Phantom, NestedShellsAreHollowSpheres) {
    for (const Index shells : {1, 2, 3}) {
        PhantomOptions options;
        options.shells = shells;
        options.size = 16 * shells;
        const oracle::Snapshot s = cut_at(make_phantom("nested-shells", options), 0.5);
        ASSERT_EQ(static_cast<Index>(s.objects.size()), shells);
        for (const oracle::Object& object : s.objects) {
            EXPECT_EQ(object.b1, 0);
            EXPECT_EQ(object.b2, 1);
        }
    }
}

TEST(Phantom, DemoTellsItsStory) {
    expect_events(analyse(make_phantom("demo")),
                  {{250, kMaximum, 2, 0, 1},
                   {220, kMaximum, 1, 0, 0},
                   {200, kMaximum, 0, 1, 0},
                   {160, kMerge, 2, 0, 1},
                   {90, kMerge, 1, 1, 1},
                   {60, kMinimum, 0, 1, 0},
                   {0, kGenus, 1, 0, 0}},
                  0);
    EXPECT_EQ(make_phantom("demo").info.geometry.unit, "mm");
}

TEST(Phantom, MarschnerLobbIsCriticalInItsFirstAndLastSliceOnly) {
    const Analysis analysis = analyse(make_phantom("marschner-lobb"));
    const double last = static_cast<double>(analysis.extent().size[2] - 1);
    for (const ElementId i : ids<ElementId>(analysis.element_count())) {
        const Element e = analysis.element(i);
        EXPECT_TRUE(e.position[2] == 0 || e.position[2] == last || e.kind == ElementKind::face) << e.position[2];
        EXPECT_EQ(e.position[2], std::floor(e.position[2]));  // only faces across z are ambiguous
    }
}

TEST(Phantom, GyroidIsNegatedByAPointReflection) {
    const Volume volume = make_phantom("gyroid");
    const Index voxels = volume.info.extent.voxels();
    for (Index i = 0; i < voxels; ++i) ASSERT_NEAR(volume.value(i), -volume.value(voxels - 1 - i), 1e-6);
}

TEST(Phantom, CheckerboardCounts) {
    for (const Index n : {1, 2, 5, 8}) {
        PhantomOptions options;
        options.size = n;
        const Analysis analysis = analyse(make_phantom("checkerboard", options));
        Index maxima = 0;
        for (const EventId i : ids<EventId>(analysis.event_count())) {
            const Event event = analysis.event(i);
            maxima += event.objects_in == 0 ? 1 : 0;
            if (event.value != 0.5) continue;
            EXPECT_EQ(event.chi, (n * n * n + 1) / 2 - 3 * n * (n - 1) * (n - 1) + 3 * (n - 1) * (n - 1) * (n - 1));
        }
        EXPECT_EQ(maxima, (n * n * n + 1) / 2);
    }
}

TEST(Phantom, SameBytesOnEveryMachine) {
    const std::map<std::string, std::uint64_t> known{
        {"checkerboard", 14256855327241970469u},
        {"demo", 4534696831242528077u},
        {"figure-plateau", 6592104548331615189u},
        {"figure-smooth", 13428379032174342746u},
        {"gyroid", 8614418074360908253u},
        {"marschner-lobb", 2124792903726506535u},
        {"nested-shells", 3108028375235924869u},
        {"noise", 1382397537465384611u},
        {"noise 1000", 12007628341847871691u},
        {"random-field", 18444168627955848063u},
        {"random-field noisy", 1150597396796991883u},
        {"torus-chain", 1625930199244739285u},
    };
    PhantomOptions options;
    std::map<std::string, std::uint64_t> now;
    for (const PhantomDescription& phantom : phantoms()) now[phantom.name] = hash(make_phantom(phantom.name));
    options.noise = 0.1;
    options.quantise = 256;
    now["random-field noisy"] = hash(make_phantom("random-field", options));
    options.quantise = 1000;
    now["noise 1000"] = hash(make_phantom("noise", options));
    EXPECT_EQ(now, known);
}

TEST(Phantom, SeedsNoiseAndLevels) {
    PhantomOptions options;
    options.size = 12;
    const Volume first = make_phantom("noise", options), again = make_phantom("noise", options);
    EXPECT_EQ(first.bytes, again.bytes);
    options.seed = 2;
    EXPECT_NE(make_phantom("noise", options).bytes, first.bytes);
    options.quantise = 7;
    const Volume grey = make_phantom("noise", options);
    EXPECT_EQ(grey.info.type, ValueType::u8);
    const auto samples = grey.samples<std::uint8_t>();
    EXPECT_EQ(std::set<std::uint8_t>(samples.begin(), samples.end()).size(), 7u);
    options.quantise = 300;
    EXPECT_EQ(make_phantom("noise", options).info.type, ValueType::u16);

    PhantomOptions noisy;
    noisy.noise = 0.05;
    const Volume clean = make_phantom("figure-plateau"), rough = make_phantom("figure-plateau", noisy);
    double largest = 0;
    for (Index i = 0; i < clean.info.extent.voxels(); ++i) largest = std::max(largest, std::fabs(clean.value(i) - rough.value(i)));
    EXPECT_GT(largest, 4.5);
    EXPECT_LE(largest, 5.0001);
}

TEST(Phantom, RefusesWhatMakesNoSenseAndSaysWhatDoes) {
    const auto message = [](const std::string& name, const PhantomOptions& options) {
        try {
            static_cast<void>(make_phantom(name, options));
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage ? std::string(error.what()) : "wrong kind of error";
        }
        return std::string("no error");
    };
    EXPECT_NE(message("giroid", {}).find("did you mean 'gyroid'?"), std::string::npos);
    EXPECT_NE(message("teapot-in-a-storm", {}).find("figure-smooth"), std::string::npos);
    const auto with = [](auto change) {
        PhantomOptions options;
        change(options);
        return options;
    };
    EXPECT_NE(message("figure-smooth", with([](auto& o) { o.size = 64; })).find("fixed size"), std::string::npos);
    EXPECT_NE(message("noise", with([](auto& o) { o.size = -1; })).find("1 to 4096"), std::string::npos);
    EXPECT_NE(message("noise", with([](auto& o) { o.quantise = 1; })).find("2 to 65536"), std::string::npos);
    EXPECT_NE(message("noise", with([](auto& o) { o.noise = std::nan(""); })).find("0 to 1"), std::string::npos);
    EXPECT_NE(message("torus-chain", with([](auto& o) { o.genus = 0; })).find("1 to 1000"), std::string::npos);
    EXPECT_NE(message("nested-shells", with([](auto& o) { o.shells = 9; })).find("1 to 4 shells"), std::string::npos);
}

}  // namespace
}  // namespace isoatlas
