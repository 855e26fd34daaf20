#include "cli/truth.h"

#include <nlohmann/json.hpp>

#include "cli/pictures.h"
#include "cli/registry.h"
#include "image_io/write.h"

namespace rainref::cli {

nlohmann::ordered_json write_differences(const std::filesystem::path& stem, std::span<const compositor::Difference> differences) {
  nlohmann::ordered_json out;
  for (const compositor::Difference& d : differences) {
    const compositor::Percentiles p = d.percentiles();
    std::filesystem::path path = stem;
    path += "." + d.file_name() + ".png";
    write_picture(path, d.picture());
    out[d.name()] = {{"unit", d.unit().empty() ? "1" : d.unit()},
                     {"pixels", p.count},
                     {"p50", p.p50},
                     {"p90", p.p90},
                     {"p99", p.p99},
                     {"max", p.max},
                     {"mean", d.mean()},
                     {"scale", d.scale()},
                     {"picture", path.filename().string()}};
  }
  return out;
}

void report_traced(Recorder* recorder, int frame, const compositor::Picture& picture, const Image& shown, double seconds) {
  if (!recorder) return;
  const std::vector<PassOutput> outputs{{"beauty", picture.beauty}, {"normal", picture.normal}, {"depth", picture.depth},
                                        {"film", picture.film},     {"mask", picture.mask},     {"picture", shown}};
  recorder->pass({frame, 0, traced_pass, outputs, seconds});
}

void write_traced_exr(const std::filesystem::path& path, const compositor::Picture& picture) {
  const Image beauty = flipped(picture.beauty), normal = flipped(picture.normal), depth = flipped(picture.depth),
              film = flipped(picture.film), mask = flipped(picture.mask);
  image_io::write_exr(path, {{"", {"R", "G", "B"}, &beauty},
                             {"normal", {"X", "Y", "Z"}, &normal},
                             {"depth", {"Z"}, &depth},
                             {"", {"film"}, &film},
                             {"", {"mask"}, &mask}});
}

}  // namespace rainref::cli
