// The page: one self-contained HTML file with a picture of every significant object, and a coarse surface
// to turn it where at most 5 MB allow that. It opens from disk and loads nothing from elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/object_names.h"

namespace isoatlas {

/// Offers a page of the smoothed volume, and shows what it would: everything at one isovalue as it is and smoothed, side by side.
struct PageSmoothing {
    double noise_part = 0;  ///< of the noise by the range of values
    double sigma = 0;       ///< of the filter
    std::string command{};  ///< that makes the page
};

struct PageReport {
    std::int64_t objects = 0;   ///< entries, with a picture each
    std::int64_t cavities = 0;  ///< of these: cavities
    std::int64_t low = 0;       ///< of these: objects of low values
    std::int64_t hidden = 0;    ///< objects and cavities of the volume that have no picture
    std::int64_t bytes = 0;     ///< of the page
};

/// What write_first_page() leaves for write_page(): pictures, tables and trees of objects of high values.
class PageDraft {
public:
    PageDraft();
    ~PageDraft();
    PageDraft(const PageDraft&) = delete;
    PageDraft& operator=(const PageDraft&) = delete;

    struct Data;
    [[nodiscard]] Data& data() { return *data_; }

private:
    std::unique_ptr<Data> data_;
};

struct PageOptions {
    std::int64_t top = 24;            ///< at most so many pictures of objects
    std::int64_t top_cavities = 12;   ///< and of cavities
    std::int64_t picture_size = 256;  ///< pixels of a side, 32 to 1024
    std::int64_t frames = 1;          ///< of a turntable, 1 to 64; pages turn the coarse surface instead
    std::vector<ObjectName> names{};  ///< that users have given
    /// The same store, open for objects of low values: both polarities in one list, without cavities.
    const Atlas* low = nullptr;
    std::vector<ObjectName> low_names{};  ///< of these
    std::string source{};                 ///< the file in commands on the page: the volume or the store; empty: the store
    std::vector<std::string> notes{};     ///< sentences about the volume: what was assumed about its samples
    std::optional<PageSmoothing> smoothing{};
    /// Set: the page is written as soon as its first five pictures are there, and again with twice as many, until it is complete; called
    /// after each time with the number of pictures.
    std::function<void(std::int64_t)> partly_written{};
    /// Of write_first_page() with the other options as here; nullptr: none. The page has the same bytes with and without it.
    PageDraft* draft = nullptr;
};

/// A page of the objects of high values alone, until there is that of both polarities: with the pictures of its first five objects and no
/// cavities. Leaves what it needed in draft. atlas: of high values, of the same samples as the store of both (BuildOptions::high_values).
/// Calls options.partly_written. Of an image it does nothing. Throws and costs as write_page() until its first five pictures.
void write_first_page(const std::string& path, const Atlas& atlas, const PageOptions& options, PageDraft& draft,
                      const Context& context = {});

/// Ranks the objects and cavities of a store, renders them and writes the page. Throws Error: usage (options), input (damaged store),
/// resource (cannot be written), cancelled. Cost: that of Atlas::hierarchy() and
/// Atlas::histogram(), find_handles() (isoatlas/handles.h), and draws objects * frames pictures, two objects at a time.
PageReport write_page(const std::string& path, const Atlas& atlas, const PageOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
