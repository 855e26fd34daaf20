"""Plots as SVG, written by hand so that nothing but Python is needed: log-log lines and points, a legend beside them."""
import math

COLOURS = ("#0b62a4", "#c8501e", "#2e8b57", "#7a4fa3", "#b8860b", "#50575e", "#c2407c", "#00868b", "#8b5a2b", "#4a6b00", "#d62728", "#1f9ed1")
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 920, 480, 74, 290, 44, 58


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def number(x):
    """1024, 0.5, 20 k: no more digits than a tick needs."""
    if x >= 1e6:
        return f"{x / 1e6:g} M"
    return f"{x / 1e3:g} k" if x >= 1e4 else f"{x:g}"


def ticks(low, high):
    """1, 2, 5 of each power of ten within; powers alone where these would be too many."""
    every = [m * 10.0 ** e for e in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)]
    inside = [t for t in every if low * 0.999 <= t <= high * 1.001]
    return inside if len(inside) <= 9 else [t for t in inside if math.isclose(math.log10(t) % 1, 0, abs_tol=1e-9)
                                            or math.isclose(math.log10(t) % 1, 1, abs_tol=1e-9)]


def svg(title, x_label, y_label, series, x_ticks=None, roof=None, direct_labels=False):
    """series: [(name, [(x, y)], {"dashed": bool, "points": bool})]; all positive. roof: [(label, factor)]: lines y = factor x."""
    xs = [x for _, points, _ in series for x, _ in points]
    ys = [y for _, points, _ in series for _, y in points]
    if not xs:
        raise ValueError(f"plot '{title}': no points")
    x_low, x_high = min(xs) / 1.12, max(xs) * 1.12
    y_low, y_high = min(ys) / 1.25, max(ys) * 1.25
    if roof:
        x_low, x_high = min(x_low, y_low), max(x_high, y_high)
    plot_width, plot_height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def across(x):
        return LEFT + plot_width * math.log(x / x_low) / math.log(x_high / x_low)

    def up(y):
        return TOP + plot_height * (1 - math.log(y / y_low) / math.log(y_high / y_low))

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
           'font-family="DejaVu Sans, Helvetica, Arial, sans-serif" font-size="13" fill="#222">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
           f'<text x="{LEFT}" y="26" font-size="16" font-weight="bold">{escape(title)}</text>']
    for t in x_ticks or ticks(x_low, x_high):
        out.append(f'<line x1="{across(t):.1f}" y1="{TOP}" x2="{across(t):.1f}" y2="{TOP + plot_height}" stroke="#e3e3e3"/>')
        out.append(f'<text x="{across(t):.1f}" y="{TOP + plot_height + 20}" text-anchor="middle">{number(t)}</text>')
    for t in ticks(y_low, y_high):
        out.append(f'<line x1="{LEFT}" y1="{up(t):.1f}" x2="{LEFT + plot_width}" y2="{up(t):.1f}" stroke="#e3e3e3"/>')
        out.append(f'<text x="{LEFT - 8}" y="{up(t) + 4.5:.1f}" text-anchor="end">{number(t)}</text>')
    out.append(f'<rect x="{LEFT}" y="{TOP}" width="{plot_width}" height="{plot_height}" fill="none" stroke="#888"/>')
    out.append(f'<text x="{LEFT + plot_width / 2:.1f}" y="{HEIGHT - 14}" text-anchor="middle">{escape(x_label)}</text>')
    out.append(f'<text x="18" y="{TOP + plot_height / 2:.1f}" text-anchor="middle" '
               f'transform="rotate(-90 18 {TOP + plot_height / 2:.1f})">{escape(y_label)}</text>')
    for label, factor in roof or []:
        begin, end = max(x_low, y_low / factor), min(x_high, y_high / factor)
        if begin >= end:
            continue
        out.append(f'<line x1="{across(begin):.1f}" y1="{up(begin * factor):.1f}" x2="{across(end):.1f}" y2="{up(end * factor):.1f}" '
                   f'stroke="#999" stroke-dasharray="{"none" if factor == 1 else "3 4"}"/>')
        at_top = 12 if end * factor > 0.999 * y_high else -2
        out.append(f'<text x="{across(end) - 14:.1f}" y="{up(end * factor) + at_top:.1f}" font-size="11" fill="#666" text-anchor="end">'
                   f"{escape(label)}</text>")
    for index, (name, points, style) in enumerate(series):
        colour = COLOURS[index % len(COLOURS)]
        places = [(across(x), up(y)) for x, y in sorted(points)]
        if len(places) > 1:
            dash = ' stroke-dasharray="6 4"' if style.get("dashed") else ""
            out.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in places)}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
        for x, y in places:
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{"#fff" if style.get("dashed") else colour}" stroke="{colour}" stroke-width="2"/>')
            if direct_labels:
                out.append(f'<text x="{x:.1f}" y="{y - 8:.1f}" font-size="11" text-anchor="middle" fill="{colour}" font-weight="bold">{index + 1}</text>')
        at = round(TOP + 12 + index * min(21, plot_height / len(series)), 1)
        dash = ' stroke-dasharray="6 4"' if style.get("dashed") else ""
        beside = WIDTH - RIGHT + 16
        if direct_labels:
            out.append(f'<text x="{beside + 14}" y="{at + 4.5:.1f}" text-anchor="middle" fill="{colour}" font-weight="bold">{index + 1}</text>')
        else:
            out.append(f'<line x1="{beside}" y1="{at}" x2="{beside + 28}" y2="{at}" stroke="{colour}" stroke-width="2"{dash}/>')
        out.append(f'<text x="{beside + 34}" y="{at + 4.5:.1f}">{escape(name)}</text>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def _side(row):
    return int(row.split("/")[3])


def size(result):
    """Rate of wave_step over the side of its level, on all threads, with its peers."""
    most = max(r["threads"] for r in result["rows"])
    lines = {}
    for r in result["rows"]:
        if r["row"].startswith("wave_step/") and r["threads"] == most:
            parts = r["row"].split("/")
            storage = {"rg16f": "half", "rg32f": "float"}.get(parts[2], parts[2])
            steps = ", 5 steps at a time" if len(parts) > 4 else ""
            lines.setdefault((f"{parts[1]}, {storage}{steps}", False), []).append((_side(r["row"]), r["rate"] / 1e3))
    for p in result["peers"]:
        if p["row"].startswith("wave_step/"):
            if p["threads"] == most or p["peer"] == "numpy":
                kind = {"rg16f": " (half)", "rg32f": " (float)"}.get(p["row"].split("/")[2], "")
                lines.setdefault((p["peer"] + kind, True), []).append((_side(p["row"]), p["rate"] / 1e3))
    sides = sorted({x for points in lines.values() for x, _ in points})
    return svg(f"wave_step on {most} threads (medians)", "side of the level [cells]", "Gcell/s",
               [(name, points, {"dashed": peer}) for (name, peer), points in lines.items()], x_ticks=sides)


SCALING = ("wave_step/corrected/rg16f/1024", "wave_step/corrected/rg32f/4096", "wave_step/corrected/rg32f/4096/steps:5", "integrate/corrected/1000000",
           "splat/corrected/100000", "composite/corrected/1920x1080", "edge_splash.splash/corrected/1920x1080",
           "rain_on_glass/corrected/pane/1080p", "screen_drops.drops/corrected/still/1080p", "surface_hit/corrected/1280x720")


def scaling(result):
    """Rate on N threads over the rate on one."""
    series = []
    for name in SCALING:
        of = {r["threads"]: r["rate"] for r in result["rows"] if r["row"] == name}
        if 1 in of and len(of) > 1:
            series.append((name.replace("/corrected", ""), [(n, rate / of[1]) for n, rate in of.items()], {}))
    if not series:
        return ('<svg xmlns="http://www.w3.org/2000/svg" width="400" height="40"><text x="10" y="25">no rows on several threads</text></svg>\n')
    threads = sorted({x for _, points, _ in series for x, _ in points})
    return svg("Rate over the rate on one thread (medians, corrected)", "threads", "times one thread", series, x_ticks=threads,
               roof=[("each thread as fast as one alone", 1.0)])


def roofline(result):
    """Rate over the rate that memory alone allows, both of the fastest go on all threads."""
    most = max(r["threads"] for r in result["rows"])
    series = []
    for r in result["rows"]:
        if "stream_percent" in r and r["threads"] == most and "/corrected" in r["row"] and "steps" not in r["row"]:
            best = r["rate"] * r["median_ms"] / r["best_ms"]
            series.append((r["row"].replace("/corrected", ""), [(best / r["stream_percent"] * 100, best)], {}))
    return svg(f"Roof of memory, {most} threads (fastest goes)", "rate of a loop that only moves the same bytes [million items/s]",
               "rate [million items/s]", series, roof=[("the roof: 100 %", 1.0), ("10 %", 0.1), ("1 %", 0.01)], direct_labels=True)


PLOTS = {"size": size, "scaling": scaling, "roofline": roofline}
