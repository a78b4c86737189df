#!/usr/bin/env python3
"""Many random stills (tests/fuzz/random_scenes.py): in one process, whose memory must stay flat; by the command, one process
each; and many commands at once in one folder, each of which must give its picture and leave nothing else.

usage: run.py RAMIFY SOAK COUNT FOLDER      SOAK is tests/soak/soak.c; FOLDER gets the scenes and memory.txt
"""
import concurrent.futures
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WARM_UP = 0.2  # of the stills: caches, threads' stacks and arenas of malloc fill
HEAP_SLACK = 64 << 10  # bytes that the allocated memory may have grown by: what a scene is the first to need
LEAK = 512  # bytes of each still that the allocated memory may have grown by further
RSS_SLACK = 0.05  # share by which the process's floor may have risen: malloc's free lists shift, and large scenes stretch them
AT_ONCE = 100
SECONDS = 600


def in_one_process(soak, scenes, folder):
    """What is wrong: memory that grows, stills that are missing."""
    start = time.monotonic()
    with open(folder / "memory.txt", "w") as out, open(folder / "errors.txt", "w") as err:
        with tempfile.TemporaryDirectory() as pictures:
            # No chunks in malloc's lists of threads, which count as allocated.
            status = subprocess.run([soak, f"{pictures}/x.png", *scenes], stdout=out, stderr=err,
                                    env=os.environ | {"GLIBC_TUNABLES": "glibc.malloc.tcache_count=0"}).returncode
            left = sorted(os.listdir(pictures))
    rows = [[int(word) for word in line.split()] for line in (folder / "memory.txt").read_text().splitlines()]
    refused = len((folder / "errors.txt").read_text().splitlines())
    rows = rows[int(WARM_UP * len(rows)):]
    part = max(1, len(rows) // 4)
    heap = [statistics.median(row[1] for row in rows[a:b]) for a, b in ((0, part), (-part, None))]
    rss = [min(row[2] for row in rows[a:b]) for a, b in ((0, part), (-part, None))]
    print(f"in one process: {len(scenes) - refused} stills, {refused} refused, {time.monotonic() - start:.0f} s; after the "
          f"warm-up, first and last quarter: {heap[0] / 1e6:.3f} and {heap[1] / 1e6:.3f} MB allocated, "
          f"at least {rss[0] / 1e6:.1f} and {rss[1] / 1e6:.1f} MB resident")
    wrong = [] if status == 0 else [f"exit status {status}"]
    wrong += [f"files are left: {left}"] if left not in (["x.png"], []) else []
    between = len(rows) - part  # stills from the middle of the first quarter to that of the last
    print(f"allocated memory grows by {(heap[1] - heap[0]) / max(1, between):.0f} bytes a still")
    wrong += ["the allocated memory grows"] if heap[1] > heap[0] + HEAP_SLACK + LEAK * between else []
    wrong += ["the process grows"] if part >= 20 and rss[1] > (1 + RSS_SLACK) * rss[0] else []  # few have no plateau
    return wrong


def command(ramify, scene, picture, folder):
    return subprocess.run([ramify, "render", scene, "-q", "--no-preview", "--threads", "2", "-o", picture], cwd=folder,
                          capture_output=True, text=True, timeout=SECONDS)


def by_commands(ramify, scenes, jobs):
    """What is wrong with as many commands, so many at once, all in one folder."""
    start, wrong, expected = time.monotonic(), [], set()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(lambda scene: command(ramify, scene, f"{scene.stem}.png", folder), scenes))
        for scene, result in zip(scenes, results):
            if result.returncode == 0:
                expected |= {f"{scene.stem}.png", f"{scene.stem}.exr"}
            if result.returncode not in (0, 2) or (result.returncode == 0 and result.stderr.strip()
                                                   and "warning" not in result.stderr):
                wrong.append(f"{scene.name}: exit status {result.returncode}: {result.stderr[-200:]}")
        found = set(os.listdir(folder))
    rendered = sum(result.returncode == 0 for result in results)
    print(f"by commands, {jobs} at once: {rendered} stills, {len(scenes) - rendered} refused, {time.monotonic() - start:.0f} s")
    return wrong + ([f"files are left or missing: {sorted(found ^ expected)[:8]}"] if found != expected else [])


def main(ramify, soak, count, folder):
    ramify, soak, folder = str(Path(ramify).resolve()), str(Path(soak).resolve()), Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, ROOT / "tests/fuzz/random_scenes.py", "--write", ramify, count, "1", folder / "scenes"],
                   check=True)
    scenes = sorted(folder.glob("scenes/*.yaml"), key=lambda file: int(file.stem))
    wrong = in_one_process(soak, scenes, folder)
    wrong += by_commands(ramify, scenes, 1)
    wrong += by_commands(ramify, scenes[:AT_ONCE], AT_ONCE)
    print("".join(f"not ok: {one}\n" for one in wrong) or "ok", flush=True)
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
