#include "simulation/opened.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/floating_point.h"
#include "base/path_text.h"
#include "cache/prepared.h"
#include "image/flipped.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "simulation/light_mean.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"

namespace rainref::simulation {
namespace {

/// Refuses a lack of memory before anything is made.
const effect::Effect& fitting(const scene::Config& config) {
  const FloatingPointGuard guard;
  const effect::RunMemory memory = memory_of(config);
  try {
    require_memory(memory);
  } catch (const Error&) {  // cached values of other scenes must not block a scene
    cache::forget();
    require_memory(memory);
  }
  return *registry::find(config.effect());
}

void write_top_first(const std::filesystem::path& path, std::vector<image_io::Layer> layers, const image_io::Notes& notes = {}) {
  std::vector<Image> turned;
  turned.reserve(layers.size());
  for (image_io::Layer& layer : layers) layer.image = &turned.emplace_back(flipped(*layer.image));
  image_io::write_exr(path, layers, notes);
}

/// One channel of one of the layers, as they are written.
Image channel_of(const std::vector<image_io::Layer>& layers, std::string_view wanted) {
  std::vector<std::string> known;
  for (const image_io::Layer& layer : layers) {
    for (std::size_t k = 0; k < layer.channels.size(); ++k) {
      known.push_back(layer.name_prefix.empty() ? layer.channels[k] : layer.name_prefix + "." + layer.channels[k]);
      if (known.back() != wanted) continue;
      const Image& all = *layer.image;
      const FormatInfo& of = info(all.format());
      Image one(of.kind == FormatInfo::float16 ? Format::r16f : Format::r32f, all.width(), all.height());
      for (int y = 0; y < all.height(); ++y)
        for (int x = 0; x < all.width(); ++x)
          std::memcpy(one.row_bytes(y) + x * of.channel_bytes, all.row_bytes(y) + x * of.texel_bytes() + k * of.channel_bytes,
                      of.channel_bytes);
      return one;
    }
  }
  throw Error(ExitCode::usage, fmt::format("expected a channel of the picture's EXR, one of {}, found '{}'{}", fmt::join(known, ", "),
                                           wanted, did_you_mean(wanted, known)));
}

void write_map(const std::filesystem::path& folder, const effect::Map& map) {
  if (map.image->format() == Format::rgba8)
    image_io::write_png(folder / utf8_path(fmt::format("{}.png", map.name)), flipped(*map.image), image_io::PngChannels::rgba);
  else
    write_top_first(folder / utf8_path(fmt::format("{}.exr", map.name)), {{"", {"R", "G", "B", "A"}, map.image}});
}

}  // namespace

const scene::EffectTable& effect_table() {
  static const scene::EffectTable table = [] {
    static std::vector<std::vector<scene::Parameter>> parameters;  // referenced by the table
    scene::EffectTable t;
    parameters.reserve(registry::effects().size());
    for (const effect::Effect* e : registry::effects()) {
      std::vector<scene::Parameter>& all = parameters.emplace_back(e->parameters.begin(), e->parameters.end());
      if (const truth::EffectTracing* tracing = truth::tracing_of(e->name)) {
        for (scene::Parameter& p : tracing->parameters()) all.push_back(std::move(p));
      }
      for (scene::Parameter& p : development_parameters()) all.push_back(std::move(p));
      t.effects.push_back({e->name, e->variants, all});
    }
    t.presets = own_data("presets");
    return t;
  }();
  return table;
}

scene::Config config_of_passes(const scene::Config& config) {
  std::vector<scene::Config::Entry> entries;
  for (const scene::Config::Entry& e : config.entries()) {
    if (!e.parameter.key.starts_with("compositor.") && !e.parameter.key.starts_with("picture.")) entries.push_back(e);
  }
  return scene::Config(std::move(entries), config.directory());
}

effect::RunMemory memory_of(const scene::Config& scene) {
  // Copied only if needed: a plan calls this for every cell, and a copy takes longer than the rest.
  std::optional<scene::Config> larger;
  if (scene.integer("run.supersample") > 1) larger = config_at_pass_size(scene);
  const scene::Config& config = larger ? *larger : scene;
  effect::RunMemory memory = registry::find(config.effect())->memory(config);
  if (const truth::EffectTracing* tracing = truth::tracing_of(config.effect())) tracing->hold(memory, config);
  const std::uint64_t n = static_cast<std::uint64_t>(scene.integer("run.supersample"));
  const Development options = development_from(scene);
  memory.samples = n * n;
  if (n > 1 || options.is_on()) memory.peak.hold(image_bytes(memory, Format::rgba8) / memory.samples);
  hold_development(memory, options, static_cast<int>(n));
  return memory;
}

namespace {

// The bare address would not do: where nothing calls a function whose result is a template, clang gives it another type, and WebAssembly
// then has no function there.
std::shared_ptr<const scene::Scenery> make_street(const scene::SceneryOptions& options) { return night_street::Street::make(options); }

}  // namespace

Opened::Opened(scene::Config config, const parallel::Executor& executor) : Opened(std::move(config), executor, make_street) {}

Opened::Opened(scene::Config config, const parallel::Executor& executor, scene::MakeScenery street)
    : config_(std::move(config)),
      pass_config_(config_at_pass_size(config_)),
      executor_(executor),
      effect_(fitting(config_)),
      inputs_{.files = {}, .warnings = {}, .notes = {}, .street = street},
      development_(development_from(config_)),
      samples_(static_cast<int>(config_.integer("run.supersample"))) {
  const FloatingPointGuard guard;
  instance_ = effect_.open(pass_config_, executor_, inputs_);
  if (development_.is_on() && !instance_->display())
    throw Error(ExitCode::usage, fmt::format("picture: expected an effect with a linear picture, found {}", effect_.name));
  is_traced_ = truth::choice_from(config_).is_traced;
  if (development_.has_layer && (is_traced_ || !instance_->has_drops_layer()))
    throw Error(ExitCode::usage, fmt::format("picture.layer: expected windshield, screen_drops corrected or rainy_glass corrected, not "
                                             "traced; found {} {}{}",
                                             effect_.name, config_.variant(), is_traced_ ? ", traced" : ""));
  if (is_traced_) has_truth();
}

void Opened::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  instance_->simulate(recorder);
}

void Opened::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  instance_->render(recorder);
  if (is_traced_ && is_shown_) tracing_->trace(instance_->frame() - 1, recorder);
  if (!is_made() || !is_shown_) return;
  if (!development_.is_on()) {
    made_ = tent_mean(picture_of_passes(), samples_, executor_);
    return;
  }
  const auto seed = static_cast<std::uint64_t>(config_.integer("seed"));
  made_ = developed(*display(), development_, samples_, seed, instance_->frame() - 1, executor_);
}

std::optional<effect::Display> Opened::display() const {
  std::optional<effect::Display> display = instance_->display();
  if (is_traced_ && display) display->radiance = tracing_->layers().front().image;
  return display;
}

void Opened::skip(Recorder* recorder) {
  const FloatingPointGuard guard;
  instance_->skip(recorder);
}

std::vector<PassOutput> Opened::buffers() const {
  const FloatingPointGuard guard;
  return instance_->buffers();
}

image_io::Notes Opened::notes() const {
  const FloatingPointGuard guard;
  return picture_notes(config_, inputs_, frame() - 1, picture_of_passes());
}
std::vector<std::byte> Opened::png_bytes() const { return image_io::png_bytes(flipped(picture()), image_io::PngChannels::rgb, notes()); }
void Opened::write_png(const std::filesystem::path& path) const {
  image_io::write_png(path, flipped(picture()), image_io::PngChannels::rgb, notes());
}

void Opened::write_exr(const std::filesystem::path& path, bool with_maps, std::string_view channel) {
  std::vector<image_io::Layer> layers = is_traced_ ? tracing_->layers() : instance_->layers();
  effect::DropsLayer own;
  if (development_.has_layer) {
    own = instance_->drops_layer(executor_);
    layers.push_back({"drops", {"R", "G", "B", "A"}, &own.drops});
    layers.push_back({"offset", {"U", "V"}, &own.offset});
    const auto is_background = [](const image_io::Layer& layer) { return layer.name_prefix == "background"; };
    if (std::none_of(layers.begin(), layers.end(), is_background)) layers.push_back({"background", {"R", "G", "B"}, &own.background});
  }
  if (!channel.empty()) {
    const Image one = channel_of(layers, channel);
    return write_top_first(path, {{"", {std::string(channel)}, &one}}, notes());
  }
  write_top_first(path, std::move(layers), notes());
  if (is_traced_ || !with_maps || std::exchange(has_written_maps_, true)) return;
  for (const effect::Map& map : instance_->maps()) write_map(path.parent_path(), map);
}

bool Opened::has_truth() {
  const FloatingPointGuard guard;
  const truth::EffectTracing* how = truth::tracing_of(effect_.name);
  if (!tracing_ && how) tracing_ = how->make(pass_config_, *instance_, inputs_, executor_);
  return tracing_ != nullptr;
}

truth::Comparison Opened::compare_truth() {
  const FloatingPointGuard guard;
  return tracing_->compare();
}

}  // namespace rainref::simulation
