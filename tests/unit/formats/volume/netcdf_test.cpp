// NetCDF: the classic formats and those of HDF5; coordinates, time, missing samples; what is damaged or lies is refused.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "unit/formats/volume/hdf5_files.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

/// Writes the classic formats: version 1, 2 or 5.
class NetcdfMaker {
public:
    explicit NetcdfMaker(int version = 1) : version_(version) {}

    int dimension(const std::string& name, std::int64_t size) {
        dimensions_.push_back({name, size});
        return static_cast<int>(dimensions_.size()) - 1;
    }
    struct Attribute {
        std::string name;
        int type;  ///< 2: text, else numbers as float64
        std::string text{};
        std::vector<double> numbers{};
    };
    /// samples: big endian, of all records, without padding.
    void variable(const std::string& name, const std::vector<int>& dims, int type, const std::string& samples,
                  const std::vector<Attribute>& attributes = {}) {
        variables_.push_back({name, dims, type, samples, attributes});
    }
    /// An axis of float64.
    void axis(const std::string& name, int dimension, const std::vector<double>& places, const std::string& units) {
        variable(name, {dimension}, 6, test::swapped(test::bytes_of(places), 8), {{.name = "units", .type = 2, .text = units}});
    }

    [[nodiscard]] std::string bytes(std::int64_t records = 0) const {
        std::string header = written({}, records);
        std::vector<std::int64_t> begins;
        std::string fixed, all;
        std::vector<std::string> per_record(static_cast<std::size_t>(records));
        std::int64_t record_variables = 0;
        for (const Variable& variable : variables_) record_variables += is_record(variable) ? 1 : 0;
        const auto start = static_cast<std::int64_t>(header.size());
        for (const Variable& variable : variables_) {
            begins.push_back(start + static_cast<std::int64_t>(fixed.size()));
            if (!is_record(variable)) fixed += padded(variable.samples);
        }
        for (std::size_t v = 0; v < variables_.size(); ++v) {
            if (!is_record(variables_[v]) || records == 0) continue;
            begins[v] = start + static_cast<std::int64_t>(fixed.size() + per_record[0].size());
            const std::size_t size = variables_[v].samples.size() / static_cast<std::size_t>(records);
            for (std::size_t r = 0; r < per_record.size(); ++r) {
                const std::string one = variables_[v].samples.substr(r * size, size);
                per_record[r] += record_variables == 1 ? one : padded(one);
            }
        }
        all = written(begins, records) + fixed;
        for (const std::string& record : per_record) all += record;
        return all;
    }

private:
    struct Dimension {
        std::string name;
        std::int64_t size;
    };
    struct Variable {
        std::string name;
        std::vector<int> dims;
        int type;
        std::string samples;
        std::vector<Attribute> attributes;
    };
    [[nodiscard]] bool is_record(const Variable& v) const {
        return !v.dims.empty() && dimensions_[static_cast<std::size_t>(v.dims[0])].size == 0;
    }
    static std::string padded(std::string text) {
        text.resize((text.size() + 3) / 4 * 4, '\0');
        return text;
    }
    static std::string number(std::int64_t value, std::size_t size) {
        std::string text;
        for (std::size_t i = size; i-- > 0;) text += static_cast<char>(value >> 8 * i & 0xff);
        return text;
    }
    [[nodiscard]] std::string size(std::size_t value) const { return number(static_cast<std::int64_t>(value), version_ == 5 ? 8 : 4); }
    [[nodiscard]] std::string name(const std::string& text) const { return size(text.size()) + padded(text); }
    [[nodiscard]] std::string attributes(const std::vector<Attribute>& list) const {
        if (list.empty()) return number(0, 4) + size(0);
        std::string text = number(12, 4) + size(list.size());
        for (const Attribute& a : list) {
            text += name(a.name) + number(a.type, 4) + size(a.type == 2 ? a.text.size() : a.numbers.size());
            text += a.type == 2 ? padded(a.text) : test::swapped(test::bytes_of(a.numbers), 8);
        }
        return text;
    }
    [[nodiscard]] std::string written(const std::vector<std::int64_t>& begins, std::int64_t records) const {
        std::string text = "CDF" + std::string(1, static_cast<char>(version_)) + size(static_cast<std::size_t>(records));
        text += number(10, 4) + size(dimensions_.size());
        for (const Dimension& d : dimensions_) text += name(d.name) + size(static_cast<std::size_t>(d.size));
        text += attributes({}) + number(11, 4) + size(variables_.size());
        for (std::size_t v = 0; v < variables_.size(); ++v) {
            const Variable& variable = variables_[v];
            text += name(variable.name) + size(variable.dims.size());
            for (const int d : variable.dims) text += size(static_cast<std::size_t>(d));
            text += attributes(variable.attributes) + number(variable.type, 4) + size(0) +
                    number(begins.empty() ? 0 : begins[v], version_ == 1 ? 4 : 8);
        }
        return text;
    }

    int version_;
    std::vector<Dimension> dimensions_;
    std::vector<Variable> variables_;
};

TEST(Netcdf, RecordsAreTheFirstDimensionAlone) {
    const test::TestFolder folder;
    NetcdfMaker last;
    const int x = last.dimension("x", 3), time = last.dimension("time", 0);
    last.variable("v", {x, time}, 1, test::telling_bytes(6));
    expect_helpful(failure_of_loading(folder.write("last.nc", last.bytes(2))), ErrorKind::input, "first dimension");
    NetcdfMaker two;
    const int one = two.dimension("one", 0), other = two.dimension("other", 0);
    two.variable("v", {one}, 1, test::telling_bytes(2)), two.variable("w", {other}, 1, test::telling_bytes(2));
    expect_helpful(failure_of_loading(folder.write("two.nc", two.bytes(2))), ErrorKind::input, "second dimension of records");
}

TEST(Netcdf, EveryTypeAndVersion) {
    const test::TestFolder folder;
    const std::pair<int, ValueType> types[] = {{1, ValueType::i8},  {3, ValueType::i16}, {4, ValueType::i32}, {5, ValueType::f32},
                                               {6, ValueType::f64}, {7, ValueType::u8},  {8, ValueType::u16}, {9, ValueType::u32}};
    for (const auto& [number, type] : types) {
        for (const int version : {1, 2, 5}) {
            if (version != 5 && number > 6) continue;
            SCOPED_TRACE(std::to_string(number) + " version " + std::to_string(version));
            NetcdfMaker maker(version);
            const int z = maker.dimension("z", 4), y = maker.dimension("y", 3), x = maker.dimension("x", 2);
            const std::string samples = test::telling_bytes(24 * size_of(type));
            maker.variable("v", {z, y, x}, number, test::swapped(samples, size_of(type)));
            const std::string path = folder.write("v.bin", maker.bytes());
            const auto reader = open_volume(path);
            EXPECT_EQ(reader->info().type, type);
            EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
            EXPECT_TRUE(reader->info().slab_readable);
            EXPECT_EQ(test::read_all(*reader, 4), samples);
            test::expect_slabs_equal_whole(path);
        }
    }
}

RC_GTEST_PROP(Netcdf, AnyBoxWithRecordsTurnedAxesAndOneDimensionMore, ()) {
    const test::TestFolder folder;
    const int version = *rc::gen::element(1, 2, 5);
    const Index3 size{*rc::gen::inRange<std::int64_t>(2, 6), *rc::gen::inRange<std::int64_t>(2, 6), *rc::gen::inRange<std::int64_t>(2, 6)};
    const bool has_records = *rc::gen::arbitrary<bool>(), has_more = *rc::gen::arbitrary<bool>(), is_turned = *rc::gen::arbitrary<bool>();
    NetcdfMaker maker(version);
    const std::int64_t steps = *rc::gen::inRange<std::int64_t>(2, 4), step = *rc::gen::inRange<std::int64_t>(0, steps);
    const int time = maker.dimension("time", has_records ? 0 : steps), more = maker.dimension("more", 1), z = maker.dimension("z", size[2]),
              y = maker.dimension("y", size[1]), x = maker.dimension("x", size[0]);
    const auto count = static_cast<std::size_t>(size.product());
    const std::string samples = test::telling_bytes(static_cast<std::size_t>(steps) * count);  // of one byte: records are filled up
    maker.variable("v", has_more ? std::vector<int>{time, more, z, y, x} : std::vector<int>{time, z, y, x}, 1, samples);
    if (*rc::gen::arbitrary<bool>())
        maker.axis("time", time, std::vector<double>(static_cast<std::size_t>(steps), 1), "s since 2000-01-01");
    std::vector<double> places;
    for (std::int64_t i = 0; i < size[0]; ++i) places.push_back(-static_cast<double>(i * i));
    if (is_turned) maker.axis("x", x, places, "m");
    OpenOptions options;
    options.time_step = step;
    const auto reader = open_volume(folder.write("v.nc", maker.bytes(has_records ? steps : 0)), options);
    RC_ASSERT(reader->info().extent.size == size);
    const bool is_reversed = is_turned && !reader->info().geometry.coordinates[0].empty();
    SampleBox box;
    for (std::size_t a = 0; a < 3; ++a) {
        box.begin[a] = *rc::gen::inRange<std::int64_t>(0, size[a]);
        box.end[a] = *rc::gen::inRange<std::int64_t>(box.begin[a] + 1, size[a] + 1);
    }
    std::string got(static_cast<std::size_t>(box.size().product()), '?');
    reader->read_box(box, std::as_writable_bytes(std::span(got)));
    std::size_t i = 0;
    for (std::int64_t k = box.begin[2]; k < box.end[2]; ++k) {
        for (std::int64_t j = box.begin[1]; j < box.end[1]; ++j) {
            for (std::int64_t h = box.begin[0]; h < box.end[0]; ++h) {
                const std::int64_t from = is_reversed ? size[0] - 1 - h : h;
                RC_ASSERT(got[i++] ==
                          samples[static_cast<std::size_t>(step) * count + static_cast<std::size_t>(from + size[0] * (j + size[1] * k))]);
            }
        }
    }
}

TEST(Netcdf, CoordinatesTimeAndMissingSamples) {
    const test::TestFolder folder;
    NetcdfMaker maker;
    const int time = maker.dimension("time", 0), lat = maker.dimension("lat", 2), lon = maker.dimension("lon", 3);
    const std::vector<float> samples{1, 2, 3, 4, 5, 6, 7, -999, 9, 10, 11, 9.96921e36F};
    maker.variable("temperature", {time, lat, lon}, 5, test::swapped(test::bytes_of(samples), 4),
                   {{.name = "units", .type = 2, .text = "K"},
                    {.name = "long_name", .type = 2, .text = "air temperature"},
                    {.name = "_FillValue", .type = 6, .numbers = {-999}}});
    maker.axis("time", time, {0, 6}, "hours since 1970-01-01");
    maker.axis("lat", lat, {45, 44}, "degrees_north");
    maker.axis("lon", lon, {1, 1.5, 2}, "degrees_east");
    const std::string path = folder.write("v.nc", maker.bytes(2));
    EXPECT_EQ(failure_of_loading(path).text.reason, Reason::time_step_needed);
    OpenOptions options;
    options.time_step = 1;
    const auto reader = open_volume(path, options);
    const VolumeInfo& info = reader->info();
    EXPECT_EQ(info.format, "NetCDF classic");
    EXPECT_EQ(info.extent, (Extent{2, {3, 2, 1}}));
    EXPECT_EQ(to_physical(info.geometry, {2, 1, 0}), (Vec3{2, 44, 0}));
    EXPECT_EQ(info.geometry.unit, "");
    EXPECT_NE(std::string::npos, info.notes.back().find("degrees_east"));
    EXPECT_EQ(info.volumes.times, (std::vector<double>{0, 6}));
    EXPECT_EQ(info.volumes.time_unit, "hours since 1970-01-01");
    EXPECT_EQ(info.value_unit, "K");
    EXPECT_EQ(info.description, "air temperature");
    EXPECT_EQ(failure_of_loading(path, options).text.reason, Reason::missing_samples);
    const Volume filled = load_volume(*reader, {.action = MissingPolicy::Action::below, .value = 0, .no_data = {}});
    EXPECT_EQ(filled.value(0), 7);
    EXPECT_LT(filled.value(1), 7);
    EXPECT_LT(filled.value(5), 7);
}

TEST(Netcdf, IntegersSayWhatIsMissing) {
    const test::TestFolder folder;
    NetcdfMaker maker;
    const int y = maker.dimension("y", 2), x = maker.dimension("x", 2);
    maker.variable("v", {y, x}, 3, std::string("\0\1\0\2\0\3\x80\1", 8),
                   {{.name = "_FillValue", .type = 6, .numbers = {-32767}},
                    {.name = "scale_factor", .type = 6, .numbers = {0.5}},
                    {.name = "add_offset", .type = 6, .numbers = {10}}});
    const auto reader = open_volume(folder.write("v.nc", maker.bytes()));
    EXPECT_EQ(reader->info().calibration.slope, 0.5);
    EXPECT_EQ(reader->info().calibration.intercept, 10);
    EXPECT_NE(std::string::npos, reader->info().notes.back().find("-32767"));
}

TEST(Netcdf, ChoicesAndRefusals) {
    const test::TestFolder folder;
    NetcdfMaker maker;
    const int y = maker.dimension("y", 2), x = maker.dimension("x", 2), a = maker.dimension("a", 2), b = maker.dimension("b", 2);
    maker.variable("one", {y, x}, 1, "abcd");
    maker.variable("two", {y, x}, 1, "efgh", {{.name = "coordinates", .type = 2, .text = "place"}});
    maker.variable("place", {y, x}, 1, "ijkl");
    maker.variable("list", {x}, 1, "mn");
    maker.variable("many", {a, b, y, x}, 1, std::string(16, 'o'));
    const std::string path = folder.write("v.nc", maker.bytes());
    const test::Failure several = failure_of_loading(path);
    EXPECT_EQ(several.text.reason, Reason::dataset_needed);
    EXPECT_EQ(several.text.choices, (std::vector<ErrorChoice>{{"/one", "2 x 2 int8"}, {"/two", "2 x 2 int8"}}));
    const auto reader = open_volume(path + ":/two");
    EXPECT_EQ(test::read_all(*reader, 1), "efgh");
    EXPECT_NE(std::string::npos, reader->info().notes.back().find("curvilinear"));
    OpenOptions options;
    for (const auto& [name, says] : {std::pair{"many", "dimensions"}, {"list", "dimensions"}, {"none", "none"}}) {
        options.dataset = name;
        const test::Failure failure = failure_of_loading(path, options);
        EXPECT_NE(std::string::npos, failure.message.find(says)) << failure.message;
    }
}

TEST(Netcdf, Netcdf4IsHdf5WithScales) {
    const test::TestFolder folder;
    {
        const test::Hdf5Maker maker(folder / "v.nc");
        maker.set("/", "_NCProperties", "version=2");
        const auto scale = [&](const std::string& path, std::vector<double> places, const std::string& name, double number) {
            maker.doubles(path, places);
            maker.set(path, "CLASS", "DIMENSION_SCALE"), maker.set(path, "NAME", name), maker.set_numbers(path, "_Netcdf4Dimid", {number});
        };
        scale("/depth", {3, 2, 1}, "depth", 0);
        scale("/across", {0, 0}, "This is a netCDF dimension but not a netCDF variable         2", 1);
        maker.set("/depth", "units", "km");
        maker.bytes("/v", {3, 2}, "abcdef");
        const hid_t lists = H5Tvlen_create(H5T_STD_REF_OBJ);
        hobj_ref_t references[2];
        H5Rcreate(&references[0], maker.file, "/depth", H5R_OBJECT, -1), H5Rcreate(&references[1], maker.file, "/across", H5R_OBJECT, -1);
        const hvl_t values[2] = {{1, &references[0]}, {1, &references[1]}};
        const hsize_t two = 2;
        const hid_t space = H5Screate_simple(1, &two, nullptr);
        const hid_t attribute = H5Acreate_by_name(maker.file, "/v", "DIMENSION_LIST", lists, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(attribute, lists, values);
        H5Aclose(attribute), H5Sclose(space);
    }
    const auto reader = open_volume(folder / "v.nc");
    EXPECT_EQ(reader->info().format, "NetCDF-4");
    EXPECT_EQ(reader->info().geometry.unit, "km");
    EXPECT_EQ(to_physical(reader->info().geometry, {1, 2, 0}), (Vec3{1, 1, 0}));
    EXPECT_EQ(test::read_all(*reader, 1), "abcdef");
}

TEST(Netcdf, Damage) {
    NetcdfMaker maker;
    const int time = maker.dimension("time", 0), y = maker.dimension("y", 2), x = maker.dimension("x", 3);
    maker.variable("v", {time, y, x}, 3, test::telling_bytes(24));
    maker.axis("time", time, {0, 1}, "s since 1970-01-01"), maker.axis("x", x, {0, 1, 4}, "m");
    const std::string content = maker.bytes(2);
    OpenOptions options;
    options.time_step = 1;
    test::expect_truncations_refused("v.nc", content, std::string::npos, options);
    test::expect_bit_flips_harmless("v.nc", content, 0, content.size(), 8, options);
    const test::TestFolder folder;
    std::string lying = content;
    lying.replace(4, 4, "\x7f\xff\xff\xff");  // records
    expect_helpful(test::failure_of([&] { (void)open_volume(folder.write("v.nc", lying), options); }), ErrorKind::input, "");
}

}  // namespace
}  // namespace isoatlas
