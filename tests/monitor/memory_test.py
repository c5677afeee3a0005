"""How much memory the page takes for an hour of four muscles at 100 Hz, and whether it stays smooth. Not run by itself.

An hour is fed in a minute or two, through the usual stream; then it goes on in real time while frames are counted.
"""

import pathlib
import sys
import time

from browser import Browser
from hour_source import HourSource

HOUR_S = 3600.0
# By then the ring moves on: it takes no more than this.
FED_S = HOUR_S + 120.0
PIECE_S = 2.0
LIVE_S = 0.05
MOST_MB = 200.0
WATCHED_S = 10.0

FRAMES = """
const [resolve] = arguments;
const frames = [];
const end = performance.now() + %d;
const frame = (now) => {
  frames.push(now);
  if (now < end) requestAnimationFrame(frame);
  else resolve(frames.slice(1).map((time, i) => time - frames[i]).sort((a, b) => a - b));
};
requestAnimationFrame(frame);
"""
MEMORY = "const [resolve] = arguments; performance.measureUserAgentSpecificMemory().then((m) => resolve(m.bytes), () => resolve(-1))"


def renderer_MB():
    """Private memory of the largest renderer among our own children: the page's."""
    def parent(pid):
        return int((pathlib.Path("/proc") / pid / "stat").read_text().rpartition(")")[2].split()[1])

    def is_ours(pid):
        while pid not in ("0", "1"):
            if pid == str(pathlib.os.getpid()):
                return True
            pid = str(parent(pid))
        return False

    sizes = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if b"--type=renderer" not in (folder / "cmdline").read_bytes() or not is_ours(folder.name):
                continue
            lines = (folder / "smaps_rollup").read_text().splitlines()
        except OSError:
            continue
        sizes.append(sum(int(line.split()[1]) for line in lines if line.startswith("Private_")) / 1024)
    return max(sizes)


def measure(browser, what):
    total = browser.driver.execute_async_script(MEMORY)
    browser.cdp("HeapProfiler.collectGarbage")
    heap = browser.run("return performance.memory.usedJSHeapSize")
    renderer = renderer_MB()
    print(f"{what}: page {total / 1e6:.0f} MB, of it JS heap {heap / 1e6:.0f} MB; renderer process {renderer:.0f} MB", flush=True)
    return total / 1e6


def watch_frames(browser, source, now_s, span_s):
    """Frames while data comes in real time."""
    browser.driver.execute_script(f"document.querySelector('input[name=span][value=\"{span_s}\"]').click()")
    browser.driver.set_script_timeout(60)
    browser.driver.execute_script("window.frames_ms = null; const done = (f) => { window.frames_ms = f; };"
                                  + FRAMES.replace("const [resolve] = arguments;", "const resolve = done;") % (WATCHED_S * 1e3))
    begin_s = time.monotonic()
    sent_s = 0.0
    while sent_s < WATCHED_S + 1.0:
        if time.monotonic() - begin_s >= sent_s + LIVE_S:
            source.send(now_s + sent_s, now_s + sent_s + LIVE_S)
            sent_s += LIVE_S
        time.sleep(0.005)
    frames = browser.run("return window.frames_ms")
    at = [frames[min(len(frames) - 1, int(len(frames) * part))] for part in (0.5, 0.95, 0.99, 1.0)]
    print(f"{span_s} s shown: {len(frames) / WATCHED_S:.0f} frames/s, median, 95 %, 99 %, longest "
          + ", ".join(f"{frame:.0f}" for frame in at) + " ms", flush=True)
    return now_s + sent_s


def main():
    source = HourSource()
    with Browser(height=1400) as browser:
        browser.driver.get(source.address)
        source.send(0.0, PIECE_S)
        time.sleep(2.0)
        measure(browser, "empty")
        now_s = PIECE_S
        while now_s < FED_S:
            source.send(now_s, now_s + PIECE_S)
            now_s += PIECE_S
            if now_s % 600 < PIECE_S:
                print(f"fed {now_s:.0f} s", flush=True)
        for span_s in (60, 3600):
            now_s = watch_frames(browser, source, now_s, span_s)
        taken_MB = measure(browser, "an hour")
        hours = browser.run("return document.querySelector('#status').textContent")
        print(f"the page says: {hours}")
    return 0 if 0 < taken_MB < MOST_MB else 1


if __name__ == "__main__":
    sys.exit(main())
