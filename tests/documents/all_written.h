// Every pass that is written from the documents.
#pragma once

#include "documents/drops_on_glass.h"
#include "documents/edge_splash.h"
#include "documents/puddle_corrected.h"
#include "documents/puddle_published.h"
#include "documents/rainy_glass.h"
#include "documents/screen_drops.h"
#include "documents/windshield_picture.h"
#include "documents/wipers.h"

namespace rainref::documents {

inline const std::vector<Written>& all_written() {
  static const std::vector<Written> all = [] {
    std::vector<Written> passes;
    for (const auto& more : {puddle_published_passes(), puddle_corrected_passes(), edge_splash_passes(), screen_drops_passes(),
                             rainy_glass_document_passes(), drops_on_glass_passes(), wipers_passes(), windshield_picture_passes()})
      passes.insert(passes.end(), more.begin(), more.end());
    return passes;
  }();
  return all;
}

}  // namespace rainref::documents
