#include "cli/differences.h"

#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "image/flipped.h"
#include "image_io/write.h"

namespace rainref::cli {

nlohmann::ordered_json write_comparison(const std::filesystem::path& stem, const truth::Comparison& comparison) {
  nlohmann::ordered_json out;
  for (const auto& [name, count] : comparison.pixels) out[name] = count;
  nlohmann::ordered_json& differences = out["differences"];
  for (const truth::Difference& d : comparison.differences) {
    const truth::Percentiles p = d.percentiles();
    std::filesystem::path path = stem;
    path += utf8_path("." + d.file_name() + ".png");
    image_io::write_png(path, flipped(d.picture()));
    differences[d.name()] = {{"unit", d.unit().empty() ? "1" : d.unit()},
                             {"pixels", p.count},
                             {"p50", p.p50},
                             {"p90", p.p90},
                             {"p99", p.p99},
                             {"max", p.max},
                             {"mean", d.mean()},
                             {"scale", d.scale()},
                             {"picture", path_text(path.filename())}};
  }
  return out;
}

}  // namespace rainref::cli
