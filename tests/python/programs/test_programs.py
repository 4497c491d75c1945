"""The programs that run the firmware: on this machine, and its image on the virtual K64."""

import csv
import math
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PROGRAMS = ROOT / "build" / "host" / "sim"
IMAGE = ROOT / "build" / "k64" / "weeding_robot_paper.bin"
ELF = IMAGE.with_suffix(".elf")
EXAMPLES = sorted((ROOT / "sim" / "scenario" / "examples").glob("*.scenario"))
CYCLE_TIMER_VECTOR = 4 * (16 + 48)

Words = list[str | Path]


def build(preset: str, *targets: str) -> None:
    folder = ROOT / "build" / preset
    jobs = str(os.cpu_count() or 1)
    commands: tuple[Words, Words] = (
        ["cmake", "-S", ROOT, "--preset", preset],
        ["cmake", "--build", folder, "--parallel", jobs, "--target", *targets],
    )
    for words in commands:
        subprocess.run(words, check=True, cwd=ROOT, timeout=600, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="module", autouse=True)
def built() -> None:
    build("host", "weeding_robot_host", "weeding_robot_board")
    build("k64", "weeding_robot_paper")


def command(binding: str, image: Path = IMAGE) -> Words:
    program = PROGRAMS / f"weeding_robot_{binding}"
    return [program, "--image", image, "--elf", ELF] if binding == "board" else [program, "--paper"]


def run(words: Words, timeout: int = 120) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, capture_output=True, text=True, timeout=timeout, check=False)


@pytest.fixture(params=["host", "board"])
def program(request: pytest.FixtureRequest) -> Words:
    return command(request.param)


Row = dict[str, str]
# What depends on the instant at which a sensor is read, or on the time that the image takes. All
# else in a report is decided.
MEASURED = {"time_ms", "steering", "velocity", "current", "position", "tension"}
MEASURED |= {"report_cycles", "awake_cycles", "start_cycles", "rejected_edges"}
# Orders of the remote control are measured too: each is the width of a pulse. The steering follows
# them, so it may turn by a step in one of the two.
REMOTE_CONTROL = "0"
SET_POINTS = {"set_point", "steering_set_point", "turn", "steering_state"}
# The greatest value of each that can be ordered, in the unit of the report.
RANGES = {"steering": 3200, "velocity": 3000, "current": 10_000, "tension": 24_000}
RANGES_OF_REMOTE_CONTROL = {"set_point": 3000, "steering_set_point": 3200}
WHEELS = "0123"
# The greatest difference of one value in one cycle, and that of all but three in a hundred [%].
ONCE = 3
USUALLY = 1
RARE = 0.03  # share of the cycles


def decided(row: Row) -> Row:
    """What the firmware decided: states, sources, set-points, faults, counts."""
    of_report = list(row)[: list(row).index("at_ms")]
    measured = MEASURED | (SET_POINTS if row["mode"] == REMOTE_CONTROL else set())
    return {name: row[name] for name in of_report if name.rstrip(WHEELS) not in measured}


def difference(first: Row, second: Row) -> float:
    """The greatest difference of a measured or applied value, in percent of its range."""
    remote = RANGES_OF_REMOTE_CONTROL if first["mode"] == REMOTE_CONTROL else {}
    return max(
        100 * abs(float(first[name]) - float(second[name])) / full
        for kind, full in (RANGES | remote).items()
        for name in first
        if name.rstrip(WHEELS) == kind
    )


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_the_image_does_what_the_firmware_on_this_machine_does(
    example: Path, tmp_path: Path
) -> None:
    """It decides the same, a decision that hangs on a measured value at most one cycle earlier or
    later. Measured and applied values differ by at most 1 % of the range in 97 of 100 cycles, and
    by more than 3 % only in a cycle next to such a decision; while pulses order, by at most 3 %.
    At the end of a connection, and at that of the scenario, one of the two may have sent a report
    more."""
    reports = []
    for binding in ("host", "board"):
        table = tmp_path / f"{binding}.csv"
        done = run([*command(binding), "--scenario", example, "--reports", table], timeout=600)
        assert done.returncode == 0, done.stdout + done.stderr
        with table.open() as lines:
            reports.append({row["cycle"]: row for row in csv.DictReader(lines)})
    host, board = reports
    common = [(host[cycle], board[cycle]) for cycle in host if cycle in board]
    assert len(common) > 50
    assert len(host.keys() ^ board.keys()) <= 2
    shifted = shifted_decisions(common)
    rare = math.ceil(len(common) * RARE)
    assert len(shifted) <= rare
    differences = [difference(*rows) for rows in common]
    beside = {other for index in shifted for other in (index - 1, index, index + 1)}
    assert max(value for index, value in enumerate(differences) if index not in beside) <= ONCE
    ordered = [first["mode"] != REMOTE_CONTROL for first, _ in common]
    larger = sum(
        value > USUALLY for value, by_pc in zip(differences, ordered, strict=True) if by_pc
    )
    assert larger <= rare + len(beside)


def shifted_decisions(common: list[tuple[Row, Row]]) -> list[int]:
    """The cycles in which the two decided differently; each value is that of a cycle beside."""
    found = []
    for index, (first, second) in enumerate(common):
        one, other = decided(first), decided(second)
        names = [name for name in one if name in other and one[name] != other[name]]
        beside = [decided(row[1]) for row in common[max(index - 1, 0) : index + 2]]
        for name in names:
            assert one[name] in [row.get(name) for row in beside], (name, first["cycle"])
        if names:
            found.append(index)
    return found


def test_an_expectation_that_fails_is_told_with_its_line(program: Words, tmp_path: Path) -> None:
    scenario = tmp_path / "wrong.scenario"
    scenario.write_text("at 50 connect\nat 350 expect state Working\nat 600 end\n")
    done = run([*program, "--scenario", scenario])
    assert done.returncode == 1
    assert f"{scenario}:2: state is 1, not Working, at 350 ms" in done.stderr


def test_a_text_that_is_no_scenario_is_wrong_usage(program: Words, tmp_path: Path) -> None:
    scenario = tmp_path / "wrong.scenario"
    scenario.write_text("at 50 connect\nat 60 jump\n")
    done = run([*program, "--scenario", scenario])
    assert done.returncode == 2
    assert done.stderr == f"{scenario}:2: there is no action 'jump'\n"


@pytest.mark.parametrize("words", [["--jump"], ["--cycles"], ["--cycles", "many"]])
def test_wrong_usage_is_explained(program: Words, words: list[str]) -> None:
    done = run([*program, *words])
    assert done.returncode == 2
    assert "usage: weeding_robot_" in done.stderr


def test_real_time_ends_after_its_cycles(program: Words, tmp_path: Path) -> None:
    link = tmp_path / "pc-link"
    done = run([*program, "--cycles", "3", "--link", link])
    assert done.returncode == 0
    assert done.stdout.startswith("PC link: /dev/")
    assert not link.is_symlink()


def test_without_link_the_same_run_gives_the_same_trace(tmp_path: Path) -> None:
    traces = []
    for name in ("first.csv", "second.csv"):
        trace = tmp_path / name
        done = run([*command("board"), "--fast", "--cycles", "100", "--trace", trace])
        assert done.returncode == 0
        traces.append((done.stdout, trace.read_text()))
    assert traces[0] == traces[1]
    assert traces[0][1].count(f"exception_entered,{16 + 48}") == 100


def test_a_finding_is_printed_and_has_its_own_exit_code(tmp_path: Path) -> None:
    """Without a vector for the cycle timer, the first clock pulse leads nowhere."""
    image = tmp_path / "broken.bin"
    content = bytearray(IMAGE.read_bytes())
    content[CYCLE_TIMER_VECTOR : CYCLE_TIMER_VECTOR + 4] = bytes(4)
    image.write_bytes(content)
    scenario = tmp_path / "idle.scenario"
    scenario.write_text("at 500 end\n")
    expecting = tmp_path / "expecting.scenario"
    expecting.write_text("at 400 expect-finding vector-missing\nat 500 end\n")
    for words in (["--fast", "--cycles", "5"], ["--scenario", scenario], ["--cycles", "5"]):
        done = run([*command("board", image), *words])
        assert done.returncode == 4, done.stdout
        finding = done.stdout.splitlines()[-1]
        assert finding.startswith("finding: vector-missing: ")
        assert " ms" in finding
    assert run([*command("board", image), "--scenario", expecting]).returncode == 0


def test_there_is_no_run_without_image(tmp_path: Path) -> None:
    board = PROGRAMS / "weeding_robot_board"
    assert run([board, "--fast", "--cycles", "1"]).returncode == 2
    missing = run([board, "--image", tmp_path / "none.bin", "--fast", "--cycles", "1"])
    assert missing.returncode == 1
    assert "there is no image" in missing.stderr
