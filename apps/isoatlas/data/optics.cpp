// The optical models of volume rendering: which options go together.
#include "data/picture.h"

#include <array>
#include <cmath>

#include "options/words.h"

namespace isoatlas::cli {
namespace {

const std::vector<std::pair<std::string, OpticalModel>> kModels{{"absorption", OpticalModel::absorption},
                                                                {"emission", OpticalModel::emission},
                                                                {"absorption-emission", OpticalModel::absorption_emission},
                                                                {"single-scattering", OpticalModel::single_scattering},
                                                                {"multiple-scattering", OpticalModel::multiple_scattering}};

[[noreturn]] void refuse_optics(const std::string& what, const std::string& next) {
    throw Error(ErrorKind::usage, {.what = what, .next = next});
}

/// Options that only some of the models know.
void check_combination(const PictureWords& words, const PictureArguments& picture) {
    const bool is_default = picture.optics == OpticalModel::absorption_emission,
               is_multiple = picture.optics == OpticalModel::multiple_scattering;
    const bool scatters = is_multiple || picture.optics == OpticalModel::single_scattering;
    if (!is_default && !picture.volume)
        refuse_optics("--optics " + words.optics + " is of volume rendering, and there is none",
                      "add --volume, or --transfer or --material");
    if (!is_default && picture.shadows)
        refuse_optics(
            "--shadows does not go with --optics " + words.optics,
            scatters ? "leave out --shadows: what scatters is in the shadow of other matter" : "leave out --shadows, or --optics");
    if (picture.optics == OpticalModel::emission && picture.background == Background::transparent)
        refuse_optics("--optics emission has no opacity, and is not seen on a transparent background", "use --background dark");
    const std::array<std::pair<const char*, bool>, 3> given{
        {{"--albedo", words.albedo.has_value()}, {"--asymmetry", words.asymmetry.has_value()}, {"--light", !words.light.empty()}}};
    for (const auto& [option, is_given] : given) {
        if (is_given && !scatters)
            refuse_optics(std::string(option) + " is of matter that scatters, and --optics " + words.optics + " does not",
                          "add --optics single-scattering or --optics multiple-scattering, or leave it out");
    }
    if (words.sky && !is_multiple)
        refuse_optics("--sky is of multiple scattering, and not of --optics " + words.optics,
                      "add --optics multiple-scattering, or leave it out");
}

}  // namespace

std::string_view optics_name(OpticalModel model) {
    for (const auto& [name, known] : kModels) {
        if (known == model) return name;
    }
    return {};
}

void convert_optics(const PictureWords& words, PictureArguments& picture) {
    picture.optics = parse_choice<OpticalModel>("--optics", words.optics, kModels);
    check_combination(words, picture);
    Scattering& scattering = picture.scattering;
    scattering.albedo = words.albedo.value_or(scattering.albedo);
    scattering.asymmetry = words.asymmetry.value_or(scattering.asymmetry);
    scattering.sky = words.sky.value_or(scattering.sky);
    if (!words.light.empty()) scattering.to_light = direction_of("--light", words.light);
}

}  // namespace isoatlas::cli
