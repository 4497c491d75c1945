"""./wr campaign: its chunks, its files, its workers, and the totals of its records."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tools.campaign import command, fuzz, kinds
from tools.campaign.chunks import Chunk, Store, chunks_of, identity_of, whole_part
from tools.campaign.faults import counted, summarise, times
from tools.campaign.kinds import KINDS, Kind
from tools.campaign.workers import run_here, run_on_dask
from tools.cli import parser
from tools.lock import BusyError
from tools.steps import FailureError
from traceability.reading.published import OUTCOMES, campaign_metrics, publish, read_published

pytestmark = pytest.mark.runs_tools

# A program whose cases depend only on the seed. Each run needs at least 0.05 s.
PROGRAM = """#!{python}
import json, random, sys, time
seed, count = (int(sys.argv[sys.argv.index(name) + 1]) for name in ("--seed", "--count"))
numbers = random.Random(seed)
time.sleep(0.05)
for _ in range(count):
    print(json.dumps({{"number": numbers.randrange(1 << 30)}}))
"""
RUN = """
import sys
from pathlib import Path
from tests.python.commands.test_campaign import run, small
root = Path(sys.argv[1])
sys.exit(run(root, *sys.argv[2:]))
"""
SOURCE = Path(__file__).resolve().parents[3]
SLOW = 60  # longest time in which a busy computer finishes three chunks [s]


def small(root: Path) -> Kind:
    """Returns a kind of campaign whose chunks have five cases."""
    program = root / "program"
    if not program.exists():  # A worker of a killed campaign may still execute this program.
        program.write_text(PROGRAM.format(python=sys.executable), encoding="utf-8")
        program.chmod(0o755)
    return replace(
        KINDS["faults"],
        size=5,
        targets=(),
        files=(Path("program"),),
        options=lambda _files: [],
        summarise=lambda _root, cases: {
            "outcomes": {"sum": sum(case["number"] for case in cases)},
        },
    )


def run(root: Path, *words: str) -> int:
    kinds.KINDS["faults"] = small(root)
    options = parser().parse_args(["campaign", "faults", *words])
    return command.campaign(root, options)


@pytest.fixture(autouse=True)
def restored(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kinds, "KINDS", dict(kinds.KINDS))
    monkeypatch.setattr(command, "KINDS", kinds.KINDS)


def record_of(root: Path) -> dict[str, Any]:
    record = read_published(root, "faults")
    assert record is not None
    return dict(record.result)


# ---- chunks --------------------------------------------------------------------


def test_a_longer_campaign_begins_with_the_chunks_of_a_shorter() -> None:
    assert chunks_of(3, 23, 10)[:2] == chunks_of(3, 100, 10)[:2]
    assert [chunk.count for chunk in chunks_of(3, 23, 10)] == [10, 10, 3]


def test_no_two_campaigns_share_a_seed() -> None:
    seeds = [chunk.seed for seed in range(3) for chunk in chunks_of(seed, 100, 10)]
    assert len(seeds) == len(set(seeds)) == 30


@pytest.mark.parametrize("count", [0, -1])
def test_a_campaign_has_cases(count: int) -> None:
    with pytest.raises(ValueError, match="cases"):
        chunks_of(1, count, 10)


def test_another_image_is_another_campaign(tmp_path: Path) -> None:
    image, program = tmp_path / "image", tmp_path / "program"
    image.write_bytes(b"one")
    program.write_bytes(b"two")
    before = identity_of([program, image])
    image.write_bytes(b"three")
    assert identity_of([program, image]) != before


def test_a_chunk_of_another_program_is_not_counted(tmp_path: Path) -> None:
    chunk = Chunk(0, 1, 1)
    Store(tmp_path, "faults", "one", 0).keep(chunk, [{}])
    (tmp_path / "build/campaign/faults/one-0").rename(tmp_path / "build/campaign/faults/two-0")
    with pytest.raises(ValueError, match="another campaign"):
        Store(tmp_path, "faults", "two", 0).read(chunk)


def test_a_half_written_chunk_is_not_finished(tmp_path: Path) -> None:
    store = Store(tmp_path, "faults", "one", 0)
    store.keep(Chunk(0, 0, 1), [{}])
    (store.folder / "000001-1.77.draft").write_text('{"identity": "o', encoding="utf-8")
    assert store.finished() == [Chunk(0, 0, 1)]
    assert store.read(Chunk(1, 1, 1)) is None


def test_only_a_whole_part_of_a_campaign_is_published() -> None:
    chunks = chunks_of(1, 23, 5)
    assert whole_part(chunks) == chunks
    assert whole_part([chunks[0], *chunks[2:]]) == chunks[:1]
    assert whole_part(chunks[1:]) == []


# ---- runs ----------------------------------------------------------------------


def test_a_campaign_shows_how_far_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, "--count", "12") == 0
    printed = capsys.readouterr().out
    assert "12 faults to run, in 3 chunks" in printed
    assert "12 of 12 faults" in printed
    assert "left" in printed


def test_finished_chunks_are_never_lost_by_mistake(tmp_path: Path) -> None:
    run(tmp_path, "--count", "10")
    with pytest.raises(FailureError, match="--resume"):
        run(tmp_path, "--count", "20")
    assert run(tmp_path, "--count", "20", "--resume") == 0


@pytest.mark.long
def test_the_number_of_workers_does_not_matter(tmp_path: Path) -> None:
    found = []
    for name, workers in (("a", "1"), ("b", "4")):
        root = tmp_path / name
        root.mkdir()
        run(root, "--count", "33", "--workers", workers, "--publish")
        found.append(record_of(root)["outcomes"])
    assert found[0] == found[1]


def test_a_chunk_counts_once(tmp_path: Path) -> None:
    run(tmp_path, "--count", "12", "--publish")
    run(tmp_path, "--count", "20", "--resume", "--publish")  # The third chunk now has five cases.
    assert record_of(tmp_path)["cases"] == 20


def test_a_chunk_that_fails_ends_the_campaign(tmp_path: Path) -> None:
    kind = small(tmp_path)
    (tmp_path / "program").write_text("#!/bin/sh\necho broken >&2; exit 3\n", encoding="utf-8")
    with pytest.raises(FailureError, match="exit code 3: broken"):
        list(run_here(kind, tmp_path, chunks_of(1, 10, 5), 2))


def test_a_program_that_gives_too_few_cases_is_found(tmp_path: Path) -> None:
    small(tmp_path)
    kind = replace(small(tmp_path), files=(Path("true"),))
    (tmp_path / "true").write_text("#!/bin/sh\n", encoding="utf-8")
    (tmp_path / "true").chmod(0o755)
    kinds.KINDS["faults"] = kind
    options = parser().parse_args(["campaign", "faults", "--count", "5"])
    with pytest.raises(FailureError, match="0 cases, not 5"):
        command.campaign(tmp_path, options)


def test_a_shorter_campaign_counts_only_its_own_chunks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run(tmp_path, "--count", "10", "--publish")
    short = record_of(tmp_path)
    run(tmp_path, "--count", "50", "--resume")
    capsys.readouterr()
    run(tmp_path, "--count", "10", "--resume", "--publish")
    assert record_of(tmp_path) == short
    assert "\n0 faults to run, in 2 chunks" in capsys.readouterr().out


def test_two_campaigns_with_the_same_chunks_do_not_run_at_once(tmp_path: Path) -> None:
    store = Store(tmp_path, "faults", "program", 1)
    with store.only_one(), pytest.raises(BusyError, match="Another process"), store.only_one():
        pass
    with store.only_one():  # The lock is free again.
        pass


def test_a_campaign_with_failures_shows_them_and_ends_with_code_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    failure = {"fuzzer": "link", "text": "a rule is broken", "input": ["01ff"]}
    kind = small(tmp_path)
    kinds.KINDS["faults"] = replace(
        kind, summarise=lambda _root, _cases: {"outcomes": {"failures": 1}, "failures": [failure]}
    )
    options = parser().parse_args(["campaign", "faults", "--count", "5"])
    assert command.campaign(tmp_path, options) == 1
    printed = capsys.readouterr().out
    assert "fuzzer: link\ntext: a rule is broken\ninput: ['01ff']\n" in printed
    assert "build/campaign/faults/" in printed


@pytest.mark.long
def test_a_killed_campaign_resumes_to_the_same_result(tmp_path: Path) -> None:
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    for root in (whole, killed):
        root.mkdir()
    run(whole, "--count", "100", "--publish")
    program = subprocess.Popen(
        [sys.executable, "-c", RUN, str(killed), "--count", "100", "--workers", "2"],
        cwd=SOURCE,
        stdout=subprocess.DEVNULL,
    )
    finished = 0
    end = time.monotonic() + SLOW
    while finished < 3 and time.monotonic() < end:
        finished = len(list(killed.glob("build/campaign/faults/*/*.json")))
        time.sleep(0.01)
    os.kill(program.pid, signal.SIGKILL)
    program.wait()
    finished = len(list(killed.glob("build/campaign/faults/*/*.json")))
    assert 3 <= finished < 20
    assert run(killed, "--count", "100", "--resume", "--publish") == 0
    assert record_of(killed) == record_of(whole)


@pytest.mark.long
def test_a_dask_cluster_that_loses_a_worker_gives_the_same_result(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    kind = small(tmp_path)
    identity = identity_of([tmp_path / "program"])
    chunks = chunks_of(1, 100, 5)
    here = dict(run_here(kind, tmp_path, chunks, 2))
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        there = {}
        results = run_on_dask(kind, tmp_path, chunks, cluster.scheduler_address, identity)
        for number, (chunk, cases) in enumerate(results):
            there[chunk] = cases
            if number == 2:
                victim = next(iter(cluster.workers.values()))
                os.kill(victim.process.pid, signal.SIGKILL)
    assert there == here


# ---- records -------------------------------------------------------------------


def test_the_numbers_of_a_record_add_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from tools.campaign import places

    class OneModule:
        def __init__(self, _root: Path, _elf: Path) -> None: ...

        def of(self, address: int) -> str:
            return "Low" if address < 100 else "High"

    monkeypatch.setattr(places, "Places", OneModule)
    cases = [
        {"kind": kind, "place": n, "pc": 2 * n, "outcome": outcome, "safe_after": n, "stop": ""}
        for n, (kind, outcome) in enumerate(
            (kind, outcome) for kind in ("ram", "register", "supply") for outcome in OUTCOMES * 20
        )
    ]
    result = summarise(tmp_path, cases)
    assert sum(result["outcomes"].values()) == len(cases)
    by_kind = [sum(counts.values()) for counts in result["kinds"].values()]
    assert sum(by_kind) == len(cases)
    with_module = sum(sum(counts.values()) for counts in result["modules"].values())
    assert with_module == sum(case["kind"] != "supply" for case in cases)
    assert set(result["modules"]) == {"Low", "High"}


def test_an_unknown_outcome_is_not_dropped() -> None:
    with pytest.raises(KeyError):
        counted([{"outcome": "forgotten"}])


def test_times_are_ordered() -> None:
    assert times([]) == {}
    assert times(list(range(100, -1, -1))) == {"median": 50, "p95": 95, "most": 100}


def test_metrics_name_their_record(tmp_path: Path) -> None:
    outcomes = {outcome: number for number, outcome in enumerate(OUTCOMES)}
    publish(tmp_path, "faults", "./wr campaign faults", "abc", {"cases": 15, "outcomes": outcomes})
    record = read_published(tmp_path, "faults")
    assert record is not None
    found = campaign_metrics({"faults": record})
    assert found["reliability.faults"]["value"] == 15
    assert found["reliability.faults_silent"] == {
        "command": "./wr campaign faults",
        "commit": "abc",
        "date": record.date,
        "value": outcomes["silent"],
    }
    parts = [entry["value"] for name, entry in found.items() if name != "reliability.faults"]
    assert sum(parts) == 15


def test_without_a_record_there_is_none(tmp_path: Path) -> None:
    assert read_published(tmp_path, "faults") is None
    assert campaign_metrics({}) == {}


def committed(name: str) -> dict[str, Any]:
    """Returns the committed result of a campaign. Checks that the recorded command contains the
    number of the recorded cases."""
    record = read_published(SOURCE, name)
    assert record is not None
    assert f"--count {record.result['cases']} " in record.command
    return dict(record.result)


def test_the_committed_record_of_the_faults_adds_up() -> None:
    result = committed("faults")
    assert sum(result["outcomes"].values()) == result["cases"]
    for outcome in OUTCOMES:
        assert sum(k[outcome] for k in result["kinds"].values()) == result["outcomes"][outcome]
    silent = [case for case in result["silent"] if case["outcome"] in ("silent", "hung")]
    assert len(silent) == len(result["silent"])


def test_the_committed_record_of_the_inputs_adds_up() -> None:
    result = committed("fuzz")
    assert sum(result["inputs"].values()) == result["outcomes"]["inputs"]
    assert len(result["failures"]) == min(result["outcomes"]["failures"], fuzz.LISTED)


def test_the_committed_record_of_the_drives_has_the_times_of_its_list() -> None:
    """The list contains the drives with the longest cycles. It can contain drives with noise and
    drives without noise."""
    result = committed("loads")
    outcomes, listed = result["outcomes"], result["longest"]
    times = [drive["longest_ns"] for drive in listed]
    assert times == sorted(times, reverse=True)
    for noise, name in ((True, "noise_ms"), (False, "longest_ms")):
        longest = next((drive for drive in listed if drive["noise"] == noise), None)
        if longest:
            assert outcomes[name] == round(longest["longest_ns"] / 1e6, 4)
        else:
            assert outcomes[name] <= times[-1] / 1e6
    assert outcomes["median_ms"] <= outcomes["longest_ms"]
    assert sum(drive["noise"] for drive in listed) <= outcomes["noisy"] <= result["cases"]
