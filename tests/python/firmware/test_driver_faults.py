"""Seeded faults in drivers. For each fault, a test changes a copy of the sources. On the virtual
K64, the firmware with this fault stops with a finding."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.firmware.contents import BUILD, ROOT
from tests.python.firmware.seeding import FOUND, Change, Program, driven, link_once
from tools.cmake_build import build
from traceability.sources import source_hash

# A calculation with floating-point numbers, at the start of the cycle timer.
CALCULATION = Change(
    "K64Pit.cpp",
    "  stop();\n  const auto ticks",
    "  stop();\n  volatile float ratio = 1.5F;\n  ratio = ratio * ratio;\n  const auto ticks",
)

# fault -> the expected finding, and the changes of the sources. The first change is in the driver
# with the fault.
FAULTS: dict[str, tuple[str, tuple[Change, ...]]] = {
    "clock gate of UART0 left closed": (
        "clock-gate",
        (Change("K64Board.cpp", "  sim::SCGC4.set(sim::SCGC4_UART0);\n", ""),),
    ),
    "clock gate of the PIT left closed": (
        "clock-gate",
        (Change("K64Board.cpp", "sim::SCGC6_PIT | ", ""),),
    ),
    "clock gate of port E left closed": (
        "clock-gate",
        (
            Change(
                "K64Board.cpp",
                "sim::SCGC5_PORTD |\n                 sim::SCGC5_PORTE",
                "sim::SCGC5_PORTD",
            ),
        ),
    ),
    "clock gate of FTM0 left closed": (
        "clock-gate",
        (Change("K64Board.cpp", "sim::SCGC6_FTM0 | ", ""),),
    ),
    "clock gate of ADC1 left closed": (
        "clock-gate",
        (Change("K64Board.cpp", "  sim::SCGC3.set(sim::SCGC3_ADC1);\n", ""),),
    ),
    "distance of the pins of a port wrong": (
        "unmodelled-register",
        (Change("K64Board.cpp", "pin.number * port::kPinDistance", "pin.number * 8U"),),
    ),
    "unlock key of the watchdog wrong": (
        "watchdog-sequence",
        (Change("K64Watchdog.cpp", "{0xD928}", "{0xD929}"),),
    ),
    "second unlock key of the watchdog missing": (
        "watchdog-sequence",
        (Change("K64Watchdog.cpp", "  wdog::UNLOCK.write({0xD928});\n", ""),),
    ),
    "watchdog configured after memory is initialised": (
        "watchdog-sequence",
        (
            Change("start_up/reset.cpp", "  wr::K64Watchdog::configure();\n", ""),
            Change(
                "start_up/reset.cpp",
                "  wr::constructObjects();\n",
                "  wr::constructObjects();\n  wr::K64Watchdog::configure();\n",
            ),
        ),
    ),
    "refresh key of the watchdog wrong": (
        "watchdog-sequence",
        (Change("K64Watchdog.cpp", "{0xB480}", "{0xB481}"),),
    ),
    "watchdog not refreshed": (
        "watchdog-missed",
        (
            Change("K64Watchdog.cpp", "  wdog::REFRESH.write({0xA602});\n", ""),
            Change("K64Watchdog.cpp", "  wdog::REFRESH.write({0xB480});\n", ""),
        ),
    ),
    "time-out of the watchdog shorter than a cycle": (
        "watchdog-missed",
        (Change("K64Watchdog.cpp", "static_cast<std::uint16_t>(kTicks)", "std::uint16_t{50}"),),
    ),
    "interrupt of the PIT not acknowledged": (
        "interrupt-storm",
        (
            Change(
                "K64Pit.cpp",
                "void K64Pit::acknowledge() {\n  pit::TFLG.at(offset()).write(pit::TFLG_TIF);\n",
                "void K64Pit::acknowledge() {\n",
            ),
        ),
    ),
    "received byte of the UART not read": (
        # The overrun is found before the repeated interrupt causes the finding interrupt-storm.
        "uart-overrun",
        (Change("K64Uart.cpp", "uart::D.at(offset()).read()", "uart::BDL.at(offset()).read()"),),
    ),
    "transmit interrupt of the UART never switched off": (
        "interrupt-storm",
        (Change("K64Uart.cpp", "    uart::C2.at(offset()).write(kReceiving);\n", ""),),
    ),
    "baud divisor wrong": (
        "uart-baud",
        (Change("K64Uart.cpp", "static_cast<std::uint8_t>(divisor.divider)", "std::uint8_t{130}"),),
    ),
    "interrupt handler of the UART too slow for its FIFO": (
        "uart-overrun",
        (
            Change(
                "K64Uart.cpp",
                "void K64Uart::serve() {\n",
                "void K64Uart::serve() {\n"
                '  for (std::uint32_t i = 0; i < 60000; ++i) {\n    asm volatile("nop");\n  }\n',
            ),
        ),
    ),
    "converter not calibrated": (
        "register-misuse",
        (Change("K64Adc.cpp", "adc::SC3_CAL | adc::SC3_AVGE | adc::SC3_AVGS_32", "{0}"),),
    ),
    "no wait for the calibration of the converters": (
        "register-misuse",
        (
            Change("K64Adc.cpp", "look < kMaxPolls &&", "look < 10 &&"),
            Change("K64Adc.cpp", "(status & (adc::SC3_CAL | adc::SC3_CALF)).any()", "false"),
        ),
    ),
    "clock of the converters too fast for their calibration": (
        "register-misuse",
        (Change("K64Adc.cpp", "adc::CFG1_ADLSMP | adc::CFG1_ADIV_8;", "adc::CFG1_ADLSMP;"),),
    ),
    "converters clocked by the alternate clock that older parts do not have": (
        "unmodelled-register",
        (Change("K64Adc.cpp", "adc::CFG1_ADICLK_BUS", "adc::CFG1.field(1, 0)"),),
    ),
    "converters calibrated at the full clock": (
        "register-misuse",
        (
            Change("start_up/reset.cpp", "  wr::platform::calibrateConverters();\n", ""),
            Change(
                "start_up/reset.cpp",
                "  wr::runRobot();\n",
                "  wr::platform::calibrateConverters();\n  wr::runRobot();\n",
            ),
        ),
    ),
    "inputs b of the converters not chosen": (
        # The firmware then reads the inputs with the suffix a of these channels.
        "unmodelled-register",
        (Change("K64Adc.cpp", "write(adc::CFG2_MUXSEL_B)", "write({0})"),),
    ),
    "result of a converter not read": (
        "interrupt-storm",
        (Change("K64Adc.cpp", "adc::RA.at(offset()).read()", "adc::PG.at(offset()).read()"),),
    ),
    "channels of the timer not set to pulses": (
        "unmodelled-register",
        (Change("K64Ftm.cpp", "ftm0::CnSC_MSB | ftm0::CnSC_ELSB", "ftm0::CnSC_ELSB"),),
    ),
    "edge of an input not acknowledged": (
        "interrupt-storm",
        (
            Change("K64Port.cpp", "    flags.write(port::ISFR.bit(number_));\n", ""),
            # Without this second change, the limit of edges would end the storm of interrupts.
            Change("K64Port.cpp", "    ++edges_;\n", ""),
        ),
    ),
    "vector of the Hall sensors missing": (
        "reset-request",
        (Change("start_up/vectors.cpp", "  lines[kHallSensorLine] = hallSensorInterrupt;\n", ""),),
    ),
    "FPU not enabled": (
        "fpu-off",
        (Change("K64Board.cpp", "  scb::CPACR.set(scb::CPACR_FPU);\n", ""), CALCULATION),
    ),
    "vector of PIT0 missing": (
        "reset-request",  # The vector leads to the handler of unexpected interrupts.
        (Change("start_up/vectors.cpp", "  lines[kCycleTimerLine] = cycleTimerInterrupt;\n", ""),),
    ),
    "vector of the main controller's thread missing": (
        "reset-request",
        (Change("start_up/vectors.cpp", "  lines[kMainThreadLine] = mainThreadInterrupt;\n", ""),),
    ),
    "vector of PIT0 empty": (
        "vector-missing",
        (Change("start_up/vectors.cpp", "= cycleTimerInterrupt;", "= nullptr;"),),
    ),
    "no wait for the PLL": (
        "register-misuse",
        (
            Change(
                "K64Board.cpp",
                "!comes(mcg::S_PLLST | mcg::S_LOCK0, mcg::S_PLLST | mcg::S_LOCK0)",
                "false",
            ),
        ),
    ),
    "clocks not divided": (
        "register-misuse",
        (Change("K64Board.cpp", "  sim::CLKDIV1.write(kDividers);\n", ""),),
    ),
    "store to flash": (
        "flash-store",
        (
            Change(
                "K64Board.cpp",
                "  faultRecord.mark = 0;\n",
                "  *reinterpret_cast<volatile std::uint32_t*>(0x8000) = 0;\n",
            ),
        ),
    ),
    "stack overflow": (
        "unmapped-memory",
        (
            Change(
                "K64Uart.cpp",
                "std::size_t K64Uart::read(std::span<std::uint8_t> bytes) {\n",
                "std::size_t K64Uart::read(std::span<std::uint8_t> bytes) {\n"
                "  volatile std::uint8_t copy[9000];\n"
                "  for (volatile std::uint8_t& byte : copy) {\n    byte = 0;\n  }\n",
            ),
        ),
    ),
}


@pytest.fixture(scope="module", autouse=True)
def program(tmp_path_factory: pytest.TempPathFactory) -> Program:
    folder = tmp_path_factory.mktemp("build")
    with (folder / "log").open("w") as log:
        build(ROOT, "k64", log, "weeding_robot_paper")
        build(ROOT, "host", log, "weeding_robot_board")
    return link_once(folder)


@pytest.fixture(scope="module")
def table() -> Iterator[dict[str, dict[str, object]]]:
    """Yields a table with the finding of each fault. If the tests of all faults ran, stores this
    table in build/results."""
    rows: dict[str, dict[str, object]] = {}
    yield rows
    for fault, row in rows.items():
        print(f"{fault:50} -> {row['finding'] or 'nothing'}")
    if rows.keys() == FAULTS.keys():
        results = ROOT / "build" / "results" / "driver_faults.json"
        results.parent.mkdir(parents=True, exist_ok=True)
        record = {"sources": source_hash(ROOT), "faults": list(rows.values())}
        results.write_text(json.dumps(record, indent=1), encoding="utf-8")


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_of_a_driver_is_found(
    tmp_path: Path, program: Program, table: dict[str, dict[str, object]], fault: str
) -> None:
    finding, changes = FAULTS[fault]
    run = driven(program.seeded(tmp_path, changes), tmp_path)
    caught = run.code == FOUND and run.finding == finding
    table[fault] = {
        "fault": fault,
        "file": f"src/k64/{changes[0].file}",
        "finding": run.finding,
        "caught": caught,
        "text": run.text,
    }
    assert caught, run.text


def test_the_image_itself_has_no_finding(tmp_path: Path) -> None:
    run = driven(BUILD / "weeding_robot_paper", tmp_path)
    assert (run.code, run.finding) == (0, ""), run.text


def test_an_image_that_is_linked_again_has_no_finding(tmp_path: Path, program: Program) -> None:
    """Verifies that linking again causes no finding. The findings in the other tests therefore come
    from the changes of the drivers."""
    run = driven(program.seeded(tmp_path, ()), tmp_path)
    assert (run.code, run.finding) == (0, ""), run.text


def test_a_calculation_with_the_fpu_on_has_no_finding(tmp_path: Path, program: Program) -> None:
    run = driven(program.seeded(tmp_path, (CALCULATION,)), tmp_path)
    assert (run.code, run.finding) == (0, ""), run.text
