#include "truth/rainy_glass_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "compositor/optics.h"
#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/host.h"
#include "truth/pane_truth.h"

namespace rainref::truth {
namespace {

using rainy_glass::Settings;

/// The camera, if the settings can be traced.
scene::Camera checked(const Settings& s, double thickness) {
  if (s.variant != Variant::corrected || s.shape != rainy_glass::Shape::pane || s.use_probe) {
    throw Error(ExitCode::usage, "a traced pane: expected the corrected variant, glass.shape = \"pane\" and glass.background = \"grab\"");
  }
  const double distance = s.distance * dot(rainy_glass::level_forward(s), rainy_glass::facing(s));
  if (!(thickness < 0.9 * distance))
    throw Error(ExitCode::usage,
                fmt::format("compositor.glass_thickness: expected less than nine tenths of the {} m from the eye to the glass, found {} m",
                            distance, thickness));
  return rainy_glass::camera(s);
}

/// The part of the glass in the picture and a little more; limited for glass at a grazing angle.
RainyGlassView::Extent extent_of(const Settings& s, const scene::Camera::Basis& basis, double half_width, double half_height) {
  const Vec level = rainy_glass::level_forward(s), normal = rainy_glass::facing(s), across = cross(Vec(0, 1, 0), normal);
  const double most = 100 * s.distance, margin = 0.05 * s.distance;
  RainyGlassView::Spot low{most, most}, high{-most, -most};
  for (const double x : {-1.05 * half_width, 1.05 * half_width}) {
    for (const double y : {-1.05 * half_height, 1.05 * half_height}) {
      const Vec ray = basis.forward + x * basis.right + y * basis.up;
      const Vec at = (s.distance * dot(level, normal) / std::max(dot(ray, normal), 1e-3)) * ray - s.distance * level;
      const double u = std::clamp(dot(at, across), -most, most), v = std::clamp(at.y, -most, most);
      low = {std::min(low.u, u - margin), std::min(low.v, v - margin)};
      high = {std::max(high.u, u + margin), std::max(high.v, v + margin)};
    }
  }
  return {low, {high.u - low.u, high.v - low.v}};
}

PaneShape shape_of(const Settings& s, const RainyGlassView::Extent& extent, double thickness) {
  const Vec normal = rainy_glass::facing(s), across = cross(Vec(0, 1, 0), normal), up(0, 1, 0);
  const Vec middle = rainy_glass::camera(s).position + s.distance * rainy_glass::level_forward(s);
  return {middle + extent.low.u * across + extent.low.v * up, extent.size.u * across, extent.size.v * up, normal, thickness, 0};
}

/// Water of given slopes, hit on the face; if a slope turns away from the ray, the face's own normal is used.
class SlopeFace : public FacePatch {
 public:
  SlopeFace(const Pane& pane, std::function<rainy_glass::ShownGlass::Slope(double, double)> slope)
      : FacePatch(pane, WaterLayer::clearance, [slope](double u, double v) { return slope(u, v).is_wet; }),
        slope_(slope),
        width_(__builtin_sqrt(dot(pane.shape().e_u, pane.shape().e_u))),
        height_(__builtin_sqrt(dot(pane.shape().e_v, pane.shape().e_v))) {}
  Vec normal(const Ray& ray, const Hit& hit) const override {
    const rainy_glass::ShownGlass::Slope s = slope_(hit.u, hit.v);
    const Vec face = pane().normal(hit.u), sloped = pane().tilted(hit.u, s.u * width_, s.v * height_);
    return dot(ray.direction, face) * dot(ray.direction, sloped) > 0 ? sloped : face;
  }

 private:
  std::function<rainy_glass::ShownGlass::Slope(double, double)> slope_;
  double width_, height_;
};

/// Objects before the glass, from the picture: a screen between the eye and the pane.
class Foreground {
 public:
  Foreground(const RainyGlassView& view, const Image& surface)
      : view_(view), surface_(surface), basis_(view.camera().basis()), half_height_(view.camera().half_height()) {}
  /// The texel that the eye sees in the direction of p.
  struct Texel {
    int x, y;
  };
  Texel texel(const Vec& p) const {
    const Vec d = p - view_.camera().position;
    const double z = dot(d, basis_.forward), half_width = half_height_ * view_.width() / view_.height();
    const auto whole = [](double share, int count) { return std::clamp(static_cast<int>(std::floor(share * count)), 0, count - 1); };
    return {whole(0.5 + 0.5 * dot(d, basis_.right) / (z * half_width), view_.width()),
            whole(0.5 + 0.5 * dot(d, basis_.up) / (z * half_height_), view_.height())};
  }
  bool is_there(const Vec& p) const {
    const Texel t = texel(p);
    return view_.surroundings().depth.row<float>(t.y)[t.x] <= surface_.row<float>(t.y)[4 * t.x + 2];
  }
  Vec radiance(const Vec& p) const {
    const Texel t = texel(p);
    const float* c = view_.surroundings().colour.row<float>(t.y) + 4 * t.x;
    return {c[0], c[1], c[2]};
  }

 private:
  const RainyGlassView& view_;
  const Image& surface_;
  scene::Camera::Basis basis_;
  double half_height_;
};

class OutsideRoom : public Environment {
 public:
  explicit OutsideRoom(const RainyGlassView& view) : view_(view), outward_(view.pane().normal(0)) {}
  void radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const override {
    // The room is dark.
    for (std::size_t i = 0; i < escaped_rays.size(); ++i)
      out[i] = dot(escaped_rays[i].direction, outward_) > 0 ? view_.met(escaped_rays[i].origin, escaped_rays[i].direction).radiance
                                                            : Vec(0, 0, 0);
  }

 private:
  const RainyGlassView& view_;
  Vec outward_;
};

}  // namespace

RainyGlassView::RainyGlassView(const Settings& s, const rainy_glass::Surroundings& around, std::optional<Street> street, double thickness,
                               const TracerOptions& tracer)
    : settings_(s),
      around_(&around),
      tracer_(tracer),
      camera_(checked(s, thickness)),
      basis_(camera_.basis()),
      half_width_(camera_.half_height() * s.width / s.height),
      half_height_(camera_.half_height()),
      extent_(extent_of(s, basis_, half_width_, half_height_)),
      pane_(shape_of(s, extent_, thickness)),
      street_(std::move(street)) {
  if (street_) colour_ = TextureData(rainy_glass::colour_as_half(street_->unbarred.colour), Address::clamp, Address::clamp);
}

void RainyGlassView::show(const Image& surface) {
  const Uncovered beyond = uncovered(around_->colour, around_->depth, surface);
  pictures_.emplace(camera_, half_width_, half_height_, rainy_glass::colour_as_half(beyond.colour), beyond.depth);
}

RainyGlassView::Met RainyGlassView::met(const Vec& origin, const Vec& direction) const {
  if (pictures_) {
    const PictureRelief::Sight seen = pictures_->look(origin, direction);
    return {std::isinf(seen.distance) ? direction : origin + seen.distance * direction - camera_.position, seen.radiance};
  }
  const scene::Scenery::Sight seen = street_->scenery->look(origin, direction);
  const bool is_sky = std::isinf(seen.distance);
  const Vec from_eye = is_sky ? direction : origin + seen.distance * direction - camera_.position;
  const double z = dot(from_eye, basis_.forward);
  if (!(z > 0)) return {from_eye, seen.radiance};
  const double u = 0.5 + 0.5 * dot(from_eye, basis_.right) / (z * half_width_),
               v = 0.5 + 0.5 * dot(from_eye, basis_.up) / (z * half_height_);
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return {from_eye, seen.radiance};
  // The eye sees the point unless something nearer hides it, there and in all neighbours, because a texel's depth is that of its centre.
  const int column = static_cast<int>(u * settings_.width), row = static_cast<int>(v * settings_.height);
  float deepest = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, settings_.height - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, settings_.width - 1); ++x)
      deepest = std::max(deepest, street_->unbarred.depth.row<float>(y)[x]);
  }
  if (!(deepest >= 0.98 * (is_sky ? rainy_glass::backdrop_far : z) - 0.1)) return {from_eye, seen.radiance};
  using compositor::scalar::Number;
  const auto s = compositor::scalar::sample_bilinear<0, 3, Number>(fixed_texture<Address::clamp, Address::clamp, 4>(colour_.view()),
                                                                   Number(u), Number(v));
  return {from_eye, {s[0].v, s[1].v, s[2].v}};
}

std::unique_ptr<Scene> RainyGlassView::scene(const rainy_glass::RainyGlass& rendered) const {
  auto scene = std::make_unique<Scene>(tracer_);
  const auto shown = std::make_shared<const rainy_glass::ShownGlass>(settings_, *around_, rendered);
  const auto slope = [this, shown, normal = pane_.normal(0)](double u, double v) {
    const Spot at = spot(u, v);
    return shown->slope(at.u, at.v, normal);
  };
  PaneMedia media;
  media.water = water(settings_.water_ior);
  add_faces(
      *scene, pane_, [slope](double u, double v) { return slope(u, v).is_wet; }, media);
  Material surface = Material::interface_of(media.outside, media.water);
  surface.is_masked = true;
  scene->add(std::make_shared<SlopeFace>(pane_, slope), surface);
  scene->add(std::make_shared<PaneRim>(pane_, 2 * WaterLayer::clearance), Material::of(emitter({0, 0, 0})));

  // Half way between the eye and the inner face.
  const auto before = std::make_shared<const Foreground>(*this, rendered.surface());
  PaneShape screen = pane_.shape();
  const double distance = dot(screen.corner - camera_.position, pane_.normal(0)), share = 0.5 * (distance - screen.thickness) / distance;
  screen.corner = camera_.position + share * (screen.corner - camera_.position);
  screen.e_u *= share;
  screen.e_v *= share;
  const Pane plane(screen);
  scene->add(std::make_shared<FacePatch>(plane, 0, [before, plane](double u, double v) { return before->is_there(plane.point(u, v)); }),
             Material::of(opaque_of([before](const Place& at) {
               Finish finish;
               finish.radiance = before->radiance(at.point);
               return finish;
             })));
  scene->set_environment(std::make_shared<OutsideRoom>(*this));
  scene->commit();
  return scene;
}

Image RainyGlassView::display(const Image& radiance, const parallel::Executor& executor) const {
  return display_of(settings_.exposure, settings_.rounding, radiance, executor);
}

}  // namespace rainref::truth
