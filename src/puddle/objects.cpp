#include "puddle/objects.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::puddle {
namespace {

constexpr std::size_t most_objects = 64;
constexpr double farthest_object = 1e4, largest_object = 100, latest_place = 1e9;  // [m], [m], [s]
constexpr double places_in_texel = 1024;                                           // exact in float on every grid, also mirrored

double mixed(double from, double to, double share) { return from + share * (to - from); }

}  // namespace

MovingObject::Place MovingObject::at(double t) const {
  if (t <= places.front().time) return places.front();
  if (t >= places.back().time) return places.back();
  const auto next = std::find_if(places.begin(), places.end(), [&](const Place& p) { return p.time > t; });
  const Place &from = *(next - 1), &to = *next;
  const double share = (t - from.time) / (to.time - from.time);
  return {t, mixed(from.x, to.x, share), mixed(from.z, to.z, share)};
}

std::vector<MovingObject> parse_objects(std::string_view text) {
  std::vector<MovingObject> objects;
  for (const std::string_view row : scene::split(text, ';')) {
    if (row.empty()) continue;  // a semicolon at the end
    const auto fail = [&](const std::string& what) {
      throw Error(ExitCode::usage, fmt::format("puddle.objects, object {}: {}", objects.size() + 1, what));
    };
    if (objects.size() == most_objects) fail(fmt::format("expected at most {}", most_objects));
    const auto numbers = [&](std::string_view part, std::size_t count, const char* form) {
      std::vector<double> out;
      for (const std::string_view word : scene::words_of(part)) {
        const std::optional<double> value = number_from<double>(word);
        if (!value) fail(fmt::format("expected a number, found '{}'", word));
        out.push_back(*value);
      }
      if (out.size() != count) fail(fmt::format("expected \"{}\", found '{}'", form, part));
      return out;
    };
    const std::vector<std::string_view> halves = scene::split(row, ':');
    if (halves.size() != 2) fail(fmt::format("expected \"radius depth: time x z, ...\", found '{}'", row));
    const std::vector<double> size = numbers(halves[0], 2, "radius depth");
    MovingObject object{size[0], size[1], {}};
    if (!(object.radius > 0 && object.radius <= largest_object))
      fail(fmt::format("radius: expected above 0 and at most {:g} m, found {:g}", largest_object, object.radius));
    if (!(std::abs(object.depth) <= largest_object))
      fail(fmt::format("depth: expected at most {:g} m, found {:g}", largest_object, object.depth));
    for (const std::string_view place : scene::split(halves[1], ',')) {
      const std::vector<double> p = numbers(place, 3, "time x z");
      if (!(std::abs(p[0]) <= latest_place)) fail(fmt::format("time: expected at most {:g} s, found {:g}", latest_place, p[0]));
      if (!object.places.empty() && !(p[0] > object.places.back().time))
        fail(fmt::format("time: expected more than {:g} of the place before, found {:g}", object.places.back().time, p[0]));
      for (const double x : {p[1], p[2]})
        if (!(std::abs(x) <= farthest_object))
          fail(fmt::format("place: expected at most {:g} m from the middle, found {:g}", farthest_object, x));
      object.places.push_back({p[0], p[1], p[2]});
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

Objects::Objects(const Settings& s, double stored_per_metre)
    : objects_(parse_objects(s.objects)),
      step_rate_(s.step_rate),
      cell_size_(s.cell_size),
      stored_per_metre_(stored_per_metre),
      edges_(edges_of(s)) {}

std::vector<Drop> Objects::records(std::int64_t step) const {
  std::vector<Drop> out;
  for (const MovingObject& object : objects_) {
    const auto head_at = [&](double t, double sign) {
      const MovingObject::Place p = object.at(t);
      const auto texel = [&](double metres, std::uint32_t size) {
        return static_cast<float>(std::floor((metres / cell_size_ + 0.5 * size) * places_in_texel + 0.5) / places_in_texel);
      };
      return Drop{texel(p.x, edges_.columns), texel(p.z, edges_.rows), static_cast<float>(sign * object.depth * stored_per_metre_),
                  static_cast<float>(std::max(object.radius / cell_size_, least_crater_radius))};
    };
    const Drop was = head_at(static_cast<double>(step) / step_rate_, -1), is = head_at(static_cast<double>(step + 1) / step_rate_, 1);
    if (was.x == is.x && was.y == is.y) continue;
    for (const Drop& head : {was, is}) {
      const bool is_in_water =
          head.x >= 0 && head.x <= static_cast<float>(edges_.columns) && head.y >= 0 && head.y <= static_cast<float>(edges_.rows);
      if (is_in_water) add_with_images(head, edges_, out);
    }
  }
  return out;
}

}  // namespace rainref::puddle
