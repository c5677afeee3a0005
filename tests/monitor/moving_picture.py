"""Takes docs/pictures/monitor.gif, the README's moving picture: a person moves a simulated muscle on the live page.

No test: it shows what page_test.py tests. Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import io
import itertools
import time

from page_test import PICTURES, Page
from PIL import Image
from programs import monitor, simulated_board

WIDTH, HEIGHT = 1200, 690
SHOWN_WIDTH = 900  # the width that a Git host gives a picture
COLOURS = 64
TRIES = 6
PERIOD_S = 0.35
# The second from which on the muscle is moved, and where to; it is cold before the first.
MOVES_MM = {0.5: 8.0, 5.0: 14.0, 9.5: 5.0}
DURATION_S = 14.0


def frames(page):
    moves, begin_s = dict(MOVES_MM), time.monotonic()
    while (now_s := time.monotonic() - begin_s) < DURATION_S:
        if moves and now_s >= min(moves):
            page.move(moves.pop(min(moves)))
        yield now_s, Image.open(io.BytesIO(page.driver.get_screenshot_as_png())).convert("RGB")
        time.sleep(max(0.0, begin_s + now_s + PERIOD_S - time.monotonic()))


def taken(page):
    """Repeats when the machine stalls for 0.25 s: then the command expires, as it must."""
    for _ in range(TRIES):
        page.arm()
        try:
            return zip(*frames(page))
        except AssertionError as late:
            print(f"once more: {str(late)[:40]}")
    raise SystemExit("this machine is too busy")


def main():
    board = simulated_board()
    program = monitor(f"socketcand:{board.found[1]}")
    try:
        with Page(width=WIDTH, height=HEIGHT) as page:
            page.screen(WIDTH, HEIGHT)
            page.open(program.found[0])
            page.click("input[name=span][value='10'] + span")
            at_s, pictures = taken(page)
    finally:
        program.stop()
        board.stop()
    small = [one.resize((SHOWN_WIDTH, SHOWN_WIDTH * HEIGHT // WIDTH), Image.LANCZOS) for one in pictures]
    palette = small[len(small) // 2].quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    small = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in small]
    shown_ms = [int(1e3 * (later - earlier)) for earlier, later in itertools.pairwise(at_s)] + [2000]
    file = PICTURES / "monitor.gif"
    small[0].save(file, save_all=True, append_images=small[1:], duration=shown_ms, loop=0, optimize=True)
    print(f"{file}: {len(small)} pictures, {file.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
