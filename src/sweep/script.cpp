#include "sweep/script.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "base/printable.h"
#include "rainref/error.h"
#include "scene/value_text.h"

namespace rainref::sweep {
namespace {

/// Quoted as one word of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Quoted as one value of YAML, which accepts JSON texts.
std::string yaml(const std::string& text) { return nlohmann::json(text).dump(-1, ' ', true); }

/// A script consists of lines, and engines also expand braces in paths.
void require_plain(const ScriptAsked& asked) {
  const std::pair<const char*, std::string> texts[] = {
      {"program", path_text(asked.program)}, {"PLAN", path_text(asked.plan)}, {"--output", path_text(asked.out)}, {"--image", asked.image}};
  for (const auto& [name, text] : texts) {
    const auto refuse = [name = name, &text = text](const char* expected) {
      throw Error(ExitCode::usage, fmt::format("{}: expected {}, found {}", name, expected, scene::toml_string(text)));
    };
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(text.begin(), text.end(), is_control)) refuse("a text without line ends and other control characters");
    if (asked.engine == "parallel" && text.find_first_of("{}") != std::string::npos)
      refuse("a text without braces, for which GNU parallel puts in its arguments");
    std::string_view rest = text;
    while (!rest.empty() && utf8_length(rest) > 0) rest.remove_prefix(utf8_length(rest));
    if (asked.engine == "kubernetes" && !rest.empty()) refuse("a text in UTF-8, as YAML wants it");
  }
}

std::string sweep(const ScriptAsked& a, const char* action, const std::string& more) {
  return fmt::format("{} sweep {} {} -o {}{}", quoted(path_text(a.program)), action, quoted(path_text(a.plan)), quoted(path_text(a.out)),
                     more);
}
std::string run(const ScriptAsked& a, const std::string& shard) {
  return sweep(a, "run", fmt::format(" --shard {} --threads {}", shard, a.threads));
}

/// The line of a job's script, quoted as one word of the script that submits it.
std::string job(const std::string& command) { return quoted("exec " + command); }

// --requeue restarts the task of a dead node; it finds the finished cells itself.
std::string slurm(const ScriptAsked& a) {
  return fmt::format(R"(#!/bin/sh
# sh THIS [sbatch options, such as --partition=X --constraint=Y]: an array of {0} shards, and collect when the last one has ended.
set -eu
mkdir -p {1}
id=$(printf '#!/bin/sh\n%s\n' {4} |
  sbatch --parsable --job-name=rainref-sweep --requeue --open-mode=append --array=0-{2} --cpus-per-task={3} --output={1}/%A_%a.txt "$@")
id=${{id%%;*}}
printf '#!/bin/sh\n%s\n' {5} |
  sbatch --parsable --job-name=rainref-collect --dependency=afterany:"$id" --open-mode=append --output={1}/collect_%j.txt "$@"
)",
                     a.shards, quoted(path_text(a.out / "slurm")), a.shards - 1, a.threads, job(run(a, "auto")),
                     job(sweep(a, "collect", "")));
}

std::string parallel(const ScriptAsked& a) {
  return fmt::format(R"(#!/bin/sh
# sh THIS [options of GNU parallel, such as --sshloginfile HOSTS where all hosts see these folders]: {0} shards, and then collect.
# After a kill the same command goes on.
set -eu
mkdir -p {1}
seq 0 {2} | parallel --joblog {1}/parallel.log --retries 3 "$@" {3} || true
exec {4}
)",
                     a.shards, quoted(path_text(a.out)), a.shards - 1, quoted(run(a, fmt::format("{{}}/{}", a.shards))),
                     sweep(a, "collect", ""));
}

std::string sge(const ScriptAsked& a) {
  return fmt::format(R"(#!/bin/sh
# sh THIS [qsub options]: an array of {0} shards, and collect when the last one has ended.
set -eu
mkdir -p {1}
id=$(printf '#!/bin/sh\n%s\n' {2} | qsub -terse -N rainref-sweep -r y -t 1-{0} -j y -o {1} "$@")
printf '#!/bin/sh\n%s\n' {3} | qsub -N rainref-collect -hold_jid "${{id%%.*}}" -j y -o {1} "$@"
)",
                     a.shards, quoted(path_text(a.out / "sge")), job(run(a, "auto")), job(sweep(a, "collect", "")));
}

std::string kubernetes(const ScriptAsked& a) {
  const std::string shards = std::to_string(a.shards);
  return fmt::format(R"(# kubectl apply -f THIS. The folder of the results is a volume that all nodes see: claim "rainref-sweep" here.
# When the job is complete: {4}
apiVersion: batch/v1
kind: Job
metadata:
  name: rainref-sweep
spec:
  completionMode: Indexed
  completions: {0}
  parallelism: {0}
  backoffLimit: {1}
  template:
    spec:
      restartPolicy: OnFailure
      containers:
      - name: sweep
        image: {2}
        command: ["/bin/sh", "-c"]
        args:
        - |
          exec {3}
        volumeMounts:
        - {{name: results, mountPath: {5}}}
        resources:
          requests: {{cpu: "{6}"}}
      volumes:
      - name: results
        persistentVolumeClaim: {{claimName: rainref-sweep}}
)",
                     a.shards, 3 * a.shards, yaml(a.image), run(a, "auto/" + shards), sweep(a, "collect", ""), yaml(path_text(a.out)),
                     a.threads);
}

}  // namespace

std::vector<std::string> engines() { return {"slurm", "parallel", "sge", "kubernetes"}; }

std::string script(const ScriptAsked& asked) {
  require_plain(asked);
  if (asked.engine == "slurm") return slurm(asked);
  if (asked.engine == "parallel") return parallel(asked);
  if (asked.engine == "sge") return sge(asked);
  if (asked.engine == "kubernetes") return kubernetes(asked);
  const std::vector<std::string> known = engines();
  throw Error(ExitCode::usage, fmt::format("--engine: expected one of {}, found '{}'{}", fmt::join(known, ", "), asked.engine,
                                           did_you_mean(asked.engine, known)));
}

}  // namespace rainref::sweep
