#include "cli/truth.h"

#include "cli/pictures.h"

namespace rainref::cli {

nlohmann::ordered_json write_differences(const std::filesystem::path& stem, std::span<const compositor::Difference> differences) {
  nlohmann::ordered_json out;
  for (const compositor::Difference& d : differences) {
    const compositor::Percentiles p = d.percentiles();
    std::filesystem::path path = stem;
    path += "." + d.file_name() + ".png";
    write_picture(path, d.picture());
    out[d.name()] = {{"unit", d.unit().empty() ? "1" : d.unit()}, {"pixels", p.count}, {"p50", p.p50}, {"p90", p.p90}, {"p99", p.p99}, {"max", p.max},
                     {"mean", d.mean()}, {"scale", d.scale()}, {"picture", path.filename().string()}};
  }
  return out;
}

}  // namespace rainref::cli
