"""Runs tasks with doit. A task runs only if its inputs changed. Independent tasks run at the same
time.

doit stores the hash of the content of each input in a JSON file such as ``build/tasks.json``. If an
input changes after the start of the run, its hash is not stored. The task then runs again the next
time."""

from __future__ import annotations

import contextlib
import os
import queue
import sys
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

from doit.action import BaseAction
from doit.control import TaskControl
from doit.dependency import Dependency, JsonDB
from doit.exceptions import BaseFail, TaskFailed, UnmetDependency
from doit.runner import MThreadRunner
from doit.task import Task as DoitTask
from doit.task import dict_to_task

from tools.steps import FailureError, attempt, log_file, log_of, no_program_left, tail
from traceability.reading.graphs import reached_from
from traceability.reading.task_record import RECORD
from traceability.sources import files_below
from traceability.whole_file import write_whole

SECONDS = "seconds of tasks"  # key of the duration of each task
WAKE = 0.2  # period at which a waiting main thread wakes up, so that it receives Ctrl-C [s]
# If a task is expected to take at least this time [s], its start is printed at once. Otherwise, its
# start is printed when the task has run for this time.
LONG = 10


@dataclass(frozen=True)
class Outcome:
    """The result of a task, with a note. ``failed`` means that the task produced bad results, such
    as failed tests."""

    note: str
    failed: bool = False
    values: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Task:
    """A task, with its action, the files and folders that it reads, and the files that it
    writes."""

    name: str
    action: Callable[[TextIO], Outcome | str | None]
    inputs: tuple[str, ...] = ()
    results: tuple[str, ...] = ()  # outputs that are removed before the task runs
    must_exist: tuple[str, ...] = ()  # other outputs, which remain until the task replaces them
    after: tuple[str, ...] = ()
    inputs_from: tuple[str, ...] = ()  # tasks that determine inputs of this task
    always: bool = (
        False  # The task runs each time, because a build tool detects the changes itself.
    )
    state: Callable[[], str] | None = None  # state of inputs that are not files
    quiet: bool = False  # The task itself prints the lines about its progress.
    # If the results exist, this action updates them. It gets the names of the changed inputs.
    update: Callable[[TextIO, frozenset[str]], Outcome] | None = None


@dataclass
class Progress:
    """The running, waiting and ended tasks. The portal shows these tasks."""

    running: dict[str, tuple[float, float | None]] = field(default_factory=dict)
    waiting: dict[str, float | None] = field(default_factory=dict)
    done: dict[str, Outcome] = field(default_factory=dict)


class Step(BaseAction):  # type: ignore[misc]  # doit has no types
    """The action of a task, with its output in a log."""

    def __init__(self, root: Path, task: Task) -> None:
        self.root, self.work = root, task
        self.task: DoitTask | None = None
        self.changed: frozenset[str] = frozenset()  # empty if the changed inputs are not known
        self.out = self.err = self.result = None
        self.values: dict[str, Any] = {}

    def execute(self, out: object = None, err: object = None) -> BaseFail | None:  # noqa: ARG002 - doit names them
        start = time.time()
        try:
            with log_file(log_of(self.root, self.work.name)) as log:
                found = attempt(self._action(), log)
        except FailureError as error:
            return TaskFailed(str(error), report=False)
        outcome = found if isinstance(found, Outcome) else Outcome(found or "")
        self.values = {
            **outcome.values,
            "note": outcome.note,
            "failed": outcome.failed,
            "seconds": round(time.time() - start, 1),
        }
        return None

    def _action(self) -> Callable[[TextIO], Outcome | str | None]:
        results = [self.root / name for name in self.work.results]
        if self.work.update and self.changed and all(path.exists() for path in results):
            update = self.work.update
            return lambda log: update(log, self.changed)
        for path in results:
            path.unlink(missing_ok=True)
        return self.work.action


class Database(JsonDB):  # type: ignore[misc]  # doit has no types
    """The JSON file in which doit records the tasks. The file is replaced as a whole. After an
    interruption it therefore contains the previous record."""

    def dump(self) -> None:
        write_whole(Path(self.name), self.codec.encode(self._db))


class Record(Dependency):  # type: ignore[misc]  # doit has no types
    """Records the inputs of a task. An input that changed after the start of the run is not
    recorded. A file below ``build`` is always recorded, because earlier tasks write such files."""

    def __init__(self, path: Path) -> None:
        super().__init__(Database, str(path))
        self.began = time.time()

    def save_success(self, task: DoitTask, result_hash: str | None = None) -> None:
        super().save_success(task, result_hash)
        for name in task.file_dep:
            made = name.startswith("build/")
            if not made and Path(name).stat().st_mtime > self.began:
                self._set(task.name, name, None)

    def changed_inputs(self, task: DoitTask) -> frozenset[str]:
        """Returns the inputs that changed, were added or were removed since the last run of the
        task. Returns the empty set if there is no record of the last run."""
        before = set(self._get(task.name, "deps:") or ())
        return frozenset(task.dep_changed) | (before - task.file_dep) if before else frozenset()

    def forget(self, task: DoitTask) -> None:
        """Removes a task from the record before the task runs. If the run is ended by force, the
        outputs are incomplete. The record of an earlier run would then be wrong."""
        if self.get_values(task.name):
            self.remove_success(task)
            self.backend.dump()


class WakingQueue(queue.Queue[Any]):
    """A queue whose reader wakes up periodically. The reader is the main thread, which receives
    Ctrl-C only when it wakes up."""

    def get(self, block: bool = True, timeout: float | None = None) -> Any:  # noqa: ARG002 - doit names them
        while True:
            with contextlib.suppress(queue.Empty):
                return super().get(timeout=WAKE)


class Runner(MThreadRunner):  # type: ignore[misc]  # doit has no types
    Queue = WakingQueue

    def select_task(self, node: Any, tasks: Any) -> bool:
        selected = bool(super().select_task(node, tasks))
        if selected:
            (step,) = node.task.actions
            step.changed = self.dep_manager.changed_inputs(node.task)
            self.dep_manager.forget(node.task)
        return selected


class Reporter:
    """Prints one line for each task, and records the progress."""

    def __init__(self, root: Path, tasks: Iterable[Task], record: Record, out: TextIO) -> None:
        self.root, self.record, self.out = root, record, out
        self.tasks = {task.name: task for task in tasks}
        self.progress = Progress()
        self.failed: list[str] = []
        self.values: dict[str, dict[str, Any]] = {}
        self.changed_inputs: dict[str, int] = {}
        self.changed: Callable[[Task | None], None] = lambda _task: None
        self.number = self.total = 0
        self.lock = threading.RLock()

    def initialize(self, tasks: dict[str, DoitTask], selected: list[str]) -> None:
        wanted = set(
            reached_from(selected, lambda name: (*tasks[name].task_dep, *tasks[name].calc_dep))
        )
        self.progress.waiting = {
            name: self._expected(name) for name in self.tasks if name in wanted
        }
        self.total = len(wanted)
        self.changed(None)

    def execute_task(self, task: DoitTask) -> None:
        with self.lock:
            expected = self.progress.waiting.pop(task.name, None)
            self.progress.running[task.name] = (time.time(), expected)
            if self.tasks[task.name].quiet:
                pass
            elif expected and expected >= LONG:
                self._say(f"        {task.name}: started, takes about {expected:.0f} s")
            else:
                timer = threading.Timer(LONG, self._say_started, [task.name])
                timer.daemon = True
                timer.start()
        self.changed(None)

    def add_success(self, task: DoitTask) -> None:
        seconds = task.values["seconds"]
        times = self.record.backend.get(SECONDS, "all") or {}
        self.record.backend.set(SECONDS, "all", {**times, task.name: seconds})
        self.record.backend.dump()
        self.changed_inputs[task.name] = len(task.dep_changed)
        self._end(task, task.values, f"{seconds:.1f} s")

    def skip_uptodate(self, task: DoitTask) -> None:
        self._end(task, self.record.get_values(task.name), "unchanged")

    def add_failure(self, task: DoitTask, fail: BaseFail) -> None:
        self.record.backend.dump()
        with self.lock:
            self._leave(task.name)
            text = fail.message.strip()
            self.failed.append(task.name)
            self.number += 1
            head = f"[{self.number}/{self.total}] {task.name} ..."
            if isinstance(fail, UnmetDependency):
                text = f"not run: {text} failed"
                self._say(f"{head} {text}")
            else:
                path = log_of(self.root, task.name)
                self._say(f"{head} FAILED: {text}")
                if path.exists() and isinstance(fail, TaskFailed):
                    self._say(f"{tail(path)}\nThe whole log: {path.relative_to(self.root)}")
            self.progress.done[task.name] = Outcome(text, failed=True)
        self.changed(None)

    def runtime_error(self, message: str) -> None:
        raise FailureError(message)

    def get_status(self, _task: DoitTask) -> None: ...
    def skip_ignore(self, _task: DoitTask) -> None: ...
    def cleanup_error(self, _error: object) -> None: ...
    def teardown_task(self, _task: DoitTask) -> None: ...
    def complete_run(self) -> None: ...

    def _end(self, task: DoitTask, values: dict[str, Any], how: str) -> None:
        with self.lock:
            self._leave(task.name)
            self.values[task.name] = values
            self.number += 1
            note, failed = values.get("note", ""), bool(values.get("failed"))
            if failed:
                self.failed.append(task.name)
            self.progress.done[task.name] = Outcome(note, failed)
            if not self.tasks[task.name].quiet:
                text = ", ".join(part for part in ("FAILED" if failed else "", note, how) if part)
                self._say(f"[{self.number}/{self.total}] {task.name} ... {text}")
                if failed and how != "unchanged":
                    self._say(tail(log_of(self.root, task.name)))
        self.changed(self.tasks[task.name] if how != "unchanged" else None)

    def _leave(self, name: str) -> None:
        self.progress.waiting.pop(name, None)
        self.progress.running.pop(name, None)

    def _expected(self, name: str) -> float | None:
        times = self.record.backend.get(SECONDS, "all") or {}
        seconds = times.get(name)
        return None if seconds is None else float(seconds)

    def _say_started(self, name: str) -> None:
        with self.lock:
            if name in self.progress.running:
                self._say(f"        {name}: started {LONG} s ago")

    def _say(self, text: str) -> None:
        print(text, file=self.out, flush=True)


@dataclass
class Graph:
    """The tasks of the project. A run can execute a part of the tasks."""

    root: Path
    tasks: list[Task]
    out: TextIO = field(default_factory=lambda: sys.stdout)
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    record: Path = RECORD

    def run(
        self, names: Iterable[str], changed: Callable[[Task | None, Progress], None] | None = None
    ) -> Reporter:
        """Runs the named tasks and the tasks that they need. Returns their results.

        ``changed`` is called when the progress changes. The first argument of ``changed`` is the
        task that ended with new results, or None. The second argument is the progress."""
        with contextlib.chdir(self.root):
            record = Record(self.record)
            reporter = Reporter(self.root, self.tasks, record, self.out)
            if changed is not None:
                reporter.changed = lambda task: changed(task, reporter.progress)
            control = TaskControl([self._doit(task) for task in self.tasks])
            control.process(list(names))
            runner = Runner(record, reporter, continue_=True, num_process=max(1, self.workers))
            with no_program_left():
                runner.run_all(control.task_dispatcher())
        return reporter

    def _doit(self, task: Task) -> DoitTask:
        inputs = [str(path.relative_to(self.root)) for path in files_below(self.root, task.inputs)]
        # The output of an earlier task may not exist yet.
        inputs += [name for name in task.inputs if name.startswith("build/") and name not in inputs]
        state = task.state() if task.state is not None else ""
        step = Step(self.root, task)
        found = dict_to_task(
            {
                "name": task.name,
                "actions": [step],
                "file_dep": inputs,
                "targets": [*task.results, *task.must_exist],
                "task_dep": list(task.after),
                "calc_dep": list(task.inputs_from),
                "uptodate": [not task.always, _same_state(state)],
            }
        )
        found.value_savers.append(lambda: {"state": state})
        return found


def _same_state(state: str) -> Callable[[DoitTask, dict[str, Any]], bool]:
    # doit passes arguments by these names.
    def same(task: DoitTask, values: dict[str, Any]) -> bool:  # noqa: ARG001 - doit names them
        return bool(values.get("state") == state)

    return same
