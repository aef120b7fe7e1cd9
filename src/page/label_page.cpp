// The page of a label volume: docs/schema/label-page.schema.json.
#include "isoatlas/label_page.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "base/cancel.h"
#include "base/phase.h"
#include "catalogue/turntable.h"
#include "isoatlas/environment.h"
#include "isoatlas/labels.h"
#include "isoatlas/units.h"
#include "isoatlas/version.h"
#include "page/page_file.h"
#include "page/page_json.h"
#include "page/web_colour.h"

namespace isoatlas {
namespace {

struct LabelCard {
    LabelRegion region;
    std::string name;
    Colour colour;
    Turntable picture{};
    PageMesh mesh{};
};

/// 1 where a sample of a 2D volume has the label.
Volume mask_of(const Volume& volume, std::int64_t label) {
    Volume mask = make_volume(volume.info.extent, ValueType::u8, volume.info.geometry);
    visit_samples(volume, [&](auto samples) {
        std::ranges::transform(samples, mask.samples<std::uint8_t>().begin(), [&](auto sample) {
            return static_cast<std::uint8_t>(static_cast<double>(sample) == static_cast<double>(label));
        });
    });
    return mask;
}

/// Draws its picture; use(surface): before that, of a 3D volume.
void draw(const Volume& volume, Interpolant interpolant, LabelCard& card, const PageOptions& options,
          const std::function<void(const Surface&)>& use, const Context& context) {
    if (volume.info.extent.rank == 2) {
        card.picture = draw_still(mask_of(volume, card.region.label), 0.5, card.colour, options, context);
        return;
    }
    ExtractOptions extracted{.interpolant = interpolant};
    extracted.surface.ids = false;
    Surface surface = extract_label(volume, card.region.label, extracted, context);
    use(surface);
    card.picture = draw_turntable(std::move(surface), card.colour, options, context);
}

void draw_all(const Volume& volume, Interpolant interpolant, std::span<LabelCard> cards, const PageOptions& options,
              const std::function<void(const Surface&)>& use, const Context& context) {
    Context silent = context;
    silent.progress = nullptr;
    for (std::size_t i = 0; i < cards.size(); ++i) {
        report(context, only_phase("draw"), static_cast<double>(i) / static_cast<double>(cards.size()));
        stop_if_cancelled(context);
        draw(volume, interpolant, cards[i], options, use, silent);
    }
}

/// As many triangles each as fit in the bytes together. surfaces: of the cards; none of a 2D volume.
void add_meshes(const std::vector<CoarseSurface>& surfaces, std::span<LabelCard> cards, std::int64_t bytes, const Context& context) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        cards[i].mesh = page_mesh(surfaces[i], bytes / static_cast<std::int64_t>(surfaces.size() - i), context);
        bytes -= std::ssize(cards[i].mesh.data);
    }
}

/// Largest first.
std::vector<LabelCard> cards_of(const LabelTable& table, std::span<const NamedLabel> names) {
    std::vector<LabelCard> cards;
    for (const LabelRegion& region : table.regions) {
        LabelCard card{region, "", colour_of_object(region.label)};
        const auto named = std::ranges::find(names, region.label, &NamedLabel::label);
        if (named != names.end()) {
            card.name = named->name;
            card.colour = {named->colour[0] / 255.0, named->colour[1] / 255.0, named->colour[2] / 255.0};
        }
        cards.push_back(card);
    }
    std::ranges::stable_sort(cards, std::ranges::greater(), [](const LabelCard& card) { return card.region.voxels; });
    return cards;
}

void write_volume(JsonStream& json, const VolumeInfo& info) {
    std::string name = info.path.substr(info.path.rfind('/') + 1);
    json.key("volume").begin_object().key("name").value(name).key("size").begin_array();
    for (int a = 0; a < info.extent.rank; ++a) json.value(info.extent.size[a]);
    json.end_array().key("type").value(name_of(info.type)).key("spacing");
    if (info.geometry.coordinates[0].empty()) {
        json.value(info.geometry.spacing);
    } else {
        json.null();
    }
    const std::string unit = length_unit_name(info.geometry);
    json.key("unit");
    if (unit == "voxels") {
        json.null();
    } else {
        json.value(unit);
    }
    json.end_object().line();
}

void write_card(JsonStream& json, const LabelCard& card, const std::string& source) {
    const LabelRegion& region = card.region;
    json.line().begin_object().key("label").value(region.label).key("name");
    if (card.name.empty()) {
        json.null();
    } else {
        json.value(card.name);
    }
    json.key("voxels").value(region.voxels).key("measure").value(region.measure).key("components").value(region.components);
    json.key("tunnels").value(region.tunnels).key("cavities").value(region.cavities);
    json.key("colour").value(web_colour(card.colour)).key("picture");
    write_picture(json, card.picture);
    write_mesh(json, card.mesh);
    json.key("commands").begin_array();
    const std::string number = std::to_string(region.label);
    for (const auto& [name, verb, suffix] : {std::array<const char*, 3>{"surface", "extract", ".ply"},
                                             {"the label alone", "label", ".seg.nrrd"},
                                             {"picture", "render", ".png"}}) {
        json.begin_object().key("name").value(name).key("line");
        json.value("isoatlas " + std::string(verb) + " " + source + " --object " + number + " -o label-" + number + suffix).end_object();
    }
    json.end_array().end_object();
}

std::string json_of(const Volume& volume, Interpolant interpolant, const std::vector<LabelCard>& cards, std::int64_t background,
                    const PageOptions& options, bool is_complete) {
    std::string text;
    JsonStream json([&text](std::string_view more) { text += more; });
    json.begin_object().key("schema").value("isoatlas/label-page/1").key("version").value(ISOATLAS_VERSION).line();
    write_volume(json, volume.info);
    json.key("notes").begin_array();
    for (const std::string& note : options.notes) json.value(note);
    json.end_array().key("interpolant").value(name_of(interpolant)).key("background").value(background);
    json.key("complete").value(is_complete).line().key("labels").begin_array();
    for (const LabelCard& card : cards) write_card(json, card, options.source.empty() ? volume.info.path : options.source);
    json.end_array().line().end_object().finish();
    return text;
}

}  // namespace

PageReport write_label_page(const std::string& path, const Volume& volume, Interpolant interpolant, std::span<const NamedLabel> names,
                            const PageOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    check_page_options(options);
    check_has_pages();
    const LabelTable table = list_labels(volume, {.interpolant = interpolant}, context);
    std::vector<LabelCard> cards = cards_of(table, names);
    const std::int64_t shown = std::min<std::int64_t>(options.top, std::ssize(cards));
    Context silent = context;
    silent.progress = nullptr;
    const std::span drawn(cards.data(), static_cast<std::size_t>(shown));
    const auto text_of = [&](bool is_complete) { return json_of(volume, interpolant, cards, table.background, options, is_complete); };
    PageReport page{.objects = shown, .hidden = std::ssize(cards) - shown};
    if (options.stills_written) {
        PageOptions still = options;
        still.frames = 1;
        draw_all(volume, interpolant, drawn, still, [](const Surface&) {}, context);
        page.bytes = write_page_file(path, text_of(false));
        options.stills_written(page);
    }
    std::vector<CoarseSurface> surfaces;
    draw_all(
        volume, interpolant, drawn, options, [&](const Surface& surface) { surfaces.push_back(coarse_for_page(surface, silent)); },
        context);
    add_meshes(surfaces, drawn, bytes_for_meshes(text_of(true), shown), silent);
    page.bytes = write_page_file(path, text_of(true));
    return page;
}

}  // namespace isoatlas
