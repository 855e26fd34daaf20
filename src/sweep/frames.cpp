#include "sweep/frames.h"

#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/capture_recorder.h"
#include "capture/hashing.h"
#include "capture/npy_write.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "effect/inputs.h"
#include "scene/json.h"
#include "simulation/opened.h"
#include "sweep/buffer_keeper.h"
#include "sweep/cell_record.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> buffers_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const Keep& keep : plan.keep)
    if (keep.what == Keep::What::buffer) names.push_back(keep.part);
  return names;
}
bool keeps(const Plan& plan, Keep::What what) {
  for (const Keep& keep : plan.keep)
    if (keep.what == what) return true;
  return false;
}

/// Another machine may have the memory that this one lacks, so this is not a reason to refuse the scene.
void require_memory_here(const scene::Config& config) {
  const effect::RunMemory memory = simulation::memory_of(config);
  try {
    effect::require_memory(memory);
  } catch (const Error& e) {
    throw Error(ExitCode::io, e.what());
  }
}

struct Begun {
  std::int64_t frame = 0;
  std::set<std::int64_t> wrong;  ///< frames whose states are damaged, or belong to another scene or frame than their names say
};
/// The newest matching state before the cell. States that do not match are skipped; the run then begins earlier.
Begun begin_from_state(simulation::Opened& opened, const Store& store, const Cell& cell) {
  Begun begun;
  for (std::int64_t frame = store.newest_state(cell.film, cell.first); frame > 0; frame = store.newest_state(cell.film, frame - 1)) {
    try {
      const fs::path path = store.state(cell.film, frame);
      const std::vector<std::byte> bytes = read_file(path);
      const state::Saved saved(bytes, path_text(path));
      if (saved.frame() == frame) {
        opened.load(saved);
        begun.frame = frame;
        return begun;
      }
    } catch (const Error&) {
    }
    begun.wrong.insert(frame);
  }
  return begun;
}
/// Unless there is already a good one.
void leave_state(const simulation::Opened& opened, const Store& store, const Cell& cell, const Begun& begun, std::int64_t frame) {
  const fs::path path = store.state(cell.film, frame);
  std::error_code error;
  if (fs::exists(path, error) && !begun.wrong.contains(frame)) return;
  fs::create_directories(path.parent_path(), error);
  AtomicFile file(path);
  opened.save("", [&](std::span<const std::byte> bytes) { file.write(bytes); });
  file.commit();
}

/// Keeps the data of one frame of a cell.
class Keeping {
 public:
  Keeping(const Cells& cells, const Cell& cell, simulation::Opened& opened, const Store& store)
      : plan_(cells.plan()),
        cell_(cell),
        opened_(opened),
        writer_(store.cell(cell.id)),
        buffers_(*opened.effect().info, opened.config().variant(), buffers_of(plan_)),
        recorders_({&hashes_, &buffers_}) {}

  Recorder* recorder() { return &recorders_; }
  CellWriter& writer() { return writer_; }

  void before(std::int64_t frame) {
    const bool is_part = frame >= cell_.first;
    hashes_.set_hashing(is_part && (keeps(plan_, Keep::What::hash) || frame == cell_.end - 1));
    bool has_buffer = false, is_shown = false;
    for (const Keep& keep : plan_.keep) {
      if (!is_part || !keep.wanted(frame, cell_.frames)) continue;
      has_buffer = has_buffer || keep.what == Keep::What::buffer;
      is_shown = is_shown || keep.what == Keep::What::picture || keep.what == Keep::What::exr;
    }
    buffers_.keep(has_buffer);
    opened_.show(is_shown || (is_part && keeps(plan_, Keep::What::hash)) || frame == cell_.end - 1);
  }

  void after(std::int64_t frame) {
    last_ = hashes_.take_lines();
    if (frame < cell_.first) return;
    for (const capture::HashLine& line : last_) lines_ += line.text() + "\n";
    const std::map<std::string, capture::Array> found = buffers_.take();
    for (const Keep& keep : plan_.keep) {
      if (keep.what == Keep::What::hash || !keep.wanted(frame, cell_.frames)) continue;
      if (keep.what == Keep::What::picture) {
        writer_.write(keep.file(frame), opened_.png_bytes());
      } else if (keep.what == Keep::What::exr) {
        write_exr(keep, keep.file(frame));
      } else if (keep.what == Keep::What::drops) {
        writer_.write(keep.file(frame), drops_text(keep));
      } else {
        const auto buffer = found.find(keep.part);
        if (buffer == found.end())
          throw Error(ExitCode::usage, keep.at,
                      fmt::format("keep: expected a buffer that a pass takes or gives in frame {}, found '{}'", frame, keep.part));
        writer_.write(keep.file(frame), capture::npy_bytes(buffer->second, 0));
      }
    }
  }

  bool finish(std::vector<fs::path>& names) {
    if (keeps(plan_, Keep::What::hash)) writer_.write("hashes.txt", lines_);
    return writer_.finish(record(), names);
  }

 private:
  void write_exr(const Keep& keep, const std::string& name) {
    try {
      opened_.write_exr(writer_.folder() / utf8_path(name), false, keep.part);
    } catch (const Error& e) {
      if (e.code() != ExitCode::usage) throw;
      throw Error(e.code(), keep.at, fmt::format("keep: {}", e.what()));
    }
    writer_.wrote(name);
  }
  /// A line for each drop that reaches into the picture: [x, y, radius] in pixels, x to the right and y down from the upper left corner.
  /// A smaller drop covers less than half of any pixel.
  std::string drops_text(const Keep& keep) const {
    const auto discs = opened_.effect_now().drop_discs();
    if (!discs)
      throw Error(
          ExitCode::usage, keep.at,
          fmt::format("keep: expected an effect with a list of round drops for 'drops', which screen_drops corrected is; found {} {}",
                      opened_.config().effect(), opened_.config().variant()));
    constexpr double smallest = 0.25;
    const scene::Integer2 size = opened_.config().integer2("run.size");
    const double width = static_cast<double>(size[0]), height = static_cast<double>(size[1]);
    std::string text;
    for (const effect::DropDisc& d : *discs) {
      const double x = d.x * height, y = height - d.y * height, radius = d.radius * height;
      if (radius < smallest || x + radius < 0 || x - radius > width || y + radius < 0 || y - radius > height) continue;
      text += fmt::format("{}\n[{:.3f}, {:.3f}, {:.3f}]", text.empty() ? "" : ",", x, y, radius);
    }
    return fmt::format("[{}]\n", text);
  }
  nlohmann::ordered_json record() const {
    nlohmann::ordered_json r{
        {"cell", cell_.id}, {"film", cell_.film}, {"golden_hash", golden_hash()}, {"first", cell_.first}, {"end", cell_.end}};
    r["config"] = scene::config_json(opened_.config());
    r["config"].erase("run.frames");  // independent of the run that the cell belongs to
    r["inputs"] = nlohmann::ordered_json::array();
    for (const effect::InputFile& f : opened_.inputs().files) r["inputs"].push_back({{"key", f.key}, {"hash", f.hash}, {"lossy", f.lossy}});
    for (const scene::Config::Entry& e : opened_.config().entries()) {
      const auto* name = std::get_if<std::string>(&e.value);
      if (name && !name->empty() && effect::names_files(e.parameter.key)) r["config"].erase(e.parameter.key);  // a name is not significant
    }
    r["last_frame"] = nlohmann::ordered_json::array();
    for (const capture::HashLine& line : last_)
      r["last_frame"].push_back({{"frame", line.frame}, {"pass", line.pass}, {"buffer", line.buffer}, {"xxh3", line.hash.text()}});
    return r;
  }

  const Plan& plan_;
  const Cell& cell_;
  simulation::Opened& opened_;
  CellWriter writer_;
  capture::HashRecorder hashes_;
  BufferKeeper buffers_;
  capture::RecorderList recorders_;
  std::string lines_;
  std::vector<capture::HashLine> last_;
};

}  // namespace

Made make_frames(const Cells& cells, const Cell& cell, const Store& store, const parallel::Executor& executor, Names& names,
                 const std::function<void(const std::string&)>& warn) {
  scene::Config config = cells.config(cell);
  require_memory_here(config);
  simulation::Opened opened(std::move(config), executor);
  for (const std::string& warning : opened.inputs().warnings) warn(warning);
  Begun begun;
  if (cell.first > 0) begun = begin_from_state(opened, store, cell);
  Made made;
  made.begun_at = begun.frame;
  Keeping keeping(cells, cell, opened, store);
  const std::int64_t every = cells.plan().state_every;
  for (std::int64_t frame = made.begun_at; frame < cell.end; ++frame) {
    keeping.before(frame);
    opened.simulate(keeping.recorder());
    // Passes that bake something once run with the first picture, and belong to frame 0.
    if (frame < cell.first && frame > 0)
      opened.skip(keeping.recorder());
    else
      opened.render(keeping.recorder());
    keeping.after(frame);
    const std::int64_t done = frame + 1;
    const bool has_state = done == cell.end || (every > 0 && done % every == 0) || begun.wrong.contains(done);
    if (done < cell.frames && has_state) leave_state(opened, store, cell, begun, done);
  }
  made.bytes = keeping.writer().bytes();
  made.was_first = keeping.finish(names);
  return made;
}

}  // namespace rainref::sweep
