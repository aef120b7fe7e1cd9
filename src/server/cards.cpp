#include "server/cards.h"

#include "preview/coarse_surface.h"
#include "server/document.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kPixels = 160;
constexpr std::size_t kMaxCardTriangles = 60'000;  ///< two a pixel

std::string card_json(const std::string& name, const Turntable& picture) {
    return document("card", [&](JsonStream& json) {
        json.key("of").value(name).key("picture");
        if (picture.image.empty()) {
            json.null();
            return;
        }
        json.begin_object().key("image").value(picture.image).key("frames").value(picture.frames);
        json.key("side").value(picture.side).end_object();
    });
}

}  // namespace

std::string Cards::json(const Atlas& atlas, const CardSubject& subject, std::int64_t frames, const Request& request, JobQueue& queue,
                        const Context& context) {
    const std::string name = subject.name + ", frames " + std::to_string(frames);
    if (std::optional<std::string> before = answers_.find(name)) return std::move(*before);
    const std::unique_ptr<JobQueue::Job> job = queue.acquire(request.client, request.is_disconnected);
    if (std::optional<std::string> before = answers_.find(name)) return std::move(*before);  // rendered for another client meanwhile
    Context own = context;
    own.threads = 1;  // surface requests have priority
    own.cancelled = [&job] { return job->is_cancelled(); };
    const PageOptions options{.picture_size = kPixels, .frames = frames};
    Surface surface = coarse_surface(surface_of(atlas, subject.is_cavity, subject.entry, own), kMaxCardTriangles);
    std::string answer = card_json(subject.name, draw_turntable(std::move(surface), subject.entry.colour, options, own));
    answers_.keep(name, answer);
    return answer;
}

}  // namespace isoatlas
