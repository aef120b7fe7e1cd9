#include "source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <utility>

#include <isoatlas/isovalue.h>
#include <isoatlas/polarity.h>

namespace isoatlas::python {
namespace {

std::string text_of(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

}  // namespace

Source::Source(std::shared_ptr<const Volume> volume, const AnalysisOptions& options) : options_(options), volume_(std::move(volume)) {}

Source::Source(const std::string& store, const AtlasOptions& options) : atlas_(std::in_place, store, options) {}

template <class Value, class Make>
std::shared_ptr<const Value> Source::once(std::shared_ptr<const Value>& value, const Context& context, const Make& make) {
    std::unique_lock lock(making_, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20))) {
        if (context.cancelled && context.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
    }
    if (!value) value = std::make_shared<const Value>(make());
    return value;
}

std::array<double, 2> Source::range() {
    if (atlas_) return atlas_->range();
    const std::scoped_lock lock(ranging_);
    if (!range_) {
        range_ = visit_samples(*volume_, [](auto samples) {
            const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
            return std::array{static_cast<double>(*low), static_cast<double>(*high)};
        });
    }
    return *range_;
}

double Source::stored(double reported) {
    if (!std::isfinite(reported)) throw Error(ErrorKind::usage, {.what = "the isovalue is not finite", .next = "give a number"});
    const double tau = stored_isovalue(info(), reported);
    const auto [low, high] = range();
    if (tau >= low && tau <= high) return tau;
    const auto [first, last] = info().calibration.reported_interval(low, high);
    throw Error(ErrorKind::not_found,
                {.file = info().path,
                 .what = "the isovalue " + text_of(reported) + " is " + (reported > last ? "above" : "below") + " every sample",
                 .expected = text_of(first) + " .. " + text_of(last),
                 .next = "atlas.objects lists isovalues that show something"});
}

Cut Source::cut(double tau, bool label, const Context& context) {
    if (atlas_) return atlas_->cut(tau, {.label = label}, context);
    return isoatlas::cut(*volume_, tau, {.interpolant = interpolant(), .tunnel_height = tunnel_height(), .label = label}, context);
}

Surface Source::extract(double tau, const SurfaceOptions& options, const Context& context) {
    if (atlas_) return atlas_->extract(tau, options, context);
    return isoatlas::extract(*volume_, tau, {.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = options}, context);
}

FrontSurface Source::extract_front(double tau, const FrontOptions& front, const SurfaceOptions& options, const Context& context) {
    if (atlas_) return atlas_->extract_front(tau, front, options, context);
    const ExtractOptions how{.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = options};
    return isoatlas::extract_front(*volume_, tau, front, how, context);
}

ObjectTable Source::objects(const RankOptions& options, const Context& context) {
    return atlas_ ? atlas_->objects(options, context) : rank_objects(*volume_, *trees(context), options, context);
}

CavityTable Source::cavities(const RankOptions& options, const Context& context) {
    return atlas_ ? atlas_->cavities(options, context) : rank_cavities(*volume_, *trees(context), options, context);
}

BranchHierarchy Source::hierarchy(const Context& context) {
    if (atlas_) return atlas_->hierarchy(context);
    return {*volume_, *trees(context), context};
}

std::shared_ptr<const Analysis> Source::trees(const Context& context) {
    return once(trees_, context, [&] { return atlas_ ? atlas_->analysis() : analyse(*volume_, options_, context); });
}

std::shared_ptr<const Analysis> Source::zones(const Context& context) {
    if (!atlas_) return trees(context);
    return std::make_shared<const Analysis>(
        analyse(atlas_->volume(context), {.interpolant = interpolant(), .tunnel_height = tunnel_height()}, context));
}

std::shared_ptr<const Volume> Source::volume(const Context& context) {
    return atlas_ ? std::make_shared<const Volume>(atlas_->volume(context)) : volume_;
}

}  // namespace isoatlas::python
