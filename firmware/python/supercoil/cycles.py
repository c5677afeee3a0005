"""Commands several muscles in one call."""

import asyncio
from collections.abc import Awaitable, Iterable, Sequence
from typing import TypeVar

from supercoil.commands import Order
from supercoil.generated import messages

T = TypeVar("T")


async def all_of(calls: Iterable[Awaitable[T]]) -> list[T]:
    """Runs all calls at the same time, each to its end; then raises the first exception."""
    results = []
    for result in await asyncio.gather(*calls, return_exceptions=True):
        if isinstance(result, BaseException):
            raise result
        results.append(result)
    return results


async def cycle(orders: Sequence[Order]) -> list[messages.Measurement]:
    """Sends all orders before waiting for an answer. Returns the newest measurement of each, in the order of the
    orders. If one is refused, all others are still obeyed, and the first refusal is raised."""
    return await all_of(order.muscle.execute(order) for order in orders)
