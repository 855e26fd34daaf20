// A rainref that is at work while the test goes on.
#pragma once

#include <functional>
#include <thread>

#include "base/child_process.h"
#include "cli/support.h"

namespace rainref::cli {

/// Starts the program in a folder. Its standard output goes to `output`, a descriptor; by default nowhere.
inline std::unique_ptr<ChildProcess> start_rainref(const std::filesystem::path& folder, std::vector<std::string> arguments,
                                                   int output = -1) {
  arguments.insert(arguments.begin(), program_under_test());
  return std::make_unique<ChildProcess>([&] {
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    ::dup2(output >= 0 ? output : ::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
    return 127;
  });
}

/// Waits until something holds, a minute at most; fails the test otherwise.
inline void await(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Whether a process runs; a zombie does not.
inline bool is_running(int id) {
  const std::string status = contents("/proc/" + std::to_string(id) + "/stat");
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

}  // namespace rainref::cli
