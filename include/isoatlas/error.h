// Error: how isoatlas reports bad input, missing resources and failed guarantees.
//
// Bad input is a reported fact: what happened, in which file and where, what was expected, what to do next.
// Every public function may throw isoatlas::Error and nothing else of ours; a bug is a failed check (kind internal).
// The texts speak of the API. A program with a user interface of its own (isoatlas, a binding) looks at the reason, and says which of its
// own options or buttons helps.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

/// Kind of failure; the value is the exit code of the command line.
enum class ErrorKind : int {
    internal = 1,      ///< a check of isoatlas itself failed: a bug
    usage = 2,         ///< a contradictory or invalid request of the caller
    input = 3,         ///< a file is missing, unreadable, truncated or corrupt
    unsupported = 4,   ///< a valid file of a format or type that isoatlas does not read
    resource = 5,      ///< output cannot be written, disk full, not enough memory
    not_found = 6,     ///< no such object or contour, isovalue outside the range
    verification = 7,  ///< a guarantee does not hold for this mesh or volume
    cancelled = 130    ///< stopped by the user
};

/// Why an operation failed, for programs: one reason for each thing that a caller can do about it. Names are stable, numbers are not.
enum class Reason : std::uint16_t {
    none,  ///< only the text says it

    // Input
    raw_layout_unknown,      ///< RAW: OpenOptions::dims or type is missing; value: name of a sidecar that could hold them
    raw_has_header,          ///< another file describes this RAW file; value: that file
    raw_type_differs,        ///< the size of the RAW file fits these dims with another type; value: the types
    raw_last_size_differs,   ///< the same with another size of the last axis; value: that size
    raw_sizes_differ,        ///< the same with other sizes; value: NXxNYxNZ
    raw_has_more,            ///< a RAW file is longer than its samples; value: OpenOptions::skip_bytes if they are its end
    raw_size_differs,        ///< the size of the RAW file fits nothing near these options
    wrong_dimension,         ///< OpenOptions::dims has not 2 or 3 sizes
    zero_spacing,            ///< OpenOptions::spacing has an axis without a distance
    skip_exceeds_file,       ///< OpenOptions::skip_bytes is not in the file
    contradicts_sidecar,     ///< an option says something else than the sidecar; value: member of OpenOptions
    contradicts_header,      ///< the same for the header of a file that is not RAW
    sidecar_invalid,         ///< the sidecar of a RAW file cannot be understood
    unknown_format,          ///< not a format that is read; value: the nearest known extension, or empty
    foreign_format,          ///< the same, with advice how to convert it
    analyze_pair,            ///< the samples of an Analyze pair: RAW with a header that is not read
    bytes_after_samples,     ///< OpenOptions::skip_rest ignores them
    file_outside_folder,     ///< a header names a file outside its folder; OpenOptions::follow_links allows it
    time_step_needed,        ///< the file has more than one volume; value: the last OpenOptions::time_step
    no_such_time_step,       ///< OpenOptions::time_step is larger than the last one, which is the value
    no_time_steps,           ///< the file has one volume
    channel_needed,          ///< the file has several channels: ErrorText::choices are words for OpenOptions::channel
    no_such_channel,         ///< likewise
    no_channels,             ///< the file has one channel
    series_needed,           ///< a folder has several series, a file several images: ErrorText::choices are words for OpenOptions::series
    no_such_series,          ///< likewise
    no_series,               ///< OpenOptions::series: there is one volume, or the format has neither series nor images
    dataset_needed,          ///< a file has several arrays that could be a volume: ErrorText::choices are words for OpenOptions::dataset
    no_such_dataset,         ///< likewise
    no_datasets,             ///< OpenOptions::dataset is for files of many arrays
    no_such_level,           ///< OpenOptions::level is larger than the last one, which is the value
    built_without_format,    ///< this build of isoatlas lacks the library for a format; value: the library
    no_ranges,               ///< a server sends whole files only, and this one is too large for that
    redirected_elsewhere,    ///< a server redirects to another host; value: that host
    address_token_needed,    ///< a server does not give the file without RemoteOptions::token
    address_token_refused,   ///< or with this one
    address_with_password,   ///< an address with a user name or password in it
    missing_samples,         ///< NaN, infinite or no-data values; MissingPolicy says what to put in their place
    only_missing_samples,    ///< there are no others
    replacement_not_stored,  ///< MissingPolicy::value is not a value of the type of the samples
    no_value_below,  ///< MissingPolicy::Action::below (above): the type has no value below the lowest (above the highest) sample, the value
    unequal_spacing,  ///< the samples of a volume that is filtered are not equally spaced
    not_a_store,
    unknown_store_version,
    no_such_part,         ///< of a store: StoreDump::parts() lists them
    polarity_not_stored,  ///< BuildOptions::polarities; value: the polarity

    // Resources
    not_enough_memory,        ///< the system has no more
    memory_budget_too_small,  ///< for a build; the message has the smallest one
    no_scratch_space,         ///< the disk has no room for a store and its scratch file
    threads_refused,          ///< by the system
    disk_full,                ///< an output
    file_too_large,           ///< an output, for its file system
    folder_missing,           ///< of an output
    not_permitted,            ///< to write in this folder
    disk_read_only,           ///< of an output
    output_is_folder,         ///< an output has the name of a folder
    output_refused,           ///< an output would replace what is not a regular file of this user
    output_read_only,         ///< an output is there and may not be written to
    build_folder_taken,       ///< the folder of a build is something else
    store_being_built,        ///< by another process
    too_many_triangles,       ///< more than SurfaceOptions::max_triangles

    // Server
    port_in_use,
    no_server,          ///< none answers at this address
    no_token,           ///< for the server at this address
    not_an_address,     ///< of a server
    token_wrong,        ///< or missing
    labels_too_large,   ///< for the memory of the server
    not_in_space,       ///< the curves of a 2D image are not a surface
    built_without_web,  ///< this build of isoatlas has no pages

    bug  ///< of isoatlas
};

/// "raw_layout_unknown", ...; "none".
[[nodiscard]] const char* name_of(Reason reason);
/// nullopt: there is no reason of this name.
[[nodiscard]] std::optional<Reason> reason_of(std::string_view name);

/// One of the things to choose from, for an error that asks for a choice.
struct ErrorChoice {
    std::string word{};   ///< that chooses it
    std::string about{};  ///< what it is: "512 x 512 x 100 uint16"
    bool operator==(const ErrorChoice&) const = default;
};

/// The parts of an error message. Empty parts are left out.
struct ErrorText {
    std::string file{};      ///< path of the file concerned
    std::string where{};     ///< offset, line, field or voxel
    std::string what{};      ///< what happened
    std::string expected{};  ///< what was expected instead
    std::string next{};      ///< what the caller can do, in words of the API
    Reason reason = Reason::none;
    std::string value{};                 ///< that goes with the reason (see there); not part of the message
    std::vector<ErrorChoice> choices{};  ///< with reasons that name them; the message has their words
};

/// "FILE: WHERE: WHAT (expected EXPECTED). Next: NEXT"
[[nodiscard]] std::string describe(const ErrorText& text);

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, ErrorText text);
    [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
    [[nodiscard]] const ErrorText& text() const noexcept { return text_; }
    [[nodiscard]] Reason reason() const noexcept { return text_.reason; }

private:
    ErrorKind kind_;
    ErrorText text_;
};

}  // namespace isoatlas
