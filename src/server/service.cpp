#include "server/service.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "formats/common/byte_writer.h"
#include "isoatlas/error.h"
#include "isoatlas/isovalue.h"
#include "isoatlas/output.h"
#include "isoatlas/server.h"
#include "page/template.h"
#include "preview/wire_mesh.h"
#include "server/answers.h"
#include "server/branch_answers.h"
#include "server/download.h"
#include "server/sample_answers.h"
#include "server/secret.h"
#include "server/several_objects.h"
#include "server/unit_word.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxListed = 100000, kMaxFrames = 16, kMaxBranches = std::int64_t{1} << 40;
constexpr int kAtOnce = 2;                ///< responses at a time
constexpr std::int64_t kLabelBytes = 24;  ///< of a voxel while labels are made

int status_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::usage: return 400;
        case ErrorKind::not_found: return 404;
        case ErrorKind::cancelled: return 409;
        case ErrorKind::resource: return 503;
        default: return 500;
    }
}

Response refusal(int status, const Error& error) { return {status, "application/json", error_json(error)}; }
Response json_answer(std::string text) { return {200, "application/json", std::move(text)}; }

/// The parameter `polarity`, which every request may have, as a member.
Request with_polarity(const Request& request) {
    Request own = request;
    QueryParameters words(request.words);
    if (const std::optional<std::string> side = words.choice("polarity", {"high", "low"}))
        own.polarity = *side == "low" ? Polarity::low : Polarity::high;
    own.words.erase("polarity");
    return own;
}

double stored_tau(const Atlas& atlas, double reported) { return stored_isovalue(atlas.info(), reported); }

}  // namespace

Service::Service(std::string token, const Context& context, const ServiceOptions& options)
    : token_(std::move(token)),
      context_(context),
      memory_((options.memory > 0 ? options.memory : available_memory() / 4) / kAtOnce),
      store_state_(changes_),
      queues_(changes_),
      scene_(options.scene, changes_),
      events_(store_state_, queues_, scene_, changes_),
      naming_(options.is_read_only) {
    context_.progress = {};
    context_.cancelled = [this] { return ended_.load(); };
}

void Service::end() {
    ended_ = true;
    queues_.end();
    events_.end();
}

void Service::set_scene(const std::string& text) { scene_.set(text, store_state_.sides().main.info()); }

Response Service::answer(const Request& request) {
    try {
        return answer_known(with_polarity(request));
    } catch (const Error& error) {
        return refusal(status_of(error.kind()), error);
    } catch (const std::bad_alloc&) {
        return refusal(503,
                       Error(ErrorKind::resource,
                             {.what = "not enough memory", .next = "request less, or retry later", .reason = Reason::not_enough_memory}));
    } catch (const std::exception& exception) {
        return refusal(500, Error(ErrorKind::internal, {.what = exception.what()}));
    }
}

void check_has_viewer() {
    if (!viewer_template().empty()) return;
    throw Error(ErrorKind::unsupported,
                {.what = "this isoatlas was built without pages", .next = "request /api/atlas", .reason = Reason::built_without_web});
}

Response Service::answer_known(const Request& request) {
    if (request.path == "/") {
        check_has_viewer();
        return {200, "text/html; charset=utf-8", std::string(viewer_template())};
    }
    if (!is_secret(request.token, token_)) {
        return refusal(403, Error(ErrorKind::usage, {.what = "the token is missing or wrong",
                                                     .next = "open the address that the server has given",
                                                     .reason = Reason::token_wrong}));
    }
    if (request.path == "/api/events") return events_answer(request);
    if (request.path == "/api/atlas") {
        QueryParameters(request.words).reject_unknown();
        return json_answer(known(request).atlas);
    }
    if (request.path == "/api/scene")
        return request.is_change ? scene_.change(request, store_state_.sides().main.info()) : scene_.answer(request);
    if (request.path == "/api/preview") return preview_answer(request);
    if (request.path == "/api/objects") return objects_answer(request);
    if (request.path == "/api/measures") return measures_answer(request);
    if (request.path == "/api/branches") return branches_answer(request);
    if (request.path == "/api/card") return card_answer(request);
    if (request.path == "/api/surface") return surface_answer(request);
    if (request.path == "/api/label") return label_answer(request);
    if (request.path == "/api/at") return at_answer(request);
    if (request.path == "/api/transfer") {
        QueryParameters(request.words).reject_unknown();
        return json_answer(side_of(request).transfer);
    }
    if (request.path == "/api/surfaces" || request.path == "/api/segmentation") return several_answer(request);
    if (request.path == "/api/names") return naming_.names(store_state_.sides(), request);
    if (request.path == "/api/name") return naming_.change(numbered_sides(request), request);
    if (request.path == "/api/slice") return samples_answer(request, slice_answer);
    if (request.path == "/api/volume") return samples_answer(request, volume_answer);
    throw Error(ErrorKind::not_found,
                {.where = request.path.substr(0, 100),
                 .what = "no such path",
                 .expected = "/api/ and one of: events, atlas, preview, objects, measures, branches, card, surface, "
                             "surfaces, label, segmentation, slice, volume, at, transfer, scene, names, name, volumes, address",
                 .next = "docs/server.md lists the requests"});
}

Response Service::samples_answer(const Request& request, Response (*make)(const Atlas&, const Request&, const Context&)) {
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::samples, request);
    const Context context = context_of(*job);
    stop_if_cancelled(context);  // other threads may read a few bricks before this one looks
    return make(atlas(request), request, context);
}

Response Service::at_answer(const Request& request) {
    const StoreCatalogue& known = this->known(request);
    const NumberedSides sides = numbered_sides(request);
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::samples, request);
    return isoatlas::at_answer(sides, known.entries, request, context_of(*job));
}

std::unique_ptr<JobQueue::Job> Service::acquire_job(QueueClass line, const Request& request) {
    return queues_.of(line).acquire(request.client, request.is_disconnected);
}

const StoreCatalogue& Service::known(const Request& request) {
    if (const StoreCatalogue* there = known_.there()) return *there;
    (void)store_state_.sides();  // throws while there is no store
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::atlas, request);
    return known(context_of(*job));
}

const StoreCatalogue& Service::known(const Context& context) {
    return known_.get(context, [sides = store_state_.sides()](const Context& shared) { return load_catalogue(sides, shared); });
}

Response Service::events_answer(const Request& request) {
    QueryParameters(request.words).reject_unknown();
    Response answer{200, "text/event-stream"};
    answer.events = events_.listen(request.client, request.is_disconnected);
    return answer;
}

Response Service::preview_answer(const Request& request) {
    QueryParameters words(request.words);
    const double tau = words.required_tau();
    const std::vector<std::int64_t> objects = voxels(words, "object", request);
    words.reject_unknown();
    if (objects.size() > 1) throw Error(ErrorKind::usage, {.where = "object", .what = "more than one", .expected = "one object"});
    NamedObject named{objects.empty() ? std::nullopt : std::optional(objects[0])};
    (void)known(request);
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::trees, request);
    const Atlas& atlas = this->atlas(request);
    const double stored = stored_tau(atlas, tau);
    if (named.id) {
        const std::vector<ActiveObject> there = atlas.active(stored, false, context_of(*job)).objects;
        const auto found = std::ranges::find(there, *named.id, &ActiveObject::id);
        if (found != there.end()) named.object = *found;
    }
    return json_answer(preview_json(atlas.preview(stored, context_of(*job)), tau, named));
}

Response Service::objects_answer(const Request& request) {
    QueryParameters words(request.words);
    const double tau = words.required_tau();
    const std::int64_t top = words.whole("top", 1, kMaxListed).value_or(1000);
    words.reject_unknown();
    (void)known(request);
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::trees, request);
    const Atlas& atlas = this->atlas(request);
    return json_answer(active_json(atlas.active(stored_tau(atlas, tau), false, context_of(*job)), tau, top));
}

Response Service::measures_answer(const Request& request) {
    const Atlas& atlas = atlas_of_volume(request);
    QueryParameters words(request.words);
    const double tau = words.required_tau();
    const std::vector<std::int64_t> objects = voxels(words, "object", request);
    words.reject_unknown();
    if (objects.empty()) throw Error(ErrorKind::usage, {.where = "object", .what = "which objects?", .next = "add object=REF,..."});
    (void)known(request);  // loads the trees
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::surfaces, request);
    const AtlasMeasureOptions options{.objects = objects, .max_triangles = max_triangles()};
    return json_answer(measures_json(atlas.info(), measure_objects(atlas, stored_tau(atlas, tau), options, context_of(*job)), tau));
}

Response Service::branches_answer(const Request& request) {
    QueryParameters words(request.words);
    const Atlas& atlas = this->atlas(request);
    const BranchesWanted wanted = branches_wanted(words, atlas.info().calibration);
    const SideCatalogue& side = side_of(request);
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::trees, request);
    return json_answer(branches_json(atlas, side.hierarchy, side.number_of_rank, wanted, context_of(*job)));
}

CardSubject Service::card_subject(QueryParameters& words, const StoreCatalogue& known, const Atlas& atlas) const {
    const std::optional<std::int64_t> entry = words.whole("entry", 0, kMaxListed), branch = words.whole("branch", 0, kMaxBranches);
    if (entry.has_value() == branch.has_value())
        throw Error(ErrorKind::usage, {.where = "entry", .what = "requires exactly one object", .next = "add entry=N or branch=RANK"});
    if (branch) {
        const Polarity polarity = polarity_of(atlas.info());
        PageEntry drawn = branch_entry(atlas, known.of(polarity).hierarchy, *branch);
        drawn.colour = palette(*branch);
        const std::string side = polarity == polarity_of(store_state_.sides().main.info()) ? "" : "low ";
        return {side + "branch " + std::to_string(*branch), false, polarity, std::move(drawn)};
    }
    const std::vector<PageEntry>& entries = known.contents.entries;
    if (*entry >= std::ssize(entries)) {
        throw Error(ErrorKind::not_found, {.where = "entry " + std::to_string(*entry),
                                           .what = "the atlas has no such entry",
                                           .expected = "less than " + std::to_string(entries.size())});
    }
    const PageEntry& drawn = entries[static_cast<std::size_t>(*entry)];
    const PageBranch& of = known.contents.branches[static_cast<std::size_t>(drawn.branch)];
    return {"entry " + std::to_string(*entry), of.is_cavity, of.polarity, drawn};
}

Response Service::card_answer(const Request& request) {
    const Atlas& atlas = atlas_of_volume(request);
    QueryParameters words(request.words);
    const CardSubject subject = card_subject(words, known(request), atlas);
    const Atlas& drawn = store_state_.sides().of(subject.polarity);
    const std::int64_t frames = words.whole("frames", 1, kMaxFrames).value_or(kMaxFrames);
    words.reject_unknown();
    return json_answer(cards_.json(drawn, subject, frames, request, queues_.of(QueueClass::cards), context_));
}

Response Service::label_answer(const Request& request) {
    const Atlas& atlas = this->atlas(request);
    QueryParameters words(request.words);
    const double tau = words.required_tau();
    const std::vector<std::int64_t> objects = voxels(words, "object", request);
    const std::string format = words.choice("format", {"nrrd", "nii", "nii.gz", "tif"}).value_or("nrrd");
    VolumeInfo info = atlas.info();
    info.geometry.unit = unit_of_lengths(words, info.geometry);
    words.reject_unknown();
    check_labels_fit();
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::surfaces, request);
    const Context context = context_of(*job);
    const Cut cut = atlas.cut(stored_tau(atlas, tau), {.label = true}, context);
    const LabelOrigin origin{.interpolant = cut.interpolant, .tunnel_height = cut.tunnel_height, .tau = cut.tau};
    stop_if_cancelled(context);
    const std::vector<std::uint32_t> labels = object_labels(cut, objects);
    stop_if_cancelled(context);
    Download download(format, context);
    write_labels(download, info, labels, origin);
    return file_answer(download.take());
}

Response Service::several_answer(const Request& request) {
    static_cast<void>(atlas_of_volume(request));  // not of a label volume
    const bool has_labels = request.path == "/api/segmentation";
    if (has_labels) check_labels_fit();
    const NumberedSides sides = numbered_sides(request);
    const SeveralObjects all{sides, Naming::usable_names(sides.stores.main),
                             sides.low != nullptr ? Naming::usable_names(*sides.stores.low) : std::vector<ObjectName>{}, max_triangles()};
    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::surfaces, request);
    return has_labels ? segmentation_answer(all, request, context_of(*job)) : surfaces_answer(all, request, context_of(*job));
}

void Service::check_labels_fit() const {
    if (store_state_.sides().main.info().extent.voxels() <= memory_ / kLabelBytes) return;
    throw Error(ErrorKind::resource, {.what = "the label volume exceeds the memory budget of this server",
                                      .next = "write them into a file without the server, or give it more memory",
                                      .reason = Reason::labels_too_large});
}

Context Service::context_of(JobQueue::Job& job) const {
    Context context = context_;
    context.cancelled = [&job] { return job.is_cancelled(); };
    context.progress = [&job](const Progress& progress) {
        job.report_progress((progress.phase_index + progress.fraction) / progress.phase_count);
    };
    return context;
}

}  // namespace isoatlas
