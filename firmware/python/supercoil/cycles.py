"""Several muscles in one call."""

import asyncio
from collections.abc import Sequence

from supercoil.commands import Order
from supercoil.generated import messages


async def cycle(orders: Sequence[Order]) -> list[messages.Measurement]:
    """All orders are sent before an answer is waited for. The newest measurement of each, in their order; where one is
    refused, all others are obeyed all the same, and the first refusal is raised."""
    answers = await asyncio.gather(*(order.muscle.execute(order) for order in orders), return_exceptions=True)
    measurements = []
    for answer in answers:
        if isinstance(answer, BaseException):
            raise answer
        measurements.append(answer)
    return measurements
