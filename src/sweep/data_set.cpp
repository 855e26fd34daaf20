#include "sweep/data_set.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/json_read.h"
#include "effect/inputs.h"
#include "image_io/evidence.h"
#include "image_io/read.h"
#include "image_io/write.h"
#include "math/half.h"
#include "math/real64.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "scene/camera.h"
#include "scene/json.h"
#include "simulation/light_mean.h"
#include "sweep/identity.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

double log10_of(double x) { return log_real(Real64(x)).v / log_real(Real64(10)).v; }
double rounded(double x) { return std::round(x * 1e4) / 1e4; }

/// Every parameter but the names of files, which mean nothing elsewhere.
Json parameters_of(const scene::Config& config) {
  Json all = scene::config_json(config);
  for (const scene::Config::Entry& e : config.entries())
    if (effect::names_files(e.parameter.key)) all.erase(e.parameter.key);
  return all;
}

/// As OpenCV has it: x to the right, y down, z ahead; pixels from the upper left corner of the picture. Null without a camera.
Json camera_of(const scene::Config& config) {
  if (!has(config, "camera.position") || !has(config, "camera.target") || !has(config, "camera.vertical_fov_deg")) return nullptr;
  const auto vector = [&](const char* key) {
    const scene::Real3& v = config.real3(key);
    return scene::Vector3{v[0], v[1], v[2]};
  };
  // The windshield's axes are the car's, with z up.
  const scene::Camera camera{vector("camera.position"), vector("camera.target"),
                             has(config, "camera.up") ? vector("camera.up") : scene::Vector3{0, 0, 1},
                             config.real("camera.vertical_fov_deg")};
  const scene::Camera::Basis basis = camera.basis();
  const scene::Integer2 size = config.integer2("run.size");
  const double width = static_cast<double>(size[0]), height = static_cast<double>(size[1]), focal = 0.5 * height / camera.half_height();
  Json rows = Json::array();
  for (const scene::Vector3& axis : {basis.right, -basis.up, basis.forward})
    rows.push_back({axis.x, axis.y, axis.z, -(axis.x * camera.position.x + axis.y * camera.position.y + axis.z * camera.position.z)});
  return {{"intrinsics", {{focal, 0, 0.5 * width}, {0, focal, 0.5 * height}, {0, 0, 1}}}, {"world_to_camera", rows}};
}

struct Compared {
  std::int64_t squares = 0, dry = 0, dry_differing = 0, covered = 0;  ///< covered: sum of the mask's codes
  int dry_difference = 0;
};
/// mask: empty, or of the pictures' size.
Compared compare(const Image& clean, const Image& rainy, const Image& mask) {
  Compared c;
  for (int y = 0; y < clean.height(); ++y) {
    for (int x = 0; x < clean.width(); ++x) {
      int largest = 0;
      for (int k = 0; k < 3; ++k) {
        const int off = std::abs(std::to_integer<int>(clean.row_bytes(y)[4 * x + k]) - std::to_integer<int>(rainy.row_bytes(y)[4 * x + k]));
        c.squares += off * off;
        largest = std::max(largest, off);
      }
      if (mask.empty()) continue;
      const int code = std::to_integer<int>(mask.row_bytes(y)[4 * x]);
      c.covered += code;
      if (code != 0) continue;
      ++c.dry;
      c.dry_differing += largest > 0;
      c.dry_difference = std::max(c.dry_difference, largest);
    }
  }
  return c;
}

/// The coverage of each pixel of the picture: the mean of its samples, weighted as the picture weighs their light. So a code of 0 says that
/// no wet sample is part of the pixel.
Image mask_of(const fs::path& file, const Image& picture) {
  const image_io::Evidence e = image_io::read_evidence(path_text(file), read_file(file));
  const auto n = static_cast<int>(e.width / static_cast<std::size_t>(picture.width()));
  const auto is_times_n = [n](std::size_t side, int of) {
    return n >= 1 && side == static_cast<std::size_t>(n) * static_cast<std::size_t>(of);
  };
  const FormatInfo::Kind kind = e.channels.at(0).kind;
  if (!is_times_n(e.width, picture.width()) || !is_times_n(e.height, picture.height()) ||
      (kind != FormatInfo::float16 && kind != FormatInfo::float32))
    throw Error(ExitCode::internal, fmt::format("{}: a mask of another size or kind than its picture", path_text(file)));
  const auto coverage = [&](int x, int y) {
    const std::byte* at = e.texels.data() + (static_cast<std::size_t>(y) * e.width + static_cast<std::size_t>(x)) * e.texel_bytes;
    if (kind == FormatInfo::float16) {
      Half half;
      std::memcpy(&half, at, sizeof half);
      return to_float(half);
    }
    float value;
    std::memcpy(&value, at, sizeof value);
    return value;
  };
  const auto row_of = [&](int y, std::span<double> light) {
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = coverage(static_cast<int>(i / 3), y);
  };
  const auto codes_of = [](int, int, const double* light, std::uint8_t* codes) { std::fill_n(codes, 3, mask_code(light[0])); };
  const parallel::Executor here(1);
  return simulation::picture_of_means(picture.width(), picture.height(), n, row_of, codes_of, here);
}

bool has_file(const Row& row, const std::string& name) {
  return std::any_of(row.files.begin(), row.files.end(), [&](const KeptFile& f) { return f.path == name; });
}

/// Writes one pair after the other.
class Writing {
 public:
  Writing(const Cells& cells, const Table& table, const Store& store, const PairsAsked& asked, capture::NewFolder& folder)
      : cells_(cells), table_(table), store_(store), asked_(asked), folder_(folder) {
    std::vector<std::string> head{"pair", "split", "frame", "clean", "rainy", "mask", "clean_cell", "rainy_cell"};
    for (const auto& [key, unused] : cells.values(cells.all().front()))
      if (key != label_key) head.push_back(key);
    head.insert(head.end(), {"psnr", "mask_share", "drops"});
    csv_ = csv_line(head);
  }

  void add(const Pair& pair, std::int64_t frame) {
    const Cell &clean = cells_.all()[pair.clean], &rainy = cells_.all()[pair.rainy];
    const std::string side = pair.is_train ? "train" : "test", name = fmt::format("{:06}.png", count_++);
    const std::string picture = Keep{.part = {}, .at = {}}.file(frame);
    const Image before = copied(clean, picture, side + "/clean/" + name), after = copied(rainy, picture, side + "/rainy/" + name);
    if (before.width() != after.width() || before.height() != after.height())
      throw Error(ExitCode::usage, fmt::format("--pairs: expected two pictures of one size for {}, found {}x{} and {}x{}",
                                               cells_.words(rainy), before.width(), before.height(), after.width(), after.height()));
    Image mask;
    if (!asked_.mask.empty()) {
      mask = mask_of(file_of(pair.rainy, Keep{.what = Keep::What::exr, .part = asked_.mask, .at = {}}.file(frame)), after);
      folder_.write(side + "/mask/" + name, image_io::png_bytes(mask));
    }
    const Compared c = compare(before, after, mask);
    const double pixels = static_cast<double>(after.width()) * after.height();
    Json line{{"pair", count_ - 1}, {"frame", frame}, {"clean", "clean/" + name}, {"rainy", "rainy/" + name}};
    if (!mask.empty()) line["mask"] = "mask/" + name;
    line["clean_cell"] = clean.id;
    line["rainy_cell"] = rainy.id;
    line["psnr"] = nullptr;
    if (c.squares > 0) {
      figures_.psnr.push_back(10 * log10_of(255.0 * 255.0 * 3 * pixels / static_cast<double>(c.squares)));
      line["psnr"] = rounded(figures_.psnr.back());
    } else {
      ++figures_.same;
    }
    if (!mask.empty()) {
      figures_.mask_share.push_back(static_cast<double>(c.covered) / (255 * pixels));
      line["mask_share"] = rounded(figures_.mask_share.back());
      line["dry_difference"] = c.dry_difference;
      figures_.dry += c.dry;
      figures_.dry_differing += c.dry_differing;
      figures_.dry_difference = std::max(figures_.dry_difference, c.dry_difference);
    }
    if (const std::string drops = Keep{.what = Keep::What::drops, .part = {}, .at = {}}.file(frame);
        has_file(table_.rows[pair.rainy], drops)) {
      const fs::path list = file_of(pair.rainy, drops);
      line["drops"] = capture::read_json(list, path_text(list), capture::large_json);
      figures_.drops.push_back(static_cast<double>(line["drops"].size()));
    }
    add_parameters(clean, rainy, line);
    (pair.is_train ? figures_.train : figures_.test) += 1;
    (pair.is_train ? train_ : test_) += line.dump() + "\n";
    add_row(pair, side, name, line);
  }

  DataSetFigures finish() {
    const auto bytes = [](const std::string& text) { return std::as_bytes(std::span(text)); };
    folder_.write("train/data.jsonl", bytes(train_));
    folder_.write("test/data.jsonl", bytes(test_));
    folder_.write("table.csv", bytes(csv_));
    return figures_;
  }

 private:
  fs::path file_of(std::size_t cell, const std::string& name) const {
    if (!has_file(table_.rows[cell], name))
      throw Error(ExitCode::usage, fmt::format("--pairs: expected '{}' of the cell {}, found none; keep every part in the same frames",
                                               name, cells_.words(cells_.all()[cell])));
    return store_.cell(cells_.all()[cell].id) / utf8_path(name);
  }
  Image copied(const Cell& cell, const std::string& name, const std::string& to) {
    const fs::path from = file_of(static_cast<std::size_t>(&cell - cells_.all().data()), name);
    folder_.write(to, read_file(from));
    return image_io::read(from).image;
  }
  void add_parameters(const Cell& clean, const Cell& rainy, Json& line) const {
    const scene::Config config = cells_.config(rainy);
    const Json in_rain = parameters_of(config);
    const Json dry = parameters_of(cells_.config(clean));
    Json otherwise = Json::object();
    for (const auto& [key, value] : dry.items())
      if (!in_rain.contains(key) || in_rain[key] != value) otherwise[key] = value;
    line["camera"] = camera_of(config);
    line["parameters"] = in_rain;
    line["clean_parameters"] = otherwise;
  }
  void add_row(const Pair& pair, const std::string& side, const std::string& name, const Json& line) {
    const auto text = [&](const char* key) { return line.contains(key) && !line[key].is_null() ? line[key].dump() : std::string(); };
    std::vector<std::string> row{std::to_string(count_ - 1),
                                 side,
                                 text("frame"),
                                 side + "/clean/" + name,
                                 side + "/rainy/" + name,
                                 asked_.mask.empty() ? "" : side + "/mask/" + name,
                                 cells_.all()[pair.clean].id,
                                 cells_.all()[pair.rainy].id};
    for (const auto& [key, value] : cells_.values(cells_.all()[pair.rainy]))
      if (key != label_key) row.push_back(value);
    row.insert(row.end(), {text("psnr"), text("mask_share"), line.contains("drops") ? std::to_string(line["drops"].size()) : ""});
    csv_ += csv_line(row);
  }

  const Cells& cells_;
  const Table& table_;
  const Store& store_;
  const PairsAsked& asked_;
  capture::NewFolder& folder_;
  DataSetFigures figures_;
  std::string csv_, train_, test_;
  std::int64_t count_ = 0;
};

/// "mean 21.32; least 15.10, 10 % below 17.00, half below 21.10, 90 % below 26.00, most 31.00".
std::string spread(std::vector<double> values, int places) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double v : values) sum += v;
  const auto count = values.size();
  const auto at = [&](std::size_t percent) { return fmt::format("{:.{}f}", values[std::min(count - 1, count * percent / 100)], places); };
  return fmt::format("mean {:.{}f}; least {}, 10 % below {}, half below {}, 90 % below {}, most {}", sum / static_cast<double>(count),
                     places, at(0), at(10), at(50), at(90), at(100));
}

}  // namespace

std::uint8_t mask_code(double coverage) {
  return coverage > 0 ? static_cast<std::uint8_t>(std::clamp(std::floor(255 * coverage + 0.5), 1.0, 255.0)) : std::uint8_t{0};
}

DataSetFigures write_data_set(const Cells& cells, const Table& table, const Store& store, const PairsAsked& asked,
                              const std::vector<Pair>& pairs, capture::NewFolder& folder) {
  Writing writing(cells, table, store, asked, folder);
  for (const Pair& pair : pairs) {
    const Cell& cell = cells.all()[pair.rainy];
    for (std::int64_t frame = cell.first; frame < cell.end; ++frame)
      if (has_file(table.rows[pair.rainy], Keep{.part = {}, .at = {}}.file(frame))) writing.add(pair, frame);
  }
  return writing.finish();
}

std::string figures_text(const DataSetFigures& f) {
  std::string text = fmt::format("{} pairs: {} train, {} test\n", f.train + f.test, f.train, f.test);
  if (!f.psnr.empty()) text += fmt::format("PSNR of rainy against clean [dB]: {}\n", spread(f.psnr, 2));
  if (f.same > 0) text += fmt::format("pairs of two same pictures, without PSNR: {}\n", f.same);
  if (!f.mask_share.empty()) {
    text += fmt::format("share of the picture under the mask: {}\n", spread(f.mask_share, 3));
    text +=
        fmt::format("pixels where the mask is 0: {}; of them {} differ, by at most {} codes\n", f.dry, f.dry_differing, f.dry_difference);
  }
  if (!f.drops.empty()) text += fmt::format("drops in a picture: {}\n", spread(f.drops, 0));
  return text;
}

}  // namespace rainref::sweep
