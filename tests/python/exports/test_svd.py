"""The CMSIS-SVD file fits the schema of Arm. Its addresses equal the addresses in the firmware."""

import re
from pathlib import Path

import pytest
from cmsis_svd.model import SVDDevice
from cmsis_svd.parser import SVDParser

from traceability.exports.svd import svd_of, write_svd
from traceability.reading.register_table import TABLE, read_registers

pytestmark = pytest.mark.reads("src/k64/registers.hpp", "sim/emulator/Blocks.hpp")

ROOT = Path(__file__).parents[3]
# The table in this file was written from the manual, independently of the firmware.
BLOCKS = ROOT / "sim/emulator/Blocks.hpp"
BLOCK = re.compile(r'\{"(\w+)", (0x[0-9A-F]{8}), \d')
REGISTER = re.compile(r"Register<std::uint(\d+)_t, (0x[0-9A-F]+).*> \w+;")


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> SVDDevice:
    path = tmp_path_factory.mktemp("svd") / "a.svd"
    write_svd(ROOT, path)
    return SVDParser.for_xml_file(str(path)).get_device()


def schema_finds(text: str) -> str:
    fits, found = SVDParser.validate_xml_str(
        text.encode(), schema_version="1.3.9", schema_version_detection=False
    )
    assert fits == (found == "")
    return found


def test_it_fits_the_schema() -> None:
    assert schema_finds(svd_of(read_registers(ROOT))) == ""


def test_what_does_not_fit_the_schema_is_refused() -> None:
    text = svd_of(read_registers(ROOT)).replace("<size>16</size>", "<size>sixteen</size>", 1)
    assert "sixteen" in schema_finds(text)


def test_each_register_of_the_firmware_has_its_address_and_its_size(device: SVDDevice) -> None:
    text = (ROOT / TABLE).read_text()
    of_firmware = {(int(address, 16), int(bits)) for bits, address in REGISTER.findall(text)}
    assert len(of_firmware) == text.count("inline constexpr Register<")
    shown = {
        (block.base_address + register.address_offset, register.size)
        for block in device.peripherals
        if block.derived_from is None
        for register in block.registers
    }
    assert shown == of_firmware


def test_each_block_is_where_the_manual_has_it(device: SVDDevice) -> None:
    of_manual = {name: int(base, 16) for name, base in BLOCK.findall(BLOCKS.read_text())}
    shown = {block.name: block.base_address for block in device.peripherals}
    common = shown.keys() & of_manual.keys()
    assert {"PORTE", "UART4", "ADC1", "FTM0", "WDOG"} < common
    upper = {"SIM": 0x1000}  # The firmware uses only registers in the second half of this block.
    for name in common:
        assert shown[name] == of_manual[name] + upper.get(name, 0), name


def test_bits_have_their_names(device: SVDDevice) -> None:
    (uart,) = (block for block in device.peripherals if block.name == "UART0")
    (status,) = (register for register in uart.registers if register.name == "S1")
    assert {field.name: field.bit_offset for field in status.fields} == {
        "FE": 1,
        "OR": 3,
        "RDRF": 5,
        "TDRE": 7,
    }
