# SPDX-License-Identifier: GPL-3.0-or-later
"""Options and tables of the benchmarks, without VTK."""

import argparse


def parser_of(text):
    """text: the docstring of a script."""
    return argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)


def add_numbers(parser, **defaults):
    """Options --name of numbers, or of lists of numbers."""
    for name, default in defaults.items():
        is_list = isinstance(default, list)
        parser.add_argument("--" + name, type=type(default[0] if is_list else default), default=default,
                            nargs="*" if is_list else None, help=f"default: {default}")


def print_head(*columns):
    print("|", " | ".join(columns), "|\n" + "|---" * len(columns) + "|", flush=True)


def print_row(*cells):
    print("|", " | ".join(map(str, cells)), "|", flush=True)
