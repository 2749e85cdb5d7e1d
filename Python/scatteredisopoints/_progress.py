# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of long calls: a callback of the caller, or a bar of tqdm or rich."""

from __future__ import annotations

import contextlib
import importlib.util
from typing import Any, Callable, Iterator, Optional, Union

Progress = Union[None, bool, Callable[[float], Any]]
"""None or False: none. True: a bar. Otherwise called with the share that is done, from 0 to 1."""


@contextlib.contextmanager
def shown_progress(progress: Progress, title: str) -> Iterator[Optional[Callable[[float], Any]]]:
    """A function to call with the share done, or None. Raises ImportError if a bar is wanted and no package
    for it is installed."""
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        yield progress
    elif progress is not True:
        raise TypeError(f"progress cannot be {progress!r}: it is a function, True or None")
    elif importlib.util.find_spec("tqdm") is not None:
        from tqdm.auto import tqdm

        with tqdm(total=100, desc=title, unit="%", bar_format="{l_bar}{bar}| {elapsed}") as bar:
            def advance(fraction: float) -> None:
                bar.update(round(100 * fraction) - bar.n)

            yield advance
    elif importlib.util.find_spec("rich") is not None:
        from rich.progress import Progress as Bar

        with Bar(transient=True) as bar:
            task = bar.add_task(title, total=1.0)
            yield lambda fraction: bar.update(task, completed=fraction)
    else:
        raise ImportError("A progress bar needs tqdm or rich: pip install tqdm, or pass a function"
                          " that is called with the share that is done.")


def part(report: Optional[Callable], begin: float, end: float) -> Optional[Callable[[float], Any]]:
    """Reports the share done of a part of the work, from begin to end; None without a report."""
    return None if report is None else lambda fraction: report(begin + fraction * (end - begin))
