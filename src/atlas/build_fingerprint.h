// What a build follows from: that of what is asked for, before any sample is read, and what the samples add.
#pragma once

#include <cstdint>

#include "isoatlas/build.h"
#include "store/contents.h"
#include "store/fingerprint.h"

namespace isoatlas {

inline constexpr const char* kSamplesMember = "checksum of the samples";
inline constexpr const char* kAnalysedMember = "checksum of the samples that are analysed";

/// file: as the reader tells it. tunnel_height: stored values, whatever the options say.
[[nodiscard]] Fingerprint header_fingerprint(const VolumeInfo& file, const BuildOptions& options, double tunnel_height);

/// samples: checksum of those in the file; analysed: of those after missing values, calibration and filter.
void add_samples(Fingerprint& fingerprint, std::uint64_t samples, std::uint64_t analysed);

/// A reader that sums up what it reads; slabs come in order.
class SummingReader final : public VolumeReader {
public:
    explicit SummingReader(VolumeReader& below);
    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override;
    /// Of all samples. A failed check: they have not been read, each once.
    [[nodiscard]] std::uint64_t sum() const;

private:
    struct Data;
    VolumeReader& below_;
    std::shared_ptr<Data> data_;
};

}  // namespace isoatlas
