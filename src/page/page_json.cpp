#include "page/page_json.h"

#include <algorithm>
#include <cmath>

#include "formats/common/byte_writer.h"
#include "isoatlas/shell_word.h"
#include "isoatlas/units.h"
#include "isoatlas/version.h"
#include "page/web_colour.h"

namespace isoatlas {
namespace {

void put_text(JsonStream& json, const std::string& text) {
    if (text.empty()) {
        json.null();
    } else {
        json.value(text);
    }
}

/// The name of the store without folder and extension.
std::string title_of(const std::string& path) {
    std::string name = path.substr(path.rfind('/') + 1);
    if (name.ends_with(".atlas")) name.resize(name.size() - 6);
    return name;
}

/// Empty: lengths are in voxels.
std::string unit_of(const Geometry& geometry) {
    const std::string unit = length_unit_name(geometry);
    return unit == "voxels" ? "" : unit;
}

template <class Items, class Of>
void put_array(JsonStream& json, const char* name, const Items& items, const Of& of) {
    json.key(name).begin_array();
    for (const auto& item : items) json.value(of(item));
    json.end_array();
}

class Writer {
public:
    Writer(JsonStream& json, const StoreSides& sides, const PageContents& contents, const std::string& source)
        : json_(json), sides_(sides), atlas_(sides.main), contents_(contents), scale_(atlas_.info().calibration), source_(source) {}

    void write() {
        json_.begin_object().key("schema").value("isoatlas/page/3").key("version").value(ISOATLAS_VERSION).line();
        write_volume();
        write_notes();
        json_.key("complete").value(contents_.is_complete);
        json_.key("interpolant").value(name_of(atlas_.interpolant()));
        json_.key("polarity").value(sides_.has_both() ? name_of(PolarityChoice::both) : name_of(polarity_of(atlas_.info())));
        write_counts();
        write_axis();
        json_.line().key("spectrum");
        put_columns(contents_.spectrum, true);
        json_.line().key("curve");
        write_curve(contents_.curve);
        if (contents_.low) write_low_side(*contents_.low);
        json_.line().key("branches").begin_array();
        for (const PageBranch& branch : contents_.branches) write_branch(branch);
        json_.end_array().line().key("entries").begin_array();
        for (std::size_t i = 0; i < contents_.entries.size(); ++i) write_entry(i);
        json_.end_array().line().end_object().finish();
    }

private:
    /// In the table; null: it does not list it.
    void put_number(std::int64_t number) {
        json_.key("number");
        if (number > 0) {
            json_.value(number);
        } else {
            json_.null();
        }
    }
    JsonStream& put_value(const char* name, double stored) { return json_.key(name).value(scale_.reported(stored)); }
    /// "low" and "high", ascending.
    void put_interval(double low, double high) {
        const auto [first, last] = scale_.reported_interval(low, high);
        json_.key("low").value(first).key("high").value(last);
    }
    /// An array along the axis of isovalues, ascending as reported.
    template <class Items, class Of>
    void put_along_axis(const char* name, const Items& items, const Of& of) {
        if (!scale_.mirror) return put_array(json_, name, items, of);
        put_array(json_, name, std::vector(items.rbegin(), items.rend()), of);
    }

    void write_volume() {
        const VolumeInfo& info = atlas_.info();
        json_.key("volume").begin_object().key("name").value(title_of(info.path));
        json_.key("size").begin_array();
        for (int a = 0; a < info.extent.rank; ++a) json_.value(info.extent.size[a]);
        json_.end_array().key("type").value(name_of(info.type)).key("spacing");
        if (info.geometry.coordinates[0].empty()) {
            json_.value(info.geometry.spacing);
        } else {
            json_.null();
            write_coordinates(info.geometry);
        }
        json_.key("space").value(info.geometry.space).key("origin").value(to_physical(info.geometry, {0, 0, 0}));
        json_.key("direction").begin_array();
        for (const Vec3& row : info.geometry.direction) json_.value(row);
        json_.end_array();
        put_text(json_.key("unit"), unit_of(info.geometry));
        put_text(json_.key("valueUnit"), info.value_unit);
        put_interval(contents_.scale.low, contents_.scale.high);
        json_.key("noise").value(scale_.reported_difference(contents_.noise)).end_object().line();
    }

    void write_notes() {
        put_array(json_, "notes", contents_.notes, [](const std::string& note) { return note; });
        json_.key("smoothing");
        if (!contents_.smoothing) {
            json_.null().line();
            return;
        }
        const PageSmoothing& smoothing = *contents_.smoothing;
        json_.begin_object().key("noisePart").value(smoothing.noise_part).key("sigma").value(smoothing.sigma);
        json_.key("command").value(smoothing.command).key("comparison");
        write_comparison();
        json_.end_object().line();
    }

    void write_comparison() {
        if (!contents_.comparison) {
            json_.null();
            return;
        }
        json_.begin_object();
        put_value("tau", contents_.comparison->tau);
        const auto put = [this](const char* name, const ShownSmoothing& shown) {
            json_.key(name).begin_object().key("objects").value(shown.objects).key("tunnels").value(shown.tunnels).key("picture");
            write_picture(json_, shown.picture);
            json_.end_object();
        };
        put("asItIs", contents_.comparison->as_is);
        put("smooth", contents_.comparison->smooth);
        json_.end_object();
    }

    /// Positions of the samples along each axis, relative to the first one.
    void write_coordinates(const Geometry& geometry) {
        json_.key("coordinates").begin_array();
        for (const std::vector<double>& axis : geometry.coordinates) {
            json_.begin_array();
            for (const double place : axis) json_.value(place - axis.front());
            json_.end_array();
        }
        json_.end_array();
    }

    void write_counts() {
        const auto put = [&](const char* name, std::int64_t all, std::int64_t significant) {
            json_.key(name).begin_object().key("all").value(all).key("significant").value(significant).end_object();
        };
        json_.key("found").begin_object();
        put("objects", contents_.objects, contents_.significant_objects);
        put("cavities", contents_.cavities, contents_.significant_cavities);
        json_.end_object();
    }

    void write_axis() {
        json_.line().key("axis").begin_object();
        put_interval(contents_.scale.low, contents_.scale.high);
        json_.key("bend");
        if (contents_.scale.bend > 0 && !scale_.mirror) {  // the page bends its axis at the low end only
            json_.value(scale_.reported_difference(contents_.scale.bend));
        } else {
            json_.null();
        }
        json_.end_object().line().key("histogram").begin_object();
        put_along_axis("edges", contents_.histogram.edges, [&](double edge) { return scale_.reported(edge); });
        put_along_axis("counts", contents_.histogram.counts, [](std::int64_t count) { return count; });
        json_.end_object();
    }

    /// Columns as one array for each number; "min" is left out where it is "max".
    void put_columns(const std::vector<CountColumn>& columns, bool all_counts) {
        if (columns.empty()) {
            json_.null();
            return;
        }
        std::vector<double> edges{columns.front().low};
        for (const CountColumn& column : columns) edges.push_back(column.high);
        json_.begin_object();
        put_along_axis("edges", edges, [&](double edge) { return scale_.reported(edge); });
        const auto put = [&](LevelCounts CountColumn::* min, LevelCounts CountColumn::* max) {
            const auto put_count = [&](const char* name, std::int64_t LevelCounts::* count) {
                json_.key(name).begin_object();
                put_along_axis("max", columns, [&](const CountColumn& column) { return (column.*max).*count; });
                const bool same =
                    std::ranges::all_of(columns, [&](const CountColumn& column) { return (column.*min).*count == (column.*max).*count; });
                if (!same) put_along_axis("min", columns, [&](const CountColumn& column) { return (column.*min).*count; });
                json_.end_object();
            };
            if (all_counts) {
                put_count("objects", &LevelCounts::objects);
                put_count("contours", &LevelCounts::contours);
            }
            put_count("tunnels", &LevelCounts::tunnels);
            put_count("cavities", &LevelCounts::cavities);
        };
        if (all_counts) {
            json_.key("all").begin_object();
            put(&CountColumn::min, &CountColumn::max);
            json_.end_object().key("significant").begin_object();
            put(&CountColumn::min_significant, &CountColumn::max_significant);
            json_.end_object();
        } else {
            put(&CountColumn::min, &CountColumn::max);
        }
        json_.end_object();
    }

    void write_low_side(const PageSide& side) {
        use_values_of(Polarity::low);
        json_.line().key("low").begin_object().key("found").begin_object();
        json_.key("all").value(side.objects).key("significant").value(side.significant_objects).end_object();
        json_.key("noise").value(scale_.reported_difference(side.noise)).key("spectrum");
        put_columns(side.spectrum, true);
        json_.key("curve");
        write_curve(side.curve);
        json_.end_object();
    }

    void write_curve(const SelectionCurve& curve) {
        json_.begin_object();
        put_array(json_, "threshold", curve.threshold, [&](double size) { return scale_.reported_difference(size); });
        put_array(json_, "kept", curve.kept, [](std::int64_t kept) { return kept; });
        json_.key("automaticThreshold").value(scale_.reported_difference(curve.automatic_threshold));
        json_.key("automaticKept").value(curve.automatic_kept).end_object();
    }

    void write_branch(const PageBranch& branch) {
        use_values_of(branch.polarity);
        json_.line().begin_object().key("side").value(branch.is_cavity ? "cavity" : "object").key("id").value(branch.id);
        if (sides_.has_both()) json_.key("polarity").value(name_of(branch.polarity));
        put_number(branch.number);
        json_.key("rank").value(branch.rank);
        put_value("appears", branch.appears);
        put_value("merges", branch.merges);  // null: never
        json_.key("parent").value(branch.parent).key("hypervolume").value(scale_.reported_difference(branch.hypervolume));
        json_.key("voxels").value(branch.voxels).key("measure").value(branch.measure).key("joined").value(branch.joined);
        json_.key("significant").value(branch.is_significant);
        if (!branch.shape.empty()) {
            json_.key("shape");
            put_columns(branch.shape, false);
        }
        if (!branch.isovalues.empty()) write_isovalues(branch.isovalues);
        if (!branch.tunnels.empty()) write_tunnels(branch);
        json_.end_object();
    }

    void write_tunnels(const PageBranch& branch) {
        json_.key("tunnels").begin_object().key("exact").value(contents_.exact_tunnels);
        json_.key("significant").value(branch.significant_tunnels).key("longest").begin_array();
        for (const PageTunnel& tunnel : branch.tunnels) {
            json_.begin_object();
            put_value("opens", tunnel.opens);
            put_value("closes", tunnel.closes);
            json_.end_object();
        }
        json_.end_array().end_object();
    }

    void write_isovalues(const std::vector<RecommendedIsovalue>& isovalues) {
        json_.key("isovalues").begin_array();
        for (const RecommendedIsovalue& isovalue : isovalues) {
            json_.begin_object().key("tau").value(scale_.reported(isovalue.tau)).key("why").value(text_of(isovalue.reason));
            const std::int64_t cavity = isovalue.reason == IsovalueReason::inner ? cavity_entry(isovalue) : -1;
            if (cavity >= 0) json_.key("cavity").value(cavity);
            json_.end_object();
        }
        json_.end_array();
    }

    /// The cavity entry with this wall; -1: not on the page.
    std::int64_t cavity_entry(const RecommendedIsovalue& isovalue) const {
        const auto entry = std::ranges::find_if(contents_.entries, [&](const PageEntry& e) {
            return contents_.branches[e.branch].is_cavity && e.id == isovalue.cavity && e.tau == isovalue.tau;
        });
        return entry == contents_.entries.end() ? -1 : entry - contents_.entries.begin();
    }

    void write_entry(std::size_t i) {
        const PageEntry& entry = contents_.entries[i];
        use_values_of(polarity_of_entry(entry));
        json_.line().begin_object().key("branch").value(entry.branch);
        put_number(entry.number);
        json_.key("reference").value(reference_of(entry));
        put_text(json_.key("name"), entry.name);
        json_.key("id").value(entry.id);
        put_value("tau", entry.tau);
        put_interval(entry.tau_low, entry.tau_high);
        json_.key("voxels").value(entry.voxels).key("measure").value(entry.measure);
        json_.key("tunnels").value(entry.tunnels).key("cavities").value(entry.cavities);
        json_.key("inside").value(entry.inside).key("around").value(entry.around);
        json_.key("card").value(entry.card).key("overlap").value(entry.overlap).key("background").value(entry.is_background);
        json_.key("reason").value(entry.reason ? name_of(*entry.reason) : "").key("why").value(entry.reason ? text_of(*entry.reason) : "");
        if (sides_.has_both()) {
            json_.key("enclosed").value(entry.is_enclosed);
            json_.key("border").value(entry.border);
        }
        json_.key("colour").value(web_colour(entry.colour)).line().key("picture");
        write_picture(json_, entry.picture);
        write_mesh(json_, entry.mesh);
        json_.line().key("commands").begin_array();
        write_commands(i);
        json_.end_array().end_object();
    }

    void write_commands(std::size_t i) {
        const PageEntry& entry = contents_.entries[i];
        const std::string reference = reference_of(entry), tau = number_text(scale_.reported(entry.tau));
        const std::string object = " --object " + reference;
        const std::string all = command_source(sides_.of(polarity_of_entry(entry)), source_);  // without a reference
        const auto put = [&](const char* name, const std::string& verb, const std::string& options) {
            const std::string source = options.starts_with(object) ? shell_word(source_) : all;
            json_.begin_object().key("name").value(name).key("line").value("isoatlas " + verb + " " + source + options).end_object();
        };
        if (contents_.branches[entry.branch].is_cavity) {
            const std::string number = std::to_string(entry.number), name = " -o cavity-" + number;
            put("its wall as a surface", "extract", object + name + ".ply");
            put("its label", "label", object + name + ".nrrd");
            put("labels of all cavities there", "label", " --cavities --tau " + tau + " -o cavities-" + number + ".nrrd");
            return;
        }
        const std::string name = " -o object-" + reference;
        put("surface", "extract", object + name + ".ply");
        put("its label", "label", object + name + ".nrrd");
        put("labels of all objects there", "label", " --tau " + tau + " -o objects-" + reference + ".nrrd");
        put("picture", "render", object + name + ".png");
    }

    /// Stored values are those of one polarity.
    void use_values_of(Polarity polarity) { scale_ = sides_.of(polarity).info().calibration; }
    [[nodiscard]] Polarity polarity_of_entry(const PageEntry& entry) const { return contents_.branches[entry.branch].polarity; }
    [[nodiscard]] std::string reference_of(const PageEntry& entry) const {
        const PageBranch& branch = contents_.branches[entry.branch];
        return std::string(branch.polarity == Polarity::low ? "low" : "") + (branch.is_cavity ? "c" : "") + std::to_string(entry.number);
    }

    JsonStream& json_;
    const StoreSides& sides_;
    const Atlas& atlas_;
    const PageContents& contents_;
    Calibration scale_;
    std::string source_;
};

}  // namespace

std::string command_source(const Atlas& atlas, const std::string& source) {
    const bool needs_side = atlas.polarities() == PolarityChoice::both && polarity_of(atlas.info()) == Polarity::low;
    return shell_word(source) + (needs_side ? " --polarity low" : "");
}

void write_picture(JsonStream& json, const Turntable& picture) {
    if (picture.image.empty()) {
        json.null();
    } else {
        json.begin_object().key("image").value(picture.image).key("frames").value(picture.frames);
        json.key("side").value(picture.side).end_object();
    }
}

void write_mesh(JsonStream& json, const PageMesh& mesh) {
    json.line().key("mesh");
    if (mesh.data.empty()) {
        json.null();
        return;
    }
    json.begin_object().key("data").value(mesh.data).key("triangles").value(mesh.triangles).key("of").value(mesh.of);
    json.key("keepsTopology").value(mesh.keeps_topology).end_object();
}

void write_page_json(JsonStream& json, const StoreSides& sides, const PageContents& contents, const std::string& source) {
    Writer(json, sides, contents, source).write();
}

}  // namespace isoatlas
