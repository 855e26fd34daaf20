#include "cli/cli.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <new>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/floating_point.h"
#include "base/signals.h"
#include "cli/terminal.h"
#include "cli/validate_reports.h"
#include "cli/verbs.h"
#include "rainref/error.h"
#include "rainref/version.h"

namespace rainref::cli {
namespace {

// The parser suggests no nearest name, and reports missing arguments before misspelt ones. So misspelt verbs and options are found first.
void refuse_unknown(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* scope = &app;  // a verb, or its action, once it was named
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") return;
    const bool is_long = word.starts_with("--");
    if (is_long || (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])))) {
      const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
      const CLI::Option* option = scope->get_option_no_throw(name);
      if (!option) {
        std::vector<std::string> names;
        for (const CLI::Option* o : scope->get_options()) {
          for (const std::string& known : o->get_lnames()) names.push_back("--" + known);
        }
        throw Error(ExitCode::usage,
                    fmt::format("{}: unknown option{}{}", name, scope != &app ? fmt::format(" of '{}'", scope->get_name()) : "",
                                did_you_mean(name, names)));
      }
      if (option->get_items_expected_max() > 0 && word == name) ++i;  // its value
    } else if (const auto all = scope->get_subcommands([](const CLI::App*) { return true; }); !all.empty()) {
      std::vector<std::string> names;
      const CLI::App* named = nullptr;
      for (const CLI::App* known : all) {
        names.push_back(known->get_name());
        if (word == known->get_name()) named = known;
      }
      if (named)
        scope = named;
      else
        throw Error(ExitCode::usage,
                    fmt::format("expected one of {}, found '{}'{}", fmt::join(names, ", "), word, did_you_mean(word, names)));
    }
  }
}

/// Replaces `help` and `help VERB` by the equivalent options.
std::vector<const char*> without_help_verb(int argc, const char* const* argv) {
  std::vector<const char*> words(argv, argv + argc);
  if (argc < 2 || std::string_view(argv[1]) != "help") return words;
  if (argc > 3 && !(argc == 4 && std::string_view(argv[2]) == "sweep"))
    throw Error(ExitCode::usage, fmt::format("help: expected one verb, found '{}' too", argv[3]));
  words.erase(words.begin() + 1);
  if (argc == 2 || argv[2][0] != '-') words.push_back("--help");
  return words;
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app;
  const std::vector<Verb> verbs = add_verbs(app, command_text(argc, argv));
  const std::vector<const char*> words = without_help_verb(argc, argv);
  refuse_unknown(app, static_cast<int>(words.size()), words.data());
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    throw Error(ExitCode::usage, fmt::format("{} (see `rainref --help`)", e.what()));
  }
  for (const Verb& verb : verbs)
    if (verb.parser->parsed()) return verb.run();
  throw Error(ExitCode::internal, "no verb was parsed");
}

}  // namespace

std::vector<Verb> add_verbs(CLI::App& app, const std::string& command) {
  app.name("rainref");
  app.allow_windows_style_options(false);  // a path may begin with a slash
  app.description("rainref: the deterministic CPU reference for real-time rain");
  app.set_version_flag("--version", fmt::format("rainref {}, golden {} {}", version(), golden_generation, golden_hash()),
                       "Print the version, and which bits this build gives");
  app.require_subcommand(1);
  app.footer("`rainref help VERB` or `rainref VERB --help` says what a verb takes.\nExample: rainref run scenes/puddle/default.toml");
  return {list_verb(app), describe_verb(app),          run_verb(app),    view_verb(app),   hash_verb(app),  pack_verb(app),
          diff_verb(app), validate_verb(app, command), mutate_verb(app), import_verb(app), sweep_verb(app), selftest_verb(app),
          demo_verb(app)};
}

int main(int argc, const char* const* argv) {
  undo_when_interrupted();  // first, because later threads must leave signals to it
  // If standard output is closed, report an error instead of ending, so that files are cleaned up.
  const bool dies_of_pipes = ignore_closed_pipes();
  const FloatingPointGuard guard;  // libraries loaded at the start may have changed the state
  ExitCode code = ExitCode::internal;
  std::string message;
  try {
    const int result = parse_and_run(argc, argv);
    // A full disk may be reported only when standard output is flushed.
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return result;
    code = ExitCode::io;
    message = "standard output cannot be written";
  } catch (const Error& e) {
    code = e.code();
    message = e.what();
  } catch (const std::bad_alloc&) {
    code = ExitCode::usage;
    message = "this scene needs more memory than can be had";
  } catch (const std::exception& e) {
    // Printing throws if a full disk is reported earlier.
    if (std::ferror(stdout)) code = ExitCode::io;
    message =
        std::ferror(stdout) ? fmt::format("standard output cannot be written: {}", e.what()) : fmt::format("internal error: {}", e.what());
  }
  if (dies_of_pipes && code == ExitCode::io && std::ferror(stdout) && reader_is_gone()) die_of_closed_pipe();
  std::fflush(stdout);  // what was printed comes before the complaint, also where both go to one place
  complain(message);
  return static_cast<int>(code);
}

}  // namespace rainref::cli
