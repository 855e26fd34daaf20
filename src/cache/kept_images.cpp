#include "cache/kept_images.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "base/hidden.h"
#include "base/machine.h"
#include "base/path_text.h"
#include "base/system.h"
#include "cache/own_file.h"
#include "cache/prepared.h"
#include "cache/program.h"
#include "rainref/error.h"

namespace rainref::cache {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "the folder belongs to one machine, but its files say nothing of byte order");

struct Folder {
  fs::path path;
  std::uintmax_t most_bytes = 0;
};
Folder& folder() {
  static Folder one;
  return one;
}

// ---- a file: Head, the recipe, ImageHead for each image, their rows without margins -------------------------------------
constexpr char magic[16] = "rainref kept 1\n";
constexpr std::string_view suffix = ".images";
struct Head {
  char magic[16];
  std::uint64_t high, low;  // hash of everything after the head
  std::uint32_t recipe_bytes, images;
};
struct ImageHead {
  std::uint32_t format, width, height;
};
std::size_t row_bytes(const Image& image) { return static_cast<std::size_t>(image.width()) * info(image.format()).texel_bytes(); }
std::span<const std::byte> row(const Image& image, int y) { return {image.row_bytes(y), row_bytes(image)}; }
template <class T>
std::span<const std::byte> raw_bytes(const T& x) {
  return std::as_bytes(std::span(&x, 1));
}
ImageHead head_of(const Image& image) {
  return {static_cast<std::uint32_t>(image.format()), static_cast<std::uint32_t>(image.width()),
          static_cast<std::uint32_t>(image.height())};
}

/// Visits everything after the head, piece by piece.
template <class Piece>
void pieces(const std::string& recipe, const std::vector<Image>& images, const Piece& piece) {
  piece(std::as_bytes(std::span(recipe)));
  for (const Image& image : images) piece(raw_bytes(head_of(image)));
  for (const Image& image : images)
    for (int y = 0; y < image.height(); ++y) piece(row(image, y));
}
Head head_of(const std::string& recipe, const std::vector<Image>& images) {
  Hasher hasher(0);
  pieces(recipe, images, [&](std::span<const std::byte> bytes) { hasher.add(bytes); });
  const Hash128 hash = hasher.finish();
  Head head{{}, hash.high, hash.low, static_cast<std::uint32_t>(recipe.size()), static_cast<std::uint32_t>(images.size())};
  std::memcpy(head.magic, magic, sizeof magic);
  return head;
}

/// Touching memory for the first time takes longer than reading a file into it, and can be done by many threads.
void touch(Image& image, const Rows& rows) {
  constexpr std::size_t page = 4096;  // lower bound
  rows(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (std::size_t at = 0; at < row_bytes(image); at += page) image.row_bytes(y)[at] = std::byte{0};
  });
}
bool has(const ImageHead& image, const Shape& shape) {
  return image.format == static_cast<std::uint32_t>(shape.format) && (shape.width == 0 || std::cmp_equal(image.width, shape.width)) &&
         (shape.height == 0 || std::cmp_equal(image.height, shape.height));
}
/// None if the file is not this user's, or not of this recipe, not of these shapes, or incomplete.
std::optional<std::vector<Image>> read(const fs::path& path, const std::string& recipe, const std::vector<Shape>& shapes,
                                       const Rows& rows) {
  OwnFile file(path);
  Head head;
  if (!file.is_own() || !file.read(head) || std::memcmp(head.magic, magic, sizeof magic) != 0 || head.recipe_bytes != recipe.size())
    return {};
  file.hash_from_here();
  std::string read_recipe(recipe.size(), '\0');
  if (!file.read(std::as_writable_bytes(std::span(read_recipe))) || read_recipe != recipe) return {};
  // Sizes are checked against the file's size before memory is allocated for them.
  if (head.images != shapes.size()) return {};
  std::vector<ImageHead> heads(shapes.size());
  std::uintmax_t expected = 0;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    ImageHead& image = heads[i];
    if (!file.read(image) || !has(image, shapes[i]) || image.width > 65536 || image.height > 65536) return {};
    expected += std::uintmax_t{image.width} * image.height * info(static_cast<Format>(image.format)).texel_bytes();
  }
  if (expected != file.left()) return {};
  std::vector<Image> images;
  images.reserve(heads.size());
  for (const ImageHead& of : heads) {
    Image& image = images.emplace_back(static_cast<Format>(of.format), static_cast<int>(of.width), static_cast<int>(of.height));
    touch(image, rows);
    for (int y = 0; y < image.height(); ++y)
      if (!file.read({image.row_bytes(y), row_bytes(image)})) return {};
  }
  if (file.hash() != Hash128{head.high, head.low}) return {};
  return images;
}
std::optional<std::vector<Image>> found(const fs::path& path, const std::string& recipe, const std::vector<Shape>& shapes,
                                        const Rows& rows) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  try {
    std::optional<std::vector<Image>> images = read(path, recipe, shapes, rows);
    if (images)
      fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // marks the time of last use
    else
      fs::remove(path, error);
    return images;
  } catch (const std::system_error&) {  // the file disappeared meanwhile
    return {};
  } catch (const Error&) {  // an image of no size
    return {};
  }
}

void write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t written = system::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw_system_error(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}
/// Removes the least recently used files until the rest fit.
void make_room(const Folder& in) {
  struct File {
    fs::file_time_type used;
    fs::path path;
    std::uintmax_t bytes;
  };
  std::vector<File> files;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(in.path)) {
    std::error_code error;  // another process may have removed it
    if (path_text(entry.path().extension()) != suffix) continue;
    const std::uintmax_t size = entry.file_size(error);
    if (error) continue;
    files.push_back({entry.last_write_time(error), entry.path(), size});
    bytes += size;
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.used < b.used; });
  for (const File& file : files) {
    if (bytes <= in.most_bytes) return;
    std::error_code error;
    fs::remove(file.path, error);
    bytes -= file.bytes;
  }
}
void keep(const Folder& in, const fs::path& path, const std::string& recipe, const std::vector<Image>& images) {
  try {
    if (fs::create_directories(in.path)) fs::permissions(in.path, fs::perms::owner_all);
    remove_leftovers(in.path);
    Hidden file(in.path, Hidden::Kind::file);
    // Set explicitly, because files writable by others are not read, whatever the umask.
    if (system::make_private(file.descriptor()) != 0) throw_system_error(errno);
    write_all(file.descriptor(), raw_bytes(head_of(recipe, images)));
    std::vector<std::byte> gathered;
    pieces(recipe, images, [&](std::span<const std::byte> bytes) {
      gathered.insert(gathered.end(), bytes.begin(), bytes.end());
      if (gathered.size() < (std::size_t{1} << 20)) return;
      write_all(file.descriptor(), gathered);
      gathered.clear();
    });
    write_all(file.descriptor(), gathered);
    file.become(path);
    make_room(in);
  } catch (const std::system_error&) {
    // No space or no permission: the next run makes them again.
  }
}

}  // namespace

void keep_in(fs::path path, std::uintmax_t most_bytes) { folder() = {std::move(path), most_bytes}; }

fs::path folder_of_user() {
  const fs::path cache = machine::cache_folder();
  return cache.empty() ? cache : cache / "rainref";
}

namespace {

std::vector<Image> kept_or_made(const Recipe& recipe, const std::vector<Shape>& shapes, const std::function<std::vector<Image>()>& make,
                                const Rows& rows) {
  const Folder& in = folder();
  const std::optional<Hash128> program = in.path.empty() ? std::nullopt : program_hash();
  if (!program) return make();
  const std::string whole = program->text() + recipe.text();
  const fs::path path = in.path / utf8_path(file_hash(std::as_bytes(std::span(whole))).text() + std::string(suffix));
  if (std::optional<std::vector<Image>> kept = found(path, whole, shapes, rows)) return std::move(*kept);
  std::vector<Image> made = make();
  keep(in, path, whole, made);
  return made;
}

}  // namespace

std::vector<Image> images(const Recipe& recipe, const std::vector<Shape>& shapes, const std::function<std::vector<Image>()>& make,
                          const Rows& rows) {
  std::shared_ptr<const void> known = find_prepared(recipe);
  if (!known) {
    auto made = std::make_shared<std::vector<Image>>(kept_or_made(recipe, shapes, make, rows));
    for (Image& image : *made) image.share();
    const std::size_t bytes = bytes_of(std::as_const(*made));
    known = keep_prepared(recipe, std::move(made), bytes);
  }
  std::vector<Image> shared;
  for (const Image& image : *static_cast<const std::vector<Image>*>(known.get())) shared.push_back(image.shared());
  return shared;
}

}  // namespace rainref::cache
