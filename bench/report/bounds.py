"""scripts/bench --bounds: what holds a row of one thread. A call of its kernel is stepped through, instruction by instruction, so that what is
counted is what was executed, with any vectors; llvm-mca says which ports each instruction may take. The bound is the time that the busiest
set of ports needs for all of them: no cache miss, no wrong branch, no wait for a result. Then the same instructions in their order go through
llvm-mca's model of the pipeline, which waits for results, of ports and for room among the instructions that have begun; branches.py counts the
branches that a processor would not have foreseen."""
import collections
import ctypes
import itertools
import json
import math
import os
import re
import shutil
import signal
import subprocess
import tempfile

import branches

STEPS, SIMULATED = 150_000, 60_000  # instructions that are enough: of a row whose rounds are alike; for the model of the pipeline
FIRST_HITS = r"^rainref::compositor::Tracer::first_hits\(rainref::compositor::RayArrays"  # with Embree and all kernels that it calls


def in_a_row(*calls):
    """Four calls from each of these on: of rays one call is too few for the branches before to be known."""
    return tuple(call + k for call in calls for k in range(4))


# Row of the bench, kernel (demangled, in the namespace of the target but where it begins with another), the calls that are stepped through, spread over the picture, whose parts
# cost unlike amounts, and how many elements each makes; 0: a vector of floats for each round of its loop, so that the call need not end.
ROWS = (
    ("edge_splash.splash/as-published/1920x1080", r"rows_of<.*PublishedSplashPass,", (67, 200), 0),
    ("edge_splash.splash/corrected/1920x1080", r"rows_of<.*::SplashPass,", (67, 200), 0),
    ("composite/as-published/1920x1080", r"rows_of<.*CompositePass,.*false>", (135, 270, 405), 0),
    ("composite/corrected/1920x1080", r"rows_of<.*CompositePass,.*true>", (135, 270, 405), 0),
    ("wave_step/corrected/rg16f/1024/steps:5", r"puddle::\w+::StepRows\(", (700, 708, 712, 720, 740, 748), 8192),  # visits of eight rows
    ("wave_step/corrected/rg32f/1024/steps:5", r"puddle::\w+::StepRows\(", (700, 708, 712, 720, 740, 748), 8192),
    ("integrate/corrected/100000", r"drops::\w+::IntegrateRange\(", (3,), 2048),
    ("surface_hit/as-published/1280x720", r"paired_hit_rows<false, \(rainref::Address\)0>", (400, 900, 1400), 512),
    ("shade/as-published/1280x720", r"rows_of<.*ShadePass,.*false>", (400, 900, 1400), 512),
    ("shade/corrected/1280x720", r"puddle::\w+::ShadeOrBackground\(", (400, 900, 1400), 512),
    ("rain_on_glass/as-published/pane/1080p", r"rainy_glass::\w+::RainOnGlassPassRows\(", (67, 200), 0),
    ("rain_on_glass/corrected/pane/1080p", r"rainy_glass::\w+::RainOnGlassPassRows\(", (67, 200), 7680),
    ("screen_drops.drops/as-published/1080p", r"rows_of<.*PublishedDropsPass,", (135,), 7680),
    ("screen_drops.drops/corrected/still/1080p", r"screen_drops::\w+::DropsPassRows\(", (33, 101, 169, 237), 7680),
    ("rays/camera/1920x1080", FIRST_HITS, in_a_row(6800, 18000, 29200), 64),
    ("rays/grazing/1920x1080", FIRST_HITS, in_a_row(14400, 21200, 28000), 64),
    ("rays/reflection/1920x1080", FIRST_HITS, in_a_row(4000, 12000, 20000), 64),
)
TARGETS = (("avx512f", "AVX3", 16, "icelake-server"), ("avx2", "AVX2", 8, "haswell"))
TRACEME, PEEKTEXT, PEEKUSER, POKETEXT, POKEUSER, CONT, SINGLESTEP = 0, 1, 3, 4, 6, 7, 9
RSP, RIP = 19 * 8, 16 * 8

libc = ctypes.CDLL(None, use_errno=True)
libc.ptrace.restype = ctypes.c_long
libc.ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]


class CannotStep(Exception):
    pass


def ptrace(request, pid, address=0, data=0):
    return libc.ptrace(request, pid, ctypes.c_void_p(address), ctypes.c_void_p(data)) & (1 << 64) - 1


def wait_for_trap(pid):
    _, status = os.waitpid(pid, 0)
    while os.WIFSTOPPED(status) and os.WSTOPSIG(status) != signal.SIGTRAP:
        ptrace(CONT, pid, 0, os.WSTOPSIG(status))
        _, status = os.waitpid(pid, 0)
    if not os.WIFSTOPPED(status):
        raise CannotStep("the program ended before the kernel was called so often")


def start(program, row):
    """A process of the program that has not begun."""
    pid = os.fork()
    if pid == 0:
        libc.personality(0x0040000)  # the same addresses in every run
        ptrace(TRACEME, 0)
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, 1)
        os.dup2(nothing, 2)
        os.execv(program, [program, f"--benchmark_filter=^{row.replace('.', '[.]')}/threads:1/", "--benchmark_min_time=0.0000001"])
    wait_for_trap(pid)
    return pid


def run_to(pid, place, stack):
    """Until the caller of the function whose return address lies at `stack` goes on."""
    while True:
        whole = ptrace(PEEKTEXT, pid, place)
        ptrace(POKETEXT, pid, place, whole & ~0xff | 0xcc)
        ptrace(CONT, pid)
        wait_for_trap(pid)
        ptrace(POKETEXT, pid, place, whole)
        ptrace(POKEUSER, pid, RIP, place)
        if ptrace(PEEKUSER, pid, RSP) > stack:
            return
        ptrace(SINGLESTEP, pid)
        wait_for_trap(pid)


def stepped(program, row, entry, calls, most):
    """The addresses that these calls of the function at `entry` execute, at most so many of each, in their order, a list for each call, counted from
    0; and of each address the file and its own address for it."""
    pid = start(program, row)
    try:
        with open(f"/proc/{pid}/maps", encoding="ascii") as maps:
            base = min(int(line.split("-")[0], 16) for line in maps if line.rstrip().endswith(os.path.basename(program)))
        place = base + entry
        whole = ptrace(PEEKTEXT, pid, place)
        out = []
        for call in range(calls[-1] + 1):
            ptrace(POKETEXT, pid, place, whole & ~0xff | 0xcc)
            ptrace(CONT, pid)
            wait_for_trap(pid)
            if ptrace(PEEKUSER, pid, RIP) != place + 1:
                raise CannotStep("the program stopped elsewhere")
            ptrace(POKETEXT, pid, place, whole)
            ptrace(POKEUSER, pid, RIP, place)
            if call not in calls:
                ptrace(SINGLESTEP, pid)
                wait_for_trap(pid)
                continue
            stack = ptrace(PEEKUSER, pid, RSP)
            back, at, executed = ptrace(PEEKTEXT, pid, stack), place, []
            while (at != back or ptrace(PEEKUSER, pid, RSP) <= stack) and len(executed) < most:
                executed.append(at)
                ptrace(SINGLESTEP, pid)
                wait_for_trap(pid)
                at = ptrace(PEEKUSER, pid, RIP)
            out.append(executed)
            if at != back and call != calls[-1]:
                run_to(pid, back, stack)
        return out, located(pid, set(itertools.chain(*out)))
    finally:
        try:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
        except (ProcessLookupError, ChildProcessError):
            pass


def located(pid, addresses):
    """Of each address that lies in a file: (path, address as the file's symbols count)."""
    with open(f"/proc/{pid}/maps", encoding="utf-8") as maps:
        lines = [line.split(None, 5) for line in maps]
    regions = [(*(int(x, 16) for x in fields[0].split("-")), int(fields[2], 16), fields[5].strip()) for fields in lines if len(fields) == 6]
    segments, out = {}, {}
    for address in addresses:
        begin, _, offset, path = next((r for r in regions if r[0] <= address < r[1]), (0, 0, 0, ""))
        if not path.startswith("/"):
            continue
        if path not in segments:
            text = subprocess.run(["readelf", "-lW", path], capture_output=True, text=True, check=True).stdout
            segments[path] = [tuple(int(x, 16) for x in m) for m in re.findall(r"LOAD\s+0x(\w+) 0x(\w+) 0x\w+ 0x(\w+)", text)]
        at = address - begin + offset
        out[address] = next((path, at - start + virtual) for start, virtual, size in segments[path] if start <= at < start + size)
    return out


def entries_of(program, namespace):
    """Where each row's kernel begins in the program; raises CannotStep where a row names none."""
    text = subprocess.run(["nm", "-C", program], capture_output=True, text=True, check=True).stdout
    symbols = [(int(line[:16], 16), line[19:]) for line in text.splitlines() if line[:16].strip() and line[17] in "tTwWu"]
    found = {}
    for row, kernel, *_ in ROWS:
        found[row] = next((address for address, name in symbols if re.search(kernel, name) and ".cold" not in name and
                           (f"N_{namespace}::" in name or kernel.startswith("^"))), None)
        if found[row] is None:
            raise CannotStep(f"{program} has no {kernel} of {namespace}")
    return found


def disassembly(places):
    """The text of each address, as llvm-mca reads it. places: what `located` gives."""
    out = {}
    for path in {file for file, _ in places.values()}:
        there = sorted({at for file, at in places.values() if file == path})
        texts, first = {}, 0
        for k in range(len(there)):  # a library is large: what was executed, in pieces
            if k + 1 < len(there) and there[k + 1] - there[k] < 4096:
                continue
            text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", f"--start-address={there[first]}", f"--stop-address={there[k] + 16}", path],
                                  capture_output=True, text=True, check=True).stdout
            for line in text.splitlines():
                match = re.match(r" *([0-9a-f]+):\s+(.*)", line)
                if match:
                    texts[int(match[1], 16)] = re.sub(r"\s*(<.*|#.*)", "", match[2]).strip()
            first = k + 1
        out.update((address, texts[at]) for address, (file, at) in places.items() if file == path and at in texts)
    return out


def once_a_string(executed, texts):
    """Without the rounds of an instruction like rep movsb, which is stepped through a round at a time."""
    return [at for k, at in enumerate(executed) if k == 0 or at != executed[k - 1] or not texts.get(at, "").startswith("rep")]


def kind_of(text):
    """Gathers, divisions, roots, loads, stores, other vector operations, or the rest."""
    name = text.split()[0]
    if "gather" in name:
        return "gathers"
    if name.startswith("vdiv"):
        return "divisions"
    if name.startswith("vsqrt"):
        return "roots"
    if "(" in text and not name.startswith(("lea", "nop", "prefetch")):
        return "stores" if text.rstrip().endswith(")") and name.startswith(("vmov", "mov", "vpmov", "vcompress", "vextract", "kmov")) else "loads"
    return "vectors" if name.startswith(("v", "k")) else "rest"


def eligible_ports(texts, cpu):
    """For each text the ports that it takes, with the cycles, from llvm-mca's resource pressure."""
    found, alike = {}, {}
    for text in texts:
        # Which registers are named does not count, but in a gather, whose three must differ; branches have no operand here.
        source = re.sub(r"^(j\w+|call)\b.*", r"\1 1f\n1:", text)
        if "gather" not in source:
            source = re.sub(r"-?0x[0-9a-f]+\(", "64(", re.sub(r"%([xyz]mm)\d+", r"%\g<1>1", source))
        if source in alike:
            found[text] = alike[source]
            continue
        run = subprocess.run(["llvm-mca", f"-mcpu={cpu}", "-iterations=100", "-instruction-info=0", "-summary-view=0", "-resource-pressure=1"],
                             input=source + "\n", capture_output=True, text=True)
        if run.returncode != 0:
            continue
        names = re.findall(r"^\[([\d.]+)\]\s+- (\S+)", run.stdout, re.M)
        table = re.search(r"Resource pressure per iteration:\n(.*)\n(.*)\n", run.stdout)
        columns = re.findall(r"\[([\d.]+)\]", table[1])
        values = [0.0 if v == "-" else float(v) for v in table[2].split()]
        label = dict(names)
        found[text] = alike[source] = {label[c]: v for c, v in zip(columns, values) if v > 0}
    return found


def port_bound(weights, pressure):
    """Cycles of the busiest set of ports: an instruction whose ports all lie in the set must run there."""
    groups = collections.Counter()
    for text, count in weights.items():
        parts = pressure.get(text, {})
        for divider in [p for p in parts if "Divider" in p]:
            groups[frozenset([divider])] += count * parts[divider]
        ports = {p: c for p, c in parts.items() if "Divider" not in p}
        # One of alike ports in turn: equal shares are one group.
        for _, alike in itertools.groupby(sorted(ports.items(), key=lambda e: round(e[1], 1)), key=lambda e: round(e[1], 1)):
            alike = list(alike)
            groups[frozenset(p for p, _ in alike)] += count * sum(c for _, c in alike)
    ports = sorted(set().union(*groups))
    best = (0.0, ())
    for size in range(1, min(len(ports), 6) + 1):
        for chosen in itertools.combinations(ports, size):
            inside = sum(cycles for group, cycles in groups.items() if group <= set(chosen))
            best = max(best, (inside / size, chosen))
    return best


def simulated_cycles(texts, cpu):
    """Of these instructions in their order, all data in the nearest cache, each branch foreseen, no load of what was just stored late."""
    source = "\n".join(re.sub(r"^(j\w+|call)\b.*", "nop", text) for text in texts)
    run = subprocess.run(["llvm-mca", f"-mcpu={cpu}", "-iterations=1", "-instruction-info=0", "-resource-pressure=0"], input=source + "\n", capture_output=True, text=True)
    found = re.search(r"Total Cycles:\s+(\d+)", run.stdout)
    if not found:
        raise CannotStep(f"llvm-mca does not take the instructions: {run.stderr.strip().splitlines()[:1]}")
    return int(found[1])


def rate_of(given, row):
    """The row's fastest go on one thread [M/s]."""
    run = subprocess.run([os.path.join(given.build, "bench/rainref_bench"), f"--benchmark_filter=^{row.replace('.', '[.]')}/threads:1/",
                          "--benchmark_min_time=0.0000001", "--benchmark_format=json"],
                         capture_output=True, text=True, check=True, env={**os.environ, "RAINREF_BENCH_SECONDS": str(given.row_seconds)})
    found = json.loads(run.stdout)["benchmarks"][0]
    return next(found[key] * factor for key, factor in (("Mpix/s", 1), ("Mdrop/s", 1), ("Mray/s", 1), ("Gcell/s", 1000)) if key in found)


def clock_ghz():
    """Of a loop that takes a cycle a round, the fastest of 20, on the thread's own time; compiled here."""
    source = ('#include <ctime>\n#include <cstdio>\nint main(){double best=1;for(int k=0;k<20;++k){timespec a,b;clock_gettime(CLOCK_THREAD_CPUTIME_ID,&a);'
              'long n=10000000;__asm__ volatile("1: dec %0\\n jnz 1b":"+r"(n));clock_gettime(CLOCK_THREAD_CPUTIME_ID,&b);'
              'double s=(b.tv_sec-a.tv_sec)+1e-9*(b.tv_nsec-a.tv_nsec);if(s<best)best=s;}std::printf("%f",1e-2/best);}')
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "clock")
        subprocess.run(["c++", "-O1", "-x", "c++", "-", "-o", program], input=source, text=True, check=True)
        return float(subprocess.run([program], capture_output=True, text=True, check=True).stdout)


def measure(given, clock, measured, say):
    """One dictionary a row; `measured` gives the rate of a row [M/s]."""
    for tool in ("llvm-mca", "objdump", "nm"):
        if not shutil.which(tool):
            raise CannotStep(f"{tool} is not installed (Debian: llvm, binutils)")
    with open("/proc/cpuinfo", encoding="ascii") as file:
        flags = file.read()
    try:
        _, namespace, lanes, cpu = next(t for t in TARGETS if t[0] in flags)
    except StopIteration:
        raise CannotStep("this processor has neither AVX2 nor AVX-512") from None
    program = os.path.abspath(os.path.join(given.build, "bench/rainref_bench"))
    entries = entries_of(program, namespace)
    out = []
    for row, _, calls, elements in ROWS:
        if not re.search(given.only, row):
            continue
        say(row)
        executed, places = stepped(program, row, entries[row], calls, math.inf if elements else STEPS // len(calls))
        texts = disassembly(places)
        executed = [once_a_string(call, texts) for call in executed]
        if elements:
            vectors = len(calls) * elements / lanes
        else:  # Nearly every instruction of a loop runs once a round: the commonest count is that of the rounds.
            counts = collections.Counter(itertools.chain(*executed))
            vectors = collections.Counter(c for c in counts.values() if c > 4).most_common(1)[0][0]
        kinds, weights = collections.Counter(), collections.Counter()
        for address, count in collections.Counter(itertools.chain(*executed)).items():
            text = texts.get(address)
            if text is None:
                continue  # of the kernel
            kinds[kind_of(text)] += count / vectors
            weights[text] += count / vectors
        cycles, ports = port_bound(weights, eligible_ports(weights, cpu))
        instructions = sum(kinds.values())
        some = [texts[address] for call in executed for address in call[:SIMULATED // len(calls)] if address in texts]
        simulated = simulated_cycles(some, cpu) * instructions / len(some)
        wrong, of_instructions = branches.wrong_branches(executed, texts, places)
        rate = clock * 1e3 * lanes
        out.append({"row": row, "lanes": lanes, "model": cpu, "instructions": instructions, **kinds, "wrong": wrong * instructions / of_instructions, "cycles": cycles, "ports": ports, "bound": rate / cycles,
                    "simulated_cycles": simulated, "simulated": rate / simulated, "measured": measured(row)})
    return out


def markdown(result, clock):
    lines = ["| row | instructions | vector | gathers | divisions | roots | loads | stores | wrong branches | cycles at least | of | bound [M/s] | cycles simulated | simulated [M/s] | measured [M/s] | % of bound | % of simulated |",
             "|" + "---|" * 17]
    for r in result:
        number = lambda key: f"{r.get(key, 0):.1f}"
        lines.append(f"| `{r['row']}` | {r['instructions']:.0f} | {number('vectors')} | {number('gathers')} | {number('divisions')} | {number('roots')} | {number('loads')} | "
                     f"{number('stores')} | {r['wrong']:.2f} | {r['cycles']:.0f} | {' '.join(r['ports'])} | {r['bound']:.0f} | "
                     f"{r['simulated_cycles']:.0f} | {r['simulated']:.0f} | {r['measured']:.1f} | {100 * r['measured'] / r['bound']:.0f} | {100 * r['measured'] / r['simulated']:.0f} |")
    if not result:
        return "No row has such a name.\n"
    return (f"For a vector of {result[0]['lanes']} elements, at {clock:.2f} GHz; ports by llvm-mca's model {result[0]['model']}.\n\n" + "\n".join(lines) + "\n")
