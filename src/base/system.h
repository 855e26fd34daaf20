// Files, folders and locks as the system has them: what differs between POSIX and Windows. CMake compiles one of
// system_<system>.cpp and of locks_<system>.cpp.
//
// A function that returns -1 sets errno. An opened file may be renamed and removed meanwhile, and no child process inherits it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/system_failure.h"

namespace rainref::system {

/// How a file is opened. Flags are added.
enum How : unsigned {
  reading = 1,
  writing = 2,
  creating = 4,  ///< if there is none
  new_only = 8,  ///< fails if the name is taken
  no_link = 16,  ///< fails if the name is a link
  no_wait = 32,  ///< does not wait for the other end of a pipe
};
/// Opens a file, or a folder for reading. Returns a descriptor or -1. A new file has the usual rights.
int open(const std::filesystem::path& path, unsigned how);
/// Opens what the lock of a folder stands on: the folder itself or, if the system locks no folders, a file beside it that ends with the
/// descriptor. Returns a descriptor or -1.
int open_folder_lock(const std::filesystem::path& folder);
/// Closes a descriptor. Returns -1 if the disk turns out to be full only here; the descriptor is closed all the same.
int close(int descriptor);
/// Reads at most so many bytes and returns their number; 0 at the end, -1 after an error.
std::ptrdiff_t read(int descriptor, void* to, std::size_t bytes);
/// Writes at most so many bytes and returns their number, or -1.
std::ptrdiff_t write(int descriptor, const void* from, std::size_t bytes);
/// Returns another descriptor of the same opened file, or -1.
int duplicate(int descriptor);
/// Waits until a file's bytes, or a folder's entries, are on the disk. Returns 0 or -1; EINVAL: the file system does not support this.
int sync(int descriptor);
/// Lets nobody but this user read or write an opened file. Returns 0 or -1.
int make_private(int descriptor);

/// Opens a stream of bytes to read. Returns nullptr after an error.
std::FILE* stream_to_read(const std::filesystem::path& path);
/// Makes a new file and opens a stream of bytes to it. Returns nullptr after an error, also if the name is taken.
std::FILE* stream_to_new_file(const std::filesystem::path& path);
/// The descriptor of a stream.
int descriptor_of(std::FILE* stream);

enum class Kind : std::uint8_t { nothing, file, folder, other };
/// What a name or descriptor leads to.
struct Found {
  Kind kind = Kind::nothing;           ///< nothing: errno has the reason, ENOENT if there is none
  bool is_mine = false;                ///< it belongs to this process's user
  bool others_may_write = false;       ///< into the file
  std::uint64_t device = 0, file = 0;  ///< identify it
  std::uint64_t bytes = 0;             ///< of a file
};
Found found(int descriptor);
Found found(const std::filesystem::path& path, bool follows_links);

/// Makes a folder, for this user only if it is private. Returns 0 or -1.
int make_folder(const std::filesystem::path& path, bool is_private);
/// Removes an empty folder. Returns 0 or -1.
int remove_folder(const std::filesystem::path& path);
/// Removes a file, which may be open. Returns 0 or -1.
int remove_file(const std::filesystem::path& path);
/// Closes the descriptor of a removed file, and sets it to -1, where an open file keeps its folder from being removed.
void release(int& descriptor);
/// Gives a file or folder another name. A file replaces a file, a folder an empty folder. Returns 0 or -1.
int rename(const std::filesystem::path& from, const std::filesystem::path& to);
/// Exchanges two names in one step. Returns false if the file system or the system cannot. Throws std::system_error.
bool exchange(const std::filesystem::path& a, const std::filesystem::path& b);

/// Fills 64 bits that nobody can predict. Returns 0 or -1.
int random_bits(std::uint64_t& bits);

}  // namespace rainref::system
