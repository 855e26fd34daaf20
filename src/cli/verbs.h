// The verbs of the command line: their options, and the functions that run them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rainref::cli {

struct Verb {
  const CLI::App* parser;
  std::function<int()> run;  ///< called after parsing: returns the exit code, or throws Error
};

// Each declares one verb with its options.
Verb list_verb(CLI::App& app);
Verb describe_verb(CLI::App& app);
Verb run_verb(CLI::App& app);
Verb view_verb(CLI::App& app);
Verb hash_verb(CLI::App& app);
Verb pack_verb(CLI::App& app);
Verb diff_verb(CLI::App& app);
/// `command`: as typed, for the reports.
Verb validate_verb(CLI::App& app, const std::string& command);
Verb mutate_verb(CLI::App& app);
Verb import_verb(CLI::App& app);
Verb sweep_verb(CLI::App& app);
Verb selftest_verb(CLI::App& app);
Verb demo_verb(CLI::App& app);

/// Adds the program's description and all verbs. `command`: as typed.
std::vector<Verb> add_verbs(CLI::App& app, const std::string& command);

}  // namespace rainref::cli
