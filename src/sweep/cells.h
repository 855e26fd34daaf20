// The cells of a plan: every combination of its axes, checked and named before any starts.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/config.h"
#include "sweep/identity.h"
#include "sweep/plan.h"

namespace rainref::sweep {

/// The column with labels of cases, which is not a key of scenes.
inline constexpr std::string_view label_key = "name";

struct Cell {
  std::string id;
  std::uint32_t scene = 0;          ///< index in the plan's scenes or packs
  std::vector<std::uint32_t> rows;  ///< of each axis; for packs that of the profile
  std::string film;                 ///< shared by all chunks of a run; "" if nothing is simulated
  std::int64_t first = 0, end = 0;  ///< its frames, the last one excluded
  std::int64_t frames = 0;          ///< of the whole run
};

/// Receives the number of checked combinations of a plan's axes, and their total.
using Planned = std::function<void(std::int64_t done, std::int64_t all)>;

class Cells {
 public:
  /// Parses the configuration of every cell. Throws Error(usage) for the first one that a scene refuses, for two equal cells, and for more
  /// than most_cells; Error(io) if a file cannot be read. The plan must outlive it.
  explicit Cells(const Plan& plan, const Planned& planned = {});

  const Plan& plan() const { return plan_; }
  const std::vector<Cell>& all() const { return cells_; }
  /// For a cell that simulates.
  scene::Config config(const Cell& cell) const;
  /// The plan's settings of the cell, as values of --set for a command line with the same result.
  std::vector<std::string> overrides(const Cell& cell) const;
  /// Scene or pack by name, and the values of the axes by key.
  std::vector<std::pair<std::string, std::string>> values(const Cell& cell) const;
  /// "scene x.toml, rain.rate 3, seed 7".
  std::string words(const Cell& cell) const;

 private:
  /// Changes the configuration of one combination into that of the next, of the same scene.
  void change(scene::Config& config, const Cell& from, const Cell& to) const;
  void add_simulated(Cell point, const scene::Config& config);
  void add_judged(Cell point);
  void add(Cell cell);
  std::vector<scene::Override> said(const Cell& cell) const;

  const Plan& plan_;
  std::vector<std::vector<scene::RawEntry>> scenes_;  ///< each read once
  std::vector<std::string> scene_ids_;                ///< hashes of their texts
  std::vector<Cell> cells_;
  std::map<std::string, std::size_t> by_id_;
  Inputs inputs_;
};

}  // namespace rainref::sweep
