#include "truth/screen_drops_view.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "compositor/optics.h"
#include "rainref/error.h"
#include "screen_drops/host.h"
#include "screen_drops/instance.h"
#include "screen_drops/shown.h"
#include "truth/pane_tracing.h"
#include "truth/pane_truth.h"

namespace rainref::truth {

Comparison ScreenDropsView::compare(const screen_drops::ScreenDrops& rendered, const PictureOptions& options,
                                    const parallel::Executor& executor) const {
  const PaneTruth pane(rendered, *this, options, executor);
  const screen_drops::ShownDrops pass(settings_, rendered);
  Difference refraction = pane.difference("refraction", "deg"), colour = pane.difference("colour", ""),
             colour_dry = pane.difference("colour_dry", ""), codes = pane.difference("display", "code");
  std::atomic<std::size_t> drops = 0, wets = 0, both = 0, mirrored = 0, mirrored_in_pass = 0;
  pane.each_pixel([&](int x, int y) {
    codes.at(x, y) = pane.codes_at(x, y);
    const screen_drops::Shown pixel = pass.at(x, y);
    const StraightPath path = pane.path(x, y);
    const bool is_drop = pixel.cover >= 0.5, is_mirrored = path.end == StraightPath::End::mirrored,
               is_wet = is_mirrored || path.interfaces > 2;
    drops += is_drop;
    wets += is_wet;
    if (is_drop != is_wet) return;
    (is_drop ? colour : colour_dry).at(x, y) = pane.colour_at(x, y);
    if (!is_drop) return;
    ++both;
    mirrored += is_mirrored;
    mirrored_in_pass += pixel.reflected >= 1;
    if (path.end != StraightPath::End::out || pixel.reflected >= 1) return;
    refraction.at(x, y) =
        degrees_between(pixel.bent.x * basis_.right + pixel.bent.y * basis_.up + pixel.bent.z * basis_.forward, path.direction);
  });
  return {{{"pixels", static_cast<std::size_t>(pane.width) * pane.height},
           {"drop_pixels", drops},
           {"wet_pixels", wets},
           {"drop_not_wet", drops - both},
           {"wet_not_drop", wets - both},
           {"mirrored_pixels", mirrored},
           {"mirrored_in_pass", mirrored_in_pass}},
          {refraction, colour, colour_dry, codes}};
}

namespace {

class ScreenDropsTracing : public PaneTracing<ScreenDropsView, screen_drops::Instance> {
 public:
  ScreenDropsTracing(const scene::Config& config, const screen_drops::Instance& drops, const parallel::Executor& on)
      : PaneTracing(config, drops,
                    ScreenDropsView(drops.settings(), drops.scene_colour(), config.real("compositor.glass_thickness"),
                                    choice_from(config).tracer, on),
                    on) {}

 private:
  void look_outside() override {
    if (instance().has_sequence()) view().show(instance().scene_colour());
  }
};

}  // namespace

EffectTracing screen_drops_tracing() {
  return {"screen_drops", pane_parameters,
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs&,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            const auto& drops = static_cast<const screen_drops::Instance&>(instance);
            if (drops.settings().variant != Variant::corrected) return nullptr;
            return std::make_unique<ScreenDropsTracing>(config, drops, executor);
          },
          hold_traced};
}

namespace {

scene::Camera at_origin(const screen_drops::Settings& s) {
  scene::Camera camera = screen_drops::camera(s);
  camera.target -= camera.position;
  camera.position = {0, 0, 0};
  return camera;
}

PaneShape shape_of(const screen_drops::Settings& s, const scene::Camera::Basis& basis, double border, double thickness) {
  const double distance = screen_drops::glass_distance(s), height = s.pane_height + 2 * border,
               width = s.pane_height * s.width / s.height + 2 * border;
  if (!(thickness < 0.9 * distance))
    throw Error(ExitCode::usage,
                fmt::format("compositor.glass_thickness: expected less than nine tenths of the {} m from the eye to the glass, found {} m",
                            distance, thickness));
  return {distance * basis.forward - 0.5 * width * basis.right - 0.5 * height * basis.up,
          width * basis.right,
          height * basis.up,
          basis.forward,
          thickness,
          0};
}

class OutsideWindow : public Environment {
 public:
  explicit OutsideWindow(const ScreenDropsView& view) : view_(view) {}
  void radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const override {
    for (std::size_t i = 0; i < escaped_rays.size(); ++i) out[i] = view_.radiance(escaped_rays[i].direction);
  }

 private:
  const ScreenDropsView& view_;
};

}  // namespace

ScreenDropsView::ScreenDropsView(const screen_drops::Settings& s, const Image& colour, double thickness, const TracerOptions& tracer,
                                 const parallel::Executor& executor)
    : settings_(s),
      tracer_(tracer),
      executor_(executor),
      border_(1e-3 * screen_drops::cell_over_radius * s.largest_radius),
      camera_(at_origin(s)),
      basis_(camera_.basis()),
      pane_(shape_of(s, basis_, border_, thickness)) {
  if (s.variant != Variant::corrected) throw Error(ExitCode::usage, "a traced window: expected the corrected variant, found as-published");
  const double half_height = camera_.half_height(), half_width = half_height * s.width / s.height;
  scale_[0] = 0.5 / (half_width * s.scene_margin);
  scale_[1] = 0.5 / (half_height * s.scene_margin);
  show(colour);
}

void ScreenDropsView::show(const Image& colour) {
  scene_ = TextureData(screen_drops::defocused_scene(settings_, colour, executor_), Address::clamp, Address::clamp);
}

Vec ScreenDropsView::radiance(const Vec& direction) const {
  const double ahead = dot(direction, basis_.forward);
  if (!(ahead > 0)) return {0, 0, 0};
  using compositor::scalar::Number;
  const double inverse = 1 / std::max(ahead, 1e-6);
  const Number u(0.5 + dot(direction, basis_.right) * inverse * scale_[0]), v(0.5 + dot(direction, basis_.up) * inverse * scale_[1]);
  const auto s = compositor::scalar::sample_bilinear<0, 3, Number>(fixed_texture<Address::clamp, Address::clamp, 4>(scene_.view()), u, v);
  return {s[0].v, s[1].v, s[2].v};
}

std::shared_ptr<const CapWater> ScreenDropsView::water(const screen_drops::ScreenDrops& rendered) const {
  std::vector<CapBase> caps;
  for (const screen_drops::Cap& c : screen_drops::caps(settings_, rendered.cells()))
    caps.push_back({c.x + border_, c.y + border_, c.radius});
  CapWater::Layer layer{};
  if (rendered.height().width() > 1) {
    layer = {std::make_shared<const WaterLayer>(rendered.height()),
             {border_, border_},
             {settings_.pane_height * settings_.width / settings_.height, settings_.pane_height}};
  }
  return std::make_shared<const CapWater>(pane_, std::move(caps), settings_.contact_angle_deg, layer);
}

std::unique_ptr<Scene> ScreenDropsView::scene(const screen_drops::ScreenDrops& rendered) const {
  auto scene = std::make_unique<Scene>(tracer_);
  PaneMedia media;
  media.water = compositor::water(settings_.water_ior);
  add_cap_pane(*scene, water(rendered), emitter({0, 0, 0}), executor_, media);
  scene->set_environment(std::make_shared<OutsideWindow>(*this));
  scene->commit();
  return scene;
}

Image ScreenDropsView::display(const Image& radiance, const parallel::Executor& executor) const {
  return display_of(settings_.exposure, settings_.rounding, radiance, executor);
}

}  // namespace rainref::truth
