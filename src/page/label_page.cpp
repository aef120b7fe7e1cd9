// The page of a label volume: docs/schema/label-page.schema.json.
#include "isoatlas/label_page.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "catalogue/draw_cards.h"
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

/// Returns the coarse surfaces of the cards; none of a 2D volume.
std::vector<CoarseSurface> draw_labels(const Volume& volume, Interpolant interpolant, std::span<LabelCard> cards,
                                       const PageOptions& options, const std::function<void(std::size_t)>& drawn, const Context& context) {
    const bool is_flat = volume.info.extent.rank == 2;
    std::vector<std::optional<CoarseSurface>> coarse(is_flat ? 0 : cards.size());
    const auto surface = [&](std::size_t i, const Context& own) {
        ExtractOptions extracted{.interpolant = interpolant};
        extracted.surface.ids = false;
        return extract_label(volume, cards[i].region.label, extracted, own);
    };
    const auto draw = [&](std::size_t i, const Context& own) {
        LabelCard& card = cards[i];
        if (is_flat) {
            card.picture = draw_still(mask_of(volume, card.region.label), 0.5, card.colour, options, own);
            return;
        }
        CardPicture now = draw_card(surface(i, own), card.colour, options, own);
        card.picture = std::move(now.picture);
        coarse[i] = std::move(now.coarse);
    };
    draw_cards(cards.size(), draw, drawn, context);
    return coarse_cards(std::move(coarse), surface, context);
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
    const auto tell = [&](std::size_t pictures) {
        if (!options.partly_written) return;
        write_page_file(path, text_of(false));
        options.partly_written(static_cast<std::int64_t>(pictures));
    };
    const std::vector<CoarseSurface> surfaces = draw_labels(volume, interpolant, drawn, options, tell, context);
    const std::vector<PageMesh> meshes = page_meshes(surfaces, bytes_for_meshes(text_of(true), shown), silent);
    for (std::size_t i = 0; i < meshes.size(); ++i) drawn[i].mesh = meshes[i];
    return {.objects = shown, .hidden = std::ssize(cards) - shown, .bytes = write_page_file(path, text_of(true))};
}

}  // namespace isoatlas
