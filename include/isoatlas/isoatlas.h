// isoatlas: which objects are in a scalar volume, and at which isovalues?
//
//   #include <isoatlas/isoatlas.h>
//   #include <cstdio>
//
//   int main(int argc, char** argv) try {
//       const isoatlas::Volume volume = isoatlas::load_volume(argc > 1 ? argv[1] : "scan.nrrd");
//       const isoatlas::Analysis analysis = isoatlas::analyse(volume);
//       for (const isoatlas::ObjectEntry& object : isoatlas::rank_objects(volume, analysis).entries)
//           std::printf("voxel %lld: best at %g, %lld voxels\n", (long long)object.id, object.best_tau, (long long)object.voxels);
//       const isoatlas::Surface surface = isoatlas::extract(volume, 100);
//       isoatlas::write_surface("surface.ply", surface);
//   } catch (const isoatlas::Error& error) {
//       std::fprintf(stderr, "%s\n", error.what());
//       return static_cast<int>(error.kind());
//   }
#pragma once

#include "isoatlas/active.h"
#include "isoatlas/analysis.h"
#include "isoatlas/array.h"
#include "isoatlas/atlas.h"
#include "isoatlas/both_polarities.h"
#include "isoatlas/brick_search.h"
#include "isoatlas/build.h"
#include "isoatlas/cards.h"
#include "isoatlas/cavities.h"
#include "isoatlas/cell_search.h"
#include "isoatlas/client.h"
#include "isoatlas/cluster_hierarchy.h"
#include "isoatlas/collection.h"
#include "isoatlas/context.h"
#include "isoatlas/criticality.h"
#include "isoatlas/cut.h"
#include "isoatlas/dataset_path.h"
#include "isoatlas/disk_search.h"
#include "isoatlas/dump.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/evolution_file.h"
#include "isoatlas/filter.h"
#include "isoatlas/handles.h"
#include "isoatlas/id.h"
#include "isoatlas/image.h"
#include "isoatlas/interpolant.h"
#include "isoatlas/isovalue.h"
#include "isoatlas/label_page.h"
#include "isoatlas/labels.h"
#include "isoatlas/level_of_detail.h"
#include "isoatlas/levels.h"
#include "isoatlas/locate.h"
#include "isoatlas/measures.h"
#include "isoatlas/method_info.h"
#include "isoatlas/navigator.h"
#include "isoatlas/nested_labels.h"
#include "isoatlas/object_names.h"
#include "isoatlas/objects.h"
#include "isoatlas/octree_front.h"
#include "isoatlas/octree_mesh.h"
#include "isoatlas/output.h"
#include "isoatlas/output_file.h"
#include "isoatlas/page.h"
#include "isoatlas/persistence.h"
#include "isoatlas/phantom.h"
#include "isoatlas/polarity.h"
#include "isoatlas/precomputed_meshes.h"
#include "isoatlas/print.h"
#include "isoatlas/projection_methods.h"
#include "isoatlas/remote.h"
#include "isoatlas/render.h"
#include "isoatlas/search_table.h"
#include "isoatlas/segmentation.h"
#include "isoatlas/selection.h"
#include "isoatlas/server.h"
#include "isoatlas/shell_word.h"
#include "isoatlas/simplify.h"
#include "isoatlas/sink.h"
#include "isoatlas/spectrum.h"
#include "isoatlas/surface.h"
#include "isoatlas/surface_defects.h"
#include "isoatlas/surface_methods.h"
#include "isoatlas/surface_points.h"
#include "isoatlas/survey.h"
#include "isoatlas/text.h"
#include "isoatlas/thickness.h"
#include "isoatlas/trilinear_distance.h"
#include "isoatlas/units.h"
#include "isoatlas/vec3.h"
#include "isoatlas/verify.h"
#include "isoatlas/version.h"
#include "isoatlas/viewpoint.h"
#include "isoatlas/volume.h"
#include "isoatlas/zone_files.h"
