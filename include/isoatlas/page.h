// The page: one self-contained HTML file with a picture of every object that matters. It opens from disk and loads nothing from elsewhere.
#pragma once

#include <cstdint>
#include <string>

#include "isoatlas/atlas.h"

namespace isoatlas {

struct PageOptions {
    std::int64_t top = 24;            ///< at most so many objects
    std::int64_t picture_size = 256;  ///< pixels of a side, 32 to 1024
    std::int64_t frames = 12;         ///< of a turntable, 1 to 64
    std::string source{};             ///< what commands on the page name: the volume or the store; empty: the store
};

struct PageReport {
    std::int64_t objects = 0;  ///< with a picture each
    std::int64_t bytes = 0;    ///< of the page
};

/// Ranks the objects of a store, draws them and writes the page. Throws Error: usage (options), input (damaged store), resource (cannot be
/// written), cancelled. Cost: Atlas::objects(), reads what the surfaces shown need, and draws objects * frames pictures.
PageReport write_page(const std::string& path, const Atlas& atlas, const PageOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
