#include "sweep/script.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::sweep {
namespace {

/// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string sweep(const ScriptAsked& a, const char* action, const std::string& more) {
  return fmt::format("{} sweep {} {} -o {}{}", quoted(a.program.string()), action, quoted(a.plan.string()), quoted(a.out.string()), more);
}
std::string run(const ScriptAsked& a, const std::string& shard) {
  return sweep(a, "run", fmt::format(" --shard {} --threads {}", shard, a.threads));
}

// A dead node's task starts anew by --requeue; which cells are there already it sees itself.
std::string slurm(const ScriptAsked& a) {
  return fmt::format(R"(#!/bin/sh
# sh THIS [sbatch options, such as --partition=X --constraint=Y]: an array of {0} shards, and collect when the last one has ended.
set -eu
mkdir -p {1}
id=$(sbatch --parsable --job-name=rainref-sweep --requeue --open-mode=append --array=0-{2} --cpus-per-task={3} --output={1}/%A_%a.txt "$@" <<'JOB'
#!/bin/sh
exec {4}
JOB
)
id=${{id%%;*}}
sbatch --parsable --job-name=rainref-collect --dependency=afterany:"$id" --open-mode=append --output={1}/collect_%j.txt "$@" <<'JOB'
#!/bin/sh
exec {5}
JOB
)",
                     a.shards, quoted((a.out / "slurm").string()), a.shards - 1, a.threads, run(a, "auto"), sweep(a, "collect", ""));
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
                     a.shards, quoted(a.out.string()), a.shards - 1, quoted(run(a, fmt::format("{{}}/{}", a.shards))),
                     sweep(a, "collect", ""));
}

std::string sge(const ScriptAsked& a) {
  return fmt::format(R"(#!/bin/sh
# sh THIS [qsub options]: an array of {0} shards, and collect when the last one has ended.
set -eu
mkdir -p {1}
id=$(qsub -terse -N rainref-sweep -r y -t 1-{0} -j y -o {1} "$@" <<'JOB'
#!/bin/sh
exec {2}
JOB
)
qsub -N rainref-collect -hold_jid "${{id%%.*}}" -j y -o {1} "$@" <<'JOB'
#!/bin/sh
exec {3}
JOB
)",
                     a.shards, quoted((a.out / "sge").string()), run(a, "auto"), sweep(a, "collect", ""));
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
        - {{name: results, mountPath: "{5}"}}
        resources:
          requests: {{cpu: "{6}"}}
      volumes:
      - name: results
        persistentVolumeClaim: {{claimName: rainref-sweep}}
)",
                     a.shards, 3 * a.shards, a.image, run(a, "auto/" + shards), sweep(a, "collect", ""), a.out.string(), a.threads);
}

}  // namespace

std::vector<std::string> engines() { return {"slurm", "parallel", "sge", "kubernetes"}; }

std::string script(const ScriptAsked& asked) {
  if (asked.engine == "slurm") return slurm(asked);
  if (asked.engine == "parallel") return parallel(asked);
  if (asked.engine == "sge") return sge(asked);
  if (asked.engine == "kubernetes") return kubernetes(asked);
  const std::vector<std::string> known = engines();
  throw Error(ExitCode::usage, fmt::format("--engine: expected one of {}, found '{}'{}", fmt::join(known, ", "), asked.engine,
                                           did_you_mean(asked.engine, known)));
}

}  // namespace rainref::sweep
