#include "windshield/scene/street.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "cache/prepared.h"
#include "image/half_image.h"
#include "parallel/rows.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;
using View = scene::Scenery::View;
using Parts = scene::Scenery::Parts;

constexpr double lane = 1.75, start_z = 200;  // the right lane; the way goes to -z

struct Work {
  const scene::Scenery& street;
  const parallel::Executor& executor;
};
Keyframe view_of(const Work& by, const std::string&, const scene::Camera& camera, const int& width, const int& height, const Parts& parts) {
  View view = by.street.view(camera, width, height, street_far, by.executor, parts);
  Keyframe made{as_half(view.colour, parallel::rows_of(by.executor)), std::move(view.depth)};
  for (Image* image : {&made.colour, &made.depth}) image->share();
  return made;
}

}  // namespace

// x forward, y left, z up become the street's x right, y up, z backward.
Vector3 in_street(const Vector3& car) { return {-car.y, car.z, -car.x}; }
// The street restarts between two keyframes, so that no view lies between its end and its beginning.
Vector3 place_in_street(double start, double distance) {
  constexpr double length = StreetDrive::street_length, spacing = StreetDrive::spacing;
  const double taken = spacing * std::floor(distance / spacing), way = start + taken;
  return {lane, 0, start_z - (way - length * std::floor(way / length) + (distance - taken))};
}

std::vector<RainLamp> lamps_from(const scene::Scenery& street, const Vector3& place) {
  std::vector<RainLamp> lamps;
  for (const scene::Lamp& lamp : street.lamps()) {
    const Vector3 from = lamp.position - place;
    lamps.push_back({{-from.z, -from.x, from.y}, lamp.radius, {lamp.radiance[0], lamp.radiance[1], lamp.radiance[2]}});
  }
  return lamps;
}

struct StreetDrive::State {
  scene::Camera camera;
  int width, height;
  double first;
  bool at_rest;
  int keyframes_in_spacing;
  std::shared_ptr<const scene::Scenery> street;
  const parallel::Executor& executor;
  std::map<int, Keyframe> keyframes;  ///< by number
  bool stands = false;                // the view of look() is rendered and does not change

  State(std::shared_ptr<const scene::Scenery> seen, const scene::Camera& c, int w, int h, const StreetOptions& o,
        const parallel::Executor& e)
      : camera(c),
        width(w),
        height(h),
        first(o.start),
        at_rest(o.at_rest),
        keyframes_in_spacing(o.keyframes),
        street(std::move(seen)),
        executor(e) {}

  double apart() const { return spacing / keyframes_in_spacing; }
  /// The distance of keyframe k. The street restarts at whole spacings, which are exact.
  double way(int k) const { return spacing * (k / keyframes_in_spacing) + apart() * (k % keyframes_in_spacing); }
  /// The last keyframe that is not ahead.
  int last(double distance) const {
    const int whole = static_cast<int>(distance / spacing);
    return whole * keyframes_in_spacing + std::min(static_cast<int>((distance - whole * spacing) / apart()), keyframes_in_spacing - 1);
  }
  Vector3 place(int k) const { return place_in_street(first, way(k)); }
  /// The camera at keyframe k.
  scene::Camera camera_at(int k) const {
    const Vector3 start = place(k);
    scene::Camera c = camera;
    c.position = start + in_street(camera.position);
    c.target = start + in_street(camera.target);
    c.up = in_street(camera.up);
    return c;
  }
  Keyframe render(int k, Parts parts) const {
    const auto made =
        cache::prepared("windshield view", Work{*street, executor}, view_of, street->identity(), camera_at(k), width, height, parts);
    return {made->colour.shared(), made->depth.shared()};
  }
  const Keyframe& keyframe(int k) {
    const auto found = keyframes.find(k);
    if (found != keyframes.end()) return found->second;
    // A car at rest may show its first view for long; views of a moving car are transient blends of two.
    return keyframes.emplace(k, render(k, at_rest && k == 0 ? Parts::nine : Parts::three)).first->second;
  }
};

StreetDrive::StreetDrive(std::shared_ptr<const scene::Scenery> street, const scene::Camera& camera, int width, int height,
                         const StreetOptions& options, const parallel::Executor& executor)
    : state_(std::make_unique<State>(std::move(street), camera, width, height, options, executor)) {}
StreetDrive::~StreetDrive() = default;
StreetDrive::StreetDrive(StreetDrive&&) noexcept = default;
const scene::Scenery& StreetDrive::street() const { return *state_->street; }

bool StreetDrive::look(double distance, bool moves, SceneView& view) {
  State& s = *state_;
  if (!moves) {
    if (s.stands) return false;
    Keyframe v = s.render(0, Parts::nine);
    view.colour = std::move(v.colour);
    view.depth = std::move(v.depth);
    s.stands = true;
    return true;
  }
  if (view.colour.width() != s.width || view.colour.height() != s.height) {
    view.colour = Image(Format::rgba16f, s.width, s.height);
    view.depth = Image(Format::r32f, s.width, s.height);
  }
  const int k = s.last(distance);
  const double gone = std::max(distance - s.way(k), 0.0);
  const bool stands = gone == 0, starts_anew = s.place(k + 1).z > s.place(k).z;
  // At a keyframe, and at the end of the street, the next one is not needed.
  const Keyframe &behind = s.keyframe(k), &ahead = stands || starts_anew ? behind : s.keyframe(k + 1);
  s.keyframes.erase(s.keyframes.begin(), s.keyframes.lower_bound(k));
  const scene::Camera::Basis basis = s.camera.basis();
  const Vector3 way(1, 0, 0);
  ReprojectUniforms u{};
  const double half_height = s.camera.half_height(), half_width = half_height * s.width / s.height;
  u.half_size[0] = static_cast<float>(half_width);
  u.half_size[1] = static_cast<float>(half_height);
  u.pixel[0] = static_cast<float>(2 * half_width / s.width);
  u.pixel[1] = static_cast<float>(2 * half_height / s.height);
  u.forward[0] = static_cast<float>(glm::dot(way, basis.right));
  u.forward[1] = static_cast<float>(glm::dot(way, basis.up));
  u.forward[2] = static_cast<float>(glm::dot(way, basis.forward));
  u.behind_by = static_cast<float>(gone);
  u.ahead_by = static_cast<float>(&ahead == &behind ? gone : gone - s.apart());
  u.share = &ahead == &behind ? 0.0f : static_cast<float>(gone / s.apart());
  s.executor.for_tiles(s.width, s.height, s.width, 2, [&](const parallel::Tile& tile) { reproject_rows(u, behind, ahead, view, tile); });
  return true;
}

}  // namespace rainref::windshield
