#!/usr/bin/python3
"""Runs the benchmarks once, tiny, and checks the form of their record: `smoke.py BUILD SUITE`. `smoke.py BUILD
--without-peers` does so where no peer was found, `--usage` looks at refusals. Times are not looked at."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMON = "schema version commit device driver cpu command seed timings ratios medians checks omitted peers".split()
RATIO = "name against quantity better median ci95 rounds repeatedRounds otherCpuSeconds".split()
# What each suite must compare, whatever the sizes: the last parts of the names of the ratios.
COMPARED = {
    "load": {("teapots", "tinygltf"), ("knot_2k", "tinygltf")},
    "bvh": {(part, peer) for part in ("tree", "fast", "medium", "high", "whole")
            for peer in ("embree_low", "embree_medium")},
    "rays": {(kind, peer) for kind in ("primary", "shadow", "bounce") for peer in ("embree1", "embree8")},
    "raster": {(method + kind, "osmesa" + kind) for method in ("flat", "gouraud", "phong") for kind in ("", "Float")},
    "start": {("warm", "cold")},
    "effects": {("specialized", "full")},
}
# What it compares with itself.
ALWAYS = {"bvh": {("refit", "medium"), ("load", "medium")}, "growth": {("threads2", "threads1")}}
# The scenes of "peers", and who draws them beside us where installed.
CONTESTS = {"knot": {"povray", "tachyon", "cycles"}, "spheres": {"povray"}, "knotRaster": {"f3d"}, "teapot": {"f3d"}}
PEER_OF = {"bvh": "embree", "rays": "embree", "raster": "osmesa"}
PARTS = "instance device pipelines upload render readback encode process".split()
ROUNDING = 1e-12  # of the exponential of a mean of logarithms, in double


def demand(condition, text):
    if not condition:
        sys.exit(f"FAILED: {text}")


def run(command, **environment):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=110, check=False,
                          env={**os.environ, **environment})
    print(done.stdout, done.stderr, sep="")
    return done


def check_ratio(ratio):
    demand(set(RATIO) <= ratio.keys(), f"ratio {ratio} lacks a field")
    low, high = ratio["ci95"]
    demand(0 < low <= ratio["median"] <= high and math.isfinite(high), f"interval of {ratio}")
    demand(ratio["rounds"] == 1, f"rounds of {ratio}")
    demand(ratio["otherCpuSeconds"] is None or ratio["otherCpuSeconds"] >= 0, f"load of {ratio}")
    demand((ratio["quantity"], ratio["better"]) in {("time", "less"), ("rate", "more")}, f"sense of {ratio}")


def check_record(record, suites):
    demand(set(COMMON) <= record.keys(), f"the record lacks {set(COMMON) - record.keys()}")
    demand(record["command"] == "bench" and record["driver"] and record["cpu"], "head of the record")
    demand(set(record["timings"]) == {suite + "Ms" for suite in suites}, f"timings {record['timings']}")
    for ratio in record["ratios"]:
        check_ratio(ratio)
    named = {median["name"]: median for median in record["medians"]}
    for median in named.values():
        demand(0 <= median["min"] <= median["median"] <= median["max"], f"order of {median}")
    for ratio in record["ratios"]:
        demand(ratio["name"] in named and ratio["against"] in named, f"absolute figures of {ratio}")
    for check in record["checks"]:
        demand(check["passed"], f"{check}")
    return named


def check_peers(record):
    """Each peer of each scene is compared or left out with the reason; our own warm start is compared with the cold one."""
    ratios = {(ratio["name"], ratio["against"]) for ratio in record["ratios"]}
    omitted = {item["name"]: item["reason"] for item in record["omitted"]}
    for scene, peers in CONTESTS.items():
        ours = f"peers.{scene}.crosslight"
        demand((ours, ours + "Cold") in ratios, f"{scene}: no cold start among {ratios}")
        for peer in peers:
            theirs = f"peers.{scene}.{peer}"
            compared = {(ours + end, theirs + end2) for end, end2 in (("", ""), ("Cold", ""), (".user", ".user"))}
            if theirs in omitted:
                demand(omitted[theirs] and not compared & ratios, f"{theirs} is left out, and compared or without reason")
            else:
                missing = {pair for pair in compared - ratios if not omitted.get(pair[1])}
                demand(not missing, f"neither compared nor left out: {missing}")


def check_suite(record, suite, named):
    if suite == "peers":
        return check_peers(record)
    found = {(r["name"].split(".")[-1], r["against"].split(".")[-1])
             for r in record["ratios"] if r["name"].startswith(suite + ".")}
    absent = suite in PEER_OF and not record["peers"][PEER_OF[suite]]
    expected = ALWAYS.get(suite, set()) | (set() if absent else COMPARED.get(suite, set()))
    demand(found == expected, f"{suite} compares {found}")
    left_out = [item for item in record["omitted"] if item["name"].startswith(suite)]
    demand(bool(left_out) == absent, f"{suite} leaves out {left_out}")
    demand(any(name.startswith(suite + ".") for name in named), f"no absolute figure of {suite}")
    if suite == "effects":
        gains = {c["name"]: c for c in record["checks"] if c["name"].endswith("Gain")}
        demand(len(gains) == 6, f"gains {list(gains)}")
        for gain in gains.values():
            demand(0 < gain["least"] <= gain["geometricMean"] * (1 + ROUNDING), f"{gain}")
    if suite == "start":
        for part in PARTS:
            demand(f"start.cold.{part}" in named and f"start.warm.{part}" in named, f"start lacks {part}")
    if suite == "rays" and not absent:
        for kind in ("primary", "shadow", "bounce"):
            for width in (1, 8):
                checks = [c for c in record["checks"] if c["name"].endswith(f".{kind}.embree{width}")]
                demand(len(checks) == 1 and 0 < checks[0]["hits"] < checks[0]["rays"], f"comparison of {kind}: {checks}")
                demand(f"rays.2k.64.{kind}.rate" in named, f"no rate of {kind}")


def smoke(command, suites, **environment):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "record.json"
        done = run([*command, *suites, "--rounds", 1, "--quick", "--json", file], **environment)
        demand(done.returncode == 0, f"exit code {done.returncode}")
        record = json.loads(file.read_text())
    named = check_record(record, suites)
    for suite in suites:
        check_suite(record, suite, named)
    return record, done


def usage(command):
    for words in (["nonsense"], ["--rounds", "0"], ["--rounds", "x"], ["--rounds"]):
        done = run([*command, *words])
        demand(done.returncode == 2 and done.stderr, f"{words} ends with {done.returncode}")
    done = run([*command, "load", "--json", "/nonexistent/record.json"])
    demand(done.returncode == 3 and "nonexistent" in done.stderr, f"a bad place ends with {done.returncode}")


def main(build, what):
    command = [ROOT / "tools/bench/run", "--build", build]
    if what == "--usage":
        usage(command)
    elif what == "--without-peers":
        alone = [pathlib.Path(build) / "crosslight_bench_alone", "--scenes", ROOT / "scenes"]
        record, done = smoke(alone, ["bvh", "rays", "raster"])
        demand(record["peers"]["embree"] is None and record["peers"]["osmesa"] is False, "peers")
        with tempfile.TemporaryDirectory() as nothing:  # no program is on this PATH
            unaccompanied, _ = smoke(alone, ["peers"], PATH=nothing)
        demand(len(unaccompanied["omitted"]) == sum(map(len, CONTESTS.values())), f"{unaccompanied['omitted']}")
        demand(done.stderr.count("left out") == 3 and done.stdout.count("left out") == 3, "left out, but not said")
    else:
        smoke(command, [what])


main(*sys.argv[1:])
