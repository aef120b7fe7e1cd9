#include "server/service.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "isoatlas/error.h"
#include "isoatlas/isovalue.h"
#include "isoatlas/output.h"
#include "page/template.h"
#include "server/answers.h"
#include "server/branches.h"
#include "server/file_bytes.h"
#include "server/sample_answers.h"
#include "server/secret.h"
#include "server/wire_mesh.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMostListed = 100000, kMostTriangles = 100'000'000, kMostFrames = 16, kMostBranches = std::int64_t{1} << 40;
constexpr int kAtOnce = 2;                                      ///< answers of size
constexpr std::int64_t kFirstTriangles = 20'000;                ///< what pages ask for first (web/src/viewer/ask/surfaces.ts)
constexpr std::int64_t kTriangleBytes = 128, kLabelBytes = 24;  ///< while an answer is made: a triangle, a voxel
constexpr std::size_t kMostObjects = 256;
constexpr double kStepsOfVoxel = 64;  ///< positions are this fine: a millimetre of a metre of voxels on a screen

/// What every page shows first; null: nothing, or a dark object.
const NamedEntry* first_of(const Known& known) {
    return known.entries.empty() || known.entries.front().dark ? nullptr : &known.entries.front();
}

int status_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::usage: return 400;
        case ErrorKind::not_found: return 404;
        case ErrorKind::cancelled: return 409;
        case ErrorKind::resource: return 503;
        default: return 500;
    }
}

Answer refusal(int status, const Error& error) { return {status, "application/json", error_json(error)}; }
Answer json_answer(std::string text) { return {200, "application/json", std::move(text)}; }
Answer file_answer(std::string bytes) { return {200, "application/octet-stream", std::move(bytes)}; }

double required_tau(Words& words) {
    const std::optional<double> tau = words.number("tau");
    if (!tau) throw Error(ErrorKind::usage, {.where = "tau", .what = "the isovalue is missing", .next = "add tau=NUMBER"});
    return *tau;
}

double stored_tau(const Atlas& atlas, double reported) { return stored_isovalue(atlas.info(), reported); }

}  // namespace

Service::Service(std::string token, const Context& context, std::int64_t memory)
    : token_(std::move(token)),
      context_(context),
      memory_((memory > 0 ? memory : available_memory() / 4) / kAtOnce),
      opening_(changes_),
      lines_(changes_),
      events_(opening_, lines_, changes_) {
    context_.progress = {};
    context_.cancelled = [this] { return ended_.load(); };
}

void Service::end() {
    ended_ = true;
    lines_.end();
    events_.end();
}

Answer Service::answer(const Question& question) {
    try {
        return answer_known(question);
    } catch (const Error& error) {
        return refusal(status_of(error.kind()), error);
    } catch (const std::bad_alloc&) {
        return refusal(503, Error(ErrorKind::resource, {.what = "not enough memory", .next = "ask for less, or again later"}));
    } catch (const std::exception& exception) {
        return refusal(500, Error(ErrorKind::internal, {.what = exception.what()}));
    }
}

Answer Service::answer_known(const Question& question) {
    if (question.path == "/") {
        if (viewer_template().empty())
            throw Error(ErrorKind::unsupported, {.what = "this isoatlas was built without pages", .next = "ask /api/atlas"});
        return {200, "text/html; charset=utf-8", std::string(viewer_template())};
    }
    if (!is_secret(question.token, token_)) {
        return refusal(
            403, Error(ErrorKind::usage, {.what = "the token is missing or wrong", .next = "open the address that isoatlas view printed"}));
    }
    if (question.path == "/api/events") return events_answer(question);
    if (question.path == "/api/atlas") {
        Words(question.words).refuse_others();
        return json_answer(known(question).atlas);
    }
    if (question.path == "/api/preview") return preview_answer(question);
    if (question.path == "/api/objects") return objects_answer(question);
    if (question.path == "/api/measures") return measures_answer(question);
    if (question.path == "/api/branches") return branches_answer(question);
    if (question.path == "/api/card") return card_answer(question);
    if (question.path == "/api/surface") return surface_answer(question);
    if (question.path == "/api/label") return label_answer(question);
    if (question.path == "/api/at") return at_answer(question);
    if (question.path == "/api/transfer") {
        Words(question.words).refuse_others();
        return json_answer(known(question).transfer);
    }
    if (question.path == "/api/slice") return samples_answer(question, slice_answer);
    if (question.path == "/api/volume") return samples_answer(question, volume_answer);
    throw Error(ErrorKind::not_found, {.where = question.path.substr(0, 100),
                                       .what = "there is nothing here",
                                       .expected = "/api/ and one of: events, atlas, preview, objects, measures, branches, card, surface, "
                                                   "label, slice, volume, at, transfer, address",
                                       .next = "docs/server.md lists the questions"});
}

Answer Service::samples_answer(const Question& question, Answer (*make)(const Atlas&, const Question&, const Context&)) {
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::samples, question);
    return make(atlas(), question, context_of(*turn));
}

Answer Service::at_answer(const Question& question) {
    const Known& known = this->known(question);
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::samples, question);
    return at_answer(atlas(), known.entries, question, context_of(*turn));
}

std::unique_ptr<Turns::Turn> Service::turn_in(Line line, const Question& question) {
    return lines_.of(line).take(question.client, question.left);
}

const Known& Service::known(const Question& question) {
    if (const Known* there = known_.there()) return *there;
    (void)atlas();  // refuses before there is one
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::atlas, question);
    return known(context_of(*turn));
}

const Known& Service::known(const Context& context) {
    return known_.get(context, [&atlas = atlas()](const Context& shared) { return know(atlas, shared); });
}

void Service::prepare(const Context& context) {
    Context own = context_;
    own.cancelled = [&] { return ended_ || (context.cancelled && context.cancelled()); };
    const NamedEntry* first = first_of(known(own));
    if (first == nullptr || atlas().info().extent.rank != 3) return;
    ExtractOptions options;
    options.ids = false;
    options.objects = {first->id};
    (void)first_.get(own, [&](const Context& shared) { return wire(extract(first->tau, options, shared), kFirstTriangles, shared); });
}

bool Service::is_first(double tau, const ExtractOptions& options, std::int64_t most) const {
    const Known* known = known_.there();
    const NamedEntry* first = known == nullptr ? nullptr : first_of(*known);
    if (first == nullptr || most != kFirstTriangles) return false;
    const bool is_alone = options.objects == std::vector{first->id} && options.contours.empty() && options.shell == ShellChoice::all;
    return is_alone && tau == first->tau && !options.ids;
}

Answer Service::events_answer(const Question& question) {
    Words(question.words).refuse_others();
    Answer answer{200, "text/event-stream"};
    answer.events = events_.listen(question.client, question.left);
    return answer;
}

Answer Service::preview_answer(const Question& question) {
    Words words(question.words);
    const double tau = required_tau(words);
    NamedObject named{words.whole("object", 0, atlas().info().extent.voxels() - 1)};
    words.refuse_others();
    (void)known(question);
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::trees, question);
    const double stored = stored_tau(atlas(), tau);
    if (named.id) {
        const std::vector<ActiveObject> objects = atlas().active(stored, false, context_of(*turn)).objects;
        const auto found = std::ranges::find(objects, *named.id, &ActiveObject::id);
        if (found != objects.end()) named.object = *found;
    }
    return json_answer(preview_json(atlas().preview(stored, context_of(*turn)), tau, named));
}

Answer Service::objects_answer(const Question& question) {
    Words words(question.words);
    const double tau = required_tau(words);
    const std::int64_t top = words.whole("top", 1, kMostListed).value_or(1000);
    words.refuse_others();
    (void)known(question);
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::trees, question);
    return json_answer(active_json(atlas().active(stored_tau(atlas(), tau), false, context_of(*turn)), tau, top));
}

Answer Service::measures_answer(const Question& question) {
    const Atlas& atlas = atlas_of_volume();
    Words words(question.words);
    const double tau = required_tau(words);
    const std::vector<std::int64_t> objects = voxels(words, "object");
    words.refuse_others();
    if (objects.empty()) throw Error(ErrorKind::usage, {.where = "object", .what = "which objects?", .next = "add object=ID,..."});
    (void)known(question);  // the trees
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::surfaces, question);
    ExtractOptions options;
    options.objects = objects;
    options.normals = false;
    const Surface surface = extract(stored_tau(atlas, tau), options, context_of(*turn));
    return json_answer(measures_json(surface, atlas.active(surface.tau, false, context_of(*turn)), tau));
}

Answer Service::branches_answer(const Question& question) {
    Words words(question.words);
    const BranchesWanted wanted = branches_wanted(words, atlas().info().calibration);
    const Known& known = this->known(question);
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::trees, question);
    return json_answer(branches_json(atlas(), known.hierarchy, wanted, context_of(*turn)));
}

CardSubject Service::card_subject(Words& words, const Known& known) const {
    const std::optional<std::int64_t> entry = words.whole("entry", 0, kMostListed), branch = words.whole("branch", 0, kMostBranches);
    if (entry.has_value() == branch.has_value())
        throw Error(ErrorKind::usage,
                    {.where = "entry", .what = "which object is meant is not said once", .next = "add entry=N or branch=RANK"});
    if (branch) {
        PageEntry drawn = branch_entry(atlas(), known.hierarchy, *branch);
        drawn.colour = palette(*branch);
        return {"branch " + std::to_string(*branch), false, std::move(drawn)};
    }
    const std::vector<PageEntry>& entries = known.contents.entries;
    if (*entry >= std::ssize(entries)) {
        throw Error(ErrorKind::not_found, {.where = "entry " + std::to_string(*entry),
                                           .what = "the atlas has no such entry",
                                           .expected = "less than " + std::to_string(entries.size())});
    }
    const PageEntry& drawn = entries[static_cast<std::size_t>(*entry)];
    return {"entry " + std::to_string(*entry), known.contents.branches[static_cast<std::size_t>(drawn.branch)].dark, drawn};
}

Answer Service::card_answer(const Question& question) {
    const Atlas& atlas = atlas_of_volume();
    Words words(question.words);
    const CardSubject subject = card_subject(words, known(question));
    const std::int64_t frames = words.whole("frames", 1, kMostFrames).value_or(kMostFrames);
    words.refuse_others();
    return json_answer(cards_.json(atlas, subject, frames, question, lines_.of(Line::cards), context_));
}

Answer Service::surface_answer(const Question& question) {
    const Atlas& atlas = atlas_of_volume();
    Words words(question.words);
    const double tau = required_tau(words);
    ExtractOptions options;
    options.objects = voxels(words, "object");
    options.contours = voxels(words, "contour");
    const std::optional<std::string> shell = words.choice("shell", {"outer", "inner"});
    if (shell) options.shell = *shell == "inner" ? ShellChoice::inner : ShellChoice::outer;
    const std::optional<std::string> format = words.choice("format", {"ply", "stl", "obj", "vtp", "glb"});
    options.ids = format.has_value();
    const std::int64_t most = words.whole("most", 1, kMostTriangles).value_or(kMostTriangles);
    words.refuse_others();

    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::surfaces, question);
    const Context context = context_of(*turn);
    const double stored = stored_tau(atlas, tau);
    if (format) {
        const Surface surface = extract(stored, options, context);
        return file_answer(file_bytes("." + *format, [&](const std::string& path) { (void)write_surface(path, surface); }, context));
    }
    const auto make = [&](const Context& own) { return wire(extract(stored, options, own), most, own); };
    WireMesh mesh = is_first(stored, options, most) ? first_.get(context, make) : make(context);
    Answer answer = file_answer(std::move(mesh.bytes));
    answer.headers["X-Triangles"] = std::to_string(mesh.triangles);
    answer.headers["X-Coarse"] = mesh.coarse ? "1" : "0";
    return answer;
}

Answer Service::label_answer(const Question& question) {
    const Atlas& atlas = this->atlas();
    Words words(question.words);
    const double tau = required_tau(words);
    const std::vector<std::int64_t> objects = voxels(words, "object");
    const std::string format = words.choice("format", {"nrrd", "nii", "nii.gz", "tif"}).value_or("nrrd");
    words.refuse_others();
    if (atlas.info().extent.voxels() > memory_ / kLabelBytes) {
        throw Error(ErrorKind::resource, {.what = "the labels of so many voxels are more than this server may hold",
                                          .next = "isoatlas label writes them; or start the viewer with more --memory"});
    }
    const std::unique_ptr<Turns::Turn> turn = turn_in(Line::surfaces, question);
    const Context context = context_of(*turn);
    const Cut cut = atlas.cut(stored_tau(atlas, tau), {.label = true}, context);
    const LabelOrigin origin{.interpolant = cut.interpolant, .tunnel_height = cut.tunnel_height, .tau = cut.tau};
    stop_if_cancelled(context);
    const std::vector<std::uint32_t> labels = object_labels(cut, objects);
    stop_if_cancelled(context);
    return file_answer(
        file_bytes("." + format, [&](const std::string& path) { write_labels(path, atlas.info(), labels, origin); }, context));
}

const Atlas& Service::atlas_of_volume() const {
    const Atlas& found = atlas();
    if (found.info().extent.rank == 3) return found;
    throw Error(ErrorKind::unsupported, {.what = "the contours of an image are no surface", .next = "isoatlas extract writes them"});
}

std::vector<std::int64_t> Service::voxels(Words& words, std::string_view name) const {
    return words.list(name, 0, atlas().info().extent.voxels() - 1, kMostObjects);
}

Context Service::context_of(Turns::Turn& turn) const {
    Context context = context_;
    context.cancelled = [&turn] { return turn.is_over(); };
    context.progress = [&turn](const Progress& progress) { turn.tell((progress.phase_index + progress.fraction) / progress.phase_count); };
    return context;
}

Surface Service::extract(double tau, ExtractOptions options, const Context& context) const {
    options.most_triangles = std::min(memory_ / kTriangleBytes, kMostTriangles);
    return atlas().extract(tau, options, context);
}

WireMesh Service::wire(const Surface& surface, std::int64_t most, const Context& context) const {
    const double spacing = std::ranges::min(atlas().info().geometry.spacing);
    return wire_mesh(surface, {.step = spacing / kStepsOfVoxel, .most_triangles = most}, context);
}

}  // namespace isoatlas
