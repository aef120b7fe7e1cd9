// Verifying damaged stores. Flipped bytes are told with the array they lie in; a store that lies under right checksums, as a bug of the
// builder would make it, fails the guarantee that it breaks.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "codec/brick_codec.h"
#include "codec/checksum.h"
#include "field/brick_grid.h"
#include "isoatlas/build.h"
#include "isoatlas/phantom.h"
#include "isoatlas/verify.h"
#include "oracle/write_file.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

/// Arrays of a store by name, free to be changed.
struct Opened {
    Contents contents;
    std::vector<std::vector<std::byte>> bytes;

    explicit Opened(const std::string& path) {
        const Container store(path);
        contents = store.contents();
        for (const StoredArray& array : contents.arrays) {
            bytes.emplace_back(static_cast<std::size_t>(array.bytes()));
            if (array.block == 0) store.read_unchecked(array, 0, bytes.back());
            if (array.block > 0) store.read(array, 0, bytes.back());
        }
    }
    template <class T>
    std::span<T> numbers(const std::string& name) {
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            if (contents.arrays[i].name == name) return {reinterpret_cast<T*>(bytes[i].data()), bytes[i].size() / sizeof(T)};
        }
        ADD_FAILURE() << "no array " << name;
        return {};
    }
    /// With right checksums.
    void write(const std::string& path) const {
        std::vector<PackedArray> arrays;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const StoredArray& array = contents.arrays[i];
            arrays.push_back(
                {array.name, array.type, array.shape, array.block, [this, i](const ByteSink& put) { put(bytes[i]); }, array.chunk});
        }
        pack_store(path, contents, arrays);
    }
};

class VerifyStore : public testing::Test {
protected:
    VerifyStore() : folder_(fs::temp_directory_path() / ("isoatlas_verify_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
        path_ = (folder_ / "good.atlas").string(), bad_ = (folder_ / "bad.atlas").string();
        build_atlas(path_, make_phantom("noise", {.size = 24, .quantise = 32}));
    }
    ~VerifyStore() override { fs::remove_all(folder_); }
    VerifyStore(const VerifyStore&) = delete;
    VerifyStore& operator=(const VerifyStore&) = delete;

    static std::vector<CheckResult> failures(const std::string& path, bool full) {
        Context context;
        context.threads = 1;
        std::vector<CheckResult> failed;
        for (const CheckResult& check : verify_atlas(Atlas(path), {.levels = 3, .full = full}, context)) {
            if (!check.holds) failed.push_back(check);
        }
        return failed;
    }

    /// Changes the store, which stays readable, and returns what fails: "name: detail", one a line.
    std::string after(const std::function<void(Opened&)>& change, bool full = true) const {
        Opened opened(path_);
        change(opened);
        opened.write(bad_);
        std::string text;
        for (const CheckResult& check : failures(bad_, full)) text += check.name + ": " + check.detail + "\n";
        return text;
    }

    /// Exchanges two samples of brick 0 that are not its extremes, under a right checksum of its own.
    static void change_brick(Opened& opened) {
        const std::size_t size = opened.numbers<std::uint16_t>("volume/bytes")[0];
        const auto begin = static_cast<std::size_t>(opened.numbers<std::uint64_t>("volume/offset")[0]);
        const std::span<std::byte> brick = opened.numbers<std::byte>("volume/data").subspan(begin, size);
        const Index3 box = BrickGrid({3, {24, 24, 24}}).box(BrickId(0)).size();
        const std::uint8_t low = opened.numbers<std::uint8_t>("volume/low")[0], high = opened.numbers<std::uint8_t>("volume/high")[0];
        std::vector<std::uint8_t> samples(static_cast<std::size_t>(box[0] * box[1] * box[2]));
        ASSERT_TRUE(decode_brick<std::uint8_t>(brick, box, low, samples));
        std::vector<std::byte> packed;
        for (std::size_t i = 0; packed.size() != size; ++i) {
            const std::uint8_t a = samples.at(i), b = samples.at(i + 1);
            if (a == b || std::min(a, b) == low || std::max(a, b) == high) continue;
            std::swap(samples[i], samples[i + 1]);
            packed.clear();
            encode_brick<std::uint8_t>(samples, box, low, static_cast<std::uint8_t>(brick.front()), packed);
            if (packed.size() != size) std::swap(samples[i], samples[i + 1]);
        }
        std::ranges::copy(packed, brick.begin());
        opened.numbers<std::uint64_t>("volume/checksum")[0] = checksum(brick);
    }

    fs::path folder_;
    std::string path_, bad_;
};

TEST_F(VerifyStore, AGoodOneHasNoFailures) {
    EXPECT_EQ(after([](Opened&) {}), "");
    EXPECT_EQ(after([](Opened&) {}, false), "");
}

TEST_F(VerifyStore, AFlippedByteIsToldWithItsArray) {
    const Container store(path_);
    std::ifstream file(path_, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const auto told = [&](std::int64_t place) {
        std::string bytes = whole;
        bytes[static_cast<std::size_t>(place)] = static_cast<char>(bytes[static_cast<std::size_t>(place)] ^ 0x10);
        oracle::write_file(bad_, bytes);
        try {
            const std::vector<CheckResult> failed = failures(bad_, false);
            return failed.empty() ? std::string("nothing") : failed.front().detail;
        } catch (const Error& error) {  // it is needed to open the store
            return std::string(error.what());
        }
    };
    for (const StoredArray& array : store.contents().arrays) {
        if (array.bytes() == 0) continue;  // a table of noise has no lines
        const std::string name = array.block == 0 ? "brick " : array.name;
        const auto place = array.chunk > 0 ? static_cast<std::int64_t>(store.index_of(array)[0]) + 10 : array.offset + array.bytes() / 2;
        EXPECT_NE(told(place).find(name), std::string::npos) << array.name;
        if (array.block == 0) continue;
        EXPECT_NE(told(array.checksums).find(array.name), std::string::npos) << array.name;
    }
    EXPECT_NE(told(20).find("header"), std::string::npos);
    EXPECT_NE(told(store.header().contents_offset + 30).find("contents"), std::string::npos);
}

TEST_F(VerifyStore, ABrickThatIsReadAtTheWrongIsovaluesIsTold) {
    for (const bool full : {false, true}) {
        const std::string high = after([](Opened& o) { o.numbers<std::uint8_t>("volume/high")[3] = 200; }, full);
        EXPECT_NE(high.find("brick 3"), std::string::npos) << high;
        const std::string low = after(  // another sample than the highest, at its true place
            [](Opened& o) {
                o.numbers<std::uint8_t>("volume/high")[2] = o.numbers<std::uint8_t>("volume/low")[2];
                o.numbers<std::uint16_t>("volume/highest")[2] = o.numbers<std::uint16_t>("volume/lowest")[2];
            },
            full);
        EXPECT_NE(low.find("brick 2"), std::string::npos) << low;
    }
}

TEST_F(VerifyStore, OtherSamplesAreTold) {
    EXPECT_NE(after(change_brick, false).find("checksums_are_right: "), std::string::npos);
    EXPECT_NE(after(change_brick, false).find("samples differ"), std::string::npos);
}

TEST_F(VerifyStore, TreesOfOtherSamplesAreTold) {
    build_atlas(path_, make_phantom("random-field", {.size = 40}));
    const Volume other = make_phantom("random-field", {.size = 40, .seed = 2});
    const std::string other_path = (folder_ / "other.atlas").string();
    build_atlas(other_path, other);
    Opened other_store(other_path);
    for (const bool full : {false, true}) {
        const std::string told = after(
            [&](Opened& o) {
                for (std::size_t i = 0; i < o.bytes.size(); ++i) {
                    if (o.contents.arrays[i].name.starts_with("volume/")) continue;
                    o.contents.arrays[i] = other_store.contents.arrays[i];
                    o.bytes[i] = other_store.bytes[i];
                }
            },
            full);
        EXPECT_NE(told, "");
        EXPECT_EQ(told.find("checksums_are_right"), std::string::npos) << told;
        EXPECT_EQ(full, told.find("stored_tree_equals_analysis: elements/") != std::string::npos) << told;
    }
}

TEST_F(VerifyStore, AWrongValueInTheTreesIsToldWithItsPlace) {
    build_atlas(path_, make_phantom("random-field", {.size = 40}));
    const std::string value = after([](Opened& o) {
        const auto values = o.numbers<double>("elements/value");
        values[7] = (values[6] + values[7]) / 2;  // still in order
    });
    EXPECT_NE(value.find("elements/value[7] is "), std::string::npos) << value;
}

TEST_F(VerifyStore, AnElementOfNoiseThatTheSamplesDoNotHaveIsTold) {
    const std::string order = after([](Opened& o) {
        const auto places = o.numbers<std::uint32_t>("elements/place");
        std::swap(places[0], places[places.size() - 1]);
    });
    EXPECT_NE(order.find("not in the order of the grid"), std::string::npos) << order;
    const std::string form = after([](Opened& o) {
        const auto forms = o.numbers<std::uint16_t>("elements/form");
        const auto face = std::ranges::find_if(forms, [](std::uint16_t bits) { return (bits & 3) == 1; });
        *face ^= 1 << 6;  // the other diagonal
    });
    EXPECT_NE(form.find("critical elements are not"), std::string::npos) << form;
}

TEST_F(VerifyStore, AWrongNumberInTheTreesIsToldWithItsPlace) {
    const std::string voxels = after([](Opened& o) {
        const auto counts = o.numbers<std::uint32_t>("elements/voxels");
        ++counts[4], --counts[5];  // the sum stays
    });
    EXPECT_NE(voxels.find("events/voxels["), std::string::npos) << voxels;
    for (const std::string name : {"elements/place", "elements/form", "elements/towards_outside"}) {
        const std::string told = after([&](Opened& o) {
            for (std::size_t i = 0; i < o.bytes.size(); ++i) {
                if (o.contents.arrays[i].name == name) o.bytes[i][o.bytes[i].size() / 2] ^= std::byte{1};
            }
        });
        EXPECT_NE(told, "") << name;
    }
}

TEST_F(VerifyStore, AWrongEventIsToldWithItsPlace) {
    build_atlas(path_, make_phantom("random-field", {.size = 40}));
    for (const std::string name : {"element", "parent", "kind", "lows_out", "delta_chi", "chi", "contours", "voxels"}) {
        const std::string told = after([&](Opened& o) {
            for (std::size_t i = 0; i < o.bytes.size(); ++i) {
                if (o.contents.arrays[i].name == "events/" + name) o.bytes[i][0] ^= std::byte{1};
            }
        });
        EXPECT_NE(told.find("stored_events_follow_from_elements: events/" + name + "[0] is "), std::string::npos) << told;
    }
}

// Tables under right checksums that are not those of the samples: each is told with array and place, also without --full.
TEST_F(VerifyStore, AWrongTableIsToldWithItsPlace) {
    build_atlas(path_, make_phantom("demo", {.size = 32}));
    const Opened good(path_);
    std::size_t tried = 0;
    for (std::size_t i = 0; i < good.bytes.size(); ++i) {
        const std::string& name = good.contents.arrays[i].name;
        const std::string group = name.substr(0, name.find('/'));
        if (group == "volume" || group == "elements" || good.bytes[i].empty()) continue;
        const auto change = [&](Opened& o) { o.bytes[i].back() ^= std::byte{1}; };
        for (const bool full : {false, true}) {
            const std::string told = after(change, full);
            const bool is_event = group == "events" && name != "events/sum";
            EXPECT_TRUE(told.find("stored_tables_are_recomputed: ") != std::string::npos || is_event) << name << ": " << told;
            EXPECT_NE(told.find(name + "["), std::string::npos) << name << ": " << told;
        }
        ++tried;
    }
    EXPECT_GT(tried, 40U);
}

TEST_F(VerifyStore, AMissingTableIsTold) {
    build_atlas(path_, make_phantom("demo", {.size = 32}));
    const std::string told = after(
        [](Opened& o) {
            for (std::size_t i = o.bytes.size(); i-- > 0;) {
                if (!o.contents.arrays[i].name.starts_with("events/sum")) continue;
                o.contents.arrays.erase(o.contents.arrays.begin() + static_cast<std::ptrdiff_t>(i));
                o.bytes.erase(o.bytes.begin() + static_cast<std::ptrdiff_t>(i));
            }
        },
        false);
    EXPECT_NE(told.find("stored_tables_are_recomputed: events/sum is missing"), std::string::npos) << told;
}

TEST_F(VerifyStore, VoxelsOfElementsInOneZoneAreComparedInFull) {
    build_atlas(path_, make_phantom("demo", {.size = 32}));
    const std::string told = after([](Opened& o) {
        for (std::size_t i = 0; i < o.bytes.size(); ++i) {
            if (o.contents.arrays[i].name == "elements/voxels") o.bytes[i][0] ^= std::byte{1};
        }
    });
    EXPECT_NE(told.find("elements/voxels[0] is "), std::string::npos) << told;
}

}  // namespace
}  // namespace isoatlas
