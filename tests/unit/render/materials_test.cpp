// Percentages of materials against the formula, and the matter that they make against its integral.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

#include "isoatlas/render.h"

namespace isoatlas {
namespace {

RC_GTEST_PROP(Materials, PercentagesAreTheFormula, ()) {
    std::vector<Material> materials(static_cast<std::size_t>(*rc::gen::inRange(1, 6)));
    for (Material& material : materials)
        material.mean = *rc::gen::inRange(-50, 50), material.sigma = *rc::gen::inRange(1, 400) / 10.0, material.density = 1;
    const double value = *rc::gen::inRange(-100, 100);
    double sum = 0;
    for (const Material& m : materials) sum += std::exp(-0.5 * std::pow((value - m.mean) / m.sigma, 2)) / m.sigma;
    const std::vector<double> percentages = material_percentages(materials, value);
    RC_ASSERT(percentages.size() == materials.size());
    RC_ASSERT(std::abs(std::accumulate(percentages.begin(), percentages.end(), 0.0) - 1) < 1e-12);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Material& m = materials[i];
        const double probability = std::exp(-0.5 * std::pow((value - m.mean) / m.sigma, 2)) / m.sigma;
        if (sum > 1e-250) RC_ASSERT(std::abs(percentages[i] - probability / sum) < 1e-9);
    }
}

TEST(Materials, FarFromEveryMeanTheWidestDistributionHasIt) {
    const std::vector<Material> materials{{.name = "narrow", .mean = 0, .sigma = 1}, {.name = "wide", .mean = -9, .sigma = 2}};
    EXPECT_EQ(material_percentages(materials, 1e6), (std::vector<double>{0, 1}));
    EXPECT_TRUE(material_percentages({}, 1).empty());
    EXPECT_THROW(static_cast<void>(material_percentages(std::vector<Material>{{.name = "none", .sigma = 0}}, 1)), Error);
}

TEST(Materials, MatterIsAsDenseAndOfTheColourThatPercentagesSay) {
    const std::vector<Material> materials{{.name = "air", .mean = 0, .sigma = 12, .colour = {1, 1, 1}, .density = 0},
                                          {.name = "red", .mean = 50, .sigma = 15, .colour = {1, 0, 0}, .density = 0.02},
                                          {.name = "blue", .mean = 90, .sigma = 10, .colour = {0, 0, 1}, .density = 0.05}};
    constexpr double kLength = 20;
    for (const int value : {20, 40, 60, 75, 80, 99}) {
        Volume volume = make_volume({.rank = 3, .size = {21, 21, 21}}, ValueType::u8);
        std::fill(volume.samples<std::uint8_t>().begin(), volume.samples<std::uint8_t>().end(), static_cast<std::uint8_t>(value));
        Scene scene;
        scene.volume = {.volume = &volume, .curves = material_transfer(materials, {0, 100}), .range = {{0, 100}}};
        const RenderOptions options{.width = 9, .height = 9, .background = Background::transparent, .samples = 1, .shading = false};
        const Camera camera{.target = {10, 10, 10}, .view = {.toward = {0, 0, 1}, .up = {0, 1, 0}}, .height = 9};
        const Image image = render_scene(scene, camera, options);
        const std::vector<double> p = material_percentages(materials, value);
        const double red = p[1] * 0.02, blue = p[2] * 0.05;
        const std::uint8_t* pixel = image.at(4, 4);
        EXPECT_NEAR(pixel[3] / 255.0, 1 - std::exp(-kLength * (red + blue)), 0.004) << value;
        const auto srgb = [](double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; };
        EXPECT_NEAR(pixel[0] / 255.0, srgb(red / (red + blue)), 0.01) << value;
        EXPECT_NEAR(pixel[2] / 255.0, srgb(blue / (red + blue)), 0.01) << value;
    }
}

}  // namespace
}  // namespace isoatlas
