// What a page of high values leaves for that of both polarities of the same volume.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "atlas/overview.h"
#include "catalogue/draw_cards.h"
#include "isoatlas/page.h"

namespace isoatlas {

struct AtlasTrees;

/// What a picture of an object of high values depends on, beside the volume and options: its id, isovalue and number, which has a colour.
using PictureKey = std::tuple<std::int64_t, double, std::int64_t>;

struct PageDraft::Data {
    std::optional<Overview> high;
    std::shared_ptr<const AtlasTrees> trees;
    std::map<PictureKey, CardPicture> cards;
};

}  // namespace isoatlas
