// The page: pictures, tables, plots, and what each method does.
#include <algorithm>

#include <fmt/format.h>

#include "compare/html.h"
#include "compare/html_table.h"
#include "compare/log_plot.h"
#include "compare/methods_text.h"
#include "compare/output.h"
#include "compare/page_style.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

std::string css_colour(const Colour& colour) {
    return fmt::format("rgb({:.0f} {:.0f} {:.0f})", 255 * colour.red, 255 * colour.green, 255 * colour.blue);
}

/// The title, which leads to what the method does.
std::string linked_title(const ComparedMethod& method) {
    const MethodSection* section = section_about(method);
    if (section == nullptr) return html_text(method.title);
    return fmt::format(R"(<a href="#{}">{}</a>)", section->anchor, html_text(method.title));
}

std::string header_html(const Comparison& found, const ComparePage& page) {
    const VolumeInfo& info = found.info;
    std::string html = fmt::format("<header>\n<h1>Methods on {}</h1>\n", html_text(info.path.substr(info.path.rfind('/') + 1)));
    html += fmt::format("<p>{} samples of {}, isovalue {}{}", extent_text(info.extent), name_of(info.type), Scale(info).text(found.tau),
                        html_text(in_unit(info)));
    if (!found.searches.empty()) html += fmt::format("; {} of {}", counted(found.active, "active cell"), count_text(found.cells));
    html += ".</p>\n<p>The methods of the dissertation's survey, each as its paper describes it, on one thread, one after the other. ";
    html += "Times are of this machine and of one run. Sections are those of the dissertation.</p>\n";
    return html + fmt::format("<p><code>{}</code></p>\n</header>\n", html_text(page.command));
}

std::string faults_text(const ExtractedSurface& one) {
    std::string text;
    const auto add = [&text](std::int64_t count, const char* noun, const char* plural) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, noun, plural);
    };
    add(one.hole_edges, "edge of a hole", "edges of holes");
    add(one.non_manifold_edges, "non-manifold edge", "non-manifold edges");
    add(one.zero_area_triangles, "triangle without area", "triangles without area");
    add(one.wrong_components, "wrong component", "wrong components");
    return text;
}

std::string figure_html(const MethodPicture& picture, const Comparison& found, bool is_part) {
    const auto one = std::ranges::find(found.surfaces, picture.name, [](const ExtractedSurface& at) { return at.method.name; });
    const bool is_method = one != found.surfaces.end();
    const std::string title = is_method ? html_text(one->method.title) : "Ray casting";
    std::string size, faults;
    if (!is_method) {
        size = "the trilinear function, looked at 20 times a voxel";
    } else {
        size = one->is_points ? counted(one->points, "point") : counted(one->triangles, "triangle");
        faults = one->is_points ? "" : faults_text(*one);
    }
    const std::string of_all = is_part && is_method && !found.surface_part ? " in the whole volume" : "";
    std::string html = fmt::format(R"(<li><figure><img width="{0}" height="{0}" alt="{1}: {2}{3}" src="{4}">)", SurfacePictures::kSide,
                                   title, size, faults.empty() ? "" : "; " + faults, data_address(picture.image));
    html += fmt::format("<figcaption>{}<span>{}{}</span>", is_method ? linked_title(one->method) : title, size, of_all);
    if (!faults.empty()) html += fmt::format(R"(<span class="bad">{}</span>)", faults);
    if (!picture.shows_all_defects) html += "<span>the first 30,000 are marked</span>";
    return html + "</figcaption></figure></li>\n";
}

std::string pictures_html(const Comparison& found, const ComparePage& page) {
    if (page.pictures.empty()) return "";
    std::string html = "<section class=\"panel\">\n<h2>Surfaces</h2>\n<ul class=\"pictures\">\n";
    html += figure_html(page.pictures.back(), found, page.pictured.has_value());  // ray casting: what all should look like
    for (std::size_t i = 0; i + 1 < page.pictures.size(); ++i) html += figure_html(page.pictures[i], found, page.pictured.has_value());
    html += "</ul>\n<p class=\"key note\">";
    html += fmt::format(R"(<span style="--key: {}">holes, edges with more than two triangles, triangles without area</span>)",
                        css_colour(kDefectColour));
    html += fmt::format(R"(<span style="--key: {}">belongs to another component of the trilinear surface</span></p>)",
                        css_colour(kMisplacedColour));
    html += "\n<p class=\"note\">All from one camera. Surfaces are open where they leave the volume.";
    if (found.surface_part) {
        html += " " + part_text(found);
    } else if (page.pictured) {
        const Index3 size = page.pictured->size();
        html += fmt::format(" The surface of the whole volume is too large for a picture: these show {} x {} x {} samples in the middle.",
                            size[0], size[1], size[2]);
    }
    return html + "</p>\n</section>\n";
}

std::string surfaces_html(const Comparison& found) {
    if (found.surfaces.empty()) return "";
    HtmlTable table("What each method makes, and at what cost", {{"method", true},
                                                                 {"section", true},
                                                                 {"time, ms"},
                                                                 {"triangles"},
                                                                 {"points"},
                                                                 {"size"},
                                                                 {"memory beside it"},
                                                                 {"components"},
                                                                 {"wrong components"},
                                                                 {"Euler number"},
                                                                 {"genus"},
                                                                 {"edges of holes"},
                                                                 {"non-manifold edges"},
                                                                 {"zero-area triangles"},
                                                                 {"mean distance"},
                                                                 {"largest distance"},
                                                                 {"largest back"}});
    for (const ExtractedSurface& one : found.surfaces) {
        table.begin(linked_title(one.method));
        for (const std::string& cell :
             {html_text(one.method.section), milliseconds(one.seconds), one.is_points ? std::string("–") : count_text(one.triangles),
              count_text(one.points), size_text(one.bytes), size_text(one.cost.bytes)})
            table.add(cell);
        if (one.is_points) {
            for (int i = 0; i < 7; ++i) table.add("–");
        } else {
            table.add(count_text(one.components)), table.add_defects(one.wrong_components), table.add(count_text(one.euler));
            table.add(one.genus ? count_text(*one.genus) : "–");
            for (const std::int64_t count : {one.hole_edges, one.non_manifold_edges, one.zero_area_triangles}) table.add_defects(count);
        }
        table.add(distance_text(one.to_trilinear, one.to_trilinear.mean)), table.add(distance_text(one.to_trilinear, one.to_trilinear.max));
        table.add(distance_text(one.from_trilinear, one.from_trilinear.max));
    }
    return "<section class=\"panel\">\n<h2>Surfaces in numbers</h2>\n" + table.html() +
           "<p class=\"note\">A wrong component crosses other edges of the grid than any component of the trilinear surface, the last "
           "line. The memory beside it is what a method holds beside samples and surface. Distances are in voxels: of what a method "
           "made to the trilinear level set, and back, which shows what is missing.</p>\n</section>\n";
}

std::string searches_html(const Comparison& found) {
    if (found.searches.empty()) return "";
    HtmlTable table("How each method finds the active cells", {{"method", true},
                                                               {"section", true},
                                                               {"query, in its paper", true},
                                                               {"build, ms"},
                                                               {"query, ms"},
                                                               {"cold, ms"},
                                                               {"cells looked at"},
                                                               {"nodes"},
                                                               {"blocks read"},
                                                               {"bytes read"},
                                                               {"memory"},
                                                               {"file"}});
    for (const SearchRun& one : found.searches) {
        table.begin(linked_title(one.method));
        table.add(html_text(one.method.section)), table.add(html_text(one.method.cost));
        if (!one.has_run()) {
            for (int i = 0; i < 7; ++i) table.add("–");
            table.add(one.missing_memory > 0 ? "would need about " + size_text(one.missing_memory) : "left out: " + html_text(one.refusal));
            table.add("–");
            continue;
        }
        const bool is_file = one.file_bytes > 0;
        const CellSearchCost& cost = one.query.cost;
        for (const std::string& cell :
             {milliseconds(one.build_seconds), milliseconds(one.query.seconds), one.cold_seconds ? milliseconds(*one.cold_seconds) : "–",
              count_text(cost.cells), count_text(cost.nodes), is_file ? count_text(cost.blocks) : "–",
              is_file ? size_text(cost.bytes_read) : "–", size_text(one.bytes), is_file ? size_text(one.file_bytes) : "–"})
            table.add(cell);
    }
    return "<section class=\"panel\">\n<h2>Active cells</h2>\n" + table.html() +
           fmt::format("<p class=\"note\">{} of {} cells; every method finds exactly these. n cells, k of them active.</p>\n</section>\n",
                       counted(found.active, "active cell"), count_text(found.cells));
}

std::string plot_html(const Growth& growth) {
    HtmlTable table(growth.y_name + " over " + growth.x_name, {{"method", true}, {growth.x_name}, {growth.y_name}});
    for (const Growth::Line& line : growth.lines) {
        for (const auto& [x, y] : line.points)
            table.begin(html_text(line.name)), table.add(count_text(static_cast<std::int64_t>(x))), table.add(fmt::format("{:.6g}", y));
    }
    const std::string variable = growth.x_name.substr(growth.x_name.size() - 1);
    return "<figure><figcaption>" + html_text(growth.y_name) + " over " + html_text(growth.x_name) + "</figcaption>\n" +
           log_plot_svg(growth) + log_plot_legend(growth, variable) + "\n<details><summary>Numbers</summary>" + table.html() +
           "</details></figure>\n";
}

std::string plots_html(const Comparison& found) {
    const std::vector<Growth> all = growth_of(found);
    if (all.empty()) return "";
    std::string html = "<section class=\"panel\">\n<h2>How it grows</h2>\n<div class=\"plots\">\n";
    for (const Growth& growth : all) html += plot_html(growth);
    html += "</div>\n<p class=\"note\">Both axes are logarithmic: a power law is a straight line, its exponent is beside its name.";
    if (!found.isovalues.empty())
        html += fmt::format(
            " Over k: {} at which a half to a 2000th of the samples are High, from low to high, each query after the one before.",
            counted(std::ssize(found.isovalues), "isovalue"));
    if (!found.sizes.empty())
        html += fmt::format(" Over n: at isovalue {}, the volume and {} of every 2nd, 4th, ... sample along each axis.",
                            Scale(found.info).text(found.tau), counted(std::ssize(found.sizes) - 1, "coarser one", "coarser ones"));
    return html + "</p>\n</section>\n";
}

/// The sections about methods that ran, with their sources.
std::string methods_html(const Comparison& found) {
    std::vector<const ComparedMethod*> methods;
    for (const ExtractedSurface& one : found.surfaces) methods.push_back(&one.method);
    for (const SearchRun& one : found.searches) methods.push_back(&one.method);
    std::string html = "<section class=\"panel\">\n<h2>What the methods do</h2>\n";
    for (const MethodSection& section : method_sections()) {
        std::string sources;
        for (const ComparedMethod* method : methods) {
            if (section_about(*method) != &section || sources.find(html_text(method->source)) != std::string::npos) continue;
            sources += (sources.empty() ? "" : "; ") + html_text(method->source);
        }
        if (sources.empty()) continue;
        html += fmt::format("<h3 id=\"{}\">{}</h3>\n{}<p class=\"note\">{}</p>\n", section.anchor, html_text(section.title), section.html,
                            sources);
    }
    return html + "<p class=\"note\">From docs/methods.md.</p>\n</section>\n";
}

}  // namespace

std::string html_of(const Comparison& found, const ComparePage& page) {
    const std::string name = html_text(found.info.path.substr(found.info.path.rfind('/') + 1));
    std::string html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
    html +=
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n";
    html += "<meta name=\"generator\" content=\"isoatlas " ISOATLAS_VERSION "\">\n<link rel=\"icon\" href=\"data:,\">\n";
    html += "<title>" + name + " – methods</title>\n<style>" + std::string(kPageStyle) + "</style>\n</head>\n<body>\n<main>\n";
    html += header_html(found, page) + pictures_html(found, page) + surfaces_html(found) + volume_pictures_html(page.volume) +
            searches_html(found) + plots_html(found);
    html += methods_html(found) + "<footer>isoatlas " ISOATLAS_VERSION "</footer>\n";
    return html + "</main>\n</body>\n</html>\n";
}

}  // namespace isoatlas::cli
