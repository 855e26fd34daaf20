"""The machine that measures: what it is, and whether others use it."""
import os
import platform
import time


def _first(path, key):
    try:
        with open(path, encoding="utf-8") as file:
            for line in file:
                if line.startswith(key):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return ""


def _processor():
    """Its name, and of x86-64 family and model: a virtual machine's name may say neither."""
    name, family, model = (_first("/proc/cpuinfo", key) for key in ("model name", "cpu family", "model\t"))
    return (name or platform.machine()) + (f" (family {family}, model {model})" if family and model else "")


def describe():
    flags = _first("/proc/cpuinfo", "flags").split()
    memory = _first("/proc/meminfo", "MemTotal").split()
    caches = []
    for index in range(5):
        folder = f"/sys/devices/system/cpu/cpu0/cache/index{index}"
        try:
            with open(folder + "/level", encoding="utf-8") as level, open(folder + "/type", encoding="utf-8") as kind, \
                    open(folder + "/size", encoding="utf-8") as size:
                if kind.read().strip() != "Instruction":
                    caches.append(f"L{level.read().strip()} {size.read().strip()}")
        except OSError:
            break
    return {"processor": _processor(), "cores": len(os.sched_getaffinity(0)),
            "simd": next((f for f in ("avx512f", "avx2", "sse4_1", "asimd") if f in flags), ""), "caches": ", ".join(caches),
            "memory_gib": round(int(memory[0]) / (1 << 20)) if memory else 0}


def _jiffies():
    """(busy, all) of the processors, in seconds."""
    with open("/proc/stat", encoding="utf-8") as file:
        fields = [int(x) for x in file.readline().split()[1:]]
    hertz = os.sysconf("SC_CLK_TCK")
    return (sum(fields[:8]) - fields[3] - fields[4]) / hertz, sum(fields[:8]) / hertz


class Watch:
    """How much of the processors others took since it was made: their time in percent of all, without this process and its children."""

    def __init__(self):
        self.start, self.own = _jiffies(), self._own()

    @staticmethod
    def _own():
        t = os.times()
        return t.user + t.system + t.children_user + t.children_system

    def others_percent(self):
        busy, every = _jiffies()
        others = (busy - self.start[0]) - (self._own() - self.own)
        return round(max(0.0, 100 * others / max(every - self.start[1], 1e-9)), 1)


def wait_until_idle(limit_s, at_most_percent=5.0, look_s=2.0):
    """Waits until others take less than a share of the processors, for limit_s at most. {"waited_s", "others_percent", "idle"}."""
    begin = time.monotonic()
    while True:
        watch = Watch()
        time.sleep(look_s)
        others = watch.others_percent()
        waited = time.monotonic() - begin
        if others <= at_most_percent or waited >= limit_s:
            return {"waited_s": round(waited), "others_percent": others, "idle": others <= at_most_percent}
