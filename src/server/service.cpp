#include "server/service.h"

#include <algorithm>
#include <exception>

#include "base/parallel.h"
#include "isoatlas/error.h"
#include "page/template.h"
#include "server/answers.h"
#include "server/mesh_file.h"
#include "server/wire_mesh.h"
#include "server/words.h"

namespace isoatlas::server {
namespace {

constexpr int kSurfacesAtOnce = 2, kMostWaiting = 256;
constexpr std::int64_t kMostListed = 100000, kMostTriangles = 100'000'000;
constexpr std::size_t kMostObjects = 256;
constexpr double kStepsOfVoxel = 64;  ///< positions are this fine: a millimetre of a metre of voxels on a screen

/// The same for every pair of texts of one length: how long it takes says nothing about the token.
bool is_token(const std::string& given, const std::string& token) {
    if (given.size() != token.size()) return false;
    unsigned different = 0;
    for (std::size_t i = 0; i < token.size(); ++i) different |= static_cast<unsigned char>(given[i] ^ token[i]);
    return different == 0;
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

double required_tau(Words& words) {
    const std::optional<double> tau = words.number("tau");
    if (!tau) throw Error(ErrorKind::usage, {.where = "tau", .what = "the isovalue is missing", .next = "add tau=NUMBER"});
    return *tau;
}

}  // namespace

Service::Service(const Atlas& atlas, std::string token, const Context& context)
    : atlas_(atlas), token_(std::move(token)), context_(context), turns_(kSurfacesAtOnce, kMostWaiting) {
    context_.progress = {};
}

Answer Service::answer(const Question& question) {
    try {
        return answer_known(question);
    } catch (const Error& error) {
        return {status_of(error.kind()), "application/json", error_json(error), {}};
    } catch (const std::exception& exception) {
        return {500, "application/json", error_json(Error(ErrorKind::internal, {.what = exception.what()})), {}};
    }
}

Answer Service::answer_known(const Question& question) {
    if (question.path == "/") {
        if (page::viewer_template().empty())
            throw Error(ErrorKind::unsupported, {.what = "this isoatlas was built without pages", .next = "ask /api/atlas"});
        return {200, "text/html; charset=utf-8", std::string(page::viewer_template()), {}};
    }
    if (!is_token(question.token, token_)) {
        const Error error(ErrorKind::usage,
                          {.what = "the token is missing or wrong", .next = "open the address that isoatlas view printed"});
        return {403, "application/json", error_json(error), {}};
    }
    if (question.path == "/api/atlas") return atlas_answer();
    if (question.path == "/api/preview") return preview_answer(question);
    if (question.path == "/api/objects") return objects_answer(question);
    if (question.path == "/api/surface") return surface_answer(question);
    throw Error(ErrorKind::not_found, {.where = question.path.substr(0, 100),
                                       .what = "there is nothing here",
                                       .expected = "/api/atlas, /api/preview, /api/objects or /api/surface"});
}

Answer Service::atlas_answer() {
    return {200, "application/json", atlas_json_.get([this] { return atlas_json(atlas_, context_); }), {}};
}

Answer Service::preview_answer(const Question& question) const {
    Words words(question.words);
    const double tau = required_tau(words);
    words.refuse_others();
    return {200, "application/json", preview_json(atlas_.preview(stored_tau(tau)), tau), {}};
}

Answer Service::objects_answer(const Question& question) const {
    Words words(question.words);
    const double tau = required_tau(words);
    const std::int64_t top = words.whole("top", 1, kMostListed).value_or(1000);
    words.refuse_others();
    return {200, "application/json", active_json(atlas_.active(stored_tau(tau), false), tau, top), {}};
}

Answer Service::surface_answer(const Question& question) {
    if (atlas_.info().extent.rank != 3) {
        throw Error(ErrorKind::unsupported, {.what = "the contours of an image are no surface", .next = "isoatlas extract writes them"});
    }
    Words words(question.words);
    const double tau = required_tau(words);
    ExtractOptions options;
    options.objects = words.list("object", 0, atlas_.info().extent.voxels() - 1, kMostObjects);
    options.contours = words.list("contour", 0, atlas_.info().extent.voxels() - 1, kMostObjects);
    const std::optional<std::string> shell = words.choice("shell", {"outer", "inner"});
    if (shell) options.shell = *shell == "inner" ? ShellChoice::inner : ShellChoice::outer;
    const std::optional<std::string> format = words.choice("format", {"ply", "stl", "obj", "vtp", "glb"});
    options.ids = format.has_value();
    const std::int64_t most = words.whole("most", 1, kMostTriangles).value_or(kMostTriangles);
    words.refuse_others();

    const std::unique_ptr<Turns::Turn> turn = turns_.take(question.client);
    Context context = context_;
    context.cancelled = [&turn] { return turn->is_over(); };
    const Surface surface = atlas_.extract(stored_tau(tau), options, context);
    if (format) return {200, "application/octet-stream", mesh_file(surface, "." + *format), {}};
    const Vec3& spacing = atlas_.info().geometry.spacing;
    const WireMesh mesh = wire_mesh(surface, {.step = std::ranges::min(spacing) / kStepsOfVoxel, .most_triangles = most});
    Answer answer{200, "application/octet-stream", std::string(reinterpret_cast<const char*>(mesh.bytes.data()), mesh.bytes.size()), {}};
    answer.headers["X-Triangles"] = std::to_string(mesh.triangles);
    answer.headers["X-Coarse"] = mesh.coarse ? "1" : "0";
    return answer;
}

}  // namespace isoatlas::server
