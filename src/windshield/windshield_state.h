// State of a running windshield.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "pass/display.h"
#include "rainref/error.h"
#include "rainref/windshield.h"
#include "state/items.h"
#include "windshield/parameters.h"
#include "windshield/picture/falling_rain.h"
#include "windshield/scene/blades_seen.h"
#include "windshield/scene/street.h"
#include "windshield/wet_pane.h"

namespace rainref::windshield {

struct Windshield::State {
  /// Refuses a scene that does not fit before the drops, the first large allocation.
  static Settings fitting(Settings s, const scene::Config& config, const Surroundings& around) {
    require_memory(fmt::format("windshield.height_size {}x{} with scene.size {}x{} for {} drops", s.surface.width, s.surface.height,
                               s.scene_size[0], s.scene_size[1], s.drops.capacity),
                   memory(s, static_cast<int>(config.integer("run.frames")), {around.colour.width(), around.colour.height()}).peak());
    return s;
  }
  static void check_pictures(const Surroundings& s) {
    const auto expect = [&](const Image& image, Format format, const char* key) {
      if (image.format() == format && image.width() == s.colour.width() && image.height() == s.colour.height()) return;
      throw Error(ExitCode::usage, fmt::format("{}: expected {} of {}x{}, found {} of {}x{}", key, info(format).name, s.colour.width(),
                                               s.colour.height(), info(image.format()).name, image.width(), image.height()));
    };
    expect(s.colour, Format::rgba16f, "scene.image");
    expect(s.depth, Format::r32f, "scene.depth_image");
  }

  Settings settings;
  const parallel::Executor& executor;
  bool corrected;
  Vehicle vehicle;
  Weather weather;
  int frame = 0;
  std::int64_t steps = 0;

  Real3 air_moved{0, 0, 0}, air_of_frame{0, 0, 0};  // distance that the air has moved past the car; at the frame's start [m]
  std::vector<FallingDrop> falling;

  std::vector<std::unique_ptr<WetPane>> panes;  // the windshield first

  Image colour, pane_colour, picture;
  Image interior;  // if the scene asks for it
  CodeTable display;
  SceneView scene;
  SceneView without_blades;  // if blades are drawn: the scene behind them
  std::vector<SeenBlade> blades;
  bool own_scene, scene_is_new = false;
  std::optional<StreetDrive> street;
  std::vector<Image> levels;
  std::optional<blur_pyramid::LevelTexture> pyramid;
  std::vector<Glint> lights;

  State(const scene::Config& config, Surroundings surroundings, const parallel::Executor& e)
      : settings(fitting(settings_from(config), config, surroundings)),
        executor(e),
        corrected(settings.corrected),
        vehicle(settings.vehicle),
        weather(settings.weather) {
    for (int k = 0; k <= static_cast<int>(settings.panes.size()); ++k)
      panes.push_back(std::make_unique<WetPane>(settings_of_pane(settings, k), k, vehicle, executor));
    colour = Image(Format::rgba16f, settings.picture.width, settings.picture.height);
    if (panes.size() > 1) pane_colour = Image(Format::rgba16f, settings.picture.width, settings.picture.height);
    picture = Image(Format::rgba8, settings.picture.width, settings.picture.height);
    if (settings.interior.on) interior = draw_interior(settings.interior, settings.picture, settings.corners, executor);
    display = pass::display_table(settings.picture.width, settings.picture.height, settings.picture.exposure, settings.surface.rounding);
    lights = glints(settings.picture);
    own_scene = surroundings.colour.empty() && surroundings.street;
    if (own_scene) {
      scene::Camera wide = camera(settings.picture);
      wide.vertical_fov_deg = widened_fov(settings.picture);
      street.emplace(std::move(surroundings.street), wide, settings.scene_size[0], settings.scene_size[1],
                     StreetOptions{settings.street_start, settings.keyframes, vehicle.at(0).speed == 0}, executor);
    } else {
      if (surroundings.colour.empty())
        throw Error(ExitCode::usage, "scene.image: expected pictures of what lies before the car or a street, found neither");
      check_pictures(surroundings);
      looked_at().colour = std::move(surroundings.colour);
      looked_at().depth = std::move(surroundings.depth);
    }
  }

  const WetPane& pane(int number) const {
    const int last = static_cast<int>(panes.size()) - 1;
    if (number < 0 || number > last)
      throw Error(ExitCode::usage, fmt::format("pane: expected a number from 0 to {}, found {}", last, number));
    return *panes[static_cast<std::size_t>(number)];
  }

  double step_time() const { return 1 / (settings.fps * settings.substeps); }
  double frame_time() const { return 1 / settings.fps; }

  pass::Moment moment(Recorder* recorder, int step, double dt) const {
    return {recorder, frame, step, frame / settings.fps, dt, settings.surface.rounding};
  }

  void list(state::Items& items);
  void step(Recorder* recorder, int substep);
  SceneView& looked_at() { return settings.shows_blades ? without_blades : scene; }
  bool look();
  bool look_at_scene();
  void rain_behind(const pass::Moment& now);
  void look_through(const pass::Moment& now);
  void show_panes(const pass::Moment& now, bool shows_drops, Image& seen, double before);
  void sit_inside(const pass::Moment& now, Image& seen);
};

}  // namespace rainref::windshield
