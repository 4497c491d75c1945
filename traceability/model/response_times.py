"""Upper bounds of three kinds of times: the response time of each interrupt, the response time of
the control cycle, and the time from an input to its effect.

Each bound includes the time of the interrupts that can occur before the response. The computation
assumes that each interrupt occurs as often as it can. Each bound also includes the longest time for
which code of a lower priority blocks the interrupts. This time is added only once. When the
interrupts are enabled again, code of a lower priority waits until the response."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from traceability.model.design_model import Model
from traceability.model.image_code import ImageCode
from traceability.model.interrupt_locks import longest_locks
from traceability.model.stack import Prover, read_declared
from traceability.model.time_bounds import DeclaredFacts, Limit, Spread, Times
from traceability.reading.call_record import BYTE_RECEIVED, Recording, read_recordings
from traceability.reading.chains import Chain, declared_chains, follow, frames_in
from traceability.reading.loop_bounds import Bounds, Inequality, Place, read_inequality
from traceability.reading.products import DEFAULT
from traceability.reading.results import numbers_reported
from traceability.reading.source_facts import Facts
from traceability.schema import VIRTUAL_K64, ExecutionContext, PathBound, TimeBound, TimeProof
from traceability.schema import Place as SourcePlace

DECLARED_IN = Path("design/times.toml")
# Processor cycles that the hardware needs for an interrupt: entry, exit, and the change to the
# interrupt that follows.
ENTRY_AND_EXIT = 12 + 10 + 6
# Processor cycles of an additional iteration of a loop with LDREX and STREX. An interrupt during
# the loop causes this iteration.
RETRY = 12
CYCLE_TIMER, TICK_TIMER = "cycle-timer", "tick-timer"
MOST_ROUNDS = 100
CLOCK = 120_000  # processor cycles in a tick of 1 ms
NANOSECONDS = 1_000_000  # nanoseconds in a millisecond


def prove_times(
    root: Path, model: Model, facts: Facts, image: ImageCode | None
) -> TimeProof | None:
    """Returns the upper bounds of the response times in the firmware image of the robot. Returns
    None if no firmware image was built from the present sources, or if ``design/times.toml`` is
    missing."""
    if image is None or not (root / DECLARED_IN).exists():
        return None
    declared = tomllib.loads((root / DECLARED_IN).read_text(encoding="utf-8"))
    times = declared_times(root, model, facts, image, declared)
    arrivals = {
        entry["context"]: entry
        | {
            name: times.bounds.value(str(entry[name]))
            for name in ("entries", "noise")
            if name in entry
        }
        for entry in declared["arrival"]
    }
    activations = {entry["context"]: entry["without"] for entry in declared["activations"]}
    locks = longest_locks(image.program.codes)
    locked = int(max((cycles for _, cycles in locks.values() if cycles != math.inf), default=0))
    contexts = with_responses(
        (
            bound
            for context in model.contexts.values()
            if context.kind != "start"
            and (bound := _of_context(context, times, arrivals, activations.get(context.id, [[]])))
        ),
        locked,
    )
    cycle_ms = cycle_response(contexts, locked, noise=False) / CLOCK
    recordings = read_recordings(root) or {}
    return TimeProof(
        contexts=contexts,
        cycle_ms=cycle_ms,
        noise_ms=cycle_response(contexts, locked, noise=True) / CLOCK,
        seen_ms=_seen(root, model),
        paths=_paths(
            root, declared["path"], contexts, cycle_ms, times.bounds, recordings=recordings
        ),
        unbound=in_order(times.unbound),
        unresolved=in_order(times.unresolved),
        locked=locked,
        unbound_locks=in_order(
            (symbol, image.program.places[address][0])
            for address, (symbol, cycles) in locks.items()
            if cycles == math.inf
        ),
        too_often=[
            (bound.context, name, *requests)
            for bound in contexts
            for name, recording in recordings.items()
            if (requests := too_many(bound, model.contexts[bound.context].handlers, recording))
        ],
    )


def in_order(places: Iterable[tuple[str, Place]]) -> list[tuple[str, SourcePlace]]:
    """Returns pairs of a function and a place, sorted by the name of the function, the file and the
    line number."""
    return [(name, SourcePlace(*place)) for name, place in sorted(places)]


def declared_times(
    root: Path, model: Model, facts: Facts, image: ImageCode, declared: Mapping[str, Any]
) -> Times:
    """Returns the object that computes the execution times in a firmware image. It uses the facts
    that ``design/times.toml`` declares."""
    prover = Prover(image.graph, facts, model, read_declared(root, facts))
    values = model.integers | declared["values"]
    for name, member in declared["counted"].items():
        if classes := {item.kind for item in facts.robot.objects([f"field {member}"])}:
            values[name] = len(classes)
    once = [name for entry in declared["once"] for name in entry["methods"]]
    bounds = Bounds(root, values)
    limits = [
        Limit(entry["method"], entry["within"], entry["counter"]) for entry in declared["limited"]
    ]
    spread = [
        Spread(
            entry["method"],
            entry["within"],
            bounds.value(entry.get("rounds", "0")),
            entry.get("counter", ""),
        )
        for entry in declared["spread"]
    ]
    flows, wrong = _flows(declared["flow"], bounds)
    times = Times(image.program, bounds, prover, DeclaredFacts(once, limits, spread, flows))
    times.unbound |= {(method, (str(DECLARED_IN), 1)) for method in wrong}
    return times


def _flows(
    declared: Iterable[Mapping[str, Any]], bounds: Bounds
) -> tuple[dict[str, list[Inequality]], list[str]]:
    """Returns the declared inequalities of each method, and the methods with an inequality that
    cannot be read."""
    flows: dict[str, list[Inequality]] = {}
    wrong = []
    for entry in declared:
        try:
            flows[entry["method"]] = [
                read_inequality(text, entry["counters"], bounds.value) for text in entry["facts"]
            ]
        except (KeyError, SyntaxError, ValueError):
            wrong.append(entry["method"])
    return flows, wrong


def _of_context(
    context: ExecutionContext,
    times: Times,
    arrivals: Mapping[str, Mapping[str, Any]],
    activations: Iterable[Iterable[str]],
) -> TimeBound | None:
    """Returns the bound of the execution time of a context. Returns None if the firmware image
    contains no handler of the context, or if the handler ends the firmware.

    The bound of an interrupt is the bound of its longest handler. A control cycle executes all
    handlers of a thread, and can activate a thread several times. The bound of a thread is
    therefore the sum over all its handlers and activations. ``activations`` contains an element for
    each activation: the methods that the thread does not call in that activation."""
    arrival = arrivals.get(context.id)
    if arrival and not arrival["entries"]:
        return None  # The handler ends the firmware.
    handlers = [handler for handler in context.handlers if handler in times.codes]
    cycles = []
    for without in activations:
        times.use_body(context.body, without)
        cycles += [times.of(handler) + ENTRY_AND_EXIT for handler in handlers]
    if not cycles:
        return None
    if context.kind == "interrupt" and context.id not in (*arrivals, CYCLE_TIMER):
        times.unbound.add((context.name, (str(DECLARED_IN), 1)))
    return TimeBound(
        context=context.id,
        name=context.name,
        cycles=sum(cycles) if context.kind == "thread" else max(cycles),
        entries=arrival["entries"] if arrival else None,
        priority=context.priority,
        ticks=arrival.get("ticks", 1) if arrival else 1,
        noise=arrival.get("noise") if arrival else None,
        why=arrival["why"] if arrival else "once in a control cycle",
    )


def with_responses(contexts: Iterable[TimeBound], locked: int = 0) -> list[TimeBound]:
    """Computes the response time of each interrupt. Returns all contexts. Each interrupt in the
    result contains its response time.

    A response time lasts from the request of the interrupt to the end of its handler. It includes
    all work of the same and of higher priorities that the processor does in this time. It also
    includes ``locked``, the longest time [cycle] for which other code blocks the interrupts."""
    all_bounds = list(contexts)
    waits = _waits(all_bounds, locked, noise=False)
    return [
        replace(bound, response_ms=_response(bound, all_bounds, waits, locked, noise=False) / CLOCK)
        if bound.entries is not None
        else bound
        for bound in all_bounds
    ]


def cycle_response(contexts: Iterable[TimeBound], locked: int = 0, *, noise: bool) -> float:
    """Returns the number of processor cycles from the clock pulse until the main thread has
    finished its work. This number includes the cycles of the interrupts in this time. It also
    includes ``locked``: the cycles for which the idle program can block the interrupts at the clock
    pulse."""
    all_bounds = list(contexts)
    own = locked + sum(bound.cycles for bound in all_bounds if bound.entries is None)
    interrupts = [bound for bound in all_bounds if bound.entries is not None]
    return _busy(own, interrupts, _waits(all_bounds, locked, noise=noise), noise=noise)


def _waits(contexts: Sequence[TimeBound], locked: int, *, noise: bool) -> dict[str, float]:
    """Returns the longest time [cycle] from a request of each interrupt to the end of its
    handler."""
    waits: dict[str, float] = {bound.context: 0 for bound in contexts if bound.entries is not None}
    for _ in range(MOST_ROUNDS):
        now = {
            bound.context: min(
                _response(bound, contexts, waits, locked, noise=noise), float(MOST_ROUNDS * CLOCK)
            )
            for bound in contexts
            if bound.entries is not None
        }
        if now == waits:
            break
        waits = {name: max(cycles, waits[name]) for name, cycles in now.items()}
    return waits


def _response(
    bound: TimeBound,
    contexts: Iterable[TimeBound],
    waits: Mapping[str, float],
    locked: int,
    *,
    noise: bool,
) -> float:
    above = [
        other
        for other in contexts
        if other.priority is not None
        and bound.priority is not None
        and other.priority <= bound.priority
    ]
    own = locked + bound.cycles
    own += sum(other.cycles for other in above if other.entries is None)
    interrupts = [other for other in above if other.entries is not None]
    if noise and bound.context == TICK_TIMER:
        # Before the handler of the tick runs, each noisy input causes at most ``noise`` interrupts.
        limited = [other for other in interrupts if other.noise is not None]
        own += sum((other.noise or 0) * (other.cycles + RETRY) for other in limited)
        interrupts = [other for other in interrupts if other.noise is None]
    return _busy(own, interrupts, waits, noise=noise)


def _busy(
    own: int, interrupts: Sequence[TimeBound], waits: Mapping[str, float], *, noise: bool
) -> float:
    """Returns the time [cycle] until a context has executed ``own`` cycles of its own. The cycles
    of the interrupts in this time are included."""
    cycles = own
    for _ in range(MOST_ROUNDS):
        now = own
        for interrupt in interrupts:
            now += _entries(interrupt, cycles, waits, noise=noise) * (interrupt.cycles + RETRY)
        if now == cycles:
            return cycles
        cycles = now
    return float("inf")


def _entries(bound: TimeBound, cycles: float, waits: Mapping[str, float], *, noise: bool) -> int:
    """Returns how often an interrupt can occur in a period of ``cycles`` processor cycles. If a
    request already waits at the beginning of this period, it is included.

    With noise, an input can cause ``bound.noise`` interrupts each time after the handler of the
    tick has run. The computation adds one tick to the period, because such interrupts can begin in
    the tick before the period. It also adds the longest response time of the tick, because the
    handler of the tick can be late."""
    assert bound.entries is not None
    if noise and bound.noise is not None:
        late = waits.get(TICK_TIMER, CLOCK)
        return math.ceil((cycles + CLOCK + late) / CLOCK) * bound.noise
    return math.ceil((cycles + waits[bound.context]) / (CLOCK * bound.ticks)) * bound.entries


def too_many(
    bound: TimeBound, handlers: Sequence[str], recording: Recording
) -> tuple[int, float] | None:
    """Searches a recording for a time in which an interrupt has more requests than its bound
    permits. Returns the number of requests in the first such time, and the time [ms] from its
    first to its last request. Returns None if there is no such time."""
    if bound.entries is None:
        return None
    waits = {bound.context: min((bound.response_ms or 0.0) * CLOCK, float(MOST_ROUNDS * CLOCK))}
    requests = sorted(
        recording.activations[span.activation].raised
        for span in recording.spans
        if span.method in handlers
    )
    for number, begin in enumerate(requests):
        for count, end in enumerate(requests[number:], 1):
            ms = (end - begin) / NANOSECONDS
            if count > _entries(bound, ms * CLOCK, waits, noise=False):
                return count, ms
    return None


def _paths(
    root: Path,
    declared: Iterable[Mapping[str, Any]],
    contexts: Sequence[TimeBound],
    cycle_ms: float,
    bounds: Bounds,
    *,
    recordings: Mapping[str, Recording],
) -> list[PathBound]:
    """Returns the declared paths from an input to its effect. Each path contains the bound of each
    of its parts, and the time that a recording shows for the path."""
    chains = {chain.name: chain for chain in declared_chains(root)}
    responses = {bound.context: (bound.name, bound.response_ms or 0.0) for bound in contexts}
    paths = []
    for entry in declared:
        parts = [(part["what"], bounds.value(part["us"]) / 1000) for part in entry["parts"]]
        for context in entry["contexts"]:
            name, response = responses[context]
            parts.append((f"interrupt: {name}", response))
        if entry["cycle"]:
            parts.append(("control cycle", cycle_ms))
        chain = chains.get(entry.get("chain", ""))
        seen = _seen_of(chain, recordings[chain.recording]) if chain and recordings else None
        paths.append(PathBound(entry["name"], entry["title"], parts, seen, entry["why"]))
    return paths


def _seen_of(chain: Chain, recording: Any) -> float | None:
    """Returns the time [ms] from the first to the last event of a chain in a recording. Returns
    None if the recording does not contain the chain.

    If the first event is a byte of a frame, the time begins at the last byte of this frame."""
    steps = follow(chain, recording)
    if steps is None:
        return None
    begin = steps[0].at
    for frame in frames_in(recording, BYTE_RECEIVED):
        times = [event.at for event in frame.events]
        if begin in times:
            begin = times[-1]
            break
    return (steps[-1].at - begin) / NANOSECONDS


def _seen(root: Path, model: Model) -> float | None:
    """Returns the longest measured time [ms] from the clock pulse to the report of a control cycle.
    The measurements are the runs of the bench and the tests of the firmware image. Returns None if
    there are no measurements."""
    runs = [run for scenario in (model.bench or {}).values() for run in scenario.runs.values()]
    times = [run.report_ms.maximum for run in runs]
    if not model.stale_on(VIRTUAL_K64):
        reported = numbers_reported(root, VIRTUAL_K64, "longest_cycle", DEFAULT)
        times += [cycles / CLOCK for cycles in reported]
    return round(max(times), 3) if times else None
