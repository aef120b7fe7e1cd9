// The page of a label volume: one self-contained HTML file with a card for every label.
#pragma once

#include <span>
#include <string>

#include "isoatlas/page.h"
#include "isoatlas/segmentation.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Lists the labels of a volume, largest first, draws their surfaces (isoatlas/labels.h) and writes the page; the first options.top labels
/// have pictures. names: of labels that have one, with their colours. options: top, picture_size, frames, source, notes and
/// partly_written; the options of reading that commands need are part of source. Throws Error: as list_labels() and write_page(). Cost:
/// list_labels(), and of each picture extract_label() and options.frames pictures.
PageReport write_label_page(const std::string& path, const Volume& volume, Interpolant interpolant, std::span<const NamedLabel> names,
                            const PageOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
