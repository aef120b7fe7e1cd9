#include "text/advice.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <isoatlas/shell_word.h>

namespace isoatlas::cli {
namespace {

/// {value} and {file} are those of the error, {option} is the option of the member of OpenOptions that the value names, {guess} asks
/// whether the value was meant.
struct Advice {
    Reason reason;
    const char* next;
    const char* what = nullptr;  ///< null: as the library says it
};

constexpr Advice kAdvice[] = {
    {Reason::raw_layout_unknown,
     "give --dims NXxNYxNZ --type TYPE, or write them into {value}, or name the file like name_64x64x64_uint8.raw"},
    {Reason::raw_type_differs, "the size fits these dims with --type {value}"},
    {Reason::raw_sizes_differ, "the size fits --dims {value} with this type"},
    {Reason::raw_has_more, "if the file begins with a header, add --skip {value}; if something follows the samples, pass --skip-rest"},
    {Reason::raw_size_differs, "check --dims, --type and --skip"},
    {Reason::wrong_dimension, "give --dims NXxNY or NXxNYxNZ"},
    {Reason::zero_spacing, "correct --spacing, or omit it", "--spacing has an axis whose samples are no distance apart"},
    {Reason::skip_exceeds_file, "correct --skip"},
    {Reason::contradicts_sidecar, "leave {option} out or correct the sidecar", "{option} contradicts the sidecar of the file"},
    {Reason::contradicts_header, "leave {option} out; it is for RAW files", "{option} contradicts the header of the file"},
    {Reason::sidecar_invalid, "correct the sidecar, or delete it and give --dims and --type"},
    {Reason::unknown_format, "{guess}convert the file, or give --dims and --type if it is RAW"},
    {Reason::analyze_pair, "give it as RAW with --dims and --type, or convert the pair to NIfTI"},
    {Reason::bytes_after_samples, "the header or the file is damaged, or it holds more than a volume: then pass --skip-rest"},
    {Reason::file_outside_folder, "copy the file into the folder, or pass --follow-links if you trust where this volume comes from"},
    {Reason::time_step_needed, "choose one with --time-step N, N from 0 to {value}"},
    {Reason::no_such_time_step, "choose another --time-step"},
    {Reason::no_time_steps, "omit --time-step"},
    {Reason::channel_needed, "choose one with --channel NAME or its number"},
    {Reason::no_such_channel, "choose another --channel"},
    {Reason::no_channels, "omit --channel"},
    {Reason::series_needed, "choose one with --series"},
    {Reason::no_such_series, "choose another --series"},
    {Reason::no_series, "omit --series"},
    {Reason::dataset_needed, "name one behind the file: {file}:/NAME"},
    {Reason::no_such_dataset, "name another one behind the file"},
    {Reason::no_datasets, "omit what follows the name of the file"},
    {Reason::no_such_level, "choose another --level"},
    {Reason::no_ranges,
     "download it (curl -O) and open the copy, or put it on a server that answers range requests, such as nginx or isoatlas serve"},
    {Reason::redirected_elsewhere, "if you trust {value}, give the address that it redirects to: curl -sI shows it"},
    {Reason::address_token_needed, "if it takes a bearer token, put it into the environment: ISOATLAS_BEARER_TOKEN"},
    {Reason::address_token_refused, "check ISOATLAS_BEARER_TOKEN: the token may have expired"},
    {Reason::address_with_password, "leave them out; a bearer token is taken from the environment: ISOATLAS_BEARER_TOKEN"},
    {Reason::missing_samples, "treat such samples as background with --missing below, or put a value in their place with --missing VALUE"},
    {Reason::only_missing_samples, "check the file and --no-data"},
    {Reason::replacement_not_stored, "give another value, or --missing below"},
    {Reason::no_value_below, "give a value instead: --missing {value}"},
    {Reason::unequal_spacing, "resample it to equal spacing first, or take the grid as it is with --voxel"},
    {Reason::not_a_store, "build one: isoatlas build VOLUME -o FILE.atlas"},
    {Reason::polarity_not_stored, "isoatlas build VOLUME --polarity both -o FILE.atlas builds one that does"},
    {Reason::no_such_part, "isoatlas dump {file} lists the parts with their sizes"},
    {Reason::memory_budget_too_small, "give a larger --memory, or fewer --threads"},
    {Reason::no_scratch_space, "free some space, choose another folder with -o, or allow more --memory"},
    {Reason::threads_refused, "allow this process more memory and threads (ulimit -v, ulimit -u), or use fewer --threads"},
    {Reason::output_refused, "choose another name with -o"},
    {Reason::output_read_only, "choose another name with -o, or allow it with chmod u+w"},
    {Reason::build_folder_taken, "rename or remove it, or build to another file with -o"},
    {Reason::store_being_built, "wait until it is done, or build to another file with -o"},
    {Reason::too_many_triangles, "ask for one object or another isovalue; isoatlas extract writes surfaces of any size"},
    {Reason::port_in_use, "choose another one with --port, or omit --port"},
    {Reason::no_server, "is `isoatlas view` still running? Start it again and use its new address"},
    {Reason::no_token,
     "is `isoatlas view` still running? Start it again and use its new address; the token of another user's viewer can "
     "be set as ISOATLAS_TOKEN"},
    {Reason::not_an_address, "use the address that `isoatlas view` printed, up to its port"},
    {Reason::token_wrong, "open the address that `isoatlas view` printed"},
    {Reason::labels_too_large, "isoatlas label writes them; or start the viewer with more --memory"},
    {Reason::not_in_space, "isoatlas extract writes them"},
    {Reason::built_without_web, "install npm and build it again without -DISOATLAS_WEB=OFF"},
    {Reason::bug, "please report it with the command line and, if you may share it, the file"},
};

std::string option_of(const std::string& member) {
    constexpr std::pair<const char*, const char*> options[] = {{"big_endian", "--endian"}, {"skip_bytes", "--skip"}};
    const auto found = std::ranges::find_if(options, [&](const auto& option) { return member == option.first; });
    return found == std::end(options) ? "--" + member : found->second;
}

std::string filled(const char* pattern, const ErrorText& text) {
    return fmt::format(fmt::runtime(pattern), fmt::arg("value", text.value), fmt::arg("file", shell_word(text.file)),
                       fmt::arg("option", option_of(text.value)),
                       fmt::arg("guess", text.value.empty() ? "" : "did you mean " + text.value + "? "));
}

}  // namespace

Error with_options(const Error& error) {
    const Advice* advice = std::ranges::find(kAdvice, error.reason(), &Advice::reason);
    if (advice == std::end(kAdvice)) return error;
    ErrorText text = error.text();
    text.next = filled(advice->next, text);
    if (advice->what != nullptr) text.what = filled(advice->what, text);
    return {error.kind(), text};
}

}  // namespace isoatlas::cli
