#include "windshield/motion/vehicle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "math/real64.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {

Vehicle::Vehicle(const VehicleSettings& settings) : settings_(settings) {
  if (!settings.drive_cycle.empty() && !settings.key_frames.empty()) {
    throw Error(ExitCode::usage, fmt::format("vehicle.drive_cycle and vehicle.key_frames: expected one of them, found '{}' and '{}'",
                                             path_text(settings.drive_cycle), settings.key_frames));
  }
  if (!settings.drive_cycle.empty()) cycle_ = read_drive_cycle(settings.drive_cycle);
  if (!settings.key_frames.empty()) cycle_ = parse_key_frames(settings.key_frames, "vehicle.key_frames");
}

VehicleState Vehicle::at(double t) const {
  VehicleState s{};
  if (cycle_) {
    const double from = settings_.start, now = settings_.start + t;
    s.speed = cycle_->speed.value(now);
    s.acceleration = cycle_->speed.derivative(now);
    s.distance = cycle_->speed.integral(from, now);
    s.yaw_rate = cycle_->yaw_rate.value(now);
    s.yaw_acceleration = cycle_->yaw_rate.derivative(now);
    s.heading = settings_.heading + cycle_->yaw_rate.integral(from, now);
  } else {
    s.speed = settings_.speed;
    s.distance = settings_.speed * t;
    s.yaw_rate = settings_.yaw_rate;
    s.heading = settings_.heading + settings_.yaw_rate * t;
  }
  s.direction = {cos_real(Real64(s.heading)).v, sin_real(Real64(s.heading)).v};
  s.velocity = {s.speed * s.direction[0], s.speed * s.direction[1], 0};
  s.body_acceleration = {s.acceleration, s.speed * s.yaw_rate, 0};
  return s;
}

namespace {

const std::vector<std::string> column_names{"time_s", "speed_mps", "yaw_rad_s"};
using Fail = std::function<void(const std::string&)>;

// The rows of a table, checked one by one; `fail` throws with the place of the current row.
class Rows {
 public:
  explicit Rows(bool has_yaw) : has_yaw_(has_yaw) {}

  void add(const std::string_view (&fields)[3], const Fail& fail) {
    const double time = number(fields[0], 0, fail), speed = number(fields[1], 1, fail);
    if (!time_.empty() && !(time > time_.back()))
      fail(fmt::format("time_s: expected more than {:g} of the row before, found {:g}", time_.back(), time));
    if (!(0 <= speed && speed <= largest_speed)) fail(fmt::format("speed_mps: expected 0 to {:g} m/s, found {:g}", largest_speed, speed));
    time_.push_back(time);
    speed_.push_back(speed);
    if (!has_yaw_) return yaw_.push_back(0);
    yaw_.push_back(number(fields[2], 2, fail));
    if (!(std::abs(yaw_.back()) <= largest_yaw_rate)) {
      fail(fmt::format("yaw_rad_s: expected {:g} to {:g} rad/s, found {:g}", -largest_yaw_rate, largest_yaw_rate, yaw_.back()));
    }
  }
  DriveCycle finish(const Fail& fail) const {
    if (time_.size() < 2) fail(fmt::format("expected at least two rows, found {}", time_.size()));
    return {Pchip(time_, speed_), Pchip(time_, yaw_)};
  }

 private:
  static double number(std::string_view field, std::size_t column, const Fail& fail) {
    const std::optional<double> value = number_from<double>(field);
    if (!value) fail(fmt::format("{}: expected a number, found '{}'", column_names[column], field));
    return *value;
  }
  bool has_yaw_;
  std::vector<double> time_, speed_, yaw_;
};

// For each of column_names its index in the header, or -1.
std::vector<int> columns_of(const std::vector<std::string_view>& header, const Fail& fail) {
  std::vector<int> column(column_names.size(), -1);
  for (std::size_t k = 0; k < header.size(); ++k) {
    const std::string name(header[k]);
    const auto found = std::find(column_names.begin(), column_names.end(), name);
    if (found == column_names.end()) {
      fail(fmt::format("expected a header of time_s,speed_mps[,yaw_rad_s], found the column '{}'{}", name,
                       did_you_mean(name, column_names)));
    }
    int& place = column[static_cast<std::size_t>(found - column_names.begin())];
    if (place >= 0) fail(fmt::format("the column '{}' stands twice", name));
    place = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (column[k] < 0)
      fail(fmt::format("expected a header of time_s,speed_mps[,yaw_rad_s], found none of the column '{}'", column_names[k]));
  }
  return column;
}

}  // namespace

DriveCycle parse_drive_cycle(std::string_view csv, const std::string& file) {
  int line = 0;
  const Fail fail = [&](const std::string& what) { throw Error(ExitCode::usage, SourceLocation{file, line, 0}, what); };
  if (csv.starts_with("\xef\xbb\xbf")) csv.remove_prefix(3);  // a byte order mark
  std::vector<int> column;
  std::size_t width = 0;
  Rows rows(false);
  for (const std::string_view text : scene::split(csv, '\n')) {
    ++line;
    if (text.empty() || text.front() == '#') continue;
    const std::vector<std::string_view> fields = scene::split(text, ',');
    if (column.empty()) {
      column = columns_of(fields, fail);
      width = fields.size();
      rows = Rows(column[2] >= 0);
      continue;
    }
    if (fields.size() != width) fail(fmt::format("expected {} fields, found {}", width, fields.size()));
    std::string_view row[3];
    for (std::size_t k = 0; k < 3; ++k) row[k] = column[k] < 0 ? std::string_view() : fields[static_cast<std::size_t>(column[k])];
    rows.add(row, fail);
  }
  if (column.empty()) fail("expected a header of time_s,speed_mps[,yaw_rad_s], found no line with text");
  return rows.finish(fail);
}

DriveCycle read_drive_cycle(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = [&] {
    try {
      return read_file(file);
    } catch (const Error& e) {
      throw Error(e.code(), std::string("vehicle.drive_cycle: ") + e.what());
    }
  }();
  return parse_drive_cycle({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path_text(file));
}

DriveCycle parse_key_frames(std::string_view text, const std::string& key) {
  int count = 0;
  const Fail fail = [&](const std::string& what) { throw Error(ExitCode::usage, fmt::format("{}, key frame {}: {}", key, count, what)); };
  std::size_t width = 0;
  Rows rows(false);
  for (const std::string_view frame : scene::split(text, ';')) {
    if (frame.empty()) continue;  // a semicolon at the end
    ++count;
    const std::vector<std::string_view> fields = scene::words_of(frame);
    if (width == 0) {
      width = fields.size();
      rows = Rows(width == 3);
    }
    if (fields.size() != width || width < 2 || width > 3) {
      fail(fmt::format("expected \"time speed\" in every one or \"time speed yaw_rate\" in every one, found '{}'", frame));
    }
    const std::string_view row[3] = {fields[0], fields[1], width == 3 ? fields[2] : std::string_view()};
    rows.add(row, fail);
  }
  return rows.finish(fail);
}

}  // namespace rainref::windshield
