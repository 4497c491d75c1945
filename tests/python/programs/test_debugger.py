"""GDB with the virtual board. The firmware runs, stops, and goes back in time."""

import re
import shutil
import signal
import socket
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Timer

import pytest

ROOT = Path(__file__).parents[3]
PROGRAM = ROOT / "build" / "host" / "sim" / "weeding_robot_board"
IMAGE = ROOT / "build" / "k64_calls" / "weeding_robot.bin"
ELF = IMAGE.with_suffix(".elf")
SCENARIO = ROOT / "sim" / "scenario" / "examples" / "velocity_step.scenario"
GDB = shutil.which("gdb-multiarch") or shutil.which("arm-none-eabi-gdb")
CYCLE = "wr::MainController::cycle"
PULSES = "wr::MainController::clockPulse"
FLUSH = "maintenance flush register-cache"

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(GDB is None, reason="there is no GDB for Arm"),
    pytest.mark.runs_tools,
]


@pytest.fixture(scope="module", autouse=True)
def built(build: Callable[..., None]) -> None:
    build("host", "weeding_robot_board")
    build("k64_calls", "weeding_robot")


Board = subprocess.Popen[str]


@pytest.fixture
def start() -> Iterator[Callable[..., tuple[Board, str]]]:
    """Yields a function that starts the board with a port for a debugger. The function returns the
    board and the port."""
    started: list[Board] = []

    def run(*options: str | Path) -> tuple[Board, str]:
        words = [PROGRAM, "--image", IMAGE, "--elf", ELF, "--gdb", "0", *options]
        board = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
        started.append(board)
        assert board.stdout is not None
        line = board.stdout.readline()
        assert line.startswith("GDB: tcp:127.0.0.1:")
        return board, line.rpartition(":")[2].strip()

    yield run
    for board in started:
        board.kill()
        board.wait()


def gdb_words(port: str, *commands: str) -> list[str]:
    assert GDB is not None
    first = (
        "set pagination off",
        "set confirm off",
        f"directory {IMAGE.parent}",
        f"target remote :{port}",
    )
    words = [GDB, "-q", "-nx", "-batch"]
    for command in (*first, *commands):
        words += ["-ex", command]
    return [*words, str(ELF)]


def gdb(port: str, *commands: str) -> str:
    done = subprocess.run(
        gdb_words(port, *commands),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def instants(text: str) -> list[tuple[float, int]]:
    """Returns the answers of `monitor time`. Each answer has a time in ms and a number of
    instructions."""
    found = re.findall(r"^([\d.]+) ms, (\d+) instructions", text, re.MULTILINE)
    return [(float(ms), int(count)) for ms, count in found]


def values(text: str) -> list[str]:
    """Returns the printed values of expressions."""
    return re.findall(r"^\$\d+ = (.+)", text, re.MULTILINE)


Start = Callable[..., tuple[Board, str]]


def test_it_stops_before_the_first_instruction_and_at_a_function(start: Start) -> None:
    board, port = start("--scenario", SCENARIO)
    text = gdb(port, "monitor time", f"break {CYCLE}", "continue", "monitor time", "bt", "kill")
    begin, stopped = instants(text)
    assert begin == (0.0, 0)
    assert 100 < stopped[0] < 120  # The first clock pulse occurs 100 ms after the start.
    assert re.search(r"Breakpoint 1, .*MainController::cycle", text)
    assert re.search(r"^#\d+ +<signal handler called>", text, re.MULTILINE)
    # The debugger unwinds the stack through the exception.
    assert re.search(r"^#\d+ .*resetHandler", text, re.MULTILINE)
    assert board.wait(10) == 0


def test_steps_go_forwards_and_back_to_the_same_state(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    look = ("monitor time", "p $pc", "p $sp", "p $r0", "p $xpsr")
    text = gdb(
        port, f"break {CYCLE}", "continue", *look, "stepi 7", *look, "reverse-stepi 7", *look
    )
    first, later, again = instants(text)
    seen = values(text)
    assert later[1] == first[1] + 7
    assert again == first
    assert seen[:4] == seen[8:]
    assert seen[0] != seen[4]


def test_reverse_continue_finds_the_stop_before(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *(f"break {CYCLE}", "continue", "monitor time", "continue", "monitor time"),
        *("reverse-continue", "monitor time", "reverse-continue", "monitor time"),
    )
    first, second, back, begin = instants(text)
    assert second[0] - first[0] == pytest.approx(100, abs=1)
    assert back == first
    assert begin == (0.0, 0)
    assert "No more reverse-execution history" in text


def test_lines_are_stepped_in_both_directions(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *("break wr::MainController::holdSystems", "continue", "finish", "next"),
        *("monitor time", "reverse-next", "monitor time"),
    )
    later, earlier = instants(text)
    assert earlier[1] < later[1]


def test_a_variable_is_watched(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    word = "*(unsigned*)$word"
    text = gdb(
        port,
        *(f"break {PULSES}", "continue", "delete", "up", "down"),
        "set $word = $sp - 8",
        *(f"watch -l {word}", "continue", "monitor time", f"p {word}"),
        *("continue", "monitor time", f"p {word}", "reverse-continue", "monitor time"),
    )
    assert "Hardware watchpoint 2" in text
    first, second, back = instants(text)
    changes = re.findall(r"Old value = (\d+)\nNew value = (\d+)", text)
    assert len(changes) == 3
    assert changes[0][1] == changes[1][0]
    # The program runs backwards. Therefore the same change leads from the new to the old value.
    assert changes[2] == changes[1][::-1]
    assert first[1] < second[1]
    assert first[1] <= back[1] < second[1]


@pytest.mark.parametrize("kind", ["rwatch", "awatch"])
def test_a_read_is_watched(start: Start, kind: str) -> None:
    _, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *(f"break {CYCLE}", "continue", "delete", "set $object = $r0"),
        *(f"{kind} *(unsigned*)($object + 8)", "continue", "monitor time", "x/i $pc"),
    )
    assert f"Hardware {'read' if kind == 'rwatch' else 'access (read/write)'} watchpoint" in text
    assert re.search(r"^Value = ", text, re.MULTILINE)


def test_registers_and_memory_are_read_and_written(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *(f"break {CYCLE}", "continue"),
        *("set $r3 = 0x12345678", "p/x $r3", "set $d1 = 1.5", "p $s3", "p $d1"),
        *("set *(unsigned*)0x2002fff0 = 0xabcdef01", "p/x *(unsigned*)0x2002fff0"),
        *("stepi", "reverse-stepi", "p/x *(unsigned*)0x2002fff0", "p/x $r3"),
        *("reverse-continue", "p/x *(unsigned*)0x2002fff0 == 0xabcdef01"),
        *("p/x *(unsigned*)0xe000ed00", "p/x *(unsigned*)0x40048038 != 0"),
    )
    seen = values(text)
    assert seen[0] == "0x12345678"
    assert seen[2] == "1.5"
    assert seen[3:6] == ["0xabcdef01", "0xabcdef01", "0x12345678"]
    # The reverse run has undone the write. CPUID is that of a Cortex-M4. A clock gate is open.
    assert seen[6:] == ["0x0", "0x410fc241", "0x1"]


def test_a_read_with_an_effect_is_refused(start: Start) -> None:
    """The data register of UART0 returns its byte only once. The debugger therefore does not read
    this register."""
    _, port = start("--scenario", SCENARIO)
    words = gdb_words(port, f"break {CYCLE}", "continue", "x/1xb 0x4006a002", "x/1xb 0x4006a007")
    done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert re.search(r"^0x4006a002:\t0x", done.stdout, re.MULTILINE)
    assert "Cannot access memory at address 0x4006a007" in done.stderr


def test_monitor_goes_to_a_time_and_back_to_the_start(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *("monitor run-to 700", FLUSH, "p $pc", "monitor run-to 300.5", FLUSH),
        *("monitor run-to 700", FLUSH, "p $pc", "monitor reset", FLUSH, "monitor time"),
    )
    times = instants(text)
    assert [ms for ms, _ in times] == pytest.approx([700, 300.5, 700, 0, 0], abs=1)
    assert times[0] == times[2]
    at_700, again = values(text)
    assert again == at_700


def test_the_end_of_a_run_leads_back(start: Start) -> None:
    board, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *("continue", "monitor time", f"break {CYCLE}", "reverse-continue", "monitor time"),
        *("delete", "continue", "continue"),
    )
    end, before = instants(text)
    assert 0 < end[0] - before[0] < 200
    assert "[Inferior 1 (Remote target) exited normally]" in text
    assert board.wait(10) == 0


def test_a_finding_stops_and_leads_back_to_its_cause(start: Start) -> None:
    board, port = start("--scenario", SCENARIO)
    text = gdb(
        port,
        *(f"break {CYCLE}", "continue", "monitor time", "delete"),
        *("set $pc = 0x30000000", "continue", "reverse-stepi", "monitor time"),
    )
    assert "SIGSEGV" in text
    assert instants(text)[1][1] == pytest.approx(instants(text)[0][1], abs=1)
    assert board.poll() is None or board.wait() in (0, 4)


def test_the_time_stands_still_while_the_program_is_stopped(start: Start) -> None:
    """Ctrl-C in the debugger stops a robot that runs in real time. While the program is stopped,
    the time of the robot does not pass."""
    _, port = start("--robot", "--uart0", "tcp:0")
    words = gdb_words(
        port,
        "python import os, threading, signal",
        "python import time",
        "python threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()",
        "continue",
        "monitor time",
        "shell sleep 1",
        "monitor time",
        "stepi",
        "monitor time",
    )
    done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert "SIGINT" in done.stdout, done.stdout + done.stderr
    stopped, waited, stepped = instants(done.stdout + done.stderr)
    assert stopped == waited
    assert 0 < stopped[0] <= stepped[0] < stopped[0] + 2


def test_bytes_of_the_pc_come_again_at_the_same_instant(start: Start) -> None:
    """A restarted run gets the input of the first run, although the PC sends nothing more."""
    board, port = start("--robot", "--uart0", "tcp:0")
    assert board.stdout is not None
    line = board.stdout.readline()
    assert line.startswith("PC link: tcp:127.0.0.1:")
    commands = (
        *("monitor run-to 500", FLUSH, "break wr::K64Uart::receive"),
        *("continue", "continue", "continue", "monitor time"),
        *("reverse-continue", "monitor time", "monitor reset", FLUSH),
        *("continue", "continue", "monitor time", "continue", "monitor time"),
    )
    words = gdb_words(port, *commands)
    shown = []
    with (
        socket.create_connection(("127.0.0.1", int(line.rpartition(":")[2])), timeout=5) as pc,
        subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as run,
    ):
        assert run.stdout is not None
        guard = Timer(40, run.kill)
        guard.start()
        for said in run.stdout:
            shown.append(said)
            if len(instants("".join(shown))) == 1 and instants(
                said
            ):  # The port of the board is open.
                for number in range(3):  # Each byte causes its own interrupt.
                    Timer(0.2 * number, pc.sendall, [b"x"]).start()
    guard.cancel()
    _, third, second, start_again, second_again, third_again = instants("".join(shown))
    assert 0 < second[0] < third[0]
    assert start_again == (0.0, 0)
    assert (second_again, third_again) == (second, third)


def received(line: socket.socket, count: int) -> bytes:
    return b"".join(line.recv(1) for _ in range(count))


def test_a_damaged_packet_is_asked_for_again(start: Start) -> None:
    _, port = start("--scenario", SCENARIO)
    with socket.create_connection(("127.0.0.1", int(port)), timeout=5) as line:
        line.sendall(b"$qAttached#00")
        assert line.recv(1) == b"-"
        line.sendall(b"$qAttached#8f")
        assert received(line, 6) == b"+$1#31"
        line.sendall(b"-")
        assert received(line, 5) == b"$1#31"


def test_ctrl_c_in_the_terminal_of_the_board_ends_it_also_while_it_waits(start: Start) -> None:
    board, _ = start("--scenario", SCENARIO)
    board.send_signal(signal.SIGINT)
    assert board.wait(5) == 0
