"""Several muscles in one call."""

import asyncio
from collections.abc import Awaitable, Iterable, Sequence
from typing import TypeVar

from supercoil.commands import Order
from supercoil.generated import messages

T = TypeVar("T")


async def all_of(calls: Iterable[Awaitable[T]]) -> list[T]:
    """At the same time, each to its end; then the first exception is raised."""
    results = []
    for result in await asyncio.gather(*calls, return_exceptions=True):
        if isinstance(result, BaseException):
            raise result
        results.append(result)
    return results


async def cycle(orders: Sequence[Order]) -> list[messages.Measurement]:
    """All orders are sent before an answer is waited for. The newest measurement of each, in their order; where one is
    refused, all others are obeyed all the same, and the first refusal is raised."""
    return await all_of(order.muscle.execute(order) for order in orders)
