#include "atlas/build_fingerprint.h"

#include "atlas/access.h"
#include "base/check.h"
#include "codec/checksum.h"
#include "formats/volume/read_slabs.h"
#include "isoatlas/atlas.h"
#include "isoatlas/environment.h"
#include "isoatlas/units.h"
#include "store/container.h"

namespace isoatlas {
namespace {

constexpr const char* kPolarityMember = "polarity";

/// A store of both polarities is one of either.
void compare_polarities(Fingerprint& there, Fingerprint& here) {
    const std::string *stored = there.find(kPolarityMember), *wanted = here.find(kPolarityMember);
    const std::string high = name_of(PolarityChoice::high), of_wanted = wanted == nullptr ? high : *wanted;
    const std::string of_stored = stored == nullptr ? high : *stored == name_of(PolarityChoice::both) ? of_wanted : *stored;
    there.remove(kPolarityMember), here.remove(kPolarityMember);
    there.add(kPolarityMember, of_stored), here.add(kPolarityMember, of_wanted);
}

std::string size_text(const Extent& extent) {
    std::string text = std::to_string(extent.size[0]) + " x " + std::to_string(extent.size[1]);
    return extent.rank == 3 ? text + " x " + std::to_string(extent.size[2]) : text;
}

std::string missing_text(const MissingPolicy& policy) {
    if (policy.action == MissingPolicy::Action::error) return "refused";
    if (policy.action == MissingPolicy::Action::below) return "below all others";
    if (policy.action == MissingPolicy::Action::above) return "above all others";
    return "replaced by " + exact_text(policy.value);
}

/// Checksum of the slice positions of a rectilinear grid.
std::string coordinates_text(const Geometry& geometry) {
    Checksum sum;
    bool is_uneven = false;
    for (const std::vector<double>& places : geometry.coordinates) {
        const std::uint64_t count = places.size();
        is_uneven = is_uneven || count > 0;
        sum.add(std::as_bytes(std::span(&count, 1)));
        sum.add(std::as_bytes(std::span(places)));
    }
    return is_uneven ? "uneven, checksum " + checksum_text(sum.sum()) : "even";
}

void add_geometry(Fingerprint& fingerprint, const Geometry& geometry) {
    fingerprint.add("spacing", exact_text(geometry.spacing, " x "));
    fingerprint.add("steps", coordinates_text(geometry));
    fingerprint.add("origin", exact_text(geometry.origin, ", "));
    std::string rows;
    for (const Vec3& row : geometry.direction) rows += (rows.empty() ? "" : ", ") + exact_text(row, " ");
    fingerprint.add("direction", rows);
    fingerprint.add("space", geometry.space);
    fingerprint.add(kUnitMember, geometry.unit);
}

/// Fingerprint of stores of versions 1 and 2, with the members of header_fingerprint().
Fingerprint fingerprint_of(const Contents& contents) {
    BuildOptions options;
    options.gaussian = contents.volume.gaussian;
    options.analysis.interpolant = contents.parameters.interpolant;
    Fingerprint fingerprint = header_fingerprint(contents.volume, options, contents.parameters.tunnel_height);
    for (const char* untold : {"format", "algorithm", "time step", "missing samples", "no-data value"}) fingerprint.remove(untold);
    return fingerprint;
}

/// The header of a file as in those stores: with its calibration applied where the slope is negative.
VolumeInfo analysed(VolumeInfo info) {
    if (info.calibration.slope < 0) info.type = ValueType::f64, info.calibration = {};
    return info;
}

std::uint64_t sum_of(VolumeReader& volume, const Context& context) {
    Checksum sum;
    for_each_slab(volume, context, {}, [&sum](std::int64_t, std::span<std::byte> samples) { sum.add(samples); });
    return sum.sum();
}

/// Differences from stores without a fingerprint.
std::vector<std::string> differences_of_old(const Contents& contents, VolumeReader& volume, const BuildOptions& options,
                                            double tunnel_height, bool compare_samples, const Context& context) {
    Fingerprint there = fingerprint_of(contents), here = header_fingerprint(analysed(volume.info()), options, tunnel_height);
    std::erase_if(here.members, [&there](const Fingerprint::Member& member) { return there.find(member.name) == nullptr; });
    if (options.polarities != PolarityChoice::high) here.add(kPolarityMember, name_of(options.polarities));
    compare_polarities(there, here);
    std::vector<std::string> found = differences(there, here);
    if (!found.empty() || !compare_samples) return found;
    const bool are_as_read =
        options.gaussian == 0 && options.missing.action == MissingPolicy::Action::error && volume.info().calibration.slope >= 0;
    if (!are_as_read)
        return {"a store of version " + std::to_string(contents.version) + ", which does not record the samples before filtering"};
    if (sum_of(volume, context) != contents.parameters.samples_checksum) found.emplace_back("other samples there");
    return found;
}

}  // namespace

Fingerprint header_fingerprint(const VolumeInfo& file, const BuildOptions& options, double tunnel_height) {
    Fingerprint fingerprint;
    fingerprint.add("format", std::to_string(kStoreVersion));
    fingerprint.add("algorithm", std::to_string(kAlgorithmVersion));
    fingerprint.add("size", size_text(file.extent));
    fingerprint.add("type", name_of(file.type));
    fingerprint.add("time step", options.time_step ? std::to_string(*options.time_step) : "");
    add_geometry(fingerprint, options.geometry ? *options.geometry : file.geometry);
    fingerprint.add("calibration", exact_text(file.calibration.slope) + " x + " + exact_text(file.calibration.intercept));
    fingerprint.add("unit of values", file.value_unit);
    fingerprint.add("description", file.description);
    fingerprint.add("missing samples", missing_text(options.missing));
    fingerprint.add("no-data value", options.missing.no_data ? exact_text(*options.missing.no_data) : "");
    fingerprint.add("Gaussian", options.gaussian > 0 ? exact_text(options.gaussian) : "");
    fingerprint.add("interpolant", name_of(options.analysis.interpolant));
    fingerprint.add("tunnel height", exact_text(tunnel_height));
    if (options.polarities != PolarityChoice::high) fingerprint.add(kPolarityMember, name_of(options.polarities));
    return fingerprint;
}

void add_samples(Fingerprint& fingerprint, std::uint64_t samples, std::uint64_t analysed) {
    fingerprint.add(kSamplesMember, checksum_text(samples));
    fingerprint.add(kAnalysedMember, checksum_text(analysed));
}

struct SummingReader::Data {
    Checksum sum;
    std::int64_t next = 0;  ///< slice
};

SummingReader::SummingReader(VolumeReader& below) : below_(below), data_(std::make_shared<Data>()) { info_ = below.info(); }

void SummingReader::read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) {
    ISOATLAS_CHECK(z_begin == data_->next);
    below_.read(z_begin, z_end, out);
    data_->sum.add(out);
    data_->next = z_end;
    info_ = below_.info();  // after the notes about the end of the file
}

std::uint64_t SummingReader::sum() const {
    ISOATLAS_CHECK(data_->next == info_.extent.size[2]);
    return data_->sum.sum();
}

std::vector<std::string> store_differences(const Atlas& atlas, VolumeReader& volume, const BuildOptions& options, bool compare_samples,
                                           const Context& context) {
    const EnvironmentScope scope(context);
    const Contents& contents = AtlasAccess::store(atlas).contents();
    double tunnel_height = options.analysis.tunnel_height;
    if (options.tunnel_height_percent > 0) {
        const std::array<double, 2> range = atlas.range();  // that of the volume, if the store was built from it
        tunnel_height = options.tunnel_height_percent / 100 * (range[1] - range[0]);
    }
    if (contents.fingerprint.members.empty()) return differences_of_old(contents, volume, options, tunnel_height, compare_samples, context);
    Fingerprint there = contents.fingerprint;
    for (Fingerprint::Member& member : there.members) {
        if (member.name == kUnitMember) member.text = unit_name(member.text);  // earlier stores have "um"
    }
    Fingerprint here = header_fingerprint(volume.info(), options, tunnel_height);
    const std::string* samples = contents.fingerprint.find(kSamplesMember);
    there.remove(kSamplesMember), there.remove(kAnalysedMember);
    compare_polarities(there, here);
    std::vector<std::string> found = differences(there, here);
    if (!found.empty() || !compare_samples) return found;
    if (samples == nullptr || checksum_text(sum_of(volume, context)) != *samples) found.emplace_back("other samples there");
    return found;
}

std::string joined_differences(const std::vector<std::string>& differences) { return joined(differences); }

}  // namespace isoatlas
