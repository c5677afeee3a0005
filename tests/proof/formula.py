"""Values of formulas in SMT-LIB's notation, with 50 digits."""

import decimal
import functools
import operator
import re

decimal.getcontext().prec = 50

OPERATIONS = {"+": operator.add, "*": operator.mul, "/": operator.truediv, ">": operator.gt,
              "not": operator.not_, "exponential": decimal.Decimal.exp,
              "-": lambda a, b=None: -a if b is None else a - b}


@functools.cache
def tree_of(text):
    stack = [[]]
    for token in re.findall(r"[()]|[^\s()]+", text):
        if token == "(":
            stack.append([])
        elif token == ")":
            stack[-2].append(stack.pop())
        else:
            stack[-1].append(token)
    (tree,) = stack[0]
    return tree


def value_of(formula, values):
    """formula: text, or a part of its tree; values: of its names."""
    if isinstance(formula, str):
        if formula.startswith("("):
            formula = tree_of(formula)
        else:
            return values[formula] if formula in values else decimal.Decimal(formula)
    operation, *operands = formula
    return OPERATIONS[operation](*(value_of(operand, values) for operand in operands))


def decimals_of(hexadecimals):
    """Doubles as C's %a prints them."""
    return [decimal.Decimal(float.fromhex(text)) for text in hexadecimals]


def exact(number):
    """A rational or algebraic number of z3."""
    rational = number if hasattr(number, "as_fraction") else number.approx(60)
    fraction = rational.as_fraction()
    return decimal.Decimal(fraction.numerator) / decimal.Decimal(fraction.denominator)
