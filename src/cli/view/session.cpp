#include "cli/view/session.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/hashing.h"
#include "capture/json_read.h"
#include "cli/run_command.h"
#include "image/flipped.h"
#include "image_io/film.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "registry/registry.h"
#include "simulation/describe.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr capture::JsonLimits from_page{std::uint64_t{16} << 20, 8, ExitCode::usage}, own{std::uint64_t{64} << 20, 64, ExitCode::internal};

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// A member of an operation's arguments. Throws Error(usage) if it is missing or of another type.
template <class T>
T argument(const Json& args, const char* name) {
  try {
    return args.at(name).get<T>();
  } catch (const Json::exception&) {
    throw Error(ExitCode::usage,
                fmt::format("{}: expected in the arguments, found {}", name, args.contains(name) ? "another type" : "none"));
  }
}

std::unique_ptr<Hidden> temporary() {
  const fs::path parent = temporary_folder();
  remove_leftovers(parent);
  try {
    return std::make_unique<Hidden>(parent, Hidden::Kind::private_folder);
  } catch (const std::system_error& e) {
    throw Error(ExitCode::io, fmt::format("no temporary folder in {}: {}", path_text(parent), e.code().message()));
  }
}

/// The name of a file that a page sends, without a folder: a page may write nowhere else.
fs::path plain_name(const std::string& name) {
  fs::path path = utf8_path(name);
  if (name.empty() || path.filename() != path || name == "." || name == "..")
    throw Error(ExitCode::usage, fmt::format("'{}': expected the name of a file without a folder", name));
  return path;
}

std::vector<std::byte> rgba(const Image& picture) {
  const std::size_t row = static_cast<std::size_t>(4) * picture.width();
  std::vector<std::byte> bytes(row * picture.height());
  for (int y = 0; y < picture.height(); ++y)  // row 0 of an effect's picture is the bottom one
    std::copy_n(picture.row_bytes(picture.height() - 1 - y), row, bytes.begin() + static_cast<std::ptrdiff_t>(row * y));
  return bytes;
}

}  // namespace

Result Session::run(std::string_view operation, const Sent& sent, const Advance& advance) {
  const Json args = capture::parse_json(sent.args.empty() ? "{}" : sent.args, "args", from_page);
  if (operation == "describe") return describe();
  const std::lock_guard lock(one_at_a_time_);
  if (operation == "open") return open(args, sent);
  if (operation == "set") return set(args);
  if (operation == "step") return step();
  if (operation == "film") return film(args, advance);
  throw Error(ExitCode::usage, fmt::format("no operation '{}'", operation));
}

Result Session::describe() const {
  Json effects = Json::array();
  for (const effect::Effect* e : registry::effects())
    effects.push_back(capture::parse_json(simulation::describe_json(e->name), e->name, own));
  const int threads = executor_.threads();
  return {dumped({{"effects", effects},
                  {"version", version()},
                  {"generation", golden_generation},
                  {"offers", {"film", "pictures"}},
                  {"where", fmt::format("in the program on this machine, with {}",
                                        threads == 1 ? "one thread" : fmt::format("{} threads", threads))}})};
}

Simulation& Session::opened() {
  if (!running_) throw Error(ExitCode::usage, "no scene is open");
  return *running_;
}

Result Session::open(const Json& args, const Sent& sent) {
  const auto file = argument<std::string>(args, "file"), known = args.contains("known") ? argument<std::string>(args, "known") : "";
  SceneText scene{argument<std::string>(args, "text"), argument<std::vector<std::string>>(args, "sets"), file};
  std::unique_ptr<Hidden> files;
  if (const fs::path own_file = scenes_.file(known); !own_file.empty()) {
    scene.file = path_text(own_file);
  } else {
    files = temporary();
    scene.file = path_text(files->path() / plain_name(file));
    for (const Upload& upload : sent.files) {
      const std::span bytes(reinterpret_cast<const std::byte*>(upload.bytes.data()), upload.bytes.size());
      write_file(files->path() / plain_name(upload.name), bytes);
    }
  }
  auto made = std::make_unique<Simulation>(scene, executor_);
  running_ = std::move(made);
  files_ = std::move(files);
  scene_ = std::move(scene);
  return info();
}

Result Session::set(const Json& args) {
  const auto key = argument<std::string>(args, "key"), value = argument<std::string>(args, "value");
  opened().set(key, value);
  std::erase_if(scene_.set, [&](const std::string& s) { return s.starts_with(key + "="); });
  scene_.set.push_back(key + "=" + value);
  return info();
}

Result Session::info() const {
  return {dumped({{"effect", running_->effect()},
                  {"variant", name(running_->variant())},
                  {"frame", running_->frame()},
                  {"frames", running_->frames()},
                  {"sceneJson", running_->scene_json()},
                  {"warnings", running_->warnings()}})};
}

Result Session::step() {
  const auto begin = std::chrono::steady_clock::now();
  capture::HashRecorder recorder;
  opened().next_frame(&recorder);
  const double milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  Json lines = Json::array();
  for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(line.text());
  const Image& picture = running_->picture();
  return {dumped({{"lines", lines}, {"milliseconds", milliseconds}, {"width", picture.width()}, {"height", picture.height()}}), "picture",
          rgba(picture)};
}

Result Session::film(const Json& args, const Advance& advance) const {
  if (!running_) throw Error(ExitCode::usage, "no scene is open");
  const auto number = argument<double>(args, "frames");
  if (constexpr int most = 1000000; !(number >= 1 && number <= most))
    throw Error(ExitCode::usage, fmt::format("frames: expected 1 to {}, found {}", most, number));
  const int frames = static_cast<int>(number);
  const std::unique_ptr<Hidden> folder = temporary();
  const fs::path path = folder->path() / plain_name(fmt::format("{}.{}", running_->effect(), argument<std::string>(args, "kind")));
  SceneText scene = scene_;
  scene.set.push_back(fmt::format("run.frames={}", frames));
  const Json keys = capture::parse_json(running_->scene_json(), "scene", own);
  image_io::Film film(path, keys.at("run.size").at(0), keys.at("run.size").at(1), {keys.at("run.fps")});
  Simulation simulation(scene, executor_);
  for (int frame = 0; frame < frames; ++frame) {
    simulation.next_frame();
    film.add(flipped(simulation.picture()));
    if (!advance(frame + 1, frames)) throw Error(ExitCode::io, "film: the page is gone");
  }
  film.finish();
  return {"{}", "film", read_file(path)};
}

}  // namespace rainref::cli
