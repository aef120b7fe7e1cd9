// Analytic and random fields.
#include <cmath>
#include <vector>

#include "phantom/fill.h"
#include "phantom/makers.h"
#include "phantom/portable.h"

namespace isoatlas::phantom {
namespace {

struct Wave {
    double x, y, z, phase;  // periods a side, turns
};

/// Directions are uniform on the sphere (a point of the ball, by rejection); frequencies uniform in 2..10.
std::vector<Wave> random_waves(Random& random, int count) {
    std::vector<Wave> waves;
    while (static_cast<int>(waves.size()) < count) {
        const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > 1 || length < 0.1) continue;
        const double scale = random.between(2, 10) / length;
        waves.push_back({x * scale, y * scale, z * scale, random.unit()});
    }
    return waves;
}

}  // namespace

Volume marschner_lobb(const PhantomOptions& options) {
    constexpr double kFrequency = 6, kAlpha = 0.25;
    const double step = 2 / static_cast<double>(options.size - 1);
    return fill<float>(options.size, options.size, options.size, [step](std::int64_t ix, std::int64_t iy, std::int64_t iz) {
        const double x = static_cast<double>(ix) * step - 1, y = static_cast<double>(iy) * step - 1, z = static_cast<double>(iz) * step - 1;
        const double ripple = cos_turns(kFrequency * cos_turns(std::sqrt(x * x + y * y) / 4));
        return (1 - sin_turns(z / 4) + kAlpha * (1 + ripple)) / (2 * (1 + kAlpha));
    });
}

Volume gyroid(const PhantomOptions& options) {
    constexpr double kPeriods = 2;
    const double step = kPeriods / static_cast<double>(options.size - 1);
    const double middle = static_cast<double>(options.size - 1) / 2;
    const auto turns = [step, middle](std::int64_t i) { return (static_cast<double>(i) - middle) * step; };
    return fill<float>(options.size, options.size, options.size, [&](std::int64_t ix, std::int64_t iy, std::int64_t iz) {
        const double x = turns(ix), y = turns(iy), z = turns(iz);
        return sin_turns(x) * cos_turns(y) + sin_turns(y) * cos_turns(z) + sin_turns(z) * cos_turns(x);
    });
}

Volume checkerboard(const PhantomOptions& options) {
    return fill<std::uint8_t>(options.size, options.size, options.size,
                              [](std::int64_t x, std::int64_t y, std::int64_t z) { return (x + y + z) % 2 == 0 ? 1 : 0; });
}

Volume random_field(const PhantomOptions& options) {
    constexpr int kWaves = 60;
    Random random(options.seed);
    const std::vector<Wave> waves = random_waves(random, kWaves);
    const double scale = 1 / static_cast<double>(options.size);
    return fill<float>(options.size, options.size, options.size, [&](std::int64_t ix, std::int64_t iy, std::int64_t iz) {
        const double x = static_cast<double>(ix) * scale, y = static_cast<double>(iy) * scale, z = static_cast<double>(iz) * scale;
        double sum = 0;
        for (const Wave& wave : waves) sum += cos_turns(wave.x * x + wave.y * y + wave.z * z + wave.phase);
        return sum / std::sqrt(static_cast<double>(kWaves) / 2);
    });
}

Volume noise(const PhantomOptions& options) {
    Random random(options.seed);
    return fill<float>(options.size, options.size, options.size,
                       [&random](std::int64_t, std::int64_t, std::int64_t) { return static_cast<float>(random.bits() >> 40) * 0x1p-24f; });
}

}  // namespace isoatlas::phantom
