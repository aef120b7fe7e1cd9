#include "field/negate.h"

#include <utility>

#include "base/streamed.h"

namespace isoatlas {

const char* name_of(Polarity polarity) { return polarity == Polarity::high ? "high" : "low"; }

const char* name_of(PolarityChoice choice) {
    static constexpr const char* kName[] = {"high", "low", "both"};
    return kName[static_cast<int>(choice)];
}

bool holds(PolarityChoice choice, Polarity polarity) {
    return choice == PolarityChoice::both || (choice == PolarityChoice::low) == (polarity == Polarity::low);
}

Polarity polarity_of(const VolumeInfo& info) { return info.calibration.mirror ? Polarity::low : Polarity::high; }

double mirror_of(ValueType type) {
    return visit_type(type, []<class T>(T) { return std::is_floating_point_v<T> ? 0.0 : static_cast<double>(negated_sample(T{0})); });
}

void negate_samples(ValueType type, std::span<std::byte> bytes) {
    visit_type(type, [&]<class T>(T) {
        const std::span<T> samples(reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T));
        constexpr std::size_t kPart = std::size_t{1} << 20;
        for (const Block block : streamed_blocks(samples.size(), kPart)) {
            for (T& sample : samples.subspan(block.first, block.size())) sample = negated_sample(sample);
        }
    });
}

VolumeInfo negated(VolumeInfo info) {
    std::optional<double>& mirror = info.calibration.mirror;
    mirror = mirror ? std::nullopt : std::optional(mirror_of(info.type));
    return info;
}

Volume negated(Volume volume) {
    negate_samples(volume.info.type, volume.bytes);
    volume.info = negated(std::move(volume.info));
    return volume;
}

}  // namespace isoatlas
