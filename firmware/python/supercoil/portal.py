"""An event loop in a thread of its own, for programs without asyncio."""

import asyncio
import concurrent.futures
import threading
from collections.abc import Coroutine
from typing import Any, TypeVar

T = TypeVar("T")

_lock = threading.Lock()
_loop: asyncio.AbstractEventLoop | None = None


def _loop_of_thread() -> asyncio.AbstractEventLoop:
    global _loop
    with _lock:
        if _loop is None:
            _loop = asyncio.new_event_loop()
            threading.Thread(target=_loop.run_forever, name="supercoil", daemon=True).start()
        return _loop


def run(work: Coroutine[Any, Any, T]) -> T:
    """The result of work; Ctrl-C cancels it."""
    future = asyncio.run_coroutine_threadsafe(work, _loop_of_thread())
    try:
        return future.result()
    except (KeyboardInterrupt, SystemExit):
        future.cancel()
        concurrent.futures.wait([future], timeout=1.0)
        raise
