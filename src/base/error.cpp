#include "isoatlas/error.h"

#include <utility>

#include "isoatlas/text.h"

namespace isoatlas {

std::string describe(const ErrorText& text) {
    std::string line;
    for (const std::string& part : {text.file, text.where}) {
        if (!part.empty()) line += part + ": ";
    }
    line += text.what;
    if (!text.expected.empty()) line += " (expected " + text.expected + ")";
    if (!text.next.empty()) line += ". Next: " + text.next;
    return shown_name(line);  // a path may hold any byte
}

namespace {

/// Of what a file is, and which part of it is read; nullptr: another reason.
const char* name_of_input(Reason reason) {
    switch (reason) {
        case Reason::raw_layout_unknown: return "raw_layout_unknown";
        case Reason::raw_has_header: return "raw_has_header";
        case Reason::raw_type_differs: return "raw_type_differs";
        case Reason::raw_last_size_differs: return "raw_last_size_differs";
        case Reason::raw_sizes_differ: return "raw_sizes_differ";
        case Reason::raw_has_more: return "raw_has_more";
        case Reason::raw_size_differs: return "raw_size_differs";
        case Reason::wrong_dimension: return "wrong_dimension";
        case Reason::zero_spacing: return "zero_spacing";
        case Reason::skip_exceeds_file: return "skip_exceeds_file";
        case Reason::contradicts_sidecar: return "contradicts_sidecar";
        case Reason::contradicts_header: return "contradicts_header";
        case Reason::sidecar_invalid: return "sidecar_invalid";
        case Reason::unknown_format: return "unknown_format";
        case Reason::foreign_format: return "foreign_format";
        case Reason::analyze_pair: return "analyze_pair";
        case Reason::bytes_after_samples: return "bytes_after_samples";
        case Reason::file_outside_folder: return "file_outside_folder";
        case Reason::time_step_needed: return "time_step_needed";
        case Reason::no_such_time_step: return "no_such_time_step";
        case Reason::no_time_steps: return "no_time_steps";
        case Reason::channel_needed: return "channel_needed";
        case Reason::no_such_channel: return "no_such_channel";
        case Reason::no_channels: return "no_channels";
        case Reason::series_needed: return "series_needed";
        case Reason::no_such_series: return "no_such_series";
        case Reason::no_series: return "no_series";
        case Reason::dataset_needed: return "dataset_needed";
        case Reason::no_such_dataset: return "no_such_dataset";
        case Reason::no_datasets: return "no_datasets";
        case Reason::no_such_level: return "no_such_level";
        case Reason::built_without_format: return "built_without_format";
        case Reason::no_ranges: return "no_ranges";
        case Reason::redirected_elsewhere: return "redirected_elsewhere";
        case Reason::address_token_needed: return "address_token_needed";
        case Reason::address_token_refused: return "address_token_refused";
        case Reason::address_with_password: return "address_with_password";
        default: return nullptr;
    }
}

/// Of samples, stores, resources and servers.
const char* name_of_others(Reason reason) {
    switch (reason) {
        case Reason::missing_samples: return "missing_samples";
        case Reason::only_missing_samples: return "only_missing_samples";
        case Reason::replacement_not_stored: return "replacement_not_stored";
        case Reason::no_value_below: return "no_value_below";
        case Reason::unequal_spacing: return "unequal_spacing";
        case Reason::not_a_store: return "not_a_store";
        case Reason::unknown_store_version: return "unknown_store_version";
        case Reason::no_such_part: return "no_such_part";
        case Reason::polarity_not_stored: return "polarity_not_stored";
        case Reason::not_enough_memory: return "not_enough_memory";
        case Reason::memory_budget_too_small: return "memory_budget_too_small";
        case Reason::no_scratch_space: return "no_scratch_space";
        case Reason::threads_refused: return "threads_refused";
        case Reason::disk_full: return "disk_full";
        case Reason::file_too_large: return "file_too_large";
        case Reason::folder_missing: return "folder_missing";
        case Reason::not_permitted: return "not_permitted";
        case Reason::disk_read_only: return "disk_read_only";
        case Reason::output_is_folder: return "output_is_folder";
        case Reason::output_refused: return "output_refused";
        case Reason::output_read_only: return "output_read_only";
        case Reason::build_folder_taken: return "build_folder_taken";
        case Reason::store_being_built: return "store_being_built";
        case Reason::too_many_triangles: return "too_many_triangles";
        case Reason::port_in_use: return "port_in_use";
        case Reason::no_server: return "no_server";
        case Reason::no_token: return "no_token";
        case Reason::not_an_address: return "not_an_address";
        case Reason::token_wrong: return "token_wrong";
        case Reason::labels_too_large: return "labels_too_large";
        case Reason::not_in_space: return "not_in_space";
        case Reason::built_without_web: return "built_without_web";
        case Reason::bug: return "bug";
        default: return "none";
    }
}

}  // namespace

const char* name_of(Reason reason) {
    const char* name = name_of_input(reason);
    return name != nullptr ? name : name_of_others(reason);
}

std::optional<Reason> reason_of(std::string_view name) {
    for (auto number = static_cast<std::uint16_t>(Reason::none); number <= static_cast<std::uint16_t>(Reason::bug); ++number) {
        if (name == name_of(static_cast<Reason>(number))) return static_cast<Reason>(number);
    }
    return std::nullopt;
}

Error::Error(ErrorKind kind, ErrorText text) : std::runtime_error(describe(text)), kind_(kind), text_(std::move(text)) {}

}  // namespace isoatlas
