"""The bring-up with the robot in Python: all steps without a fault, steps with a fault, and the
record of the bring-up."""

import argparse
import json
import os
import pty
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from weeding_robot_client import bring_up, exit_codes
from weeding_robot_client.bring_up import BringUp, Motion, Record, Step, choose_link, perform
from weeding_robot_client.link import Link
from weeding_robot_client.operators import Control, OperatorError, SimulatedOperator

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]
STEPS = 20
STEPS_OF_RC = 4
WHEEL_0 = "wheel 0, front left"


@pytest.fixture(autouse=True)
def _quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shortens the times of the bring-up. The robot in Python has no inertia, so shorter times are
    sufficient."""
    monkeypatch.setattr(bring_up, "OBSERVE_S", 0.2)
    monkeypatch.setattr(bring_up, "WHEEL_S", 0.5)
    monkeypatch.setattr(SimulatedOperator, "patience_s", 1.0)


@pytest.fixture
def images(tmp_path: Path) -> Path:
    """Returns a folder with a firmware image. The robot in Python reports the build id of this
    image."""
    folder = tmp_path / "k64"
    folder.mkdir()
    (folder / "weeding_robot.bin").write_bytes(b"code 0123abcd code")
    return folder


class First(BringUp):
    """A bring-up that ends after the step ``last``."""

    last = ""

    def steps(self) -> list[Step]:
        steps = super().steps()
        names = [step.name for step in steps]
        return steps[: names.index(self.last) + 1] if self.last else steps


def go(
    mcu: Any,
    control: Path,
    images: Path,
    *,
    has_rc: bool = True,
    volts: float = 24.0,
    last: str = "",
) -> Record:
    """Executes all steps, or the steps up to the step ``last``. A simulated operator answers."""
    record = Record("2026-01-01T00:00:00", str(mcu.path), simulated=True)
    operator = SimulatedOperator(Control(control), volts)
    with Link(mcu.path) as link:
        steps = First(link, operator, images, has_rc)
        steps.last = last
        perform(steps, record)
    return record


def verdicts(record: Record) -> dict[str, str]:
    return {step.step: step.verdict for step in record.steps}


def step(record: Record, name: str) -> Any:
    return next(step for step in record.steps if step.step == name)


def test_a_robot_without_fault_passes_every_step(mcu: Any, control: Path, images: Path) -> None:
    record = go(mcu, control, images)
    assert set(verdicts(record).values()) == {"pass"}, verdicts(record)
    assert record.passed
    assert record.firmware == "firmware 1.2.3 build 0123abcd"
    assert len(record.steps) == STEPS
    assert not mcu.stop


def test_no_wheel_turns_before_the_emergency_stop_has_passed(
    mcu: Any, control: Path, images: Path
) -> None:
    mcu.estop_wired = False
    record = go(mcu, control, images, has_rc=False)
    assert step(record, "emergency stop").verdict == "fail"
    assert "Connect no motor" in step(record, "emergency stop").advice
    assert "./wr flash --product weeding_robot" in step(record, "emergency stop").advice
    assert "needs: emergency stop" in step(record, WHEEL_0).seen
    ordered = [frame.payload[8:20] for frame in mcu.of_kind(0x04)]
    assert ordered
    assert not any(any(wheels) for wheels in ordered)
    assert not record.passed


def test_no_wheel_turns_without_confirmation(
    mcu: Any, control: Path, images: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SimulatedOperator, "confirm", lambda *_: False)
    record = go(mcu, control, images, has_rc=False)
    assert step(record, "wheels off the ground").verdict == "fail"
    assert all(wheel.turns == 0 for wheel in mcu.wheels)


def test_the_motors_are_connected_while_the_emergency_stop_is_pressed(
    mcu: Any, control: Path, images: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pressed = []

    def confirm(*_: Any) -> bool:
        pressed.append(mcu.estop)
        return True

    monkeypatch.setattr(SimulatedOperator, "confirm", confirm)
    name = "wheels off the ground"
    record = go(mcu, control, images, has_rc=False, last=name)
    assert pressed == [True] * 3
    assert step(record, name).seen == "confirmed; acknowledged: armed"
    assert not mcu.estop


@pytest.mark.parametrize(
    ("fault", "finding"),
    [
        ({"leads_swapped": True}, "the motor leads are swapped"),
        ({"hall_swapped": True}, "the Hall wires are swapped"),
        (
            {"leads_swapped": True, "hall_swapped": True},
            "the motor leads and the Hall wires are swapped",
        ),
        ({"hall_dead": True}, "its Hall sensors had no edges"),
        ({"blocked": True}, "no motion"),
        ({"current_reversed": True}, "the current has the wrong sign"),
    ],
)
def test_a_wheel_that_is_connected_wrongly_is_found_out(
    mcu: Any, control: Path, images: Path, fault: dict[str, bool], finding: str
) -> None:
    for name, value in fault.items():
        setattr(mcu.wheels[1], name, value)
    record = go(mcu, control, images, has_rc=False, last="wheel 1, front right")
    failed = [name for name, verdict in verdicts(record).items() if verdict != "pass"]
    assert failed == ["wheel 1, front right"]
    wheel = step(record, "wheel 1, front right")
    assert finding in wheel.seen
    assert wheel.advice


@pytest.mark.parametrize(
    ("fault", "finding"),
    [
        ("steering_reversed", "the steering turns in the wrong direction"),
        ("steering_stuck", "the steering does not follow"),
    ],
)
def test_a_steering_that_is_connected_wrongly_is_found_before_a_wheel_turns(
    mcu: Any, control: Path, images: Path, fault: str, finding: str
) -> None:
    mcu.angle = 80
    setattr(mcu, fault, True)
    record = go(mcu, control, images, has_rc=False, last=WHEEL_0)
    failed = [name for name, verdict in verdicts(record).items() if verdict != "pass"]
    assert failed == ["steering", WHEEL_0]
    steering = step(record, "steering")
    assert "ordered to the left" in steering.seen
    assert finding in steering.seen
    assert "steering motor" in steering.advice
    assert not mcu.latched


def test_a_steering_that_misses_its_angle_fails(
    mcu: Any, control: Path, images: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bring_up, "STEERING_S", 0.3)
    mcu.steering_speed = 1
    record = go(mcu, control, images, has_rc=False, last="steering")
    assert "instead of 5.0 degrees" in step(record, "steering").seen


def test_the_front_wheels_must_turn_as_the_reported_angle(
    mcu: Any, control: Path, images: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SimulatedOperator, "confirm", lambda _, text, __: "Did the" not in text)
    steering = step(go(mcu, control, images, has_rc=False, last="steering"), "steering")
    assert steering.verdict == "fail"
    assert "the front wheels do not" in steering.seen
    assert "exchange the two leads of one winding" in steering.advice


def test_the_steering_gets_no_order_to_turn_before_its_step(
    mcu: Any, control: Path, images: Path
) -> None:
    mcu.angle = -310
    mcu.steering_stuck = True
    record = go(mcu, control, images, last="wheels off the ground")
    assert record.passed, verdicts(record)
    assert mcu.armed
    assert {frame.payload[6:8] for frame in mcu.of_kind(0x04)} <= {
        (0).to_bytes(2, "little"),
        (-310).to_bytes(2, "little", signed=True),
    }


def test_an_earlier_protective_stop_does_not_hide_the_emergency_stop(
    mcu: Any, control: Path, images: Path
) -> None:
    mcu.latched = 2  # steering fault
    assert go(mcu, control, images, has_rc=False, last="emergency stop").passed


def test_only_the_wheel_of_the_step_gets_1_volt(mcu: Any, control: Path, images: Path) -> None:
    go(mcu, control, images, has_rc=False)
    driven = set()
    for frame in mcu.of_kind(0x04):
        points = [frame.payload[8 + 3 * n : 11 + 3 * n] for n in range(4)]
        moving = [(n, point) for n, point in enumerate(points) if point[1:] != b"\0\0"]
        assert len(moving) <= 1
        driven.update(moving)
    assert driven == {(n, b"\1" + (1000).to_bytes(2, "little")) for n in range(4)}


def motion(**values: Any) -> Motion:
    usual = {"wheel": 0, "counts": 12, "amperes": 0.3, "others": ()}
    return Motion(**{**usual, "saw_forward": True, "stop": None, **values})


@pytest.mark.parametrize(
    ("values", "finding"),
    [
        ({"counts": 0, "others": ("rear left",)}, "the wrong wheel moved: rear left"),
        ({"others": ("rear left",)}, "other wheels also moved: rear left"),
        ({"saw_forward": None}, "did not see this wheel turn"),
        ({"counts": 2, "saw_forward": None}, "no motion"),
        ({"amperes": -0.2}, "wrong sign"),
    ],
)
def test_findings_about_cables(values: dict[str, Any], finding: str) -> None:
    found = motion(**values).fault()
    assert found is not None
    assert finding in found[0]


def test_a_small_current_has_no_sign() -> None:
    assert motion(amperes=-0.1).fault() is None
    assert motion(counts=3).fault() is None


def test_a_receiver_that_keeps_the_last_pulses_fails(mcu: Any, control: Path, images: Path) -> None:
    mcu.hold_last = True
    name = "remote control: transmitter off"
    off = step(go(mcu, control, images, last=name), name)
    assert off.verdict == "fail"
    assert "fail-safe of the receiver" in off.advice
    assert mcu.transmitter  # The transmitter is on again for the steps that follow.


def test_a_product_without_remote_control_has_no_steps_for_it(
    mcu: Any, control: Path, images: Path
) -> None:
    record = go(mcu, control, images, has_rc=False)
    assert record.passed
    assert len(record.steps) == STEPS - STEPS_OF_RC


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        ({"left_end": True}, ("left end stop", "although nobody presses it")),
        ({"angle": 3400}, ("analog inputs", "steering angle is 34.0")),
        ({"start": (4, 0, 0, 0)}, ("reset cause", "watchdog")),
        ({"start": (7, 1, 3, 0)}, ("reset cause", "assertion 3")),
    ],
)
def test_an_input_that_is_wrong_fails_its_step(
    mcu: Any, control: Path, images: Path, change: dict[str, Any], wrong: tuple[str, str]
) -> None:
    for field, value in change.items():
        setattr(mcu, field, value)
    name, seen = wrong
    found = step(go(mcu, control, images, last=name), name)
    assert found.verdict == "fail"
    assert seen in found.seen


@pytest.mark.parametrize(("volts", "verdict"), [(20.9, "fail"), (21.0, "pass"), (29.1, "fail")])
def test_the_supply_has_bounds(
    mcu: Any, control: Path, images: Path, volts: float, verdict: str
) -> None:
    assert step(go(mcu, control, images, volts=volts, last="supply"), "supply").verdict == verdict


def test_an_image_of_another_build_fails(mcu: Any, control: Path, images: Path) -> None:
    (images / "weeding_robot.bin").write_bytes(b"code 99999999 code")
    image = step(go(mcu, control, images, last="image"), "image")
    assert image.verdict == "fail"
    assert "./wr flash" in image.advice


def test_without_connection_every_step_that_needs_it_is_skipped(
    mcu: Any, control: Path, images: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("weeding_robot_client.orders.CONNECT_WITHIN_S", 0.3)
    mcu.silent = True
    record = go(mcu, control, images)
    found = verdicts(record)
    assert found.pop("connection") == "fail"
    assert found.pop("supply") == "pass"
    assert set(found.values()) == {"skip"}


def options(mcu: Any, control: Path, folder: Path, **more: Any) -> argparse.Namespace:
    usual = {"link": mcu.path, "record": folder, "no_rc": True, "simulated": True}
    return argparse.Namespace(**{**usual, "control": control, **more})


def test_the_record_is_written_as_json_and_markdown(
    mcu: Any, control: Path, images: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(BringUp.__init__, "__defaults__", (images, True))
    folder = tmp_path / "records"
    assert bring_up.run(options(mcu, control, folder)) == 0
    (data,) = folder.glob("*.json")
    (page,) = folder.glob("*.md")
    content = json.loads(data.read_text())
    assert content["passed"]
    assert content["simulated"]
    assert {step["verdict"] for step in content["steps"]} == {"pass"}
    assert "| emergency stop |" in page.read_text()
    assert "all steps passed" in page.read_text()


def test_a_step_that_fails_gives_exit_code_1(mcu: Any, control: Path, tmp_path: Path) -> None:
    mcu.left_end = True
    assert bring_up.run(options(mcu, control, tmp_path)) == 1
    assert "at least one step did NOT pass" in next(tmp_path.glob("*.md")).read_text()


def test_the_simulated_operator_refuses_a_real_port(
    mcu: Any, control: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    port = tmp_path / "ttyACM0"
    port.touch()
    assert bring_up.run(options(mcu, control, tmp_path, link=port)) == 2
    assert "is not the link of a simulator" in capsys.readouterr().err


def test_a_missing_simulator_is_explained(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert bring_up.run(options(mcu, tmp_path / "none", tmp_path)) == exit_codes.MISSING
    assert "./wr sim" in capsys.readouterr().err


def test_an_action_that_the_simulator_refuses_is_an_error(control: Path) -> None:
    operator = Control(control)
    with pytest.raises(OperatorError, match="rejected 'fly'"):
        operator.do("fly")
    operator.close()


def test_a_bring_up_by_a_person_needs_a_terminal(tmp_path: Path) -> None:
    words = [sys.executable, "-m", "tools", "bring-up", "--record", str(tmp_path)]
    ended = subprocess.run(
        words, cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 2
    assert "run it in a terminal" in ended.stderr


@pytest.mark.parametrize(
    ("ports", "chosen", "words"),
    [([], None, "no board found"), (["a"], "a", ""), (["a", "b"], None, "--link b")],
)
def test_the_port_of_the_only_board_is_chosen(
    ports: list[str],
    chosen: str | None,
    words: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(bring_up, "find_port", lambda: [Path(port) for port in ports])
    assert choose_link(None) == (Path(chosen) if chosen else None)
    assert words in capsys.readouterr().err
    assert choose_link(Path("c")) == Path("c")


class Person:
    """A person at a terminal in which ``./wr bring-up`` runs."""

    def __init__(self, mcu: Any, folder: Path) -> None:
        self.keys, self._inner = pty.openpty()
        words = ["bring-up", "--no-rc", "--link", str(mcu.path), "--record", str(folder)]
        self.program = subprocess.Popen(
            [sys.executable, "-m", "tools", *words],
            cwd=ROOT, stdin=self._inner, stdout=self._inner, stderr=self._inner,
            env={**os.environ, "PYTHONPATH": f"{ROOT}:{ROOT / 'client'}"},
        )  # fmt: skip
        self.shown = b""

    def reads(self, text: str, seconds: float = 15.0) -> None:
        """Reads the output of the program until a text is found. The next call begins its search
        after this text."""
        end = time.monotonic() + seconds
        while text.encode() not in self.shown:
            assert time.monotonic() < end, self.shown.decode()
            if select.select([self.keys], [], [], 0.1)[0]:
                self.shown += os.read(self.keys, 4096)
        self.shown = self.shown.partition(text.encode())[2]

    def types(self, text: str) -> None:
        os.write(self.keys, f"{text}\n".encode())

    def close(self) -> None:
        self.program.kill()
        self.program.wait()
        os.close(self._inner)
        os.close(self.keys)


def test_a_person_is_led_and_ctrl_c_stops_the_robot(mcu: Any, tmp_path: Path) -> None:
    person = Person(mcu, tmp_path)
    try:
        person.reads("Volts")
        person.types("ab")
        person.reads("is not a number")
        person.types("24.5")
        person.reads("PASS: 24.5 V")
        person.reads("press the left end stop by hand")
        person.types("")
        mcu.left_end = True
        person.reads("release the left end stop")
        person.types("")
        mcu.left_end = False
        person.reads("PASS: seen pressed and released")
        person.reads("press the right end stop by hand")
        person.types("s")
        person.reads("SKIP: skipped by the operator")
        person.reads("press the emergency stop")
        person.types("")
        time.sleep(0.2)
        assert not mcu.latched
        mcu.control("estop press")
        person.reads("release the emergency stop")
        mcu.control("estop release")
        person.types("")
        person.reads("PASS: pressed: stopped; released: still stopped; acknowledged: armed")
        person.types("")
        person.reads("off the ground, and is the robot secured? [yes/no]")
        person.types("")
        # The program asks again.
        person.reads("off the ground, and is the robot secured? [yes/no]")
        person.program.send_signal(signal.SIGINT)
        assert person.program.wait(10) == 130
    finally:
        person.close()
    assert mcu.stop
    content = json.loads(next(tmp_path.glob("*.json")).read_text())
    found = {step["step"]: step["verdict"] for step in content["steps"]}
    assert (found["supply"], found["left end stop"]) == ("pass", "pass")
    assert (found["right end stop"], found[WHEEL_0]) == ("skip", "not done")
    assert not content["passed"]


def test_a_folder_that_cannot_be_made_is_wrong_usage(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    parser = argparse.ArgumentParser()
    bring_up.add_options(parser)
    plain = tmp_path / "plain"
    plain.touch()
    with pytest.raises(SystemExit) as ended:
        parser.parse_args(["--record", str(plain / "folder")])
    assert ended.value.code == 2
    assert f"cannot create {plain / 'folder'}: Not a directory" in capsys.readouterr().err
    assert parser.parse_args(["--record", str(tmp_path / "new")]).record.is_dir()
