#include "formats/volume/vtk_legacy_file.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "formats/common/text.h"
#include "formats/common/text_source.h"
#include "formats/common/word_reader.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kLargestSize = std::int64_t{1} << 40, kAnyCount = std::numeric_limits<std::int64_t>::max();

struct NumberType {
    std::string_view name;
    int bits;
    std::optional<ValueType> type;
    WideInteger wide = WideInteger::none;
};
constexpr NumberType kNumberTypes[] = {{"unsigned_char", 8, ValueType::u8},
                                       {"char", 8, ValueType::i8},
                                       {"signed_char", 8, ValueType::i8},
                                       {"unsigned_short", 16, ValueType::u16},
                                       {"short", 16, ValueType::i16},
                                       {"unsigned_int", 32, ValueType::u32},
                                       {"int", 32, ValueType::i32},
                                       {"float", 32, ValueType::f32},
                                       {"double", 64, ValueType::f64},
                                       {"bit", 1, {}},
                                       {"long", 64, ValueType::f64, WideInteger::int64},
                                       {"unsigned_long", 64, ValueType::f64, WideInteger::uint64},
                                       {"vtktypeint64", 64, ValueType::f64, WideInteger::int64},
                                       {"vtktypeuint64", 64, ValueType::f64, WideInteger::uint64},
                                       {"vtkidtype", 32, {}}};

class LegacyParser {
public:
    explicit LegacyParser(const std::string& path) : words_(open_file_source(path)) { file_.path = path; }

    [[nodiscard]] VtkLegacyFile parsed() {
        (void)words_.line();  // "# vtk DataFile Version"
        file_.title = words_.line();
        const std::string encoding = lower(words_.word());
        if (encoding != "ascii" && encoding != "binary") bad("is neither ASCII nor BINARY but " + in_quotes(encoding), "ASCII or BINARY");
        file_.binary = encoding == "binary";
        if (lower(words_.word()) != "dataset") bad("does not say what its grid is", "DATASET");
        take_dataset();
        for (std::string keyword = words_.word(); !keyword.empty(); keyword = words_.word()) {
            take(lower(keyword));
            if (file_.samples && !file_.samples->cells) break;
        }
        return std::move(file_);
    }

private:
    [[noreturn]] void bad(const std::string& what, const std::string& expected) const {
        throw Error(ErrorKind::input, {.file = file_.path,
                                       .where = "offset " + std::to_string(words_.position()),
                                       .what = what,
                                       .expected = expected,
                                       .next = "the file is damaged or cut off: get it again or correct it"});
    }

    void take_dataset() {
        const std::string grid = lower(words_.word());
        file_.rectilinear = grid == "rectilinear_grid";
        if (grid == "structured_points" || file_.rectilinear) return;
        throw Error(ErrorKind::unsupported, {.file = file_.path,
                                             .where = "DATASET",
                                             .what = "is " + in_quotes(grid),
                                             .expected = "STRUCTURED_POINTS or RECTILINEAR_GRID",
                                             .next = "resample it, e.g. in ParaView with the filter Resample To Image"});
    }

    void take(const std::string& keyword) {
        const std::size_t axis = keyword.ends_with("_coordinates") && keyword.size() == 13 ? static_cast<std::size_t>(keyword[0] - 'x') : 3;
        if (keyword == "dimensions") return take_dimensions();
        if (keyword == "origin") return take_triple(file_.origin);
        if (keyword == "spacing" || keyword == "aspect_ratio") return take_triple(file_.spacing);
        if (axis < 3) return take_coordinates(axis);
        if (keyword == "point_data" || keyword == "cell_data") return begin_data(keyword == "cell_data");
        if (keyword == "field") return take_field();
        if (keyword == "scalars") return take_scalars();
        if (keyword == "color_scalars") return take_colours();
        if (keyword == "lookup_table") return take_colour_table();
        if (keyword == "metadata") return skip_to_empty_line();
        take_attribute(keyword);
    }

    [[nodiscard]] std::int64_t integer(std::int64_t least, std::int64_t most, const char* of_what) {
        const std::string word = words_.word();
        const std::optional<std::int64_t> value = parse_integer(word);
        if (!value || *value < least || *value > most)
            bad(std::string(of_what) + " is " + in_quotes(word), "an integer from " + std::to_string(least));
        return *value;
    }
    void take_dimensions() {
        if (tuples_ > 0) bad("the dimensions follow the data", "DIMENSIONS before POINT_DATA");
        for (std::size_t axis = 0; axis < 3; ++axis) file_.points.size[axis] = integer(1, kLargestSize, "a dimension");
    }
    void take_triple(Vec3& values) {
        for (double& value : values) {
            const std::string word = words_.word();
            const std::optional<double> number = parse_number(word);
            if (!number) bad(in_quotes(word) + " is no number", "three numbers");
            value = *number;
        }
    }
    void take_coordinates(std::size_t axis) {
        VtkLegacyArray array{.name = "coordinates", .tuples = integer(1, kLargestSize, "the number of coordinates")};
        const std::string type = words_.word();
        (void)words_.line();
        skip_numbers(array, type);
        if (!array.type || array.wide != WideInteger::none) bad("coordinates are of type " + in_quotes(type), "float or double");
        file_.coordinates[axis] = std::move(array);
    }
    void begin_data(bool cells) {
        if (file_.points.size[2] < 1) bad("the grid has no dimensions", "DIMENSIONS before POINT_DATA");
        is_cell_data_ = cells;
        const Extent extent = file_.points.samples(cells);
        const std::int64_t count = sample_bytes(file_.path, extent, ValueType::u8);
        tuples_ = integer(0, kAnyCount, "the number of values");
        (void)words_.line();
        if (tuples_ != count) bad(std::to_string(tuples_) + " values on a grid with " + std::to_string(count), std::to_string(count));
    }

    // Arrays. Each is noted and skipped.
    void take_scalars() {
        VtkLegacyArray array{.name = words_.word(), .tuples = tuples_, .cells = is_cell_data_};
        const std::string type = words_.word(), count = std::string(trim(words_.line()));
        const std::optional<std::int64_t> components = count.empty() ? std::optional<std::int64_t>(1) : parse_integer(count);
        if (!components || *components < 1 || *components > 4) bad("scalars of " + in_quotes(count) + " numbers each", "1 to 4");
        array.components = *components;
        const std::int64_t begin = words_.position();
        if (lower(words_.word()) == "lookup_table")
            (void)words_.line();
        else
            words_.go_to(begin);
        note(std::move(array), type);
    }
    void take_field() {
        (void)words_.word();
        const std::int64_t arrays = integer(0, kLargestSize, "the number of arrays");
        (void)words_.line();
        for (std::int64_t i = 0; i < arrays; ++i) {
            std::string name = words_.word();
            while (lower(name) == "metadata") skip_to_empty_line(), name = words_.word();
            if (name.empty()) bad("the file ends between arrays", std::to_string(arrays) + " arrays");
            VtkLegacyArray array{.name = name, .cells = is_cell_data_};
            array.components = integer(0, kLargestSize, "the number of components");
            array.tuples = integer(0, kLargestSize, "the number of values");
            const std::string type = words_.word();
            (void)words_.line();
            note(std::move(array), type);
            if (file_.samples && !file_.samples->cells) return;
        }
    }
    /// Bytes; as text their 255th parts. VTK writes scalars of unsigned_char like that.
    void take_colours() {
        VtkLegacyArray array{.name = words_.word(), .tuples = tuples_, .cells = is_cell_data_};
        array.components = integer(1, 4, "the number of colour components");
        array.slope = file_.binary ? 1 : 255;
        (void)words_.line();
        note(std::move(array), file_.binary ? "unsigned_char" : "float");
    }
    void take_colour_table() {
        (void)words_.word();
        VtkLegacyArray array{.components = 4, .tuples = integer(0, kLargestSize, "the size of the colour table")};
        (void)words_.line();
        skip_numbers(array, "unsigned_char");
    }
    void take_attribute(const std::string& keyword) {
        static constexpr std::pair<std::string_view, int> kComponents[] = {
            {"vectors", 3},    {"normals", 3},      {"tensors", 9},    {"tensors6", 6},
            {"global_ids", 1}, {"pedigree_ids", 1}, {"edge_flags", 1}, {"texture_coordinates", 0}};
        for (const auto& [known, components] : kComponents) {
            if (keyword != known) continue;
            VtkLegacyArray array{.name = words_.word(), .components = components, .tuples = tuples_, .cells = is_cell_data_};
            if (components == 0) array.components = integer(1, 3, "the number of texture coordinates");
            const std::string type = words_.word();
            (void)words_.line();
            skip_numbers(array, type);
            file_.others.push_back(array.name);
            return;
        }
        bad("unknown keyword " + in_quotes(keyword), "a keyword of the legacy format");
    }
    void skip_to_empty_line() {
        (void)words_.line();
        while (words_.left() > 0 && !trim(words_.line()).empty()) continue;
    }

    /// Sets where the numbers lie, and goes behind them.
    void skip_numbers(VtkLegacyArray& array, const std::string& type) {
        const std::string wanted = lower(type);
        const auto* known = std::ranges::find(kNumberTypes, wanted, &NumberType::name);
        if (known == std::end(kNumberTypes)) bad("values of type " + in_quotes(type), "a type of numbers");
        array.type = known->type;
        array.wide = known->wide;
        array.begin = words_.position();
        const std::int64_t left = words_.left();
        const std::string what = "the file ends inside " + in_quotes(array.name);
        if (array.components > 0 && array.tuples > 8 * (left + 1) / array.components) bad(what, "more bytes");
        const std::int64_t numbers = array.components * array.tuples;
        if (file_.binary) {
            const std::int64_t bytes = numbers / 8 * known->bits + (numbers % 8 * known->bits + 7) / 8;
            if (bytes > left) bad(what, std::to_string(bytes) + " bytes, " + std::to_string(left) + " are left");
            words_.go_to(array.begin + bytes);
            array.end = words_.position();
        } else {
            if (!words_.skip_words(numbers)) bad(what, std::to_string(numbers) + " numbers");
            array.end = words_.position() + (words_.left() > 0 ? 1 : 0);  // with the separator: without it a last 4 may be a cut 41
        }
    }
    void note(VtkLegacyArray array, const std::string& type) {
        skip_numbers(array, type);
        const bool fits = array.components == 1 && array.tuples == tuples_ && tuples_ > 0 && array.type;
        if (!fits || (file_.samples && array.cells)) return file_.others.push_back(array.name);
        if (file_.samples) file_.others.push_back(file_.samples->name);  // cells give way to points
        file_.samples = std::move(array);
    }

    WordReader words_;
    VtkLegacyFile file_;
    bool is_cell_data_ = false;
    std::int64_t tuples_ = 0;  ///< of the point or cell data; 0: none yet
};

}  // namespace

std::unique_ptr<ByteSource> VtkLegacyFile::open(const VtkLegacyArray& array) const {
    std::unique_ptr<ByteSource> bytes = open_file_source(path, array.begin, array.end - array.begin);
    return binary ? std::move(bytes) : open_text_source(std::move(bytes), *array.type, TextEnd::separator, array.wide);
}

bool VtkLegacyFile::is_big_endian() const { return binary || needs_swap(false); }

VtkLegacyFile read_vtk_legacy(const std::string& path) { return LegacyParser(path).parsed(); }

}  // namespace isoatlas
