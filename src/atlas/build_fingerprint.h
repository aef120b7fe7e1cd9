// The fingerprint of a build: of header and options, before any sample is read, and of the samples.
#pragma once

#include <cstdint>

#include "isoatlas/build.h"
#include "store/contents.h"
#include "store/fingerprint.h"

namespace isoatlas {

inline constexpr const char* kUnitMember = "unit of length";
inline constexpr const char* kSamplesMember = "checksum of the samples";
inline constexpr const char* kAnalysedMember = "checksum of the samples that are analysed";

/// file: info of the reader. tunnel_height: stored values; overrides the options.
[[nodiscard]] Fingerprint header_fingerprint(const VolumeInfo& file, const BuildOptions& options, double tunnel_height);

/// samples: checksum of the samples in the file; analysed: of the samples after missing values, calibration and filter.
void add_samples(Fingerprint& fingerprint, std::uint64_t samples, std::uint64_t analysed);

/// A reader that computes the checksum of the slabs it reads, in order.
class SummingReader final : public VolumeReader {
public:
    explicit SummingReader(VolumeReader& below);
    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override;
    /// Checksum of all samples. Precondition (checked): each was read once.
    [[nodiscard]] std::uint64_t sum() const;

private:
    struct Data;
    VolumeReader& below_;
    std::shared_ptr<Data> data_;
};

}  // namespace isoatlas
