// Windows. Everything is opened with all rights of sharing, so that open files can be renamed and removed as elsewhere.
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <ntsecapi.h>

#include <algorithm>
#include <cerrno>

#include "base/system.h"
#include "base/system_windows.h"

namespace rainref::system {

namespace fs = std::filesystem;

namespace {

constexpr DWORD all_may = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

Found found_of(HANDLE handle) {
  Found out;
  if (::GetFileType(handle) != FILE_TYPE_DISK) {
    out.kind = Kind::other;
    return out;
  }
  BY_HANDLE_FILE_INFORMATION info;
  if (!::GetFileInformationByHandle(handle, &info)) {
    fail();
    return out;
  }
  const auto whole = [](DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; };
  const auto has = [&](DWORD attribute) { return (info.dwFileAttributes & attribute) != 0; };
  out.kind = has(FILE_ATTRIBUTE_REPARSE_POINT) ? Kind::other : has(FILE_ATTRIBUTE_DIRECTORY) ? Kind::folder : Kind::file;
  out.is_mine = true;  // the rights of its folder say who may put files there, and a file's owner may be a group
  out.device = info.dwVolumeSerialNumber;
  out.file = whole(info.nFileIndexHigh, info.nFileIndexLow);
  out.bytes = whole(info.nFileSizeHigh, info.nFileSizeLow);
  return out;
}

int descriptor_of(HANDLE handle, unsigned how) {
  return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT | ((how & writing) ? 0 : _O_RDONLY));
}

}  // namespace

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

fs::path lock_of(const fs::path& folder) { return fs::path(folder) += L".lock"; }

int open(const fs::path& path, unsigned how) {
  const DWORD access = ((how & reading) ? GENERIC_READ : 0) | ((how & writing) ? GENERIC_WRITE : 0);
  const DWORD which = (how & new_only) ? CREATE_NEW : (how & creating) ? OPEN_ALWAYS : OPEN_EXISTING;
  // Folders are opened only with the first of these.
  const DWORD flags = FILE_FLAG_BACKUP_SEMANTICS | ((how & no_link) ? FILE_FLAG_OPEN_REPARSE_POINT : 0);
  const HANDLE handle = ::CreateFileW(path.c_str(), access, all_may, nullptr, which, flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return fail();
  if ((how & no_link) && found_of(handle).kind == Kind::other) {
    ::CloseHandle(handle);
    errno = ELOOP;
    return -1;
  }
  return descriptor_of(handle, how);
}
// No folder can be locked, and none can be renamed that holds an open file. However this process ends, the system removes the file.
int open_folder_lock(const fs::path& folder) {
  const HANDLE handle =
      ::CreateFileW(lock_of(folder).c_str(), GENERIC_READ | GENERIC_WRITE, all_may, nullptr, OPEN_ALWAYS,
                    FILE_FLAG_DELETE_ON_CLOSE | FILE_FLAG_OPEN_REPARSE_POINT | FILE_ATTRIBUTE_HIDDEN | FILE_ATTRIBUTE_TEMPORARY, nullptr);
  return handle == INVALID_HANDLE_VALUE ? fail() : descriptor_of(handle, writing);
}
int close(int descriptor) { return ::_close(descriptor); }
std::ptrdiff_t read(int descriptor, void* to, std::size_t bytes) {
  return ::_read(descriptor, to, static_cast<unsigned>(std::min<std::size_t>(bytes, 1u << 30)));
}
std::ptrdiff_t write(int descriptor, const void* from, std::size_t bytes) {
  return ::_write(descriptor, from, static_cast<unsigned>(std::min<std::size_t>(bytes, 1u << 30)));
}
int duplicate(int descriptor) {
  HANDLE copy = nullptr;
  const HANDLE process = ::GetCurrentProcess();
  if (!::DuplicateHandle(process, handle_of(descriptor), process, &copy, 0, FALSE, DUPLICATE_SAME_ACCESS)) return fail();
  return descriptor_of(copy, writing);
}
// What was opened for reading cannot be flushed, nor can a folder, whose entries are in the file system's journal.
int sync(int descriptor) {
  if (::FlushFileBuffers(handle_of(descriptor))) return 0;
  const DWORD why = ::GetLastError();
  return why == ERROR_ACCESS_DENIED || why == ERROR_INVALID_FUNCTION || why == ERROR_INVALID_HANDLE ? 0 : fail();
}
int make_private(int) { return 0; }  // the rights come from the folder

std::FILE* stream_to_read(const fs::path& path) {
  const int descriptor = open(path, reading);
  if (descriptor < 0) return nullptr;
  if (found(descriptor).kind == Kind::folder) {
    ::_close(descriptor);
    errno = EISDIR;
    return nullptr;
  }
  return ::_fdopen(descriptor, "rb");
}
std::FILE* stream_to_new_file(const fs::path& path) {
  const int descriptor = open(path, writing | new_only);
  return descriptor < 0 ? nullptr : ::_fdopen(descriptor, "wb");
}
int descriptor_of(std::FILE* stream) { return ::_fileno(stream); }

Found found(int descriptor) { return found_of(handle_of(descriptor)); }
Found found(const fs::path& path, bool follows_links) {
  const DWORD flags = FILE_FLAG_BACKUP_SEMANTICS | (follows_links ? 0 : FILE_FLAG_OPEN_REPARSE_POINT);
  const HANDLE handle = ::CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, all_may, nullptr, OPEN_EXISTING, flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) {
    fail();
    return {};
  }
  const Found what = found_of(handle);
  ::CloseHandle(handle);
  return what;
}

int make_folder(const fs::path& path, bool) { return ::CreateDirectoryW(path.c_str(), nullptr) ? 0 : fail(); }
int remove_folder(const fs::path& path) { return ::RemoveDirectoryW(path.c_str()) ? 0 : fail(); }
int remove_file(const fs::path& path) { return ::DeleteFileW(path.c_str()) ? 0 : fail(); }
// Before Windows 10 of 1709, and on network drives, the name of a removed file stays until the file is closed.
void release(int& descriptor) {
  if (descriptor >= 0) ::_close(descriptor);
  descriptor = -1;
}
bool exchange(const fs::path&, const fs::path&) { return false; }

int random_bits(std::uint64_t& bits) {
  if (::RtlGenRandom(&bits, sizeof bits)) return 0;
  errno = EIO;
  return -1;
}

}  // namespace rainref::system
