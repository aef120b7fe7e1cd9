// What the page shows: objects with their relations and pictures, and counts over the isovalue. The page itself is web/.
#include "isoatlas/page.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/atomic_file.h"
#include "isoatlas/shell_word.h"
#include "output/byte_writer.h"
#include "output/json_stream.h"
#include "page/relations.h"
#include "page/template.h"
#include "page/turntable.h"

namespace isoatlas {
namespace {

using output::JsonStream;
using page::Turntable;

constexpr std::int64_t kIsovalues = 160;  // of the histogram and the counts

struct Counted {
    double tau;
    SurfacePreview there;
};

std::vector<Counted> count_over_isovalues(const Atlas& atlas) {
    const auto [low, high] = atlas.range();
    std::vector<Counted> counted;
    for (std::int64_t i = 0; i <= kIsovalues && high > low; ++i) {
        const double tau = low + (high - low) * static_cast<double>(i) / static_cast<double>(kIsovalues);
        counted.push_back({tau, atlas.preview(tau)});
    }
    return counted;
}

double middle(const Bounds& bounds) { return 0.5 * static_cast<double>(bounds.least + bounds.most); }

std::string web_colour(const Colour& colour) {
    std::string text = "#";
    for (const double part : {colour.red, colour.green, colour.blue}) {
        const int byte = static_cast<int>(std::lround(255 * part));
        for (const int digit : {byte / 16, byte % 16}) text += "0123456789abcdef"[digit];
    }
    return text;
}

class PageWriter {
public:
    PageWriter(const Atlas& atlas, const PageOptions& options, const Context& context)
        : atlas_(atlas), options_(options), context_(context), scale_(atlas.info().calibration) {
        source_ = shell_word(options.source.empty() ? atlas.info().path : options.source);
        table_ = atlas.objects({.top = options.top}, context);
        into_ = page::merge_targets(table_, atlas.analysis());
        for (std::size_t i = 0; i < table_.entries.size(); ++i) pictures_.push_back(draw(i));
    }

    void write(JsonStream& json) {
        json.begin_object().key("schema").value("isoatlas/page/1").key("version").value(ISOATLAS_VERSION).line();
        write_volume(json);
        json.key("interpolant").value(name_of(atlas_.interpolant()));
        json.key("branches").value(table_.branches);
        json.key("rule").value("those that noise alone explains and those far smaller than the largest are not shown");
        write_counts(json.line());
        json.line().key("objects").begin_array();
        for (std::size_t i = 0; i < table_.entries.size(); ++i) write_entry(json.line(), i);
        json.end_array().line().end_object().finish();
    }
    [[nodiscard]] std::int64_t objects() const { return static_cast<std::int64_t>(table_.entries.size()); }

private:
    Turntable draw(std::size_t i) const {
        const ObjectEntry& entry = table_.entries[i];
        if (atlas_.info().extent.rank != 3) return {};
        const auto done = static_cast<double>(i) / static_cast<double>(table_.entries.size());
        context_.report("draw", 0, 1, done);
        Context quiet = context_;
        quiet.progress = {};
        ExtractOptions options;
        options.objects = {entry.id};
        return page::draw_turntable(atlas_.extract(entry.best_tau, options, quiet), palette(static_cast<std::int64_t>(i)), options_, quiet);
    }

    void write_volume(JsonStream& json) const {
        const VolumeInfo& info = atlas_.info();
        const auto [low, high] = atlas_.range();
        json.key("volume").begin_object().key("name").value(title_of(info.path));
        json.key("size").begin_array();
        for (int a = 0; a < info.extent.rank; ++a) json.value(info.extent.size[a]);
        json.end_array().key("type").value(name_of(info.type)).key("spacing").value(info.geometry.spacing);
        put_text(json.key("unit"), info.geometry.unit);
        put_text(json.key("valueUnit"), info.value_unit);
        json.key("low").value(std::min(scale_.reported(low), scale_.reported(high)));
        json.key("high").value(std::max(scale_.reported(low), scale_.reported(high)));
        json.key("noise").value(scale_.reported_difference(table_.noise)).end_object().line();
    }
    /// The name of the store without folder and extension.
    static std::string title_of(const std::string& path) {
        std::string name = path.substr(path.rfind('/') + 1);
        if (name.ends_with(".atlas")) name.resize(name.size() - 6);
        return name;
    }
    static void put_text(JsonStream& json, const std::string& text) {
        if (text.empty()) {
            json.null();
        } else {
            json.value(text);
        }
    }

    void write_counts(JsonStream& json) const {
        const std::vector<Counted> counted = count_over_isovalues(atlas_);
        const auto [low, high] = atlas_.range();
        json.key("histogram").begin_object().key("low").value(scale_.reported(low)).key("high").value(scale_.reported(high));
        json.key("counts").begin_array();
        for (std::size_t i = 0; i + 1 < counted.size(); ++i)
            json.value(std::max(0.0, std::round(middle(counted[i].there.voxels) - middle(counted[i + 1].there.voxels))));
        if (counted.empty()) json.value(atlas_.info().extent.voxels());
        json.end_array().end_object().line().key("spectrum").begin_object().key("tau").begin_array();
        for (const Counted& at : counted) json.value(scale_.reported(at.tau));
        json.end_array();
        const auto put = [&](const char* name, auto count) {
            json.key(name).begin_array();
            for (const Counted& at : counted) json.value(count(at.there));
            json.end_array();
        };
        put("objects", [](const SurfacePreview& there) { return there.objects; });
        put("contours", [](const SurfacePreview& there) { return there.contours; });
        put("tunnels", [](const SurfacePreview& there) { return there.tunnels; });
        put("cavities", [](const SurfacePreview& there) { return there.contours - there.objects; });
        json.end_object();
    }

    void write_entry(JsonStream& json, std::size_t i) const {
        const ObjectEntry& entry = table_.entries[i];
        json.begin_object().key("id").value(entry.id).key("side").value("bright").key("appears").value(scale_.reported(entry.appears));
        json.key("merges").value(scale_.reported(entry.merges));  // null: never
        json.key("best").value(scale_.reported(entry.best_tau));
        json.key("low")
            .value(scale_.reported(std::max(entry.tau_low, atlas_.range()[0])))
            .key("high")
            .value(scale_.reported(entry.tau_high));
        json.key("voxels").value(entry.voxels).key("measure").value(entry.measure);
        json.key("tunnels").value(entry.tunnels).key("cavities").value(entry.cavities);
        json.key("hypervolume").value(entry.hypervolume).key("inside").value(entry.inside).key("into").value(into_[i]);
        json.key("trunk").value(entry.trunk).key("note").value(note_of(entry));
        json.key("colour").value(web_colour(palette(static_cast<std::int64_t>(i)))).line();
        json.key("picture");
        if (pictures_[i].image.empty()) {
            json.null();
        } else {
            json.begin_object().key("image").value(pictures_[i].image).key("frames").value(pictures_[i].frames);
            json.key("width").value(pictures_[i].side).key("height").value(pictures_[i].side).end_object();
        }
        json.line().key("commands").begin_array();
        const std::string object = " --object " + std::to_string(entry.id),
                          tau = " --tau " + output::number_text(scale_.reported(entry.best_tau));
        const std::string name = "object-" + std::to_string(i + 1);
        put_command(json, "surface", "isoatlas extract " + source_ + object + tau + " -o " + name + ".ply");
        put_command(json, "labels of all objects there", "isoatlas label " + source_ + tau + " -o " + name + ".nrrd");
        put_command(json, "picture",
                    "isoatlas render " + source_ + " --object " + std::to_string(entry.id) + "@" +
                        output::number_text(scale_.reported(entry.best_tau)) + " -o " + name + ".png");
        json.end_array().end_object();
    }
    static void put_command(JsonStream& json, const char* name, const std::string& line) {
        json.begin_object().key("name").value(name).key("line").value(line).end_object();
    }
    static std::string note_of(const ObjectEntry& entry) {
        if (entry.inside >= 0) return "inside object " + std::to_string(entry.inside + 1);
        return entry.note;
    }

    const Atlas& atlas_;
    const PageOptions& options_;
    const Context& context_;
    Calibration scale_;
    std::string source_;
    ObjectTable table_;
    std::vector<std::int64_t> into_;
    std::vector<Turntable> pictures_;
};

/// JSON inside a script element: nothing in it may look like the end of that element.
std::string escaped(const std::string& json) {
    std::string text;
    text.reserve(json.size());
    for (const char letter : json) text += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    return text;
}

void check(const PageOptions& options) {
    const auto refuse = [](const char* what, const char* expected) { throw Error(ErrorKind::usage, {.what = what, .expected = expected}); };
    if (options.picture_size < 32 || options.picture_size > 1024) refuse("the size of the pictures is out of range", "32 to 1024");
    if (options.frames < 1 || options.frames > 64) refuse("the number of frames is out of range", "1 to 64");
    if (options.frames * options.picture_size > 16383) refuse("a turntable is too wide", "frames times size at most 16383");
    if (options.top < 1) refuse("the number of objects is out of range", "1 or more");
}

}  // namespace

PageReport write_page(const std::string& path, const Atlas& atlas, const PageOptions& options, const Context& context) {
    check(options);
    if (page::page_template().empty()) {
        throw Error(ErrorKind::unsupported,
                    {.what = "this isoatlas was built without pages", .next = "install npm and build it again without -DISOATLAS_WEB=OFF"});
    }
    std::string json;
    PageWriter writer(atlas, options, context);
    JsonStream stream([&json](std::string_view text) { json += text; });
    writer.write(stream);
    const std::string_view page = page::page_template(), mark = R"(<script id="atlas-data" type="application/json">null</script>)";
    const std::size_t at = page.find(mark), data = at + mark.find("null");
    AtomicFile file(path);
    file.write(page.substr(0, data));
    file.write(escaped(json));
    file.write(page.substr(data + 4));
    PageReport report{writer.objects(), file.size()};
    file.commit();
    return report;
}

}  // namespace isoatlas
