#include "cli/manual.h"

#include <algorithm>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/option_values.h"
#include "cli/verbs.h"
#include "rainref/version.h"

namespace rainref::cli {
namespace {

/// An option, or a positional argument.
struct Described {
  std::vector<std::string> names;  ///< "-o", "--output"; "SCENE" if it has no dash
  std::string value, sentence;     ///< "DIR"; "" if it has no value
  bool is_positional = false, may_repeat = false;

  /// "exr|png|both|none" as words; empty for other values.
  std::vector<std::string> words() const { return value.find('|') == std::string::npos ? std::vector<std::string>() : split(value); }
  bool is_scene() const { return names[0] == "SCENE"; }
  bool is_preset() const { return names[0] == "--preset"; }

  static std::vector<std::string> split(std::string text) {
    std::replace(text.begin(), text.end(), '|', ',');
    return list_of(text);
  }
};

/// The actions of a verb such as `sweep`, which are verbs themselves.
std::vector<const CLI::App*> actions_of(const CLI::App& verb) {
  return verb.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<Described> options_of(const CLI::App& verb) {
  std::vector<Described> all;
  for (const CLI::Option* o : verb.get_options()) {
    Described d{{}, o->get_items_expected_max() > 0 ? o->get_type_name() : "", o->get_description()};
    for (const std::string& name : o->get_snames()) d.names.push_back("-" + name);
    for (const std::string& name : o->get_lnames()) d.names.push_back("--" + name);
    for (const std::string& name : o->get_fnames())
      if (std::find(d.names.begin(), d.names.end(), "--" + name) == d.names.end()) d.names.push_back("--" + name);
    d.is_positional = d.names.empty();
    if (d.is_positional) d.names.push_back(o->get_name(true));
    d.may_repeat = !d.is_positional && o->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw && o->get_items_expected_max() > 1;
    all.push_back(std::move(d));
  }
  std::stable_partition(all.begin(), all.end(), [](const Described& d) { return d.is_positional; });
  return all;
}

/// Options with those of the verb's actions, each name once, and the actions as words.
std::vector<Described> options_and_actions_of(const CLI::App& verb) {
  std::vector<Described> all = options_of(verb);
  std::vector<std::string> names;
  std::vector<Described> more;
  for (const CLI::App* action : actions_of(verb)) {
    names.push_back(action->get_name());
    for (Described& d : options_of(*action))
      if (const auto is_it = [&](const Described& known) { return known.names == d.names; };
          std::none_of(all.begin(), all.end(), is_it) && std::none_of(more.begin(), more.end(), is_it))
        more.push_back(std::move(d));
  }
  if (!names.empty()) all.insert(all.begin(), {{"ACTION"}, fmt::format("{}", fmt::join(names, "|")), "What to do", true, false});
  all.insert(all.end(), more.begin(), more.end());
  std::stable_partition(all.begin(), all.end(), [](const Described& d) { return d.is_positional; });
  return all;
}

/// The program's own options, and its verbs with theirs.
struct Program {
  CLI::App app;
  std::vector<Verb> verbs = add_verbs(app, "");
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}
/// Escapes text for a manual page, so that troff interprets none of it.
std::string roff(const std::string& text) {
  std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  out = replaced(out, "\n.", "\n\\&.");
  out = replaced(out, "\n'", "\n\\&'");
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string man_options(const std::vector<Described>& options) {
  std::string out;
  for (const Described& d : options) {
    std::string names;
    for (const std::string& name : d.names) names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    out += fmt::format(".TP\n{}{}\n{}\n", names, d.value.empty() || d.is_positional ? "" : fmt::format(" \\fI{}\\fR", roff(d.value)),
                       roff(d.sentence + (d.is_positional && d.value.find('|') != std::string::npos ? ": " + d.value : "") + "."));
  }
  return out;
}
/// The examples in a verb's help: the text after "Example:", unchanged.
std::string man_examples(const std::string& footer) {
  std::string text = replaced(footer, "Examples: ", "");
  text = replaced(replaced(text, "Example: ", ""), "\n          rainref", "\nrainref");
  return fmt::format(".PP\n.EX\n{}\n.EE\n", roff(text));
}

std::string shell_words(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }
/// Puts text in single quotes for a shell.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

/// Prints the names of scenes: the second part of `rainref list`, without its sentences.
constexpr const char* scenes_command =
    "rainref list 2>/dev/null | sed -n -e '/^Scenes$/,/^$/!d' -e 's/^  //' -e 's/[.]toml  .*/.toml/' -e '/[.]toml$/p'";

/// Prints the names of presets.
constexpr const char* presets_command = "rainref list 2>/dev/null | sed -n -e '/^Presets/,/^$/s/^  \\([a-z_]*\\) .*/\\1/p'";

}  // namespace

std::string man_page() {
  const Program program;
  std::string out = fmt::format(
      ".TH RAINREF 1 \"\" \"rainref {}\" \"User Commands\"\n.SH NAME\nrainref \\- deterministic CPU reference for real\\-time rain, and "
      "judge of "
      "GPU ports\n.SH SYNOPSIS\n.B rainref\n\\fIVERB\\fR [\\fIOPTION\\fR]...\n.SH DESCRIPTION\nSimulates five published rain effects with "
      "the "
      "same bits on every machine, and judges GPU ports of them pass by pass.\n.SH OPTIONS\n{}.SH VERBS\n",
      version(), man_options(options_of(program.app)));
  for (const Verb& verb : program.verbs) {
    const CLI::App& v = *verb.parser;
    out += fmt::format(".SS {}\n{}.\n{}{}", roff(v.get_name()), roff(v.get_description()), man_options(options_of(v)),
                       man_examples(v.get_footer()));
    for (const CLI::App* action : actions_of(v))
      out += fmt::format(".PP\n\\fB{} {}\\fR: {}.\n{}{}", roff(v.get_name()), roff(action->get_name()), roff(action->get_description()),
                         man_options(options_of(*action)), man_examples(action->get_footer()));
  }
  out +=
      ".SH \"EXIT STATUS\"\n0: passed. 1: a check failed, or something was not judged. 2: command line, scene, or an image that cannot be "
      "decoded. "
      "3: a port's files, or a pack. 4: a file that cannot be read or written. 5: a defect of rainref.\n"
      ".SH ENVIRONMENT\n.TP\n\\fBXDG_CACHE_HOME\\fR\nWhere \\fBrun\\fR keeps pictures that it made: in its folder \\fIrainref\\fR. "
      "Default: "
      "\\fI~/.cache\\fR.\n.SH FILES\n.TP\n\\fI.../share/rainref\\fR\nScenes and presets, which \\fBlist\\fR names, small packs and "
      "profiles, beside "
      "the "
      "program wherever it is installed.\n";
  return out;
}

std::string bash_completion() {
  const Program program;
  std::vector<std::string> verbs{"help"}, own;
  for (const Verb& verb : program.verbs) verbs.push_back(verb.parser->get_name());
  for (const Described& d : options_of(program.app)) own.insert(own.end(), d.names.begin(), d.names.end());
  std::string cases;
  for (const Verb& verb : program.verbs) {
    std::vector<std::string> names, positional;
    bool has_files = false;
    const std::string v = verb.parser->get_name();
    for (const Described& d : options_and_actions_of(*verb.parser)) {
      if (d.is_positional) {
        const auto words = d.words();
        positional.insert(positional.end(), words.begin(), words.end());
        if (d.is_scene()) positional.push_back("$(" + std::string(scenes_command) + ")");
        has_files |= words.empty();
        continue;
      }
      names.insert(names.end(), d.names.begin(), d.names.end());
      if (d.value.empty()) continue;
      for (const std::string& name : d.names) {
        const std::string action = !d.words().empty()  ? fmt::format("_rainref_words \"{}\"", shell_words(d.words()))
                                   : d.is_preset()     ? fmt::format("_rainref_words \"$({})\"", presets_command)
                                   : d.value == "FILE" ? "_rainref_files"
                                   : d.value == "DIR"  ? "_rainref_folders"
                                                       : ":";
        cases += fmt::format("    '{} {}') {}; return ;;\n", v, name, action);
      }
    }
    cases += fmt::format("    '{} '*) _rainref_words \"{}\"", v, shell_words(names));
    if (!positional.empty()) cases += fmt::format("; [[ $cur == -* ]] || _rainref_words \"{}\"", shell_words(positional));
    if (has_files) cases += "; [[ $cur == -* ]] || _rainref_files";
    cases += " ;;\n";
  }
  return fmt::format(
      "# bash completion of rainref, written by its build from the program's own options.\n"
      "_rainref_words() {{ COMPREPLY+=($(compgen -W \"$1\" -- \"$cur\")); }}\n"
      "_rainref_files() {{ compopt -o filenames 2>/dev/null; COMPREPLY+=($(compgen -f -- \"$cur\")); }}\n"
      "_rainref_folders() {{ compopt -o filenames 2>/dev/null; COMPREPLY+=($(compgen -d -- \"$cur\")); }}\n"
      "_rainref() {{\n"
      "  local IFS=$' \\t\\n' cur=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then _rainref_words \"{} {}\"; return; fi\n"
      "  case \"${{COMP_WORDS[1]}} $previous\" in\n"
      "    'help '*) _rainref_words \"{}\" ;;\n{}"
      "  esac\n}}\n"
      "complete -F _rainref rainref\n",
      shell_words(verbs), shell_words(own), shell_words({verbs.begin() + 1, verbs.end()}), cases);
}

std::string zsh_completion() {
  const Program program;
  // Escapes text inside a specification of _arguments.
  const auto inside = [](const std::string& text) {
    return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
  };
  const auto action = [](const Described& d) -> std::string {
    if (!d.words().empty()) return fmt::format("({})", shell_words(d.words()));
    if (d.is_scene()) return "_rainref_scenes";
    if (d.is_preset()) return "_rainref_presets";
    return d.value == "DIR" ? "_files -/" : d.value == "FILE" ? "_files" : " ";
  };
  std::string names, cases;
  for (const Verb& verb : program.verbs) {
    const CLI::App& v = *verb.parser;
    names += fmt::format("    {}\n", quoted(v.get_name() + ":" + inside(v.get_description())));
    cases += fmt::format("    ({})\n      _arguments", v.get_name());
    for (const Described& d : options_and_actions_of(v)) {
      if (d.is_positional) {
        cases += " \\\n        " + quoted(fmt::format(":{}:{}", d.names[0], action(d)));
        continue;
      }
      for (const std::string& name : d.names) {
        cases += " \\\n        " + quoted(fmt::format("{}{}[{}]{}", d.may_repeat ? "*" : "", name, inside(d.sentence),
                                                      d.value.empty() ? "" : fmt::format(":{}:{}", inside(d.value), action(d))));
      }
    }
    cases += " ;;\n";
  }
  std::string own;
  for (const Described& d : options_of(program.app))
    for (const std::string& name : d.names) own += " " + quoted(fmt::format("{}[{}]", name, inside(d.sentence)));
  return fmt::format(
      "#compdef rainref\n# zsh completion of rainref, written by its build from the program's own options.\n"
      "_rainref_scenes() {{\n  local -a scenes=(${{(f)\"$({})\"}})\n  _alternative 'scenes:scene:compadd -a scenes' "
      "'files:file:_files'\n}}\n"
      "_rainref_presets() {{\n  local -a presets=(${{(f)\"$({})\"}})\n  compadd -a presets\n}}\n"
      "_rainref_verbs() {{\n  local -a verbs=(\n    'help:What a verb takes'\n{}  )\n  _describe verb verbs\n}}\n"
      "_rainref() {{\n  local line state\n  _arguments -C{} '1:verb:_rainref_verbs' '*::argument:->arguments'\n"
      "  [[ $state == arguments ]] || return\n  case $line[1] in\n    (help)\n      _rainref_verbs ;;\n{}  esac\n}}\n"
      "if [[ $funcstack[1] == _rainref ]]; then _rainref \"$@\"; else compdef _rainref rainref; fi\n",
      scenes_command, presets_command, names, own, cases);
}

}  // namespace rainref::cli
