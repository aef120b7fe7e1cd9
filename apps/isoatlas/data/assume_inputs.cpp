#include "data/assume_inputs.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "data/input.h"
#include "data/session.h"
#include "data/source.h"
#include "options/words.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

/// Verbs whose results follow from the samples; the others take them as they are.
bool is_analysis(const std::string& verb) {
    constexpr std::array<std::string_view, 14> verbs{"atlas", "view",    "build",   "objects", "measure", "tree",     "extract",
                                                     "label", "animate", "handles", "render",  "verify",  "spectrum", "name"};
    return std::ranges::find(verbs, verb) != verbs.end();
}

/// Two digits, and never 1e+02.
std::string percent(double part) { return part >= 0.995 ? "nearly all" : fmt::format("{:.2g} %", 100 * part); }

/// The number as a user would type it: 1e20 for the float next to it.
double typed_value(double stored, ValueType type) {
    double typed = stored;
    if (type == ValueType::f32) (void)read_number(fmt::format("{}", static_cast<float>(stored)), typed);
    return typed;
}

/// Fill values lie below all others where the type has room for it, else they become the lowest of the others; for objects of low values
/// above all others, else the highest.
MissingPolicy without_fill(MissingPolicy missing, const FillValue& fill, ValueType type, bool is_low) {
    using Action = MissingPolicy::Action;
    missing.no_data = typed_value(fill.value, type);
    if (missing.action == Action::replace) return missing;
    const bool has_room = visit_type(type, [&]<class T>(T) {
        return is_low ? fill.high < static_cast<double>(std::numeric_limits<T>::max())
                      : fill.low > static_cast<double>(std::numeric_limits<T>::lowest());
    });
    const Action beyond = is_low ? Action::above : Action::below;
    if (missing.action == Action::error) {
        missing.action = has_room ? beyond : Action::replace;
        missing.value = is_low ? fill.high : fill.low;
    }
    return missing;
}

void leave_out(Arguments& arguments, const FillValue& fill, const VolumeInfo& info, std::int64_t samples) {
    const MissingPolicy given = arguments.missing;
    arguments.missing = without_fill(given, fill, info.type, arguments.is_low());
    if (!arguments.is_low() && given.action != MissingPolicy::Action::replace) {
        MissingPolicy of_low = given;
        if (of_low.action == MissingPolicy::Action::below) of_low.action = MissingPolicy::Action::above;
        arguments.inputs.missing_of_low = without_fill(of_low, fill, info.type, true);
    }
    const Scale scale(info);
    arguments.inputs.assumed.push_back(fmt::format(
        "{} looks like a fill value ({} of the samples, the others are {} .. {}) and counts as missing; --no-data none takes it as a value",
        scale.text(fill.value), percent(static_cast<double>(fill.count) / static_cast<double>(samples)), scale.brief(fill.low),
        scale.brief(fill.high)));
}

/// Verbs that take labels as objects.
bool has_labels(const std::string& verb) {
    constexpr std::array<std::string_view, 7> verbs{"atlas", "view", "objects", "measure", "extract", "label", "render"};
    return std::ranges::find(verbs, verb) != verbs.end();
}

/// Is something asked for that only values have?
bool has_isovalue(const Arguments& arguments) {
    return arguments.tau || arguments.best || arguments.cavities || arguments.both || arguments.selects || arguments.all ||
           arguments.zones || shows_isovalues(arguments.picture) || !arguments.curve.empty() || arguments.is_low() ||
           arguments.polarity == PolarityChoice::both;
}

void take_labels(Arguments& arguments, const SampleSurvey& survey) {
    InputChoices& inputs = arguments.inputs;
    inputs.are_labels = true;
    const std::string why = fmt::format("the samples look like labels ({} whole numbers, {} of the neighbours are equal)", survey.values,
                                        percent(survey.likeness.equal));
    if (has_labels(arguments.verb)) {
        inputs.are_labels = !has_isovalue(arguments);
        inputs.assumed.push_back(why + (inputs.are_labels ? ": one object for each; --labels no takes them as values"
                                                          : ", isovalues between them mean nothing; without them and without --polarity "
                                                            "there is one object for each label"));
    } else {
        inputs.are_labels = false;
        inputs.assumed.push_back(why + ", isovalues between them mean nothing: isoatlas objects " + shell_word(arguments.file) +
                                 reading_options(arguments) + " has one object for each");
    }
}

/// Measures the noise, where it is filtered or smoothing could be advised.
void look_at_noise(Arguments& arguments, VolumeReader& reader, const SampleSurvey& survey, const std::optional<FillValue>& fill) {
    const bool may_advise = !arguments.gaussian && (arguments.verb == "objects" || arguments.verb == "atlas");
    if (survey.samples == 0 || !(arguments.inputs.seeks_gaussian || may_advise)) return;
    VolumeInfo info = reader.info();
    if (arguments.voxel_units) info.geometry = voxel_geometry();  // as the verb will have it
    const double low = fill ? fill->low : survey.low.value, high = fill ? fill->high : survey.high.value;
    const double noise = independent_noise(reader, survey, fill), range = high - low, sigma = advised_sigma(info, noise, range);
    if (!arguments.inputs.seeks_gaussian) {
        arguments.inputs.noise = noise, arguments.inputs.range = range;
        return;
    }
    const std::string is = fmt::format("the noise is {} of the range of values", percent(range > 0 ? noise / range : 0));
    if (sigma > 0) {
        arguments.gaussian = sigma;
        arguments.inputs.assumed.push_back(is + fmt::format(": filtered with --gaussian {}", sigma));
    } else {
        arguments.inputs.assumed.push_back(is + ": not filtered");
    }
}

void look(Arguments& arguments, VolumeReader& reader, const Context& context) {
    const VolumeInfo& info = reader.info();
    InputChoices& inputs = arguments.inputs;
    const bool analyses = is_analysis(arguments.verb);
    const SampleSurvey survey = survey_samples(reader, context);
    std::optional<FillValue> fill;
    if (inputs.seeks_no_data && !arguments.missing.no_data && analyses) fill = fill_value(survey, info);
    if (fill) leave_out(arguments, *fill, info, survey.samples);
    const bool may_be_labels = inputs.labels == LabelChoice::automatic && !arguments.gaussian && analyses && arguments.verb != "verify";
    if (may_be_labels && survey.likeness.are_labels) {
        take_labels(arguments, survey);
    } else {
        look_at_noise(arguments, reader, survey, fill);
    }
}

}  // namespace

void assume_inputs(Arguments& arguments, Terminal& terminal) {
    InputChoices& inputs = arguments.inputs;
    inputs.are_labels = inputs.labels == LabelChoice::yes;
    if (inputs.are_labels && (arguments.is_low() || arguments.polarity == PolarityChoice::both))
        throw Error(ErrorKind::usage, {.what = "labels have no objects of low values", .next = "omit --labels yes, or --polarity"});
    const bool filters = inputs.seeks_gaussian && filters_stores(arguments.verb);
    if (!(is_analysis(arguments.verb) || filters) || is_atlas(arguments.file)) return;
    try {
        const std::unique_ptr<VolumeReader> reader = open_input(arguments).reader;
        Arguments looked = arguments;  // all or nothing
        Session session(arguments, terminal);
        look(looked, *reader, session.context());
        arguments = looked;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
    }
}

std::string noise_advice(const Arguments& arguments, const VolumeInfo& info) {
    const auto [noise, range] = std::pair(arguments.inputs.noise, arguments.inputs.range);
    const double sigma = advised_sigma(info, noise, range);
    if (sigma == 0) return "";
    return fmt::format("the noise is {} of the range of values: --gaussian auto (sigma {:.4g}) smooths it", percent(noise / range), sigma);
}

}  // namespace isoatlas::cli
