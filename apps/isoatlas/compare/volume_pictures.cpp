#include "compare/volume_pictures.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "compare/html.h"
#include "compare/html_table.h"
#include "compare/output.h"
#include "compare/seconds_of.h"
#include "data/picture.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kPictureSide = 240;

constexpr std::array<std::pair<OpticalModel, const char*>, 5> kOpticalModels{
    {{OpticalModel::absorption, "Absorption"},
     {OpticalModel::emission, "Emission"},
     {OpticalModel::absorption_emission, "Absorption and emission"},
     {OpticalModel::single_scattering, "Single scattering"},
     {OpticalModel::multiple_scattering, "Multiple scattering"}}};

/// Nothing below tau, then as much as lets light pass a few voxels.
SceneVolume matter_from(const Volume& volume, double tau) {
    const std::array<double, 2> range = visit_samples(volume, [](auto samples) {
        const auto [first, last] = std::ranges::minmax_element(samples);
        return std::array<double, 2>{static_cast<double>(*first), static_cast<double>(*last)};
    });
    const double voxel = std::ranges::min(volume.info.geometry.spacing), ramp = 0.02 * (range[1] - range[0]);
    const double thin = extinction_of(0.05, voxel), thick = extinction_of(0.25, voxel);
    SceneVolume matter{.volume = &volume, .range = range};
    matter.curves = {{.points = {{tau - ramp, 0}, {tau + ramp, thin}, {std::max(range[1], tau + 2 * ramp), thick}}, .colour = palette(0)}};
    return matter;
}

std::vector<ModelPicture> draw_models(const SceneVolume& matter, const Camera& camera, const Context& context) {
    std::vector<ModelPicture> pictures;
    for (const auto& [model, title] : kOpticalModels) {
        Scene scene;
        scene.volume = matter;
        scene.volume.optics = model;
        scene.volume.scattering.albedo = 0.95;
        const bool is_multiple = model == OpticalModel::multiple_scattering;
        if (is_multiple) scene.volume.scattering.sky = 0.25;
        const RenderOptions options{.width = kPictureSide,
                                    .height = kPictureSide,
                                    .background = model == OpticalModel::absorption ? Background::light : Background::dark,
                                    .samples = is_multiple ? 4 : 1};
        ModelPicture picture{.name = std::string(optics_name(model)), .title = title};
        picture.seconds = seconds_of([&] { picture.image = render_scene(scene, camera, options, context); });
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

std::vector<ProjectionPicture> draw_projections(const SceneVolume& matter, const Camera& camera, const Context& context) {
    const ProjectionOptions options{.width = kPictureSide, .height = kPictureSide};
    const ProjectedPicture exact = projected_integral(matter, camera, options, context);
    std::vector<ProjectionPicture> pictures;
    for (const ProjectionMethodInfo& info : projection_methods()) {
        ProjectedPicture projected;
        ProjectionPicture picture{.name = std::string(info.name), .title = std::string(info.title), .source = std::string(info.source)};
        picture.seconds = seconds_of([&] { projected = project_by(info.method, matter, camera, options, context); });
        picture.samples = projected.samples, picture.error = picture_error(projected, exact), picture.image = image_of(projected);
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

std::string figure_of(const Image& image, const std::string& title, const std::string& note) {
    return fmt::format(
               R"(<li><figure><img width="{0}" height="{0}" style="background:#1d1f26" alt="{1}: {2}" src="{3}"><figcaption>{1}<span>{2}</span></figcaption></figure></li>)",
               kPictureSide, html_text(title), html_text(note), data_address(image)) +
           "\n";
}

}  // namespace

VolumePictures make_volume_pictures(const Volume& volume, double tau, const Camera& camera, const Context& context) {
    const auto& axes = volume.info.geometry.coordinates;
    if (std::ranges::any_of(axes, [](const std::vector<double>& axis) { return !axis.empty(); })) return {};
    const SceneVolume matter = matter_from(volume, tau);
    Context silent = context;
    silent.progress = {};
    return {draw_models(matter, camera, silent), draw_projections(matter, camera, silent), kPictureSide};
}

std::string volume_pictures_html(const VolumePictures& pictures) {
    if (pictures.models.empty()) return "";
    std::string html = "<section class=\"panel\">\n<h2>Volume rendering</h2>\n<ul class=\"pictures\">\n";
    for (const ModelPicture& one : pictures.models) html += figure_of(one.image, one.title, milliseconds(one.seconds) + " ms");
    for (const ProjectionPicture& one : pictures.projections)
        html += figure_of(one.image, one.title, fmt::format("root mean square error {:.4f}", one.error.root_mean_square));
    html += "</ul>\n";
    HtmlTable table(
        "Image order and object order: absorption and emission against the integral",
        {{"method", true}, {"source", true}, {"time, ms"}, {"values looked at"}, {"root mean square error"}, {"largest error"}});
    for (const ProjectionPicture& one : pictures.projections) {
        table.begin(html_text(one.title));
        for (const std::string& cell : {html_text(one.source), milliseconds(one.seconds), count_text(one.samples),
                                        fmt::format("{:.5f}", one.error.root_mean_square), fmt::format("{:.3f}", one.error.largest)})
            table.add(cell);
    }
    return html + table.html() +
           fmt::format(
               "<p class=\"note\">Matter where the value is at least the isovalue, the denser the higher; {0} x {0} pixels. Optical "
               "models as isoatlas render --optics draws them. Errors are of colours and opacities from 0 to 1, against rays with "
               "32 samples a voxel; methods that project use one thread.</p>\n</section>\n",
               pictures.side);
}

}  // namespace isoatlas::cli
