// Analytic and random fields.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/portable.h"
#include "phantom/fill.h"
#include "phantom/makers.h"

namespace isoatlas {
namespace {

/// cos and sin of the phase of a wave along one axis, per sample.
struct Turn {
    double cosine, sine;
};

Turn turn_by(double turns) { return {cos_turns(turns), sin_turns(turns)}; }
Turn add(const Turn& a, const Turn& b) { return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine}; }

/// A plane wave on the grid: its phase is the sum of three tables, so no cosine is evaluated per voxel.
struct Wave {
    std::vector<Turn> x, y, z;

    /// periods: of the wave along each axis, a side; phase in turns.
    Wave(const std::array<double, 3>& periods, double phase, std::int64_t size) {
        const double side = static_cast<double>(size);
        for (std::int64_t i = 0; i < size; ++i) {
            const double t = static_cast<double>(i) / side;
            x.push_back(turn_by(periods[0] * t + phase));
            y.push_back(turn_by(periods[1] * t));
            z.push_back(turn_by(periods[2] * t));
        }
    }
};

/// Directions are uniform on the sphere (a point of the ball, by rejection); frequencies uniform in 2..10 periods a side.
std::vector<Wave> random_waves(Random& random, int count, std::int64_t size) {
    std::vector<Wave> waves;
    while (static_cast<int>(waves.size()) < count) {
        const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > 1 || length < 0.1) continue;
        const double scale = random.between(2, 10) / length;
        waves.emplace_back(std::array<double, 3>{x * scale, y * scale, z * scale}, random.unit(), size);
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
    const std::int64_t size = options.size;
    Random random(options.seed);
    const std::vector<Wave> waves = random_waves(random, kWaves, size);
    const double scale = 1 / std::sqrt(kWaves / 2.0);  // unit variance
    Volume volume = make_volume({3, {size, size, size}}, ValueType::f32);
    const std::span<float> samples = volume.samples<float>();
    std::vector<double> row(static_cast<std::size_t>(size));
    for (std::int64_t z = 0; z < size; ++z) {
        for (std::int64_t y = 0; y < size; ++y) {
            std::fill(row.begin(), row.end(), 0.0);
            for (const Wave& wave : waves) {
                const Turn start = add(wave.y[y], wave.z[z]);
                for (std::int64_t x = 0; x < size; ++x) row[x] += wave.x[x].cosine * start.cosine - wave.x[x].sine * start.sine;
            }
            float* out = samples.data() + size * (y + size * z);
            for (std::int64_t x = 0; x < size; ++x) out[x] = static_cast<float>(row[x] * scale);
        }
    }
    return volume;
}

Volume noise(const PhantomOptions& options) {
    Random random(options.seed);
    return fill<float>(options.size, options.size, options.size,
                       [&random](std::int64_t, std::int64_t, std::int64_t) { return static_cast<float>(random.bits() >> 40) * 0x1p-24f; });
}

}  // namespace isoatlas
