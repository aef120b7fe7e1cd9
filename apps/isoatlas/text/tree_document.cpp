#include "text/tree_document.h"

namespace isoatlas::cli {

const char* detail_name(TreeDetail detail) {
    switch (detail) {
        case TreeDetail::events: return "events";
        case TreeDetail::levels: return "levels";
        case TreeDetail::elements: return "elements";
        case TreeDetail::contours: return "contours";
    }
    return "events";
}

Json tree_file_document(const Arguments& arguments, const VolumeInfo& info, const Analysis& analysis) {
    Json json = document("tree-file", info, analysis.interpolant(), analysis.tunnel_height());
    json["output"] = arguments.output;
    json["detail"] = detail_name(arguments.detail);
    json["events"] = analysis.event_count();
    json["levels"] = analysis.level_count();
    json["elements"] = analysis.element_count();
    json["contours"] = analysis.contour_arc_count();
    return json;
}

}  // namespace isoatlas::cli
