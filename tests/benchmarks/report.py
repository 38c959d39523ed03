# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Markdown tables from the results of the benchmarks, each figure beside its goal."""

import json
import re
import statistics
import sys
from pathlib import Path

MICRO = 1e-6
UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Results:
    """Medians over the repetitions of each case of one run of a program."""

    def __init__(self, path):
        data = json.loads(Path(path).read_text())
        self.context = data["context"]
        self.cases = {}
        for entry in data["benchmarks"]:
            if entry.get("run_type") == "iteration" and not entry.get("error_occurred"):
                self.cases.setdefault(entry["run_name"], []).append(entry)

    def seconds(self, name):
        """CPU time, or wall time where the case measures that (or its own)."""
        kind = "real_time" if re.search("/(manual|real)_time$", name) else "cpu_time"
        return statistics.median(e[kind] * UNITS[e["time_unit"]] for e in self.cases[name])

    def counter(self, name, counter):
        return statistics.median(e[counter] for e in self.cases[name])

    def rate(self, name, counter):
        return self.counter(name, counter) / self.seconds(name)


def percent(x):
    return f"{100 * x:.0f} %"


def times(x):
    return f"{x:.1f} ×"


def micro(x):
    return f"{x / MICRO:.3g} µs"


def assembly_rows(folder):
    small, large = Results(folder / "assembly.json"), Results(folder / "assembly_large.json")
    kinds = {0: "vertex", 1: "averaged"}
    for kind, word in kinds.items():
        name = f"assemble/n:2562/averaged:{kind}/threads:1"
        plain = large.seconds(f"assemblePlainly/n:2562/averaged:{kind}")
        yield (f"assembly, n = 2562, {word} collocation, over plain Eigen", "≥ 6 ×",
               times(plain / large.seconds(name)))
        yield f"the same, pairs a second", "≥ 12 M", f"{large.rate(name, 'pairs') / 1e6:.1f} M"
    for kind, word in kinds.items():
        name = f"assemble/n:642/averaged:{kind}/threads:1"
        plain = small.seconds(f"assemblePlainly/n:642/averaged:{kind}")
        yield (f"assembly, n = 642, {word} collocation, over plain Eigen", "",
               times(plain / small.seconds(name)))
        case = f"integrate/n:642/averaged:{kind}/closed:"
        whole, rules = small.seconds(case + "1"), small.seconds(case + "0")
        near = whole - rules * (1 - small.counter(case + "1", "closed_share"))
        yield f"near pairs' share of the integration, n = 642, {word}", "≤ 25 %", percent(near / whole)
    for kind, word in kinds.items():
        wall = [large.seconds(f"assembleWallTime/n:2562/averaged:{kind}/threads:{t}/real_time")
                for t in (1, 2)]
        yield f"assembly, n = 2562, {word}, two threads (wall time)", "≥ 1.6 ×", times(wall[0] / wall[1])
    rates = []
    for name in ("baseline", "avx2", "avx512"):
        run = Results(folder / f"assembly_{name}.json")
        if run.context["instruction_set"] == name:
            rates.append(f"{run.rate('assemble/n:642/averaged:1/threads:1', 'pairs') / 1e6:.1f} M {name}")
    yield "pairs a second, n = 642, averaged, by instruction set", "", ", ".join(rates)


def solve_rows(folder):
    run = Results(folder / "solve.json")
    for n in (642, 1280):
        for few, word in ((0, "all free columns"), (1, "few columns")):
            case = f"/n:{n}/few:{few}"
            ours = run.seconds("solveInOnePrecision<double>" + case)
            size = int(run.counter("solveMixed" + case, "N"))
            columns = int(run.counter("solveMixed" + case, "columns"))
            yield (f"factor + solve, N = {size}, {columns} columns, of LAPACK's rate", "≥ 90 %",
                   percent(run.seconds("solveByLapack" + case) / ours))
            yield (f"the same, mixed over double time ({word})", "≤ 0.65",
                   f"{run.seconds('solveMixed' + case) / ours:.2f}")
            yield (f"the same, float over double time", "",
                   f"{run.seconds('solveInOnePrecision<float>' + case) / ours:.2f}")
    case = "/n:1280/few:2"
    size, products = (int(run.counter("solveIterative" + case, name)) for name in ("N", "products"))
    yield (f"one node's columns by {products} iterations over factoring, N = {size}", "",
           f"{run.seconds('solveIterative' + case) / run.seconds('solveInOnePrecision<double>' + case):.2f}")


def precompute_rows(folder):
    for file, n, goal in (("precompute", 642, "about 1 s"), ("precompute_large", 2562, "about 30 s")):
        run = Results(folder / f"{file}.json")
        for name, cases in run.cases.items():
            word = re.search("<(.*)>", name).group(1)
            yield (f"precomputation, n = {n}, {word}, one thread", goal if word == "double" else "",
                   f"{run.seconds(name):.2f} s")
            peak = max(entry["peak"] for entry in cases)
            yield "the same, peak memory over 8 (3n)² bytes", "≤ 2.2", f"{peak:.2f}"


def deformation_rows(folder):
    run = Results(folder / "deformation.json")

    def bandwidth(kind, n):
        return max(run.rate(f"read{kind}<{stream}>/n:{n}", "bytes")
                   for stream in ("readInOneStream", "readInEightStreams"))

    for kind, n, goal in (("Cold", 2562, "≥ 85 %"), ("Hot", 642, "≥ 60 %")):
        read = bandwidth(kind, n)
        place = "memory's" if kind == "Cold" else "the second-level cache's"
        for scalar in ("double", "float"):
            share = run.rate(f"sum{kind}<{scalar}>/n:{n}", "bytes") / read
            yield (f"deformation sum, {scalar}, of {place} {read / 1e9:.0f} GB/s",
                   goal if scalar == "double" else "", percent(share))
        ratio = run.seconds(f"sum{kind}<float>/n:{n}") / run.seconds(f"sum{kind}<double>/n:{n}")
        yield f"float over double time, {kind.lower()}", "≤ 0.55" if kind == "Cold" else "", f"{ratio:.2f}"


def contact_rows(folder):
    run = Results(folder / "contact.json")
    best = min(run.seconds(f"factorBy{library}/n:642/s:100") for library in ("Eigen", "Lapack"))
    for word, name, goal in (("add", "addNode", 12), ("remove", "removeNode", 30)):
        seconds = run.seconds(f"{name}/n:642/s:100/manual_time")
        yield (f"{word} a node at s = 100 ({micro(seconds)}), over the best LU ({micro(best)})",
               f"≥ {goal} ×", times(best / seconds))
    ticks = (("tick of a masked point contact, sliding", "tickOfPointContact/n:642", "≤ 5 µs"),
             ("the same with all points of fig. 8, sticking", "tickOfStickingContact/n:642", "≤ 5 µs"),
             ("tick at s = 40, one node enters", "tickWithOneAddition/n:642/s:40/manual_time", "≤ 50 µs"),
             ("tick at s = 40, one node for another", "tickWithOneChange/n:642/s:40", "≤ 50 µs"),
             ("tick at s = 100, one node enters", "tickWithOneAddition/n:642/s:100/manual_time", "≤ 100 µs"),
             ("tick at s = 100, one node for another", "tickWithOneChange/n:642/s:100", "≤ 100 µs"))
    for word, name, goal in ticks:
        yield word, goal, micro(run.seconds(name))
    yield ("heap allocations in all of these ticks", "0",
           f"{sum(run.counter(name, 'allocations') for _, name, _ in ticks):.0f}")


def haptics_rows(folder):
    for file, n in (("haptics", 642), ("haptics_large", 2562)):
        run = Results(folder / f"{file}.json")
        for name, word, goal in (("tickOfPointTouch", "tick of a point that slides with friction", "≤ 5 µs"),
                                 ("tickOfPointTouchWithSnapshot", "the same and its snapshot", "")):
            case = next(c for c in run.cases if c.startswith(f"{name}/n:{n}"))
            for kind, words in (("", f"{word}, n = {n}, p50 / p99 / p99.9 / max of the CPU time"),
                                ("own_", "the same, each tick in the quickest of five passes")):
                figures = " / ".join(f"{run.counter(case, kind + p):.2g}"
                                     for p in ("p50", "p99", "p99_9", "max"))
                yield words, goal, f"{figures} µs"
            yield ("the same, heap allocations", "0", f"{run.counter(case, 'allocations'):.0f}")
    run = Results(folder / "haptics_large.json")
    for s, goal in ((40, "≤ 200 µs"), (100, "≤ 1000 µs")):
        case = next(c for c in run.cases if c.startswith(f"tickOfBall/n:2562/s:{s}/"))
        for kind, words in (("", f"tick of a ball that rubs with friction, n = 2562, {run.counter(case, 'contacts'):.0f} "
                                 "vertices under force on average, p50 / p99 / p99.9 / max of the CPU time"),
                            ("own_", "the same, each tick in the quickest of five passes")):
            figures = " / ".join(f"{run.counter(case, kind + p):.3g}"
                                 for p in ("p50", "p99", "p99_9", "max"))
            yield words, goal, f"{figures} µs"


def servo_rows(folder):
    run = Results(folder / "servo.json")
    case = next(c for c in run.cases if c.startswith("devicesBesideFrames/tools:2/n:2562"))
    for prefix, words in (("", "tick of two balls with friction, n = 2562, {contacts:.0f} vertices under force, "
                               "beside {frames_a_second:.0f} deformations of all vertices a second, "
                               "p50 / p99 / p99.9 / max of the CPU time"),
                          ("late_", "the same, how late the ticks begin (the system's share)")):
        counters = {name: run.counter(case, name) for name in ("contacts", "frames_a_second")}
        figures = " / ".join(f"{run.counter(case, prefix + p):.3g}" for p in ("p50", "p99", "p99_9", "max"))
        yield words.format(**counters), "" if prefix else "≤ 1000 µs", f"{figures} µs"
    yield ("the same, each deformation, p50 / max of the CPU time", "",
           f"{run.counter(case, 'frame_p50'):.3g} / {run.counter(case, 'frame_max'):.3g} µs")


def print_table(header, rows):
    print("| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def print_paper_tables(folder):
    run = Results(folder / "james_pai.json")
    print("[JP01] Table 2, the paper's figures in brackets\n")
    rows = []
    for name in ("nodule", "kidney", "spatula", "banana_seat"):
        whole, tick = f"table2Precompute/{name}", f"table2Simulate/{name}"
        seconds = run.seconds(whole)
        rows.append((f"{name.replace('_', ' ')}, {run.counter(whole, 'vertices'):.0f} "
                     f"({run.counter(whole, 'free'):.0f} free)",
                     f"{run.counter(whole, 'faces'):.0f}",
                     f"{seconds:.2f} s ({run.counter(whole, 'paper_minutes'):g} min)",
                     f"{percent(run.counter(whole, 'lu_seconds') / seconds)} "
                     f"({run.counter(whole, 'paper_lu_percent'):g} %)",
                     f"{micro(run.seconds(tick))} ({run.counter(tick, 'paper_ms'):g} ms)"))
    print_table(("model, vertices", "faces", "precompute", "LU's share", "simulate"), rows)
    print("[JP01] Table 3\n")
    rows = []
    for s in (10, 20, 40, 100):
        cells = [str(s)]
        for name in ("Factor", "Update", "Solve", "Apply", "Sum"):
            case = f"table3{name}/s:{s}"
            seconds = run.seconds(case)
            if name == "Sum":
                seconds *= 100 / run.counter(case, "nodes")
            paper = "" if name in ("Update", "Apply") else f" ({run.counter(case, 'paper_ms'):g} ms)"
            cells.append(micro(seconds) + paper)
        rows.append(cells)
    print_table(("s", "LU factor", "kept inverse, one node out and in", "LU solve",
                 "kept inverse applied", "sum for 100 nodes"), rows)


def main():
    folder = Path(sys.argv[1])
    rows = []
    for part in (assembly_rows, solve_rows, precompute_rows, deformation_rows, contact_rows,
                 haptics_rows, servo_rows):
        rows += part(folder)
    print_table(("quantity", "goal", "measured"), rows)
    print_paper_tables(folder)


if __name__ == "__main__":
    main()
