#include "sweep/store.h"

#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/file_lock.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "base/system.h"
#include "capture/json_field.h"
#include "capture/json_read.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;
constexpr char marker[] = "rainref-store";

/// Names in a folder with this prefix; none if there is no folder.
std::vector<fs::path> beginning_with(const fs::path& folder, const std::string& begin) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
    if (path_text(i->path().filename()).starts_with(begin)) found.push_back(i->path());
  return found;
}

/// State of the process that makes, or made, a cell. If the file system has no locks it is unknown.
enum class MakerState : std::uint8_t { dead, alive, unknown };
MakerState maker_of(const fs::path& path) {
  const int descriptor = system::open(path, system::reading | system::writing | system::no_link);
  if (descriptor < 0) return MakerState::unknown;  // it is finished
  const FileLock lock = lock_file(descriptor);
  const bool is_there = is_still(descriptor, path);
  system::close(descriptor);
  if (!is_there || lock == FileLock::impossible) return MakerState::unknown;
  return lock == FileLock::mine ? MakerState::dead : MakerState::alive;
}

}  // namespace

bool is_id(std::string_view name) { return name.size() == 32 && name.find_first_not_of("0123456789abcdef") == name.npos; }

bool Store::is_marked() const {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(root_ / marker, error));
}

bool Store::has(const std::string& id) const {
  std::error_code error;
  return fs::exists(cell(id) / "cell.json", error);
}

std::optional<Failure> Store::failure(const std::string& id) const {
  const fs::path path = root_ / "failed" / utf8_path(id + ".json");
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  try {
    const nlohmann::ordered_json json = capture::read_json(path, path_text(path), capture::small_json);
    const capture::JsonField from(json, path_text(path));
    return Failure{static_cast<int>(from["code"].whole(0, 5)), from["sentence"].text()};
  } catch (const Error& e) {
    if (e.code() != ExitCode::port_files) throw;
    return {};  // not accessible: the cell is tried
  }
}

void Store::record(const std::string& id, const std::string& words, const Failure& failure) const {
  const nlohmann::ordered_json json{{"cell", id}, {"is", words}, {"code", failure.code}, {"sentence", failure.sentence}};
  write_file(root_ / "failed" / utf8_path(id + ".json"), json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void Store::forget(const std::string& id) const {
  std::error_code ignored;
  fs::remove(root_ / "failed" / utf8_path(id + ".json"), ignored);
  for (const fs::path& path : beginning_with(root_ / "tries", id))
    if (maker_of(path) == MakerState::dead) fs::remove(path, ignored);
}

void Store::remove_cell(const std::string& id) const {
  std::error_code error;
  fs::remove(cell(id) / "cell.json", error);  // removed first, so that it is no longer a finished cell
  if (!error) fs::remove_all(cell(id), error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot be removed: {}", path_text(cell(id)), error.message()));
}

Store::Tries Store::tries(const std::string& id) const {
  Tries count;
  for (const fs::path& path : beginning_with(root_ / "tries", id)) {
    const MakerState maker = maker_of(path);
    count.dead += maker == MakerState::dead;
    count.alive += maker == MakerState::alive;
  }
  return count;
}

std::unique_ptr<Hidden> Store::begin(const std::string& id) const {
  try {
    return std::make_unique<Hidden>(root_ / "tries", Hidden::Kind::file, [&] { return id + Hidden::random_name(); });
  } catch (const std::system_error& e) {
    throw Error(ExitCode::io, fmt::format("{}: cannot write there: {}", path_text(root_ / "tries"), e.code().message()));
  }
}

fs::path Store::state(const std::string& film, std::int64_t frame) const {
  return states(film) / utf8_path(fmt::format("{}.state", frame));
}

std::int64_t Store::newest_state(const std::string& film, std::int64_t frame) const {
  std::int64_t newest = 0;
  for (const fs::path& path : beginning_with(states(film), "")) {
    const std::int64_t of = path.extension() == ".state" ? whole_from<std::int64_t>(path_text(path.stem())).value_or(0) : 0;
    if (of <= frame) newest = std::max(newest, of);
  }
  return newest;
}

void Store::make() const {
  for (const char* folder : {"cells", "failed", "states", "tries", "log"}) {
    std::error_code error;
    fs::create_directories(root_ / folder, error);
    if (error) throw Error(ExitCode::io, fmt::format("{}: cannot make this folder: {}", path_text(root_ / folder), error.message()));
  }
  if (!is_marked())
    write_file(root_ / marker, "Results of `rainref sweep`. `rainref sweep gc` removes files in folders that hold this one.\n");
}

}  // namespace rainref::sweep
