// isoatlas animate: a turntable of objects, or their evolution while the isovalue changes.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "data/movie.h"
#include "data/picture.h"
#include "data/sides.h"
#include "text/document.h"
#include "text/evolution.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr Colour kRest{0.62, 0.64, 0.66};  // of objects that are not kept

struct Made {
    Animation animation;
    std::vector<Frame> frames;            ///< of an evolution
    std::optional<bool> exact_tunnels{};  ///< of an evolution
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

void append(Surface& to, const Surface& from) {
    const auto shift = static_cast<std::int64_t>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    for (const auto& t : from.triangles) to.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    to.tau = from.tau, to.unit = from.unit;
}

/// Kept objects in the colours of their ranks, constant over all isovalues; the others grey, unless a selection hides them.
Scene scene_at(const Surface& surface, const std::map<std::int64_t, std::int64_t>& kept, bool others, const std::string& unit) {
    Scene scene;
    scene.unit = unit;
    SceneObject rest{.surface = {}, .colour = kRest};
    for (auto& [id, part] : parts_of(surface)) {
        const auto rank = kept.find(id);
        if (rank != kept.end())
            scene.objects.push_back({.surface = std::move(part), .colour = palette(rank->second)});
        else if (others)
            append(rest.surface, part);
    }
    if (!rest.surface.triangles.empty()) scene.objects.push_back(std::move(rest));
    return scene;
}

/// "3 objects"; "3 of 1,204 objects" when only some are kept.
std::string part_text(std::int64_t kept, std::int64_t all, const std::string& one, const std::string& many) {
    return kept == all ? counted(all, one, many) : fmt::format("{} of {}", count_text(kept), counted(all, one, many));
}

/// Captions report events of kept objects: with noise, the others have events at every isovalue.
std::vector<std::string> caption(const Frame& frame, const Frame* before, const Scale& scale) {
    std::string happened;
    const auto add = [&](const std::string& what) { happened += (happened.empty() ? "" : ", ") + what; };
    const bool falling = before == nullptr || frame.tau <= before->tau;  // of negated samples: rising, as reported
    const Census& kept = frame.kept;
    if (kept.appeared > 0) add(fmt::format("{} {}", count_text(kept.appeared), falling ? "appeared" : "vanished"));
    if (kept.merged > 0) add(fmt::format("{} {}", count_text(kept.merged), falling ? "merged" : "split off"));
    if (before != nullptr && kept.tunnels != before->kept.tunnels) add(fmt::format("tunnels {:+}", kept.tunnels - before->kept.tunnels));
    if (before != nullptr && kept.cavities != before->kept.cavities)
        add(fmt::format("cavities {:+}", kept.cavities - before->kept.cavities));
    return {happened,
            part_text(kept.objects, frame.all.objects, "object", "objects") + ", " +
                part_text(kept.tunnels, frame.all.tunnels, "tunnel", "tunnels") + ", " +
                part_text(kept.cavities, frame.all.cavities, "cavity", "cavities"),
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

Made evolve(const Arguments& arguments, Source& source, RenderOptions options) {
    refuse_flat(arguments, source);
    const PictureArguments& picture = arguments.picture;
    const std::vector<double> taus = isovalues(arguments, source);
    const Scale scale(source.info());
    const Evolution evolution(arguments, source);
    // The camera is fixed at the best view of the largest surface.
    Scene largest;
    largest.objects.push_back({.surface = source.extract(*std::min_element(taus.begin(), taus.end()), {}), .colour = palette(0)});
    const View view = picture.view ? *picture.view : best_view(largest, picture.up, source.context());
    const Camera camera = fit_camera(largest, view, options);
    largest = {};
    Made made;
    made.exact_tunnels = evolution.has_exact_tunnels();
    for (std::size_t i = 0; i < taus.size(); ++i) {
        stop_if_interrupted();
        made.frames.push_back(evolution.at(taus[i], i > 0 ? std::optional(taus[i - 1]) : std::nullopt));
        options.caption =
            picture.plain ? std::vector<std::string>{} : caption(made.frames[i], i > 0 ? &made.frames[i - 1] : nullptr, scale);
        Scene scene =
            scene_at(source.extract(taus[i], {}), evolution.kept_objects(taus[i]), !arguments.selects, length_unit(source.info()));
        scene.removed = removed_part(picture, source.info(), view);
        made.animation.frames.push_back(scene.objects.empty() ? blank_picture(options)
                                                              : render_scene(scene, camera, options, source.context()));
    }
    return made;
}

Made turntable(const Arguments& arguments, Sides& sides, const RenderOptions& options) {
    const PictureArguments& picture = arguments.picture;
    Source& source = sides.main();
    Scene scene = scene_of(arguments, sides);
    const View view = picture.view ? *picture.view : best_view(scene, picture.up, source.context());
    scene.removed = removed_part(picture, source.info(), view);
    Camera camera = fit_turntable(scene, view, picture.up, options);
    Made made;
    for (std::int64_t i = 0; i < picture.animation.steps; ++i) {
        stop_if_interrupted();
        camera.view = rotated(view, picture.up, 360 * static_cast<double>(i) / static_cast<double>(picture.animation.steps));
        made.animation.frames.push_back(render_scene(scene, camera, options, source.context()));
    }
    return made;
}

Json census_json(const Census& census) {
    return {{"objects", census.objects},
            {"tunnels", census.tunnels},
            {"cavities", census.cavities},
            {"appeared", census.appeared},
            {"merged", census.merged}};
}

void print_json(const Arguments& arguments, Terminal& terminal, Source& source, const Made& made) {
    Json head = document("animate", source.info(), source.interpolant(), source.tunnel_height());
    head["output"] = arguments.output;
    head["width"] = made.animation.frames[0].width;
    head["height"] = made.animation.frames[0].height;
    head["frame_count"] = made.animation.frames.size();
    head["frames_per_second"] = made.animation.frames_per_second;
    if (made.exact_tunnels) head["pairs"] = *made.exact_tunnels ? "exact" : "approximate";
    add_reads(head, source.reads());
    const Scale scale(source.info());
    print(terminal, head, "frames", static_cast<std::int64_t>(made.frames.size()), [&](std::int64_t i) -> Json {
        const Frame& frame = made.frames[static_cast<std::size_t>(i)];
        Json json{{"tau", scale.reported(frame.tau)}, {"events", frame.events}};
        json.update(census_json(frame.all));
        json["significant"] = census_json(frame.kept);
        return json;
    });
}

}  // namespace

int run_animate(const Arguments& arguments, Terminal& terminal) {
    const AnimationArguments& wanted = arguments.picture.animation;
    check_output(arguments, {".gif", ".webp", ".png", ".apng", ".mp4", ".vtkhdf"});
    check_movie(arguments.output);
    if (wanted.from.has_value() != wanted.to.has_value()) {
        throw Error(ErrorKind::usage,
                    {.what = "--from and --to must be given together", .next = "give both isovalues, or omit both for a turntable"});
    }
    if (arguments.selects && !wanted.from)
        throw Error(ErrorKind::usage,
                    {.what = "a selection applies to an evolution only", .next = "give --from and --to, or omit the selection"});
    if (lower_extension(arguments.output) == ".vtkhdf") {
        return animate_surfaces(arguments, terminal, [&](Source& source) { return isovalues(arguments, source); });
    }
    Sides sides(arguments, terminal);
    Source& source = sides.main();
    RenderOptions options = options_of_picture(arguments.picture);
    Made made = wanted.from ? evolve(arguments, source, options) : turntable(arguments, sides, options);
    made.animation.frames_per_second = wanted.frames_per_second;
    write_movie(arguments.output, made.animation);
    if (arguments.json) {
        print_json(arguments, terminal, source, made);
    } else {
        const Image& first = made.animation.frames[0];
        if (made.exact_tunnels && !*made.exact_tunnels)
            terminal.say("note: tunnel counts are approximate: the tunnel that opened last is assumed to close first");
        terminal.out() << fmt::format("{}: {}, {} x {} pixels\n", shown_name(arguments.output),
                                      counted(static_cast<std::int64_t>(made.animation.frames.size()), "frame"), first.width, first.height);
    }
    return 0;
}

}  // namespace isoatlas::cli
