// New names, locks and errors of Windows.
#include <windows.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <vector>

#include "base/file_lock.h"
#include "base/system.h"
#include "base/system_windows.h"

namespace rainref::system {

namespace fs = std::filesystem;

namespace {

struct Reason {
  DWORD windows;
  int posix;
};
constexpr int held_open = ETXTBSY;  // no other call gives it
constexpr std::array<Reason, 25> reasons{{{ERROR_FILE_NOT_FOUND, ENOENT},
                                          {ERROR_PATH_NOT_FOUND, ENOENT},
                                          {ERROR_INVALID_NAME, ENOENT},
                                          {ERROR_BAD_NETPATH, ENOENT},
                                          {ERROR_BAD_NET_NAME, ENOENT},
                                          {ERROR_INVALID_DRIVE, ENOENT},
                                          {ERROR_FILE_EXISTS, EEXIST},
                                          {ERROR_ALREADY_EXISTS, EEXIST},
                                          {ERROR_DIR_NOT_EMPTY, ENOTEMPTY},
                                          {ERROR_DIRECTORY, ENOTDIR},
                                          {ERROR_ACCESS_DENIED, EACCES},
                                          {ERROR_WRITE_PROTECT, EROFS},
                                          {ERROR_SHARING_VIOLATION, held_open},
                                          {ERROR_LOCK_VIOLATION, held_open},
                                          {ERROR_DISK_FULL, ENOSPC},
                                          {ERROR_HANDLE_DISK_FULL, ENOSPC},
                                          {ERROR_NOT_SAME_DEVICE, EXDEV},
                                          {ERROR_TOO_MANY_OPEN_FILES, EMFILE},
                                          {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
                                          {ERROR_BUFFER_OVERFLOW, ENAMETOOLONG},
                                          {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
                                          {ERROR_CANT_RESOLVE_FILENAME, ELOOP},
                                          {ERROR_BROKEN_PIPE, EPIPE},
                                          {ERROR_NO_DATA, EPIPE},
                                          {ERROR_INVALID_PARAMETER, EINVAL}}};

/// From Windows 10 of 1607 on, and on NTFS: takes the place of a file that others have open, as everywhere else.
bool rename_as_posix(const fs::path& from, const fs::path& to) {
  // FILE_RENAME_INFO as newer headers declare it.
  struct Asked {
    DWORD flags;
    HANDLE root;
    DWORD bytes;
    wchar_t name[1];
  };
  constexpr auto information = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);  // FileRenameInfoEx
  constexpr DWORD replaces = 1, posix_semantics = 2;
  std::error_code error;
  const std::wstring name = fs::absolute(to, error).make_preferred().native();
  if (error) return false;
  std::vector<std::max_align_t> memory((sizeof(Asked) + name.size() * sizeof(wchar_t)) / sizeof(std::max_align_t) + 1);
  auto* const asked = reinterpret_cast<Asked*>(memory.data());
  asked->flags = replaces | posix_semantics;
  asked->bytes = static_cast<DWORD>(name.size() * sizeof(wchar_t));
  std::copy(name.begin(), name.end(), asked->name);
  const HANDLE handle = ::CreateFileW(from.c_str(), DELETE | SYNCHRONIZE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                      OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return false;
  const bool done =
      ::SetFileInformationByHandle(handle, information, asked, static_cast<DWORD>(memory.size() * sizeof(std::max_align_t))) != 0;
  ::CloseHandle(handle);
  return done;
}

/// Whether a file is there that cannot be replaced because it is open elsewhere.
bool is_held_open(const fs::path& path) {
  const HANDLE handle = ::CreateFileW(path.c_str(), DELETE, 0, nullptr, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
  if (handle != INVALID_HANDLE_VALUE) ::CloseHandle(handle);
  return handle == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_SHARING_VIOLATION;
}

class Failures : public std::error_category {
 public:
  const char* name() const noexcept override { return "system"; }
  std::string message(int error) const override {
    switch (error) {
      case held_open:
        return "another program holds it open";
      case ELOOP:
        return "Too many levels of symbolic links";  // the C library has no words for it
      default:
        return std::generic_category().message(error);
    }
  }
  std::error_condition default_error_condition(int error) const noexcept override { return {error, std::generic_category()}; }
};

}  // namespace

int fail() {
  const DWORD why = ::GetLastError();
  errno = EIO;
  for (const Reason& reason : reasons)
    if (reason.windows == why) errno = reason.posix;
  return -1;
}

int rename(const fs::path& from, const fs::path& to) {
  const DWORD attributes = ::GetFileAttributesW(to.c_str());
  const bool is_there = attributes != INVALID_FILE_ATTRIBUTES, is_folder = is_there && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  // As everywhere, a folder takes no file's place.
  if (is_there && !is_folder && found(from, false).kind == Kind::folder) {
    errno = ENOTDIR;
    return -1;
  }
  // No call of the system lets a folder take the place of an empty one. One that is not empty stays, with its own error.
  if (is_folder && !::RemoveDirectoryW(to.c_str())) return fail();
  if (is_there && !is_folder && rename_as_posix(from, to)) return 0;
  if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING)) return 0;
  fail();
  if (errno == EACCES && fs::is_directory(to) && fs::is_directory(from)) errno = EEXIST;  // another process made it meanwhile
  if (errno == EACCES && (is_held_open(to) || is_held_open(from))) errno = held_open;
  return -1;
}

}  // namespace rainref::system

namespace rainref {

const std::error_category& system_failures() {
  static const system::Failures only;
  return only;
}

// A byte far behind the end of any file, because nobody else may read or write what is locked.
FileLock lock_file(int descriptor) {
  OVERLAPPED at{};
  at.OffsetHigh = 0x40000000;
  if (::LockFileEx(system::handle_of(descriptor), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &at)) return FileLock::mine;
  const DWORD why = ::GetLastError();
  return why == ERROR_LOCK_VIOLATION || why == ERROR_IO_PENDING ? FileLock::taken : FileLock::impossible;
}

bool is_still(int descriptor, const std::filesystem::path& path) {
  system::Found opened = system::found(descriptor), named = system::found(path, false);
  if (named.kind == system::Kind::folder && opened.kind == system::Kind::file) named = system::found(system::lock_of(path), false);
  const bool has_device = opened.device != 0;  // Wine does not know that of an opened file that got another name
  return opened.kind != system::Kind::nothing && named.kind != system::Kind::nothing && opened.file == named.file &&
         (opened.device == named.device || !has_device);
}

}  // namespace rainref
