#include "truth/puddle_scene.h"

#include <algorithm>
#include <array>

#include "compositor/interface.h"
#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/ground.h"
#include "puddle/host.h"
#include "puddle/instance.h"
#include "rainref/error.h"
#include "truth/pixels.h"
#include "truth/tracing.h"

namespace rainref::truth {
namespace {

/// shade's end of the refracted ray: the bed's depth under the surface point, straight along the ray.
Vec ground_of_passes(const Vec& point, const Vec& view, const Vec& normal, double depth) {
  const Vec bent = split(view, normal, 1, water_refractive_index).refracted;
  return point + depth / std::max(-bent.y, 0.05) * bent;
}

}  // namespace

Image display(const puddle::Settings& settings, const Image& radiance, const parallel::Executor& executor) {
  Image picture(Format::rgba8, radiance.width(), radiance.height());
  pass::HostIo<puddle::DisplayPass> io;
  io.colour = radiance;
  io.picture = picture;
  pass::Run<puddle::DisplayPass>(puddle::display_uniforms(settings), settings.variant == Variant::corrected, settings.rounding, io)
      .tiles(executor, 8);
  return picture;
}

Comparison compare(const puddle::Puddle& puddle, const puddle::Settings& settings, const PuddleScene& traced, const ShadingOptions& options,
                   const parallel::Executor& executor) {
  const int width = settings.width, height = settings.height;
  const Scene& scene = traced.scene();
  const PictureOptions one_ray{options, 1};
  const Picture truth = trace_picture(scene, traced.camera(), width, height, one_ray, executor);
  const Image shown = display(settings, truth.beauty, executor);
  const TextureData bed = puddle::make_bed(settings);
  const puddle::ShadeUniforms shade_uniforms = puddle::shade_uniforms(settings);
  const PrimaryRays primary(traced.camera(), width, height);
  const float f0 = reflectance_straight_on(static_cast<float>(water_refractive_index));

  Comparison out;
  enum { distance, angle, offset, colour, code, ground_code, schlick };
  const auto add = [&](const char* name, const char* unit) { out.differences.emplace_back(name, unit, width, height); };
  add("hit_distance", "m");
  add("normal_angle", "deg");
  add("ground_offset", "m");
  add("colour", "");
  add("display", "code");
  add("ground_display", "code");
  add("schlick", "");

  std::vector<std::array<std::size_t, 3>> counts(static_cast<std::size_t>(height));
  executor.for_tiles(width, height, width, 1, [&](const parallel::Tile& tile) {
    const int y = tile.y0;
    std::vector<Ray> rays(static_cast<std::size_t>(width));
    std::vector<Hit> hits(rays.size()), beds(rays.size());
    for (int x = 0; x < width; ++x) rays[x] = primary.through(x + 0.5, y + 0.5);
    scene.tracer().first_hits(rays, hits);
    std::vector<Ray> bent = rays;
    std::vector<Vec> normals(rays.size());
    for (int x = 0; x < width; ++x) {
      bent[x].farthest = 0;  // skipped unless the ray hits water
      if (!hits[x].is_surface() || !scene.material(hits[x].surface).is_masked) continue;
      const Material& water = scene.material(hits[x].surface);
      Place at;
      at.hit = hits[x];
      at.normal = scene.tracer().surface(hits[x].surface).normal(rays[x], hits[x]);
      normals[x] = water.smooth_normals ? smooth_normal(water, at) : at.normal;
      const Vec direction = glm::normalize(rays[x].direction);
      bent[x] = {rays[x].at(hits[x].t), split(direction, normals[x], 1, water_refractive_index).refracted};
      bent[x].nearest = 1e-9;
    }
    scene.tracer().first_hits(bent, beds);
    for (int x = 0; x < width; ++x) {
      const float* hit = puddle.hit().row<float>(y) + 4 * static_cast<std::ptrdiff_t>(x);
      const Half* stored = puddle.normal().row<Half>(y) + 4 * static_cast<std::ptrdiff_t>(x);
      const Vec position(hit[0], hit[1], hit[2]), normal(to_float(stored[0]), to_float(stored[1]), to_float(stored[2]));
      const compositor::scalar::Number u(position.x * shade_uniforms.inverse_size[0] + 0.5),
          v(position.z * shade_uniforms.inverse_size[1] + 0.5);
      const double depth = compositor::scalar::sample_bilinear<0, 1>(bed.view(), u, v)[0].v;
      const bool is_water = to_float(stored[3]) > 0.5f && depth > 0,
                 is_truly_water = hits[x].is_surface() && scene.material(hits[x].surface).is_masked;
      auto& count = counts[static_cast<std::size_t>(y)];
      count[0] += is_water && is_truly_water;
      count[1] += is_water && !is_truly_water;
      count[2] += !is_water && is_truly_water;
      const Vec view = glm::normalize(rays[x].direction);
      if (is_water && is_truly_water) {
        const double length = glm::length(rays[x].direction);
        out.differences[distance].at(x, y) = glm::length(position - rays[x].origin) - hits[x].t * length;
        out.differences[angle].at(x, y) = degrees_between(normal, normals[x]);
        if (beds[x].is_surface()) {
          const Vec there = ground_of_passes(position, view, normal, depth) - bent[x].at(beds[x].t);
          out.differences[offset].at(x, y) = std::sqrt(there.x * there.x + there.z * there.z);
        }
      }
      if (is_truly_water) {
        const double cosine = std::clamp(-dot(view, normals[x]), 0.0, 1.0);
        out.differences[schlick].at(x, y) =
            compositor::scalar::fresnel_schlick(compositor::scalar::Number(cosine), f0).v -
            compositor::scalar::fresnel_dielectric(compositor::scalar::Number(cosine), water_refractive_index).v;
      }
      if (is_water && is_truly_water) {
        out.differences[colour].at(x, y) = pixel_difference<Half>(puddle.colour(), truth.beauty, x, y);
        out.differences[code].at(x, y) = pixel_difference<Unorm8>(puddle.picture(), shown, x, y);
      } else if (hits[x].is_surface() && !is_truly_water) {
        out.differences[ground_code].at(x, y) = pixel_difference<Unorm8>(puddle.picture(), shown, x, y);
      }
    }
  });
  std::array<std::size_t, 3> all{};
  for (const auto& c : counts)
    for (std::size_t k = 0; k < 3; ++k) all[k] += c[k];
  out.pixels = {{"pixels", static_cast<std::size_t>(width) * height},
                {"water_in_both", all[0]},
                {"water_in_passes_only", all[1]},
                {"water_in_truth_only", all[2]}};
  return out;
}

namespace {

/// Null if rays see the passes' picture.
std::shared_ptr<const scene::Scenery> street(const scene::Config& config, const effect::Inputs& inputs) {
  if (config.text("compositor.surroundings") != "street") return nullptr;
  if (!config.text("environment.image").empty()) {
    throw Error(ExitCode::usage,
                "compositor.surroundings: expected \"picture\", for environment.image names one; \"street\" is the street made here");
  }
  return effect::street_of(inputs, {});
}

class PuddleTracing : public Tracing {
 public:
  PuddleTracing(const scene::Config& config, const puddle::Instance& puddle, const effect::Inputs& inputs, const parallel::Executor& on)
      : Tracing(choice_from(config), on),
        puddle_(puddle),
        scene_(puddle.settings(), puddle.surroundings(), {choice().tracer, street(config, inputs), choice().picture.samples}, on) {}

  Comparison compare() override {
    scene_.update(puddle_.running(), executor());
    return truth::compare(puddle_.running(), puddle_.settings(), scene_, choice().picture.shading, executor());
  }

 private:
  Picture picture() override {
    scene_.update(puddle_.running(), executor());
    return trace_picture(scene_.scene(), scene_.camera(), puddle_.settings().width, puddle_.settings().height, choice().picture,
                         executor());
  }
  Image display(const Image& radiance) const override { return truth::display(puddle_.settings(), radiance, executor()); }

  const puddle::Instance& puddle_;
  PuddleScene scene_;
};

}  // namespace

EffectTracing puddle_tracing() {
  return {"puddle",
          [] {
            std::vector<scene::Parameter> all = parameters();
            all.push_back(scene::choice("compositor.surroundings", {"picture", "street"}, "picture",
                                        "What a traced ray sees beyond the puddle: the passes' picture of the surroundings, or the "
                                        "generated street, ray by ray.")
                              .only("corrected"));
            return all;
          },
          [](const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
             const parallel::Executor& executor) -> std::unique_ptr<Tracing> {
            const auto& puddle = static_cast<const puddle::Instance&>(instance);
            if (puddle.settings().variant != Variant::corrected) return nullptr;
            return std::make_unique<PuddleTracing>(config, puddle, inputs, executor);
          },
          hold_traced};
}

}  // namespace rainref::truth
