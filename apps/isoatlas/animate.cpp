// isoatlas animate: objects turning around, or appearing, merging and changing while the isovalue moves.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "document.h"
#include "interrupt.h"
#include "movie.h"
#include "picture.h"
#include "source.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

constexpr Colour kSmall{0.62, 0.64, 0.66};  // of what is too small for a colour of its own
constexpr double kSmallPart = 2e-4;         // of all triangles at the last isovalue

struct Frame {
    double tau = 0;  ///< stored
    std::int64_t objects = 0, tunnels = 0, cavities = 0, appeared = 0, merged = 0, events = 0;
};

struct Made {
    Animation animation;
    std::vector<Frame> frames;  ///< of an evolution
};

/// One surface for each of its objects, by id.
std::map<std::int64_t, Surface> parts_of(const Surface& whole) {
    std::map<std::int64_t, Surface> parts;
    std::vector<std::int64_t> number(whole.points.size(), -1);
    for (const auto& triangle : whole.triangles) {
        Surface& part = parts[whole.object[static_cast<std::size_t>(triangle[0])]];
        std::array<std::int64_t, 3> corners{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto p = static_cast<std::size_t>(triangle[c]);
            if (number[p] < 0) {
                number[p] = static_cast<std::int64_t>(part.points.size());
                part.points.push_back(whole.points[p]);
                part.normals.push_back(whole.normals[p]);
            }
            corners[c] = number[p];
        }
        part.triangles.push_back(corners);
        part.tau = whole.tau, part.unit = whole.unit;
    }
    return parts;
}

/// Colours that stay with an object while the isovalue moves: its id is that of its highest voxel.
class ObjectColours {
public:
    explicit ObjectColours(std::int64_t least_triangles) : least_(least_triangles) {}

    Scene scene(const Surface& surface, const std::string& unit) {
        Scene scene;
        scene.unit = unit;
        SceneObject rest{.surface = {}, .colour = kSmall};
        for (auto& [id, part] : parts_of(surface)) {
            const bool known = colours_.count(id) > 0;
            if (!known && static_cast<std::int64_t>(part.triangles.size()) < least_) {
                append(rest.surface, part);
                continue;
            }
            const auto next = static_cast<std::int64_t>(colours_.size());
            const std::int64_t colour = colours_.try_emplace(id, next).first->second;
            scene.objects.push_back({.surface = std::move(part), .colour = palette(colour)});
        }
        if (!rest.surface.triangles.empty()) scene.objects.push_back(std::move(rest));
        return scene;
    }

private:
    static void append(Surface& to, const Surface& from) {
        const auto shift = static_cast<std::int64_t>(to.points.size());
        to.points.insert(to.points.end(), from.points.begin(), from.points.end());
        to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
        for (const auto& t : from.triangles) to.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
        to.tau = from.tau, to.unit = from.unit;
    }
    std::int64_t least_;
    std::map<std::int64_t, std::int64_t> colours_;
};

/// Who answers questions about isovalues: the store's own index, or one made from the volume.
class Index {
public:
    explicit Index(Source& source) {
        if (source.is_store()) {
            index_ = &source.atlas().active_index();
            return;
        }
        analysis_.emplace(source.analysis(false));
        made_.emplace(*analysis_);
        index_ = &*made_;
    }
    [[nodiscard]] Frame at(double tau, const std::optional<double>& before) const {
        Frame frame{.tau = tau};
        for (const ActiveObject& object : index_->at(tau, {.contours = false}).objects) {
            ++frame.objects;
            frame.tunnels += object.b1, frame.cavities += object.b2;
        }
        if (!before) return frame;
        const ObjectChanges changes = index_->changes(*before, tau);
        frame.appeared = changes.appeared, frame.merged = changes.merged, frame.events = changes.events;
        return frame;
    }

private:
    std::optional<Analysis> analysis_;
    std::optional<ActiveIndex> made_;
    const ActiveIndex* index_ = nullptr;
};

std::vector<std::string> caption(const Frame& frame, const Frame* before, const Scale& scale) {
    std::string happened;
    const auto add = [&](const std::string& what) { happened += (happened.empty() ? "" : ", ") + what; };
    const bool falling = before == nullptr || frame.tau <= before->tau;
    if (frame.appeared > 0) add(fmt::format("{} {}", count_text(frame.appeared), falling ? "appeared" : "vanished"));
    if (frame.merged > 0) add(fmt::format("{} {}", count_text(frame.merged), falling ? "merged" : "split off"));
    if (before != nullptr && frame.tunnels != before->tunnels) add(fmt::format("tunnels {:+}", frame.tunnels - before->tunnels));
    if (before != nullptr && frame.cavities != before->cavities) add(fmt::format("cavities {:+}", frame.cavities - before->cavities));
    return {happened,
            fmt::format("{}, {}, {}", counted(frame.objects, "object"), counted(frame.tunnels, "tunnel"),
                        counted(frame.cavities, "cavity", "cavities")),
            "isovalue " + scale.brief(frame.tau)};
}

std::vector<double> isovalues(const Arguments& arguments, Source& source) {
    const AnimationArguments& animation = arguments.picture.animation;
    const double from = source.stored(*animation.from), to = source.stored(*animation.to);
    std::vector<double> taus;
    for (std::int64_t i = 0; i < animation.steps; ++i)
        taus.push_back(animation.steps == 1 ? from
                                            : from + (to - from) * static_cast<double>(i) / static_cast<double>(animation.steps - 1));
    return taus;
}

void refuse_flat(const Arguments& arguments, Source& source) {
    if (source.info().extent.rank == 3) return;
    throw Error(ErrorKind::usage, {.file = arguments.file,
                                   .what = "a 2D volume has no surfaces to draw in space",
                                   .next = "isoatlas extract " + shell_word(arguments.file) + " --tau T -o curves.vtp writes its curves"});
}

Made evolution(const Arguments& arguments, Source& source, RenderOptions options) {
    refuse_flat(arguments, source);
    const PictureArguments& picture = arguments.picture;
    const std::vector<double> taus = isovalues(arguments, source);
    const Scale scale(source.info());
    const Index index(source);
    // The camera stays where it sees the largest surface best.
    Scene largest;
    largest.objects.push_back({.surface = source.extract(*std::min_element(taus.begin(), taus.end()), {}), .colour = palette(0)});
    const View view = picture.view ? *picture.view : best_view(largest, picture.up, source.context());
    const Camera camera = fit_camera(largest, view, options);
    ObjectColours colours(static_cast<std::int64_t>(kSmallPart * static_cast<double>(largest.objects[0].surface.triangles.size())) + 20);
    largest = {};
    Made made;
    for (std::size_t i = 0; i < taus.size(); ++i) {
        stop_if_interrupted();
        made.frames.push_back(index.at(taus[i], i > 0 ? std::optional(taus[i - 1]) : std::nullopt));
        options.caption =
            picture.plain ? std::vector<std::string>{} : caption(made.frames[i], i > 0 ? &made.frames[i - 1] : nullptr, scale);
        Scene scene = colours.scene(source.extract(taus[i], {}), length_unit(source.info()));
        scene.removed = removed_part(picture, source.info(), view);
        made.animation.frames.push_back(scene.objects.empty() ? blank_picture(options)
                                                              : render_scene(scene, camera, options, source.context()));
    }
    return made;
}

Made turntable(const Arguments& arguments, Source& source, const RenderOptions& options) {
    const PictureArguments& picture = arguments.picture;
    Scene scene = scene_of(arguments, source);
    const View view = picture.view ? *picture.view : best_view(scene, picture.up, source.context());
    scene.removed = removed_part(picture, source.info(), view);
    Camera camera = fit_turntable(scene, view, picture.up, options);
    Made made;
    for (std::int64_t i = 0; i < picture.animation.steps; ++i) {
        stop_if_interrupted();
        camera.view = turned(view, picture.up, 360 * static_cast<double>(i) / static_cast<double>(picture.animation.steps));
        made.animation.frames.push_back(render_scene(scene, camera, options, source.context()));
    }
    return made;
}

void print_json(const Arguments& arguments, Terminal& terminal, Source& source, const Made& made) {
    Json head = document("animate", source.info(), source.interpolant(), source.tunnel_height());
    head["output"] = arguments.output;
    head["width"] = made.animation.frames[0].width;
    head["height"] = made.animation.frames[0].height;
    head["frame_count"] = made.animation.frames.size();
    head["frames_per_second"] = made.animation.frames_per_second;
    add_reads(head, source.reads());
    const Scale scale(source.info());
    print(terminal, head, "frames", static_cast<std::int64_t>(made.frames.size()), [&](std::int64_t i) -> Json {
        const Frame& frame = made.frames[static_cast<std::size_t>(i)];
        return {{"tau", scale.reported(frame.tau)}, {"objects", frame.objects}, {"tunnels", frame.tunnels}, {"cavities", frame.cavities},
                {"appeared", frame.appeared},       {"merged", frame.merged},   {"events", frame.events}};
    });
}

}  // namespace

int run_animate(const Arguments& arguments, Terminal& terminal) {
    const AnimationArguments& wanted = arguments.picture.animation;
    check_output(arguments, {".gif", ".webp", ".png", ".apng", ".mp4"});
    check_movie(arguments.output);
    if (wanted.from.has_value() != wanted.to.has_value()) {
        throw Error(ErrorKind::usage, {.what = "--from and --to belong together",
                                       .next = "give both isovalues; or leave both out: then the objects turn around"});
    }
    Source source(arguments, terminal);
    RenderOptions options = options_of_picture(arguments.picture);
    Made made = wanted.from ? evolution(arguments, source, options) : turntable(arguments, source, options);
    made.animation.frames_per_second = wanted.frames_per_second;
    {
        const WritingGuard guard(arguments.output);
        write_movie(arguments.output, made.animation);
    }
    if (arguments.json) {
        print_json(arguments, terminal, source, made);
    } else {
        const Image& first = made.animation.frames[0];
        terminal.out() << fmt::format("{}: {}, {} x {} pixels\n", arguments.output,
                                      counted(static_cast<std::int64_t>(made.animation.frames.size()), "frame"), first.width, first.height);
    }
    return 0;
}

}  // namespace isoatlas::cli
