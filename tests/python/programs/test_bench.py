"""The bench measures the firmware image. If a module becomes slower, the row of this module shows
more instructions. The bench can also measure a board, through the serial line."""

import json
import shlex
import subprocess
import time
from pathlib import Path

import pytest

from tests.python.firmware.seeding import BOARD, link_command
from tools import bench
from traceability.reading.bench_record import (
    BENCH,
    FOLDER,
    SCENARIOS,
    Record,
    frames_of,
    profile_of,
)
from traceability.reading.results import read_record

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[3]
BUILD = ROOT / "build" / "k64"
ALGORITHM = ROOT / "src/wheel_control/algorithms/VelocityAlgorithm.cpp"
BUSY = "  for (volatile int i = 0; i < 1000;) {\n    const int next = i + 1;\n    i = next;\n  }\n"
FEW = "at 50 arm\nfrom 1550 to 101050 every 100 order velocity 500\nat 101150 end\n"


def slowed(folder: Path) -> Path:
    """Returns the path of a firmware image, without its suffix. In this image, an algorithm
    contains a busy loop."""
    source = folder / ALGORITHM.name
    begin = "  setPoint_.fill(setPoint);\n"
    text = ALGORITHM.read_text(encoding="utf-8")
    assert text.count(begin) == 1
    source.write_text(text.replace(begin, begin + BUSY), encoding="utf-8")
    entries = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    (entry,) = [one for one in entries if one["file"] == str(ALGORITHM)]
    words = shlex.split(entry["command"])
    compiled = source.with_suffix(".obj")
    words[words.index("-c") + 1] = str(source)
    words[words.index("-o") + 1] = str(compiled)
    words.append(f"-ffile-prefix-map={folder}=src/wheel_control/algorithms")
    subprocess.run(words, check=True, cwd=entry["directory"], timeout=60)
    link = link_command()
    image = folder / "weeding_robot"
    link[link.index("-o") + 1] = f"{image}.elf"
    # The slower module must be before the library, because the library also contains this module.
    link.insert(link.index("-o"), str(compiled))
    subprocess.run(link, check=True, cwd=BUILD, timeout=60)
    words = ["arm-none-eabi-objcopy", "-O", "binary", f"{image}.elf", f"{image}.bin"]
    subprocess.run(words, check=True, timeout=60)
    return image


def rows(image: Path, folder: Path) -> dict[str, float]:
    """Returns the number of instructions of each module in a cycle."""
    scenario, output = folder / "few.scenario", folder / "bench.json"
    scenario.write_text(FEW, encoding="utf-8")
    words: list[str | Path] = [BOARD, "--image", f"{image}.bin", "--scenario", scenario]
    words += ["--bench", output, "--profile"]
    subprocess.run(words, check=True, timeout=120, stdout=subprocess.DEVNULL)
    raw = json.loads(output.read_text(encoding="utf-8"))
    counts = {int(address): tuple(pair) for address, pair in raw["profile"].items()}
    found = profile_of(counts, frames_of(image.with_suffix(".elf"), counts))
    return {name: whole for name, whole, _ in found.modules}


def test_a_slowed_algorithm_shows_in_its_row(tmp_path: Path) -> None:
    before = rows(BUILD / "weeding_robot_paper", tmp_path)
    after = rows(slowed(tmp_path), tmp_path)
    more = {name: count - before.get(name, 0) for name, count in after.items()}
    assert max(more, key=lambda name: more[name]) == "VelocityAlgorithm"
    # There are four wheels, and at least three instructions in each iteration.
    assert more["VelocityAlgorithm"] > 4 * 1000 * 3
    others = sum(abs(count) for name, count in more.items() if name != "VelocityAlgorithm")
    assert others < more["VelocityAlgorithm"] / 10


def test_a_board_on_a_line_is_measured(tmp_path: Path) -> None:
    for paper in SCENARIOS:
        file = tmp_path / FOLDER / f"{paper.name}.scenario"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text((ROOT / FOLDER / file.name).read_text(encoding="utf-8"))
    link = tmp_path / "line"
    words: list[str | Path] = [BOARD, "--robot", "--image", BUILD / "weeding_robot.bin"]
    words += ["--link", link]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL) as board:
        try:
            end = time.monotonic() + 20
            while not link.exists() and time.monotonic() < end:
                time.sleep(0.05)
            assert bench.on_board(tmp_path, link, 2) == 0
        finally:
            board.terminate()
    record = read_record(tmp_path / BENCH, Record)
    assert record is not None
    for paper in SCENARIOS:
        found = record[paper.name].runs[bench.BOARD]
        assert found.cycles >= 5
        assert 0.05 < found.report_ms.average < 5
        assert 0 < found.load.average < 100
