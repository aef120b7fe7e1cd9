#include "data/source.h"

#include <cmath>

#include <fmt/format.h>

#include "options/suggest.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {

bool filters_stores(const std::string& verb) { return verb == "convert" || verb == "table131" || verb == "compare"; }

void check_store_options(const Arguments& arguments, const Atlas& atlas) {
    const auto refuse = [&](const char* option, const std::string& has) {
        throw Error(ErrorKind::usage, {.file = arguments.file,
                                       .what = std::string(option) + " contradicts the store, which was built with " + has,
                                       .next = std::string("omit ") + option + ", or build another store from the volume"});
    };
    if (arguments.interpolant_given && arguments.interpolant != atlas.interpolant())
        refuse("--interpolant", std::string("--interpolant ") + name_of(atlas.interpolant()));
    if (arguments.tunnel_height > 0) refuse("--tunnel-height", fmt::format("a tunnel height of {}", atlas.tunnel_height()));
    const OpenOptions& open = arguments.open;
    if (open.dims || open.type || open.big_endian || open.skip_bytes || open.time_step || open.channel || open.series || open.level ||
        open.skip_rest || open.follow_links)
        refuse("an option of the reader", "the header of the volume file");
    if (arguments.missing.action != MissingPolicy::Action::error || arguments.missing.no_data) refuse("--missing", "complete samples");
    if (filters_stores(arguments.verb)) return;
    if (arguments.box) refuse("--box", "all samples of the volume");
    const double gaussian = atlas.info().gaussian;
    if ((arguments.gaussian && *arguments.gaussian != gaussian) || (arguments.inputs.seeks_gaussian && gaussian == 0))
        refuse("--gaussian", gaussian > 0 ? fmt::format("--gaussian {}", gaussian) : "unfiltered samples");
    if (arguments.verb != "atlas" && arguments.verb != "view") return;
    if (arguments.voxel_units && atlas.info().geometry != voxel_geometry()) refuse("--voxel", "the geometry of the volume");
}

Source::Source(const Arguments& arguments, Terminal& terminal) : arguments_(arguments), session_(arguments, terminal) {
    if (!is_atlas(arguments.file)) {
        volume_ = session_.load();
        info_ = volume_->info;
        return;
    }
    atlas_.emplace(arguments.file, AtlasOptions{.polarity = arguments.side(), .corrections = corrections_of(arguments)});
    check_store_options(arguments, *atlas_);
    info_ = atlas_->info();
    if (arguments.voxel_units) info_.geometry = voxel_geometry();
    if (arguments.quiet) return;
    for (const std::string& note : info_.notes) terminal.say("note: " + note);
    terminal.say(session_.describe(info_, range()));
}

ValueRange Source::range() {
    if (!range_ && atlas_) {
        const std::array<double, 2> both = atlas_->range();
        range_ = ValueRange{both[0], both[1]};
    }
    if (!range_) range_ = range_of(*volume_);
    return *range_;
}

Interpolant Source::interpolant() const { return atlas_ ? atlas_->interpolant() : arguments_.interpolant; }

double Source::tunnel_height() {
    if (atlas_) return atlas_->tunnel_height();
    if (arguments_.tunnel_height == 0) return 0;
    if (!arguments_.tunnel_height_in_percent) return arguments_.tunnel_height / std::abs(info_.calibration.slope);
    return arguments_.tunnel_height / 100 * (range().high - range().low);
}

double Source::stored(double typed) {
    const Scale scale(info_);
    const double tau = scale.stored(typed);
    const ValueRange all = range();
    if (tau >= all.low && tau <= all.high) return tau;
    const auto [low, high] = scale.ends(all.low, all.high);
    const bool is_above = (tau > all.high) != scale.is_low();
    throw Error(ErrorKind::not_found, {.file = arguments_.file,
                                       .what = fmt::format("the isovalue {} is {} every sample", typed, is_above ? "above" : "below"),
                                       .expected = fmt::format("{} .. {}", scale.text(low), scale.text(high)),
                                       .next = "isoatlas objects " + shell_word(arguments_.file) + " lists isovalues that show something"});
}

Cut Source::cut(double tau, bool label) {
    if (atlas_ && !arguments_.voxel_units) return atlas_->cut(tau, {.label = label}, context(), &cost_);
    return isoatlas::cut(volume(), tau, {.interpolant = interpolant(), .tunnel_height = tunnel_height(), .label = label}, context());
}

Surface Source::extract(double tau, const SurfaceOptions& options) {
    if (arguments_.octree.is_asked_for()) {
        octree_.asked = arguments_.octree;
        const ExtractOptions how{.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = options};
        const auto front = [&](const FrontOptions& blocks) {
            return atlas_ && !arguments_.voxel_units ? atlas_->extract_front(tau, blocks, options, context(), &cost_)
                                                     : extract_front(volume(), tau, blocks, how, context());
        };
        return octree_.take(front(octree_.options(info().geometry)));
    }
    if (atlas_ && !arguments_.voxel_units) return atlas_->extract(tau, options, context(), &cost_);
    return isoatlas::extract(volume(), tau, {.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = options},
                             context());
}

ObjectTable Source::objects(const RankOptions& options) {
    if (!atlas_) return rank_objects(volume(), ranked(), options, context());
    ObjectTable table = atlas_->objects(options, context());
    for (ObjectEntry& entry : table.entries) {
        if (arguments_.voxel_units) entry.measure = static_cast<double>(entry.voxels);
    }
    return table;
}

CavityTable Source::cavities(const RankOptions& options) {
    if (!atlas_) return rank_cavities(volume(), ranked(), options, context());
    if (arguments_.voxel_units) return rank_cavities(volume(), analysis(false), options, context());
    return atlas_->cavities(options, context());
}

ObjectsAndCavities Source::objects_and_cavities(const RankOptions& options) {
    if (!atlas_) return rank_both(volume(), ranked(), options, context());
    return {objects(options), cavities(options)};
}

BranchHierarchy Source::hierarchy() {
    if (atlas_ && !arguments_.voxel_units) return atlas_->hierarchy(context());
    return {volume(), analysis(true), context()};
}

std::pair<Analysis, BranchHierarchy> Source::analysis_and_hierarchy() {
    if (atlas_ && !arguments_.voxel_units) return {atlas_->analysis(), atlas_->hierarchy(context())};
    Analysis made = analysis(true);
    BranchHierarchy hierarchy(volume(), made, context());
    return {std::move(made), std::move(hierarchy)};
}

Selection Source::selection() {
    Selection selection = arguments_.selection;
    const double slope = std::abs(info_.calibration.slope);
    selection.min_hypervolume /= slope;
    if (arguments_.persistence_in_percent)
        selection.min_persistence *= (range().high - range().low) / 100;
    else
        selection.min_persistence /= slope;
    return selection;
}

Spectrum Source::spectrum(const SpectrumOptions& options) {
    if (atlas_ && !arguments_.voxel_units) return isoatlas::spectrum(*atlas_, options, context());
    return isoatlas::spectrum(volume(), analysis(true), options, context());
}

std::vector<ObjectMeasures> Source::measure(double tau, const std::vector<std::int64_t>& objects) {
    const bool thickness = arguments_.thickness;
    if (atlas_ && !arguments_.voxel_units)
        return measure_objects(*atlas_, tau, {.objects = objects, .thickness = thickness}, context(), &cost_);
    const MeasureOptions options{
        .interpolant = interpolant(), .tunnel_height = tunnel_height(), .objects = objects, .thickness = thickness};
    return measure_objects(volume(), tau, options, context());
}

std::vector<ObjectMeasures> Source::measure_labels() {
    return isoatlas::measure_labels(volume(), {.interpolant = interpolant(), .thickness = arguments_.thickness}, context());
}

std::vector<std::int64_t> Source::samples_below(const std::vector<double>& taus) {
    const auto count = [this](const std::vector<double>& at) {
        return volume_ ? isoatlas::samples_below(*volume_, at, context()) : isoatlas::samples_below(*atlas_, at, context());
    };
    if (polarity_of(info_) == Polarity::high) return count(taus);
    std::vector<double> after = taus;  // negated samples that are not above tau are those of the file that are not below it
    for (double& tau : after) tau = std::nextafter(tau, INFINITY);
    std::vector<std::int64_t> below = count(after);
    for (std::int64_t& samples : below) samples = info_.extent.voxels() - samples;
    return below;
}

Percolation Source::percolation() {
    const Percolation found = isoatlas::percolation(volume(), analysis_options(), context());
    if (polarity_of(info_) == Polarity::high) return found;
    return {.high = found.low, .low = found.high};  // of the values of the file
}

Analysis Source::analysis(bool with_zones) {
    if (atlas_ && !with_zones) return atlas_->analysis();
    return analyse(volume(), analysis_options(), context());
}

const Analysis& Source::ranked() {
    if (!ranked_) ranked_ = analysis(true);
    return *ranked_;
}

const Volume& Source::volume() {
    if (!volume_) {
        const AtlasReads before = atlas_->reads();
        volume_ = atlas_->volume(context());
        const AtlasReads after = atlas_->reads();
        QueryCost whole;
        whole.bytes = after.bytes - before.bytes, whole.extents = after.extents - before.extents,
        whole.bricks = after.bricks - before.bricks;
        whole.cells_loaded = whole.cells_visited = info_.extent.voxels();
        cost_ += whole;
        volume_->info = info_;
        if (filters_samples()) volume_ = shaped(std::move(*volume_), arguments_.gaussian, arguments_.box, context());
        info_ = volume_->info;
    }
    return *volume_;
}

const Volume& Source::volume(const SamplesWanted& wanted) {
    if (volume_ || filters_samples()) return volume();
    part_ = atlas_->volume(wanted, context(), &cost_);
    part_->info = info_;
    return *part_;
}

bool Source::filters_samples() const { return filters_stores(arguments_.verb) && (arguments_.box || arguments_.gaussian); }

std::optional<QueryCost> Source::reads() const { return atlas_ ? std::optional(cost_) : std::nullopt; }

}  // namespace isoatlas::cli
